//! Constant scallop from given start curves: what its programs leave, and what is told of curves that are none.

use glam::DVec3;
use serde_json::{Value, json};
use stepover::job::{self, JobError, Plan, Shape, Spec};
use stepover::monitor::Stage;
use stepover::toolpath::Role;

/// `source` cut from the curve through `points`.
fn job(source: Value, points: &[[f64; 3]]) -> Value {
    json!({
        "source": source,
        "cutter": {"kind": "bull_nose", "diameter_mm": 8, "corner_radius_mm": 2},
        "strategy": {"kind": "constant_scallop", "start": "curve", "start_points_mm": points, "lead_deg": 8},
        "tolerance": {"scallop_mm": 0.02},
    })
}

fn planned(job: &Value) -> Result<(Spec, Plan), JobError> {
    let spec = Spec::from_json(&job.to_string())?;
    let plan = job::plan(&spec, None, &Stage::silent())?;
    Ok((spec, plan))
}

fn length(plan: &Plan) -> f64 {
    plan.emitted.toolpath.length(Role::Cut)
}

/// Excess at most the scallop plus what sampling can miss, gouge at most a micrometre.
fn proven((spec, plan): &(Spec, Plan)) {
    let verified = plan.prove(&Stage::silent()).unwrap().unwrap().verified;
    let limit = spec.tolerance.scallop_mm + verified.sampling_error_mm.unwrap();
    let (excess, gouge) = (verified.largest_excess_mm.unwrap(), verified.largest_gouge_mm.unwrap());
    assert!(excess <= limit, "{excess} at {:?}", verified.largest_excess_at);
    assert!(gouge >= -0.001, "{gouge} at {:?}", verified.largest_gouge_at);
    assert!(verified.uncut_area_mm2 <= 0.0, "{} mm² uncut", verified.uncut_area_mm2);
}

fn tube() -> Value {
    json!({"kind": "cylinder", "radius_mm": 8, "angle_deg": 360, "length_mm": 12})
}

fn plane() -> Value {
    json!({"kind": "plane", "size_mm": [30, 20]})
}

/// Contacts of passes.
fn contacts(plan: &Plan) -> Vec<DVec3> {
    let moves = plan.emitted.toolpath.moves.iter().zip(&plan.touches);
    moves.filter(|(m, t)| m.role == Role::Cut && t.contact.is_some()).map(|(_, t)| t.point).collect()
}

/// `job` with another setting of its strategy.
fn of(name: &str, job: &Value, value: Value) -> Value {
    let mut job = job.clone();
    job["strategy"][name] = value;
    job
}

/// The median width of the strips, mm.
fn usual_strip(plan: &Plan) -> f64 {
    let mut strips: Vec<f64> = plan.touches.iter().filter_map(|t| t.contact?.1.strip).collect();
    strips.sort_by(f64::total_cmp);
    strips[strips.len() / 2]
}

/// On a plane strips have one width: passes are parallel to the curve that far apart.
#[test]
fn from_a_slanted_line_on_a_plane_passes_are_parallel_to_it() {
    let it = planned(&job(plane(), &[[-5.0, -3.0, 0.0], [5.0, 2.0, 0.0]])).unwrap();
    proven(&it);
    let width = usual_strip(&it.1);
    // The line is x − 2y = 1. Beside its two ends, and in the two corners, a border stops passes.
    let mut inner = 0;
    for p in contacts(&it.1).iter().filter(|p| p.x.abs() < 12.0 && p.y.abs() < 7.5) {
        let strips = (p.x - 2.0 * p.y - 1.0) / (5f64.sqrt() * width);
        // Strips overlap by 0.3 %.
        let off = (strips - strips.round()) / strips.abs().max(1.0);
        assert!(off.abs() < 4e-3, "{strips} strips at {p}");
        inner += 1;
    }
    assert!(inner > 60, "{inner}");
}

#[test]
fn from_a_circle_on_a_plane_passes_are_rings() {
    let corner = |k: u32| {
        let (s, c) = libm::sincos(std::f64::consts::TAU * f64::from(k) / 96.0);
        [6.0 * c, 6.0 * s, 0.0]
    };
    // The last point is the first.
    let it = planned(&job(plane(), &(0..=96).map(|k| corner(k % 96)).collect::<Vec<_>>())).unwrap();
    proven(&it);
    let width = usual_strip(&it.1);
    // Outwards to the border; inwards until short passes take over, where rings bend about as tight as strips are wide.
    for p in contacts(&it.1).iter().filter(|p| (3.0 * width..9.0).contains(&p.length())) {
        let strips = (p.length() - 6.0) / width;
        assert!((strips - strips.round()).abs() < 0.02, "{strips} strips at {p}");
    }
}

/// The wave of the gallery, cut from points on its line of constant u at 40 %, and from that line itself.
#[test]
fn from_points_on_a_line_of_a_parameter_passes_are_those_of_the_line() {
    let mut wave: Value = serde_json::from_str(&job::gallery()[0].spec.to_json()).unwrap();
    let Ok((Shape::Face(face), _)) = job::gallery()[0].spec.source.shape(None) else { panic!("a face") };
    let on_line = |k: u32| face.surface.point(face.domain().at(0.4, 0.1 + 0.02 * f64::from(k))).to_array();
    wave["strategy"] = json!({"kind": "constant_scallop", "start": "u_line", "start_percent": 40});
    let points: Vec<[f64; 3]> = (0..=40).map(on_line).collect();
    let given = of("start", &of("start_points_mm", &wave, json!(points)), "curve".into());
    for (rule, within) in [("fixed", 0.02), ("matched", 0.06)] {
        let [line, curve] = [&wave, &given].map(|job| planned(&of("rule", job, rule.into())).unwrap());
        let share = length(&curve.1) / length(&line.1);
        assert!((share - 1.0).abs() <= within, "{rule}: {share}");
        proven(&curve);
    }
}

/// Beside the turns of a curve more than the limit was left on spots smaller than an eighth of a strip.
#[test]
fn where_a_curve_turns_no_small_spot_is_left() {
    let mut wave: Value = serde_json::from_str(&job::gallery()[0].spec.to_json()).unwrap();
    let points = json!([[-25, 0, 0], [-3, 0, 0], [0, 15, 0], [25, 15, 0]]);
    wave["strategy"] =
        json!({"kind": "constant_scallop", "start": "curve", "start_points_mm": points, "lead_deg": 15});
    wave["verify"] = json!({"spacing_mm": 0.25});
    let (spec, plan) = planned(&wave).unwrap();
    let excess = plan.prove(&Stage::silent()).unwrap().unwrap().verified.largest_excess_mm.unwrap();
    assert!(excess <= spec.tolerance.scallop_mm, "{excess}");
}

#[test]
fn a_curve_round_a_tube_may_swing() {
    let corner = |k: u32| {
        let angle = std::f64::consts::TAU * f64::from(k) / 36.0;
        let (s, c) = libm::sincos(angle);
        [1.5 * libm::cos(2.0 * angle), 8.0 * s, 8.0 * c]
    };
    let it = planned(&job(tube(), &(0..=36).map(|k| corner(k % 36)).collect::<Vec<_>>())).unwrap();
    proven(&it);
}

#[test]
fn what_is_no_start_curve_says_why() {
    let here = [1.0, 2.0, 0.0];
    let wrong = |source: Value, points: &[[f64; 3]]| {
        let error = planned(&job(source, points)).err().unwrap();
        assert_eq!(error.field_path(), Some("strategy.start_points_mm"), "{error}");
        error.to_string()
    };
    for points in [&[][..], &[here], &[here, here]] {
        assert!(wrong(plane(), points).contains("two different points"));
    }
    assert!(wrong(plane(), &[here, [500.0, 0.0, 0.0]]).contains("point 2 is 485.0 mm away"));
    let bow = [[-5.0, -5.0, 0.0], [5.0, 5.0, 0.0], [5.0, -5.0, 0.0], [-5.0, 5.0, 0.0]];
    assert!(wrong(plane(), &bow).contains("behind points 1 and 3"));
    // There and back, and round next to nothing.
    assert!(wrong(plane(), &[here, [5.0, 5.0, 0.0], here]).contains("divide the face"));
    assert!(wrong(plane(), &[here, [1.01, 2.0, 0.0], [1.0, 2.01, 0.0], here]).contains("divide the face"));
    // Round a tube without an end, and along it.
    assert!(wrong(tube(), &[[0.0, 0.0, 8.0], [0.0, 8.0, 0.0]]).contains("at point 2"));
    assert!(wrong(tube(), &[[-2.0, 0.0, 8.0], [2.0, 0.0, 8.0]]).contains("divide the face"));
    let flat = planned(&of("start_points_mm", &job(plane(), &[]), json!([[1, 2]]))).err().unwrap();
    assert!(flat.to_string().contains("point 1 must be three numbers"), "{flat}");
    let word = planned(&of("start_points_mm", &job(plane(), &[]), json!("here"))).err().unwrap();
    assert!(word.to_string().contains("list of up to 1000 points"), "{word}");
}
