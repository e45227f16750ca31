//! Postures that are chosen: where the answer is known, how it changes with the part, and what programs of them leave.

use glam::DVec3;
use serde_json::Value;
use stepover::contact::{FaceObstacle, model_strip};
use stepover::cutter::Cutter;
use stepover::geometry::{Curvature, Cylinder, Face, Field, Jet, NurbsSurface, Plane, Range, Side, Uv};
use stepover::job::{self, Spec};
use stepover::math::angle::angle_between;
use stepover::math::frame::Frame;
use stepover::monitor::Stage;
use stepover::posture::{Ground, Limits, PostureField, Rule, choose};
use stepover::toolpath::{Bound, Posture};

const WORLD: Frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };

/// Jet and contact frame with feed along u.
fn along_u(face: &Face, uv: Uv, reversed: bool) -> Option<(Jet, Frame)> {
    let (jet, n) = face.at(uv)?;
    let feed = Field::V.surface_gradient(uv, &jet).cross(n) * if reversed { -1.0 } else { 1.0 };
    Some((jet, Frame::from_normal(n, feed)?))
}

fn chosen(face: &Face, cutter: &Cutter, scallop: f64, rule: Rule) -> PostureField {
    let obstacle = FaceObstacle::for_cutter(face, cutter);
    let feed = |uv, reversed| along_u(face, uv, reversed);
    let ground = Ground {
        face,
        obstacle: &obstacle,
        cutter,
        holder: None,
        feed: &feed,
        scallop,
        gouge: 0.0005,
        most_lift: [0.0; 2],
    };
    choose(&rule, &ground, true, &Stage::silent()).unwrap()
}

fn mill(center_radius: f64, corner_radius: f64) -> Cutter {
    Cutter::bull_nose(2.0 * (center_radius + corner_radius), corner_radius, 100.0).unwrap()
}

/// `z = k_xy x y + (k_xx x² + k_yy y²)/2` over a square of half side `a`.
fn quadric(k: Curvature, a: f64) -> Face {
    let knots = || vec![-1.0, -1.0, -1.0, 1.0, 1.0, 1.0];
    // Control values of the polynomials t and t² over −1 to 1.
    let (line, square) = ([-1.0, 0.0, 1.0], [1.0, -1.0, 1.0]);
    let points: Vec<DVec3> = (0..9)
        .map(|n| {
            let (i, j) = (n / 3, n % 3);
            let bend = 0.5 * (k.ff * square[i] + k.bb * square[j]) + k.fb * line[i] * line[j];
            DVec3::new(a * line[i], a * line[j], a * a * bend)
        })
        .collect();
    Face::new(NurbsSurface::new([2, 2], [knots(), knots()], &points, None).unwrap(), Side::Front)
}

const MIDDLE: Uv = Uv { u: 0.0, v: 0.0 };

#[test]
fn on_a_plane_the_least_lead_without_yaw_is_widest() {
    let range = Range::open(-15.0, 15.0);
    let face = Face::new(Plane { origin: DVec3::ZERO, frame: WORLD, u: range, v: range }, Side::Front);
    let postures = chosen(&face, &mill(3.0, 2.0), 0.01, Rule::Widest(Limits::default()));
    for (u, v) in [(0.0, 0.0), (-15.0, 3.0), (11.0, -8.0)] {
        let Posture { lead, yaw } = postures.at(Uv::new(u, v), false);
        assert!((lead.to_degrees() - 2.0).abs() < 1e-9 && yaw.abs() < 0.03, "{lead} {yaw}");
        assert_eq!(postures.bound(Uv::new(u, v), false), Bound::Least);
    }
}

#[test]
fn in_a_trough_curvatures_match() {
    // Curvatures of a cutter with R1 = 9.5, r = 3 and a trough of radius 50 match at 11.66°.
    let trough = Cylinder::new(DVec3::ZERO, WORLD, 50.0, [-0.5, 0.5], [-15.0, 15.0]).unwrap();
    let face = Face::new(trough, Side::Back);
    let obstacle = FaceObstacle::for_cutter(&face, &mill(9.5, 3.0));
    let feed = |uv: Uv, _| {
        let (jet, n) = face.at(uv)?;
        Some((jet, Frame::from_normal(n, DVec3::Z)?))
    };
    let cutter = mill(9.5, 3.0);
    let ground = Ground {
        face: &face,
        obstacle: &obstacle,
        cutter: &cutter,
        holder: None,
        feed: &feed,
        scallop: 0.01,
        gouge: 0.0005,
        most_lift: [0.0; 2],
    };
    let width = |posture| {
        let surface = Curvature { ff: 0.0, fb: 0.0, bb: 0.02 };
        let (l, r) = model_strip(&cutter, posture, &surface, 0.01).half_widths().unwrap();
        l + r
    };
    let postures = choose(&Rule::Matched(Limits::default()), &ground, false, &Stage::silent()).unwrap();
    let matched = postures.at(MIDDLE, false);
    assert!((11.66..11.9).contains(&matched.lead.to_degrees()) && matched.yaw == 0.0, "{matched:?}");
    assert!(matches!(postures.bound(MIDDLE, false), Bound::Curvature | Bound::Beside));
    assert!((width(matched) / 9.03 - 1.0).abs() < 0.03, "{}", width(matched));
    assert!(postures.misfits().is_empty());
    let postures = choose(&Rule::Widest(Limits::default()), &ground, false, &Stage::silent()).unwrap();
    let widest = postures.at(MIDDLE, false);
    assert!(width(widest) > 0.995 * width(matched), "{widest:?} {}", width(widest));
}

#[test]
fn yaw_wins_where_the_surface_twists() {
    let surface = Curvature { ff: 0.0, fb: 0.006, bb: 0.005 };
    let (face, cutter) = (quadric(surface, 14.0), mill(9.5, 3.0));
    let limits = Limits { least_lead: 8f64.to_radians(), ..Limits::default() };
    let width = |rule| {
        let posture = chosen(&face, &cutter, 0.01, rule).at(MIDDLE, false);
        let (l, r) = model_strip(&cutter, posture, &surface, 0.01).half_widths().unwrap();
        (l + r, posture.yaw.to_degrees())
    };
    let (matched, _) = width(Rule::Matched(limits));
    let (widest, yaw) = width(Rule::Widest(limits));
    assert!((matched - 3.00).abs() < 0.02, "{matched}");
    assert!(widest >= 3.46 && (-30.0..=-15.0).contains(&yaw), "{widest} at {yaw}");
}

#[test]
fn a_mirrored_part_mirrors_the_yaw_and_feed_turned_round_keeps_it() {
    let limits = Limits { least_lead: 8f64.to_radians(), ..Limits::default() };
    let postures = |fb| {
        let face = quadric(Curvature { ff: -0.004, fb, bb: 0.005 }, 14.0);
        chosen(&face, &mill(9.5, 3.0), 0.01, Rule::Widest(limits))
    };
    let (one, other) = (postures(0.006), postures(-0.006));
    for (u, v) in [(0.0, 0.0), (0.4, -0.7), (-0.8, 0.2)] {
        let (a, b) = (one.at(Uv::new(u, v), false), other.at(Uv::new(u, -v), false));
        assert!((a.lead - b.lead).abs() < 1e-6 && (a.yaw + b.yaw).abs() < 5e-3, "{a:?} {b:?}");
        // The part is its own image turned by half a turn, and so is the feed.
        let c = one.at(Uv::new(-u, -v), true);
        assert!((a.lead - c.lead).abs() < 1e-6 && (a.yaw - c.yaw).abs() < 5e-3, "{a:?} {c:?}");
    }
}

#[test]
fn scaled_parts_and_cutters_have_the_same_postures() {
    let limits = Limits::default();
    let at = |s: f64| {
        let k = Curvature { ff: -0.004 / s, fb: 0.003 / s, bb: 0.012 / s };
        let turns = limits.most_turn.map(|turn| turn / s);
        let face = quadric(k, 14.0 * s);
        let rule = Rule::Widest(Limits { most_turn: turns, ..limits });
        chosen(&face, &mill(4.0 * s, 2.0 * s), 0.01 * s, rule).at(Uv::new(0.2, -0.1), false)
    };
    let (one, two) = (at(1.0), at(1.7));
    // Gouges are judged in micrometres, whatever the size.
    assert!((one.lead - two.lead).abs() < 2e-3 && (one.yaw - two.yaw).abs() < 2e-2, "{one:?} {two:?}");
}

/// The first face of the gallery.
fn wave() -> Face {
    let Ok((job::Shape::Face(face), _)) = job::gallery()[0].spec.source.shape(None) else { panic!() };
    face
}

#[test]
fn axes_turn_no_faster_than_the_limits() {
    let face = wave();
    let limits = Limits { most_turn: [2f64.to_radians(); 2], ..Limits::default() };
    let postures = chosen(&face, &mill(3.0, 2.0), 0.01, Rule::Widest(limits));
    let place = |i: i32, j: i32| face.domain().at(0.004 * f64::from(i), 0.006 * f64::from(j));
    let local = |uv| {
        let Posture { lead, yaw } = postures.at(uv, false);
        let ((sl, cl), (so, co)) = (libm::sincos(lead), libm::sincos(yaw));
        DVec3::new(sl * co, sl * so, cl)
    };
    // Chords of the nodes are a little shorter than the ways between them.
    let slack = 1.05;
    let mut fastest = 0.0f64;
    for i in 0..250 {
        for j in 0..166 {
            let (a, b, c) = (place(i, j), place(i + 1, j), place(i, j + 1));
            let [(pa, fa), (pb, fb), (pc, _)] = [a, b, c].map(|uv| along_u(&face, uv, false).unwrap());
            let way = pa.p.distance(pb.p);
            let own = angle_between(fa.to_world(local(a)), fb.to_world(local(a)));
            let turn = angle_between(fa.to_world(local(a)), fb.to_world(local(b)));
            let allowed = (limits.most_turn[0] * way).max(own + 0.1 * limits.most_turn[0] * way);
            assert!(turn <= slack * allowed + 1e-6, "{turn} {allowed} at {a:?}");
            fastest = fastest.max(turn / way);
            let across = angle_between(local(a), local(c));
            let square = libm::hypot(limits.most_turn[0], limits.most_turn[1]);
            assert!(across <= slack * square * pa.p.distance(pc.p) + 1e-6, "{across} at {a:?}");
        }
    }
    assert!(fastest > limits.most_turn[0], "the crests bend by more than the limit");
}

#[test]
fn where_nothing_fits_the_largest_cutter_that_does_is_told() {
    // A trough of radius 6 with feed along it: at the largest lead, 45°, the curvature of a cutter with R1 = 7 s and
    // r = 3 s matches at s = 0.465; what lies farther up needs a little more room.
    let trough = Cylinder::new(DVec3::ZERO, WORLD, 6.0, [-0.6, 0.6], [-15.0, 15.0]).unwrap();
    let face = Face::new(trough, Side::Back);
    let cutter = mill(7.0, 3.0);
    let obstacle = FaceObstacle::for_cutter(&face, &cutter);
    let feed = |uv: Uv, _| {
        let (jet, n) = face.at(uv)?;
        Some((jet, Frame::from_normal(n, DVec3::Z)?))
    };
    let ground = Ground {
        face: &face,
        obstacle: &obstacle,
        cutter: &cutter,
        holder: None,
        feed: &feed,
        scallop: 0.01,
        gouge: 0.0005,
        most_lift: [0.0; 2],
    };
    let postures = choose(&Rule::Widest(Limits::default()), &ground, false, &Stage::silent()).unwrap();
    assert!(postures.misfits().len() > 100);
    assert!(postures.misfits().iter().all(|&uv| postures.bound(uv, false) == Bound::Misfit));
    let share = postures.largest_fit().unwrap();
    assert!((0.36..0.465).contains(&share), "{share}");
}

/// Excess at most the scallop plus what sampling can miss, and a gouge of at most a micrometre.
fn assert_keeps(spec: &Spec) {
    let plan = job::plan(spec, None, &Stage::silent()).unwrap();
    let verified = plan.prove(&Stage::silent()).unwrap().unwrap().verified;
    let (excess, gouge) = (verified.largest_excess_mm.unwrap(), verified.largest_gouge_mm.unwrap());
    let limit = spec.tolerance.scallop_mm + verified.sampling_error_mm.unwrap();
    assert!(excess <= limit, "{}: {excess} at {:?}", spec.name, verified.largest_excess_at);
    assert!(gouge >= -0.001, "{}: {gouge} at {:?}", spec.name, verified.largest_gouge_at);
    assert!(verified.uncut_area_mm2 <= 0.0, "{}: {} mm²", spec.name, verified.uncut_area_mm2);
}

#[test]
fn programs_with_the_widest_strips_keep_their_promise() {
    for example in job::gallery() {
        let mut spec: Value = serde_json::from_str(&example.spec.to_json()).unwrap();
        spec["strategy"]["rule"] = "widest".into();
        let planes = serde_json::json!({"kind": "iso_planar", "angle_deg": 15, "rule": "widest"});
        for strategy in [spec["strategy"].clone(), planes] {
            spec["strategy"] = strategy;
            assert_keeps(&Spec::from_json(&spec.to_string()).unwrap());
        }
    }
}
