//! The simulation itself: closed forms, brute force, and what must not change a result.

use crate::support::{PLANE_INSERT, extremes, held, near, order, planned, proof, toric};
use std::f64::consts::TAU;
use std::sync::Arc;
use stepover::monitor::Stage;
use stepover::toolpath::{AxisPoint, Interpolation, Nose, TurningPath};
use stepover::turning::sag::{Biconic, Conic, Toric, ToricKind};
use stepover::turning::{Aperture, Curve, Order, Outline, Placed, Spacing, Step, Tool, Way, Ways};
use stepover::verify::{TurnedError, TurnedOptions, TurnedPart, verify_turned};

/// A disc of radius 5 mm in z = 0.
fn disc() -> Order {
    Order {
        part: held(Conic::new(0.0, 0.0, vec![], 100.0)),
        aperture: Aperture { outline: Outline::Round(5.0), center: [0.0; 2], angle: 0.0 },
        ..order(0.5, 3.0)
    }
}

/// Circles `step` apart around the axis, the last on it, the tip at the height `z`.
fn rings(radius: f64, step: f64, z: f64) -> TurningPath {
    let mut points = Vec::new();
    for ring in 0..30 {
        for i in 0..=36 {
            let c = TAU * (f64::from(ring) + f64::from(i) / 36.0);
            let time = points.len() as f64;
            points.push(AxisPoint {
                x: step * f64::from(29 - ring),
                z: z + radius,
                c,
                time,
                rates: [0.0; 3],
            });
        }
    }
    TurningPath { points, interpolation: Interpolation::Linear }
}

/// Between circles on a plane stays `r − √(r² − s²/4)`, and a path that is higher leaves as much more everywhere.
#[test]
fn cusps_on_a_plane_are_those_of_circles() {
    let (r, s) = (2.0, 0.7);
    let cusp = 1e3 * (r - f64::sqrt(r * r - 0.25 * s * s));
    for nose in [Nose::Ball(r), Nose::Insert(r)] {
        let [low, high] = extremes(&proof(&disc(), nose, &rings(r, s, 0.0), 0.05));
        near(low, 0.0, 1e-6);
        near(high, cusp, 5e-3);
        let [low, high] = extremes(&proof(&disc(), nose, &rings(r, s, -0.003), 0.05));
        near(low, -3.0, 1e-6);
        near(high, cusp - 3.0, 5e-3);
    }
}

/// Every residue is the least over a path cut into thousandths of a degree.
#[test]
fn residues_are_those_of_brute_force() {
    for tool in [Tool::Ball { radius: 15.0 }, PLANE_INSERT] {
        for interpolation in [Interpolation::Linear, Interpolation::Pvt] {
            let order = Order { tool, interpolation, ..order(1.5, 8.0) };
            let order = Order { asked: stepover::turning::Asked { residue: 1.0, chord: 1.0 }, ..order };
            let path = planned(&order).path;
            let found = proof(&order, tool.nose(), &path, 2.0);
            for (ray, ring) in [(3, 5), (17, 11), (40, 15), (61, 14), (77, 9), (90, 2)] {
                let (rho, t) = (found.radius(ring), found.angle(ray));
                let (sin, cos) = libm::sincos(t);
                let f = order.part.at(rho * cos, rho * sin);
                let w = f.stretch();
                let wanted = match tool {
                    Tool::Ball { radius } => {
                        let n = [-f.g[0] / w, -f.g[1] / w, 1.0 / w];
                        brute_ball(&path, radius, [rho * cos, rho * sin, f.z], n)
                    }
                    Tool::Insert { radius, .. } => brute_insert(&path, radius, rho, t, f.z) / w,
                };
                let residue = f64::from(found.residues[ray * found.rings + ring]);
                assert!(
                    (residue - wanted).abs() < 1e-6,
                    "{tool:?} {interpolation:?} {ray} {ring}: {residue} {wanted}"
                );
            }
        }
    }
}

/// X, Z and C between two points, written down anew.
fn between(path: &TurningPath, a: &AxisPoint, b: &AxisPoint, u: f64) -> [f64; 3] {
    let ends = [(a.x, b.x), (a.z, b.z), (a.c, b.c)];
    let dt = b.time - a.time;
    [0, 1, 2].map(|k| {
        let (p, q) = ends[k];
        match path.interpolation {
            Interpolation::Linear => (1.0 - u) * p + u * q,
            Interpolation::Pvt => {
                let v = 1.0 - u;
                v * v * (1.0 + 2.0 * u) * p
                    + u * u * (3.0 - 2.0 * u) * q
                    + dt * u * v * (v * a.rates[k] - u * b.rates[k])
            }
        }
    })
}

fn brute_ball(path: &TurningPath, r: f64, p: [f64; 3], n: [f64; 3]) -> f64 {
    let mut least = f64::INFINITY;
    for pair in path.points.windows(2) {
        for i in 0..=800 {
            let [x, z, c] = between(path, &pair[0], &pair[1], f64::from(i) / 800.0);
            let (sin, cos) = libm::sincos(c);
            let d = [x * cos - p[0], x * sin - p[1], z - p[2]];
            let along: f64 = d.iter().zip(n).map(|(d, n)| d * n).sum();
            let under = r * r - d.iter().map(|d| d * d).sum::<f64>() + along * along;
            if under > 0.0 {
                least = least.min(along - under.sqrt());
            }
        }
    }
    least
}

fn brute_insert(path: &TurningPath, r: f64, rho: f64, t: f64, z0: f64) -> f64 {
    let mut least = f64::INFINITY;
    for pair in path.points.windows(2) {
        for i in 0..800 {
            let at = |i: i32| between(path, &pair[0], &pair[1], f64::from(i) / 800.0);
            let (a, b) = (at(i), at(i + 1));
            // Where C passes the ray, or the ray opposite.
            for (angle, side) in [(t, 1.0), (t + 0.5 * TAU, -1.0)] {
                let turns = ((b[2] - angle) / TAU).floor();
                let c = angle + TAU * turns;
                if c > a[2] && c <= b[2] {
                    let u = (c - a[2]) / (b[2] - a[2]);
                    let (x, z) = (a[0] + u * (b[0] - a[0]), a[1] + u * (b[1] - a[1]));
                    let under = r * r - (rho - side * x) * (rho - side * x);
                    if under > 0.0 {
                        least = least.min(z - under.sqrt() - z0);
                    }
                }
            }
        }
    }
    least
}

/// A lens turned by a whole number of points under a path of circles is cut alike.
#[test]
fn turning_the_lens_turns_the_residue() {
    for tool in [Tool::Ball { radius: 15.0 }, PLANE_INSERT] {
        let ways = Ways {
            curve: Curve::Circles(6.0_f64.to_radians()),
            way: Way::Inward,
            lead_in: 1.0,
            lead_out: 1.0,
        };
        let cut = |degrees: f64| {
            let part = Placed::new(Arc::new(toric()), [0.0; 2], degrees.to_radians());
            let order = Order { tool, ways, part, ..order(1.0, 3.0) };
            extremes(&proof(&order, tool.nose(), &planned(&order).path, 0.5))
        };
        let [low, high] = cut(0.0);
        let [low30, high30] = cut(30.0);
        near(low30, low, 0.1);
        near(high30, high, 0.3);
    }
}

/// A lens with its axes exchanged and held a quarter turned is the same lens.
#[test]
fn swapped_axes_and_a_quarter_turn_undo_each_other() {
    let cut = |curvature: [f64; 2], turn: f64| {
        let biconic = Biconic { curvature, conic: [0.2; 2] };
        let part = Placed::new(Arc::new(biconic), [0.0; 2], turn);
        planned(&Order { part, ..order(1.0, 3.0) })
    };
    let (a, b) = (-1.0 / 190.0, -1.0 / 50.0);
    let (one, other) = (cut([a, b], 0.0), cut([b, a], 0.25 * TAU));
    assert_eq!(one.path.points.len(), other.path.points.len());
    for (p, q) in one.path.points.iter().zip(&other.path.points) {
        near(p.z, q.z, 1e-9);
        near(p.rates[1], q.rates[1], 1e-8);
    }
}

/// Ten times the size is ten times the residue at the same angles.
#[test]
fn scale_scales() {
    let cut = |k: f64| {
        let part = held(Toric::new(ToricKind::Convex, 40.0 * k, 150.0 * k).unwrap());
        let aperture = Aperture { outline: Outline::Round(30.0 * k), center: [0.0; 2], angle: 0.0 };
        let asked = stepover::turning::Asked { residue: 1.0, chord: 1.0 };
        let order =
            Order { part, aperture, asked, tool: Tool::Ball { radius: 15.0 * k }, ..order(1.5 * k, 3.0) };
        extremes(&proof(&order, Nose::Ball(15.0 * k), &planned(&order).path, 0.5 * k)).map(|h| h / k)
    };
    let ([low, high], [low10, high10]) = (cut(1.0), cut(0.1));
    near(low10, low, 0.02);
    near(high10, high, 0.2);
}

#[test]
fn both_ways_and_all_spacings_keep_the_cusp() {
    for (curve, way) in [
        (Curve::Spiral, Way::Outward),
        (Curve::Circles(0.3), Way::Inward),
        (Curve::Circles(0.3), Way::Outward),
    ] {
        for spacing in [
            Spacing::Arc { length: 0.8, most: 0.4 },
            Spacing::Hybrid { length: 0.8, switch: 12.0 },
            Spacing::Angle(0.03),
        ] {
            let ways = Ways { curve, way, lead_in: 1.0, lead_out: 0.5 };
            let order = Order {
                ways,
                spacing: Step::Given(spacing),
                interpolation: Interpolation::Pvt,
                ..order(1.0, 3.0)
            };
            let found = planned(&order);
            let path = found.path;
            assert!(path.points.windows(2).all(|w| w[1].c > w[0].c && w[1].time > w[0].time));
            let turned = proof(&order, Nose::Ball(15.0), &path, 0.5);
            let [low, high] = extremes(&turned);
            let [left, dug] = found.chord.map(|c| 1e3 * c.error);
            assert!(
                turned.form.uncut == 0.0 && low > dug - 0.2,
                "{curve:?} {way:?} {spacing:?}: {low} {dug}"
            );
            let cusp = 1e3 * found.cusp.height;
            assert!(high < cusp + left + 0.3 && high > 0.5 * cusp, "{curve:?} {way:?} {spacing:?}: {high}");
        }
    }
}

/// A rectangle off the axis, a lens off the axis: nothing in the aperture stays uncut, and the cusp is kept.
#[test]
fn decentred_apertures_are_finished() {
    let part = Placed::new(Arc::new(toric()), [3.0, -2.0], 0.4);
    for outline in [Outline::Rectangle([12.0, 7.0]), Outline::Ellipse([14.0, 9.0]), Outline::Round(10.0)] {
        let aperture = Aperture { outline, center: [6.0, 4.0], angle: 0.9 };
        for tool in [
            Tool::Ball { radius: 5.0 },
            Tool::Insert { radius: 5.0, rake: 0.0, least_rake: -1.0, clearance: 0.5, sweep: 1.3 },
        ] {
            let base = order(0.3, 2.0);
            let order =
                Order { part: part.clone(), aperture, tool, interpolation: Interpolation::Pvt, ..base };
            let found = planned(&order);
            let turned = proof(&order, tool.nose(), &found.path, 0.2);
            let [low, high] = extremes(&turned);
            assert!(turned.form.uncut == 0.0 && low > -0.1, "{outline:?} {tool:?} {low}");
            assert!(
                high < 1020.0 * found.cusp.height + 0.05,
                "{outline:?} {tool:?}: {high}, {}",
                found.cusp.height
            );
        }
    }
}

#[test]
fn paths_that_cannot_be_judged_are_refused() {
    let judge = |path: &TurningPath| {
        let surface = |_: f64, _: f64| None;
        let part = TurnedPart { surface: &surface, farthest: 5.0, meridians: ([0.0; 2], vec![]) };
        let options = TurnedOptions { spacing: 1.0, search: 1.0, bands: vec![], chord: 1.0 };
        verify_turned(&part, Nose::Ball(1.0), path, &options, &Stage::silent())
    };
    let mut path = rings(2.0, 0.7, 0.0);
    // An empty aperture is no error: there is nothing to say of it.
    assert_eq!(judge(&path).unwrap().form.samples, 0);
    path.points[7].c -= 1.0;
    assert!(matches!(judge(&path), Err(TurnedError::Backwards { index: 7, .. })));
    path.points[7].c = f64::NAN;
    assert!(matches!(judge(&path), Err(TurnedError::NotFinite { index: 7 })));
    path.points.truncate(1);
    assert_eq!(judge(&path), Err(TurnedError::Empty));
}
