//! What a path leaves, against closed forms, planted faults and brute force.

use glam::{DQuat, DVec3};
use std::f64::consts::{PI, TAU};
use std::num::NonZeroUsize;
use stepover::cutter::Cutter;
use stepover::geometry::{Cylinder, Face, Plane, Range, Side, Sphere, TriMesh, Zone};
use stepover::math::frame::Frame;
use stepover::monitor::{Cancelled, Monitor, Stage};
use stepover::toolpath::{ClPoint, Move, Rate, Role, Toolpath};
use stepover::verify::{Body, Options, SampleError, Samples, Verification, VerifyError, verify};

const UPRIGHT: Frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };

fn rectangle(x: [f64; 2], y: [f64; 2]) -> Face {
    let (u, v) = (Range::open(x[0], x[1]), Range::open(y[0], y[1]));
    Face::new(Plane { origin: DVec3::ZERO, frame: UPRIGHT, u, v }, Side::Front)
}

fn path(locations: impl IntoIterator<Item = ClPoint>) -> Toolpath {
    let cut = |to| Move { to, rate: Rate::Feed(1000.0), role: Role::Cut };
    Toolpath { moves: locations.into_iter().map(cut).collect() }
}

/// The location at which a bull-nose with the given lead along x touches the plane z = 0 at `(x, y)`.
fn on_plane(cutter: &Cutter, x: f64, y: f64, lead: f64) -> ClPoint {
    let axis = DVec3::new(libm::sin(lead), 0.0, libm::cos(lead));
    // The lowest point of the centre circle is ahead of the disc's centre, lower by R1 sin λ.
    let ahead = DVec3::new(libm::cos(lead), 0.0, -libm::sin(lead)) * cutter.center_radius;
    let contact = DVec3::new(x, y, cutter.corner_radius);
    let tip = contact - if lead == 0.0 { DVec3::ZERO } else { ahead } - axis * cutter.corner_radius;
    ClPoint { tip, axis }
}

/// Parallel lines along x with the given lines' y, in steps of `step`, lifted in between.
fn raster(cutter: &Cutter, x: [f64; 2], ys: &[f64], step: f64, lead: f64) -> Toolpath {
    let mut locations = Vec::new();
    for &y in ys {
        let count = ((x[1] - x[0]) / step).ceil() as usize;
        let at = |i: usize| on_plane(cutter, x[0] + (x[1] - x[0]) * i as f64 / count as f64, y, lead);
        let lifted = |cl: ClPoint| ClPoint { tip: cl.tip + DVec3::Z * 5.0, ..cl };
        locations.push(lifted(at(0)));
        locations.extend((0..=count).map(at));
        locations.push(lifted(at(count)));
    }
    path(locations)
}

fn judge(cutter: &Cutter, path: &Toolpath, samples: &Samples, options: &Options) -> Verification {
    verify(cutter, path, samples, options, &Stage::silent()).unwrap()
}

fn max(v: &Verification) -> f64 {
    v.statistics.max.unwrap().excess
}

fn min(v: &Verification) -> f64 {
    v.statistics.min.unwrap().excess
}

#[test]
fn ball_leaves_the_closed_forms_scallop() {
    let cutter = Cutter::ball(6.0, 30.0).unwrap();
    for spacing in [0.3_f64, 1.0, 2.0] {
        let scallop = 3.0 - (9.0 - 0.25 * spacing * spacing).sqrt();
        let ys: Vec<f64> = (0..12).map(|i| -2.03 + spacing * f64::from(i)).collect();
        let path = raster(&cutter, [-1.0, 7.0], &ys, 2.5, 0.0);
        let top = (ys[11] - spacing).min(4.0);
        let samples = Samples::of_face(&rectangle([0.0, 6.0], [0.0, top]), 0.1).unwrap();
        let options = Options { search: 2.0 * scallop, ..Options::for_height(scallop, &cutter) };
        let v = judge(&cutter, &path, &samples, &options);
        let error = v.statistics.excess_error;
        assert!(error <= options.sampling_tolerance, "{spacing}: {error}");
        assert!(
            max(&v) <= scallop + 1e-9 && scallop <= max(&v) + error + 1e-9,
            "{spacing}: {} {scallop}",
            max(&v)
        );
        // Whether or not a sample lies under a line, the deepest place is known to be at 0.
        assert!(min(&v) >= -1e-9 && min(&v) - v.statistics.gouge_error <= 0.0, "{spacing}: {}", min(&v));
        assert_eq!(v.statistics.uncut_area, 0.0);
        assert!((v.statistics.area - 6.0 * top).abs() < 1e-9);
    }
}

#[test]
fn flat_mill_leaves_a_plane_bare() {
    let cutter = Cutter::flat(10.0, 30.0).unwrap();
    let path = raster(&cutter, [0.0, 20.0], &[0.0, 9.0, 18.0], 0.5, 0.0);
    let samples = Samples::of_face(&rectangle([0.0, 20.0], [-2.0, 18.0]), 0.25).unwrap();
    let v = judge(&cutter, &path, &samples, &Options::for_height(0.01, &cutter));
    assert!(v.excess.iter().all(|t| t.abs() < 1e-9));
    assert_eq!(v.statistics.share_within, 1.0);
    assert!(v.statistics.excess_error <= 0.001, "{:?}", v.statistics);
    // Where it turns, a sharp edge could leave a sliver between any two samples.
    let mut turning = path;
    turning.moves.iter_mut().step_by(2).for_each(|m| m.to.axis = DVec3::new(1e-6, 0.0, 1.0).normalize());
    let v = judge(&cutter, &turning, &samples, &Options::for_height(0.01, &cutter));
    assert_eq!(v.statistics.excess_error, f64::INFINITY);
}

/// Height above the plane that a bull-nose leaves at the distance `y` from its straight line of contact.
///
/// The r-offset of the ellipse with semi-axes R1 and R1 sin λ that the centre circle sweeps.
fn profile(major: f64, r: f64, lead: f64, y: f64) -> f64 {
    let b = major * libm::sin(lead);
    let at = |t: f64| {
        let d = (b * b * libm::sin(t) * libm::sin(t) + major * major * libm::cos(t) * libm::cos(t)).sqrt();
        (
            major * libm::sin(t) + r * b * libm::sin(t) / d,
            b * (1.0 - libm::cos(t)) + r * (1.0 - major * libm::cos(t) / d),
        )
    };
    let (mut lo, mut hi) = (0.0, 0.5 * PI);
    for _ in 0..100 {
        let mid = 0.5 * (lo + hi);
        if at(mid).0 < y { lo = mid } else { hi = mid }
    }
    at(lo).1
}

#[test]
fn bull_nose_leaves_what_the_circle_model_misses() {
    // Lead, the circle model's stepover for 0.5 mm, and what it really leaves.
    for (degrees, stepover, left) in [(15.0, 4.7387, 0.767), (30.0, 3.8730, 0.554), (45.0, 3.5576, 0.5175)] {
        let cutter = Cutter::bull_nose(6.0, 2.0, 20.0).unwrap();
        let lead = f64::to_radians(degrees);
        let exact = profile(1.0, 2.0, lead, 0.5 * stepover);
        assert!((exact - left).abs() < 1e-3, "{degrees}: {exact}");
        let path = raster(&cutter, [-3.0, 6.0], &[0.0, stepover, 2.0 * stepover], 0.5, lead);
        let samples = Samples::of_face(&rectangle([0.0, 2.0], [0.3, 2.0 * stepover]), 0.1).unwrap();
        let options = Options { search: 1.5, sampling_tolerance: 1e-5, ..Options::for_height(0.5, &cutter) };
        let v = judge(&cutter, &path, &samples, &options);
        assert!(v.statistics.excess_error <= 1e-5, "{degrees}: {}", v.statistics.excess_error);
        assert!(max(&v) <= exact + 1e-9 && exact <= max(&v) + 1e-5, "{degrees}: {} {exact}", max(&v));
        for (sample, t) in samples.samples.iter().zip(&v.excess) {
            let y = sample.point.y;
            let nearest =
                [0.0, 1.0, 2.0].map(|k| (y - k * stepover).abs()).into_iter().fold(f64::INFINITY, f64::min);
            assert!((t - profile(1.0, 2.0, lead, nearest)).abs() < 1e-8, "{degrees} {y}: {t}");
        }
    }
}

#[test]
fn ball_in_a_hollow_cylinder_leaves_the_closed_form() {
    let (radius, r, turn) = (30.0, 5.0, 0.06_f64);
    let hollow = Cylinder::new(DVec3::ZERO, UPRIGHT, radius, [0.0, 0.6], [0.0, 4.0]).unwrap();
    let cutter = Cutter::ball(2.0 * r, 20.0).unwrap();
    let axis = DVec3::new(-0.6, -0.2, 1.0).normalize();
    let at = |k: i32, z: f64| {
        let (s, c) = libm::sincos(f64::from(k) * turn);
        ClPoint { tip: DVec3::new(c, s, 0.0) * (radius - r) + DVec3::Z * z - axis * r, axis }
    };
    let path = path((-1..12).flat_map(|k| [at(k, -1.0), at(k, 5.0), at(k, -1.0)]));
    let (c, reach) = (libm::cos(0.5 * turn) * (radius - r), radius - r);
    let exact = radius - (c + (c * c - reach * reach + r * r).sqrt());
    let samples = Samples::of_face(&Face::new(hollow, Side::Back), 0.15).unwrap();
    let v = judge(&cutter, &path, &samples, &Options::for_height(exact, &cutter));
    assert!(max(&v) <= exact + 1e-9 && exact <= max(&v) + v.statistics.excess_error, "{} {exact}", max(&v));
    assert!(v.statistics.excess_error <= exact / 10.0);
    assert!(min(&v) > -1e-9);
}

#[test]
fn a_planted_gouge_is_found_on_and_between_samples() {
    let cutter = Cutter::bull_nose(10.0, 2.0, 30.0).unwrap();
    for x in [10.0, 10.13] {
        let mut path = raster(&cutter, [0.0, 20.0], &[5.03], 0.01, 0.2);
        let station = path.moves.iter_mut().find(|m| {
            let cc = m.to.tip.x - on_plane(&cutter, x, 5.03, 0.2).tip.x;
            cc.abs() < 1e-6 && m.to.tip.z < 1.0
        });
        station.unwrap().to.tip.z -= 0.005;
        let samples = Samples::of_face(&rectangle([0.0, 20.0], [4.0, 6.0]), 0.25).unwrap();
        let options = Options { sampling_tolerance: 5e-5, ..Options::for_height(0.01, &cutter) };
        let v = judge(&cutter, &path, &samples, &options);
        let found = v.statistics.min.unwrap();
        assert!((found.excess + 0.005).abs() < 1e-4, "{x}: {found:?}");
        assert!(v.statistics.gouge_error <= 5e-5);
        assert!(found.point.distance(DVec3::new(x, 5.03, 0.0)) < 0.05, "{found:?}");
    }
}

#[test]
fn a_leaning_cutter_that_was_not_lifted_digs_in_with_its_rim() {
    let cutter = Cutter::bull_nose(10.0, 2.0, 30.0).unwrap();
    let lean = 0.1_f64;
    let location = |x: f64| ClPoint {
        tip: DVec3::new(x, 5.0, 0.0),
        axis: DVec3::new(libm::sin(lean), 0.0, libm::cos(lean)),
    };
    let samples = Samples::of_face(&rectangle([0.0, 20.0], [0.0, 10.0]), 0.2).unwrap();
    let v =
        judge(&cutter, &path([location(5.0), location(10.0)]), &samples, &Options::for_height(0.01, &cutter));
    let deep = cutter.center_radius * libm::sin(lean) + 2.0 * (1.0 - libm::cos(lean));
    let s = &v.statistics;
    assert!(-min(&v) <= deep + 1e-9 && deep <= -min(&v) + s.gouge_error + 1e-9, "{} {deep}", min(&v));
    assert!(s.gouge_error <= 0.001);
    // Deeper than there is material by the caller's word: reported as that deep.
    let shallow = Options { depth: 0.1, ..Options::for_height(0.01, &cutter) };
    assert_eq!(min(&judge(&cutter, &path([location(5.0), location(10.0)]), &samples, &shallow)), -0.1);
}

#[test]
fn the_crest_of_a_thin_wall_is_gouged_as_deep_as_it_is_shaved() {
    // A wall a tenth of a millimetre thick ends at z = 0, a little too high for a ball over its other side.
    let cutter = Cutter::ball(6.0, 20.0).unwrap();
    let wall = Frame { f: DVec3::Y, b: DVec3::Z, n: DVec3::X };
    let plane =
        Plane { origin: DVec3::ZERO, frame: wall, u: Range::open(-1.0, 1.0), v: Range::open(-5.0, 0.0) };
    let samples = Samples::of_face(&Face::new(plane, Side::Front), 0.25).unwrap();
    let over = ClPoint { tip: DVec3::new(-0.1, 0.0, -0.003), axis: DVec3::Z };
    let v = judge(&cutter, &path([over]), &samples, &Options::for_height(0.01, &cutter));
    let exact = libm::hypot(0.1, 2.997) - 3.0;
    assert!((min(&v) - exact).abs() < 1e-4, "{} {exact}", min(&v));
}

#[test]
fn the_shank_is_part_of_the_cutter() {
    // A wall beside a cutter that leans into it far above its edge.
    let cutter = Cutter::ball(6.0, 10.0).unwrap();
    let wall = Frame { f: DVec3::Y, b: DVec3::Z, n: DVec3::X };
    let plane =
        Plane { origin: DVec3::ZERO, frame: wall, u: Range::open(-5.0, 5.0), v: Range::open(0.0, 60.0) };
    let samples = Samples::of_face(&Face::new(plane, Side::Front), 0.5).unwrap();
    let lean = 0.08_f64;
    let axis = DVec3::new(-libm::sin(lean), 0.0, libm::cos(lean));
    let path = path([ClPoint { tip: DVec3::new(6.0, 0.0, 0.0), axis }]);
    let v = judge(&cutter, &path, &samples, &Options { depth: 20.0, ..Options::for_height(0.01, &cutter) });
    // At height z on the wall the cylinder's nearest line is at 6 cos λ − z sin λ − 3.
    let exact = 6.0 * libm::cos(lean) - 60.0 * libm::sin(lean) - 3.0;
    assert!((min(&v) - exact).abs() < 1e-8, "{} {exact}", min(&v));
}

/// Random numbers in [0, 1), the same in every run.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
    fn around(&mut self, reach: f64) -> f64 {
        reach * (2.0 * self.roll() - 1.0)
    }
}

#[test]
fn turning_moves_agree_with_brute_force() {
    let mut dice = Dice(7);
    let samples = Samples::of_face(&rectangle([-3.0, 3.0], [-3.0, 3.0]), 1.5).unwrap();
    for cutter in
        [Cutter::bull_nose(10.0, 1.5, 20.0), Cutter::flat(8.0, 20.0), Cutter::new(8.0, 1.0, 0.2, 0.15, 20.0)]
    {
        let cutter = cutter.unwrap();
        let body = Body::new(&cutter, 200.0);
        for _ in 0..4 {
            let mut location = || ClPoint {
                tip: DVec3::new(dice.around(3.0), dice.around(3.0), dice.around(0.3)),
                axis: DVec3::new(dice.around(0.2), dice.around(0.2), 1.0).normalize(),
            };
            let (from, to) = (location(), location());
            let options = Options { search: 3.0, depth: 4.0, ..Options::for_height(0.5, &cutter) };
            let v = judge(&cutter, &path([from, to]), &samples, &options);
            for (sample, t) in samples.samples.iter().zip(&v.excess) {
                let steps = 500_u32;
                let distance = |t: f64, s: f64| {
                    let axis = from.axis.lerp(to.axis, s).normalize();
                    let w = sample.point + sample.normal * t - from.tip.lerp(to.tip, s);
                    let z = w.dot(axis);
                    body.distance((w - axis * z).length(), z)
                };
                let closest = |t: f64| {
                    let at = |i: u32| f64::from(i) / f64::from(steps);
                    let (_, i) = (0..=steps)
                        .map(|i| (distance(t, at(i)), i))
                        .fold((f64::INFINITY, 0), |best, new| if new.0 < best.0 { new } else { best });
                    let (mut lo, mut hi) = (at(i.max(1) - 1), at((i + 1).min(steps)));
                    for _ in 0..60 {
                        let (a, b) = (lo + (hi - lo) / 3.0, hi - (hi - lo) / 3.0);
                        if distance(t, a) < distance(t, b) { hi = b } else { lo = a }
                    }
                    distance(t, 0.5 * (lo + hi))
                };
                if t.is_infinite() {
                    assert!(closest(3.0) > -5e-5, "{cutter:?} {sample:?}");
                } else if *t < 0.0 {
                    // As deep as the point ever is in the cutter.
                    assert!((t - closest(0.0)).abs() < 1e-4, "{cutter:?} {sample:?} {t} {}", closest(0.0));
                } else {
                    // The promise: the closest approach is found to 0.05 µm.
                    let there = closest(*t);
                    assert!((-5e-5..1e-9).contains(&there), "{cutter:?} {sample:?} {t} {there}");
                    assert!(closest(t - 1e-3) > 0.0, "{cutter:?} {sample:?} {t}");
                }
            }
        }
    }
}

#[test]
fn a_turned_scene_gives_the_same_result() {
    let cutter = Cutter::bull_nose(10.0, 2.0, 30.0).unwrap();
    let path = raster(&cutter, [0.0, 8.0], &[0.0, 2.5, 5.0], 0.5, 0.15);
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 1.1);
    let shift = DVec3::new(30.0, -70.0, 11.0);
    let turned_frame = Frame { f: turn * DVec3::X, b: turn * DVec3::Y, n: turn * DVec3::Z };
    let (u, v) = (Range::open(1.0, 7.0), Range::open(0.0, 5.0));
    let turned_face = Face::new(Plane { origin: shift, frame: turned_frame, u, v }, Side::Front);
    let mut turned_path = path.clone();
    for m in &mut turned_path.moves {
        m.to = ClPoint { tip: turn * m.to.tip + shift, axis: turn * m.to.axis };
    }
    let options = Options { search: 0.5, ..Options::for_height(0.05, &cutter) };
    let here =
        judge(&cutter, &path, &Samples::of_face(&rectangle([1.0, 7.0], [0.0, 5.0]), 0.2).unwrap(), &options);
    let there = judge(&cutter, &turned_path, &Samples::of_face(&turned_face, 0.2).unwrap(), &options);
    assert_eq!(here.excess.len(), there.excess.len());
    for (a, b) in here.excess.iter().zip(&there.excess) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
    assert!((max(&here) - max(&there)).abs() < 1e-6 && (min(&here) - min(&there)).abs() < 1e-6);
}

/// The location at which a cutter that leads along `f` touches the point `p` with the normal `n`.
fn touching(cutter: &Cutter, p: DVec3, n: DVec3, f: DVec3, lead: f64) -> ClPoint {
    let axis = n * libm::cos(lead) + f * libm::sin(lead);
    let u = ((n.dot(axis)) * axis - n).normalize_or_zero();
    let c = p + n * cutter.corner_radius - u * cutter.center_radius;
    ClPoint { tip: c - axis * cutter.corner_radius, axis }
}

/// Passes along parallels of latitude on a sphere of radius 25 about the origin, on its outside or its inside: moves are
/// chords, and axes turn. To and fro, so that no link runs through the outside.
fn parallels(cutter: &Cutter, side: Side, step: f64) -> Toolpath {
    let at = |u: f64, v: f64| {
        let out = DVec3::new(libm::cos(v) * libm::cos(u), libm::cos(v) * libm::sin(u), libm::sin(v));
        let f = DVec3::new(-libm::sin(u), libm::cos(u), 0.0);
        touching(cutter, 25.0 * out, if side == Side::Front { out } else { -out }, f, 0.2)
    };
    let count = (1.475 / step).ceil() as i32;
    path((0..9).flat_map(|j| {
        let along = move |i: i32| f64::from(if j % 2 == 0 { i } else { count - i });
        (0..=count).map(move |i| at(-0.2 + step * along(i), -0.4 + 0.12 * f64::from(j)))
    }))
}

/// Compares what coarse samples promise with what dense ones find; returns the errors promised.
fn stays_within_the_promise(cutter: &Cutter, face: &Face, path: &Toolpath, spacings: &[f64]) -> Vec<f64> {
    let fine = Options { sampling_tolerance: 1e-4, search: 1.0, ..Options::for_height(0.2, cutter) };
    let fine = judge(cutter, path, &Samples::of_face(face, 0.1).unwrap(), &fine);
    let known = fine.statistics.excess_error;
    assert_eq!(fine.statistics.uncut_area, 0.0);
    assert!(known <= 1e-4, "{cutter:?}: {known}");
    let promise = |(spacing, most_refined): (f64, usize)| {
        let options = Options { most_refined, search: 1.0, ..Options::for_height(0.2, cutter) };
        let v = judge(cutter, path, &Samples::of_face(face, spacing).unwrap(), &options);
        let (found, error) = (max(&v), v.statistics.excess_error);
        assert!(
            max(&fine) <= found + error + 1e-9,
            "{cutter:?} {spacing} {most_refined}: {} {found} {error}",
            max(&fine)
        );
        assert!(found <= max(&fine) + known + 1e-9, "{cutter:?} {spacing}");
        let (deepest, error) = (min(&v), v.statistics.gouge_error);
        assert!(min(&fine) >= deepest - error - 1e-9, "{cutter:?} {spacing}: {} {deepest}", min(&fine));
        v.statistics.excess_error
    };
    spacings.iter().flat_map(|s| [(*s, 0), (*s, 4), (*s, 300)]).map(promise).collect()
}

#[test]
fn finer_samples_stay_within_the_promise() {
    let sphere = Sphere::new(DVec3::ZERO, UPRIGHT, 25.0, [0.0, 1.0], [-0.3, 0.5]).unwrap();
    let [bull, ball] = [Cutter::bull_nose(12.0, 2.5, 30.0), Cutter::ball(12.0, 30.0)].map(Result::unwrap);
    // Moves shorter than the samples are apart, and longer.
    for (cutter, side, step) in [
        (&bull, Side::Front, 0.025),
        (&bull, Side::Back, 0.1),
        (&ball, Side::Front, 0.1),
        (&ball, Side::Back, 0.025),
    ] {
        let face = Face::new(sphere.clone(), side);
        stays_within_the_promise(cutter, &face, &parallels(cutter, side, step), &[0.8, 0.4, 0.2]);
    }
}

#[test]
fn a_sharp_edge_that_does_not_turn_stays_within_its_promise() {
    let cutter = Cutter::flat(8.0, 30.0).unwrap();
    let cap = Sphere::new(DVec3::ZERO, UPRIGHT, 25.0, [0.0, TAU], [1.2, 0.5 * PI]).unwrap();
    // The bottom rests on the cap's top, or its rim on the side nearest to it.
    let at = |x: f64, y: f64| {
        let away = (libm::hypot(x, y) - cutter.center_radius).max(0.0);
        ClPoint { tip: DVec3::new(x, y, (625.0 - away * away).sqrt()), axis: DVec3::Z }
    };
    let path = path((0..29).flat_map(|j| {
        let along = move |i: i32| f64::from(if j % 2 == 0 { i } else { -i });
        (-30..=30).map(move |i| at(0.5 * along(i), f64::from(j) - 14.0))
    }));
    let errors = stays_within_the_promise(&cutter, &Face::new(cap, Side::Front), &path, &[0.8, 0.4, 0.2]);
    assert!(errors.last().unwrap().is_finite(), "{errors:?}");
}

#[test]
fn the_promise_is_as_sharp_as_the_strip_is_flat() {
    // Half a millimetre between samples; a corner of 1.5 mm rises by 40 µm over the middle of four.
    let cutter = Cutter::bull_nose(10.0, 1.5, 30.0).unwrap();
    let hollow = Cylinder::new(DVec3::ZERO, UPRIGHT, 60.0, [0.0, 0.2], [0.0, 8.0]).unwrap();
    let at = |u: f64, z: f64| {
        let (s, c) = libm::sincos(u);
        let out = DVec3::new(c, s, 0.0);
        touching(&cutter, 60.0 * out + DVec3::Z * z, -out, DVec3::new(-s, c, 0.0), 0.12)
    };
    let path = path((0..11).flat_map(|j| {
        let along = move |i: i32| f64::from(if j % 2 == 0 { i } else { 40 - i });
        (0..=40).map(move |i| at(-0.1 + 0.01 * along(i), f64::from(j) - 1.0))
    }));
    let samples = Samples::of_face(&Face::new(hollow, Side::Back), 0.5).unwrap();
    let options = Options { most_refined: 4000, search: 1.0, ..Options::for_height(0.005, &cutter) };
    let s = judge(&cutter, &path, &samples, &options).statistics;
    assert!(s.excess_error <= 5e-4, "{s:?}");
    assert!(s.gouge_error <= 5e-4, "{s:?}");
}

#[test]
fn links_far_away_change_nothing() {
    let cutter = Cutter::bull_nose(6.0, 1.5, 30.0).unwrap();
    let short = raster(&cutter, [0.0, 12.0], &[0.0, 1.5, 3.0, 4.5], 0.4, 0.2);
    // At each end of a line out along the axis, a quarter round the part leaning away from it, and back.
    let mut long = Toolpath::default();
    for step in &short.moves {
        long.moves.push(*step);
        if step.to.tip.z > 3.0 {
            let at = |tip: DVec3, axis: DVec3| Move {
                to: ClPoint { tip, axis: axis.normalize() },
                rate: Rate::Rapid,
                role: Role::Link,
            };
            let out = at(step.to.tip + step.to.axis * 150.0, step.to.axis);
            let aside = at(DVec3::new(150.0, 40.0, 60.0), DVec3::new(1.0, 0.3, 0.2));
            long.moves.extend([out, aside, out, *step]);
        }
    }
    let samples = Samples::of_face(&rectangle([0.0, 12.0], [0.0, 4.5]), 0.2).unwrap();
    let options = Options { search: 0.5, ..Options::for_height(0.05, &cutter) };
    let [short, long] = [short, long].map(|path| judge(&cutter, &path, &samples, &options));
    for (a, b) in short.excess.iter().zip(&long.excess) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
    assert!((max(&short) - max(&long)).abs() < 1e-9 && (min(&short) - min(&long)).abs() < 1e-9);
}

#[test]
fn mesh_and_face_agree() {
    let cutter = Cutter::bull_nose(10.0, 2.0, 30.0).unwrap();
    let path = raster(&cutter, [-1.0, 5.0], &[0.0, 2.5, 5.0], 0.5, 0.15);
    let corner = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let mesh = TriMesh {
        vertices: vec![corner(0.0, 0.0), corner(4.0, 0.0), corner(4.0, 5.0), corner(0.0, 5.0)],
        triangles: vec![[0, 1, 2], [0, 2, 3], [0, 0, 1]],
    };
    let options = Options { search: 0.5, sampling_tolerance: 1e-5, ..Options::for_height(0.1, &cutter) };
    let mesh = judge(&cutter, &path, &Samples::of_mesh(&mesh, 0.2).unwrap(), &options);
    let face =
        judge(&cutter, &path, &Samples::of_face(&rectangle([0.0, 4.0], [0.0, 5.0]), 0.2).unwrap(), &options);
    assert!((max(&mesh) - max(&face)).abs() <= 1e-5);
    assert!((mesh.statistics.area - 20.0).abs() < 1e-9);
    assert!((mesh.statistics.median - face.statistics.median).abs() < 5e-3);
}

#[test]
fn what_is_out_of_reach_is_uncut_and_what_is_excluded_is_apart() {
    let cutter = Cutter::ball(10.0, 30.0).unwrap();
    // Lines cover the left half only.
    let ys: Vec<f64> = (0..40).map(|i| f64::from(i) * 0.25).collect();
    let path = raster(&cutter, [0.0, 5.0], &ys, 5.0, 0.0);
    let samples = Samples::of_face(&rectangle([0.0, 10.0], [0.0, 9.75]), 0.25).unwrap();
    let options = Options::for_height(0.01, &cutter);
    let open = judge(&cutter, &path, &samples, &options).statistics;
    assert!(open.uncut_area > 40.0 && open.share_within < 0.6 && open.q95.is_infinite());
    let right = samples.samples.iter().zip(&samples.areas).filter(|(s, _)| s.point.x > 5.0);
    let zone = Zone::from_samples(0.125, right.map(|(s, area)| (s.point, *area)));
    let rest = judge(&cutter, &path, &samples, &Options { excluded: Some(&zone), ..options }).statistics;
    assert_eq!((rest.uncut_area, rest.share_within), (0.0, 1.0));
    assert!((rest.excluded_area - zone.area()).abs() < 1e-9);
    assert!((rest.area + rest.excluded_area - open.area).abs() < 1e-9);
    assert!(rest.max.unwrap().excess < 0.01);
    assert_eq!(rest.excluded_gouge, None);
    // A gouge in the zone is told apart.
    let mut dips = path.clone();
    let mut dip = *dips.moves.last().unwrap();
    dip.to.tip = glam::DVec3::new(8.0, 4.0, -0.02);
    dips.moves.push(dip);
    let dug = judge(&cutter, &dips, &samples, &Options { excluded: Some(&zone), ..options }).statistics;
    let deepest = dug.excluded_gouge.unwrap();
    assert!((deepest.excess + 0.02).abs() < 1e-6 && deepest.point.distance(dip.to.tip) < 0.03, "{deepest:?}");
    assert!(dug.min.unwrap().excess > -0.02);
}

#[test]
fn what_is_excluded_between_the_samples_is_apart_too() {
    let cutter = Cutter::ball(10.0, 30.0).unwrap();
    // A line is left out at y = 4.5, where no sample is.
    let ys = (0..40).map(|i| f64::from(i) * 0.25).filter(|y| (y - 4.5).abs() > 0.3);
    let path = raster(&cutter, [0.0, 10.0], &ys.collect::<Vec<_>>(), 10.0, 0.0);
    let samples = Samples::of_face(&rectangle([0.0, 10.0], [0.0, 9.0]), 1.0).unwrap();
    let options = Options::for_height(0.1, &cutter);
    let options = Options { sampling_tolerance: 1e-3, ..options };
    let left = |away: f64| 5.0 - (25.0 - away * away).sqrt();
    let most = judge(&cutter, &path, &samples, &options).statistics.max.unwrap();
    assert!((most.excess - left(0.5)).abs() < 1e-3 && (most.point.y - 4.5).abs() < 0.05, "{most:?}");
    let cubes =
        (0..101).flat_map(|i| (0..5).map(move |j| (0.05 + 0.1 * f64::from(i), 4.25 + 0.1 * f64::from(j))));
    let zone = Zone::from_samples(0.1, cubes.map(|(x, y)| (DVec3::new(x, y, 0.0), 0.01)));
    let rest = judge(&cutter, &path, &samples, &Options { excluded: Some(&zone), ..options }).statistics;
    assert!(rest.max.unwrap().excess < left(0.3) + 1e-9, "{:?}", rest.max);
}

#[test]
fn samples_cover_spheres_evenly_with_their_poles() {
    let sphere = Sphere::new(DVec3::ZERO, UPRIGHT, 10.0, [0.0, TAU], [-0.5 * PI, 0.5 * PI]).unwrap();
    let samples = Samples::of_face(&Face::new(sphere, Side::Front), 0.25).unwrap();
    assert!((samples.area() / (400.0 * PI) - 1.0).abs() < 1e-3);
    for [a, b, c] in &samples.triangles {
        let [a, b, c] = [a, b, c].map(|i| samples.samples[*i as usize].point);
        let shortest = a.distance(b).min(b.distance(c)).min(c.distance(a));
        assert!(shortest <= 0.25 + 1e-9);
    }
    assert!(samples.samples.iter().all(|s| (s.normal * 10.0).distance(s.point) < 1e-4));
    assert_eq!(Samples::of_mesh(&TriMesh::default(), 0.0).unwrap_err(), SampleError::Spacing);
    let tiny = Samples::of_face(&rectangle([0.0, 100.0], [0.0, 100.0]), 1e-3);
    assert!(matches!(tiny, Err(SampleError::TooMany { .. })));
}

#[test]
fn impossible_questions_name_what_is_wrong() {
    let cutter = Cutter::ball(10.0, 30.0).unwrap();
    let samples = Samples::of_face(&rectangle([0.0, 1.0], [0.0, 1.0]), 0.5).unwrap();
    let ask = |path: &Toolpath, options: &Options| verify(&cutter, path, &samples, options, &Stage::silent());
    let options = Options::for_height(0.01, &cutter);
    let at = |axis: DVec3| ClPoint { tip: DVec3::ZERO, axis };
    for axis in [DVec3::NEG_Z, DVec3::Z * 1.1, DVec3::NAN] {
        let wrong = ask(&path([at(DVec3::Z), at(axis)]), &options);
        assert!(matches!(wrong, Err(VerifyError::Move { index: 1, .. })), "{wrong:?}");
    }
    let wrong = ask(&Toolpath::default(), &Options { height: 0.0, ..options });
    assert!(matches!(wrong, Err(VerifyError::Option { field: "height", .. })));
    // No moves cut nothing.
    let nothing = ask(&Toolpath::default(), &options).unwrap();
    assert_eq!((nothing.statistics.uncut_area, nothing.statistics.max), (1.0, None));
}

#[test]
fn workers_and_monitors_change_nothing_and_cancelling_stops() {
    struct Stop;
    impl Monitor for Stop {
        fn progress(&self, _phase: &str, _fraction: f64) {}
        fn is_cancelled(&self) -> bool {
            true
        }
    }
    let cutter = Cutter::bull_nose(10.0, 2.0, 30.0).unwrap();
    let path = raster(&cutter, [0.0, 20.0], &[0.0, 3.0, 6.0, 9.0], 0.5, 0.15);
    let samples = Samples::of_face(&rectangle([0.0, 20.0], [0.0, 9.0]), 0.1).unwrap();
    let options = Options { search: 0.5, ..Options::for_height(0.05, &cutter) };
    let one = judge(&cutter, &path, &samples, &options);
    let three = Stage::whole(&stepover::monitor::Silent, NonZeroUsize::new(3).unwrap());
    assert_eq!(one, verify(&cutter, &path, &samples, &options, &three).unwrap());
    let stopped = verify(&cutter, &path, &samples, &options, &Stage::whole(&Stop, NonZeroUsize::MIN));
    assert_eq!(stopped, Err(VerifyError::Cancelled(Cancelled)));
}
