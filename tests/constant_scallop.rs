//! Constant scallop: what its programs leave, how even their cusps are, and how long they are beside iso-parametric ones.

use serde_json::{Value, json};
use std::num::NonZeroUsize;
use stepover::job::{self, Plan, Shape, Spec};
use stepover::math::angle::angle_between;
use stepover::monitor::{Silent, Stage};
use stepover::toolpath::{Bound, Role};

#[path = "support/cusps.rs"]
mod cusps;

fn planned(job: &Value) -> (Spec, Plan) {
    let spec = Spec::from_json(&job.to_string()).unwrap();
    let plan = job::plan(&spec, None, &Stage::silent()).unwrap();
    (spec, plan)
}

fn length(plan: &Plan) -> f64 {
    plan.emitted.toolpath.length(Role::Cut)
}

/// The largest turn of the axis in a cutting move, radians.
fn most_turn(plan: &Plan) -> f64 {
    let pairs = plan.emitted.toolpath.moves.windows(2);
    let cuts = pairs.filter(|w| w[1].role == Role::Cut);
    cuts.map(|w| angle_between(w[0].to.axis, w[1].to.axis)).fold(0.0, f64::max)
}

/// Excess at most the scallop plus what sampling can miss, gouge at most a micrometre; the median cusp.
fn proven((spec, plan): &(Spec, Plan)) -> f64 {
    let verified = plan.prove(&Stage::silent()).unwrap().unwrap().verified;
    let (name, h) = (&spec.name, spec.tolerance.scallop_mm);
    let (excess, gouge) = (verified.largest_excess_mm.unwrap(), verified.largest_gouge_mm.unwrap());
    let limit = h + verified.sampling_error_mm.unwrap();
    assert!(excess <= limit, "{name}: {excess} of {h} at {:?}", verified.largest_excess_at);
    assert!(gouge >= -0.001, "{name}: {gouge} at {:?}", verified.largest_gouge_at);
    assert!(verified.uncut_area_mm2 <= 0.0, "{name}: {} mm² uncut", verified.uncut_area_mm2);
    assert!(most_turn(plan) <= 0.06, "{name}: the axis turns by {} at once", most_turn(plan));
    let Ok((Shape::Face(face), _)) = spec.source.shape(None) else { panic!("a face") };
    cusps::median_cusp(plan, &face, h, 0.15, &Stage::silent())
}

/// `source` cut from `start`, and along the parameter `along`.
fn analytic(source: &str, start: &str, along: &str) -> [Value; 2] {
    let strategies = [
        json!({"kind": "constant_scallop", "start": start, "lead_deg": 8}),
        json!({"kind": "iso_parametric", "along": along, "lead_deg": 8}),
    ];
    strategies.map(|strategy| {
        json!({
            "name": format!("{source} {start}"),
            "source": serde_json::from_str::<Value>(source).unwrap(),
            "cutter": {"kind": "bull_nose", "diameter_mm": 8, "corner_radius_mm": 2},
            "strategy": strategy,
            "tolerance": {"scallop_mm": 0.02},
        })
    })
}

const PLANE: &str = r#"{"kind": "plane", "size_mm": [30, 20]}"#;
const TUBE: &str = r#"{"kind": "cylinder", "radius_mm": 8, "angle_deg": 360, "length_mm": 12}"#;
const CAP: &str = r#"{"kind": "sphere", "radius_mm": 30, "angle_deg": [50, 40]}"#;
const RING: &str = r#"{"kind": "torus", "major_mm": 30, "minor_mm": 10, "angle_deg": [60, 360]}"#;

#[test]
fn on_a_plane_passes_are_parallel_and_a_strip_apart() {
    let (_, plan) = planned(&analytic(PLANE, "v_low", "u")[0]);
    let passes: Vec<f64> = {
        let moves = plan.emitted.toolpath.moves.iter().zip(&plan.touches);
        let mut ys: Vec<f64> = moves.filter(|(m, _)| m.role == Role::Cut).map(|(_, t)| t.point.y).collect();
        ys.sort_by(f64::total_cmp);
        ys.dedup_by(|b, a| *b - *a < 0.1);
        ys
    };
    let steps: Vec<f64> = passes.windows(2).map(|w| w[1] - w[0]).collect();
    let (_, iso) = planned(&analytic(PLANE, "v_low", "u")[1]);
    assert!((length(&plan) / length(&iso) - 1.0).abs() < 2e-3, "{} {}", length(&plan), length(&iso));
    // All but the last, which the border stops, within half a percent.
    let inner = &steps[..steps.len() - 1];
    assert!(inner.iter().all(|s| (s / inner[0] - 1.0).abs() < 5e-3), "{steps:?}");
    // What is told of each contact: the posture that was given, and strips as wide as passes are apart.
    let told: Vec<_> = plan.touches.iter().filter_map(|t| t.contact).collect();
    let strips: Vec<f64> = told.iter().filter_map(|(_, work)| work.strip).collect();
    assert!(strips.len() > told.len() / 2 && told.iter().all(|(_, work)| work.bound == Bound::Given));
    assert!(strips.iter().all(|s| (s / inner[0] - 1.0).abs() < 5e-3), "{strips:?}");
}

#[test]
fn closed_faces_are_cut_from_their_borders_and_from_lines_along_them() {
    for (source, start) in
        [(TUBE, "v_low"), (TUBE, "u_low"), (TUBE, "v_line"), (CAP, "v_low"), (RING, "u_line")]
    {
        let median = proven(&planned(&analytic(source, start, "u")[0]));
        assert!(median >= 0.9, "{source} {start}: {median}");
    }
}

#[test]
fn where_widths_differ_paths_are_shorter_than_iso_parametric_ones() {
    // At the inside of a ring strips are narrower than at the outside.
    let [even, iso] = analytic(RING, "u_line", "v").map(|job| length(&planned(&job).1));
    assert!(even < 0.9 * iso, "{even} {iso}");
}

/// Each with how long it may be beside the iso-parametric path along the same parameter.
#[test]
fn the_gallery_has_even_cusps_on_no_longer_paths() {
    for (i, start, along, most) in
        [(0, "v_high", "u", 0.97), (0, "u_low", "v", 0.94), (1, "u_high", "v", 0.88), (2, "v_low", "u", 1.0)]
    {
        let mut job: Value = serde_json::from_str(&job::gallery()[i].spec.to_json()).unwrap();
        job["name"] = format!("{} from {start}", job["name"]).into();
        job["strategy"] = json!({"kind": "iso_parametric", "along": along, "lead_deg": 8});
        let iso = length(&planned(&job).1);
        job["strategy"] = json!({"kind": "constant_scallop", "start": start, "lead_deg": 8});
        let even = planned(&job);
        let share = length(&even.1) / iso;
        assert!(share <= most, "{}: {share} of {iso}", job["name"]);
        let median = proven(&even);
        assert!(median >= 0.9, "{}: {median}", job["name"]);
    }
}

#[test]
fn chosen_postures_are_offset_too() {
    let mut job: Value = serde_json::from_str(&job::gallery()[0].spec.to_json()).unwrap();
    let [even, iso] = [
        json!({"kind": "constant_scallop", "start": "u_low", "rule": "matched"}),
        json!({"kind": "iso_parametric", "along": "v", "rule": "matched"}),
    ]
    .map(|strategy| {
        job["strategy"] = strategy;
        planned(&job)
    });
    let share = length(&even.1) / length(&iso.1);
    assert!(share <= 0.93, "{share}");
    // Near where curvatures match strips break off at half their width: what lies beside them is below the limit by more.
    let median = proven(&even);
    assert!(median >= 0.54, "{median}");
}

#[test]
fn any_number_of_workers_writes_the_same_bytes() {
    let mut job: Value = serde_json::from_str(&job::gallery()[0].spec.to_json()).unwrap();
    let [section, evened] = [
        json!({"kind": "constant_scallop", "start": "section", "angle_deg": 20}),
        json!({"kind": "constant_scallop", "start": "u_high", "rule": "matched"}),
    ];
    let mut net = job.clone();
    net["source"] = json!({
        "kind": "nurbs", "degrees": [2, 2], "knots_u": [0, 0, 0, 1, 1, 1], "knots_v": [0, 0, 0, 1, 1, 1],
        "points_mm": [[0, 0, 0], [0, 12, 5], [0, 25, 0], [12, 0, 5], [12, 12, 12], [12, 25, 5], [25, 0, 0], [25, 12, 5], [25, 25, 0]],
    });
    (job["strategy"], net["strategy"]) = (section, evened);
    for job in [job, net] {
        let (spec, alone) = planned(&job);
        let many = job::plan(&spec, None, &Stage::whole(&Silent, NonZeroUsize::new(3).unwrap())).unwrap();
        assert!(alone.apt == many.apt && alone.csv == many.csv);
    }
}
