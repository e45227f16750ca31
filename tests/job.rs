//! Whole jobs: what the emitted text leaves, measured by the simulation.

use std::num::NonZeroUsize;
use stepover::job::{self, Plan, Spec, Verified};
use stepover::monitor::{Cancelled, Monitor, Silent, Stage};
use stepover::toolpath::Role;

fn planned(spec: &Spec, bytes: Option<&[u8]>) -> Plan {
    job::plan(spec, bytes, &Stage::silent()).unwrap()
}

fn proven(plan: &Plan) -> Verified {
    plan.prove(&Stage::silent()).unwrap().unwrap().verified
}

/// Excess at most the scallop plus what sampling can miss; gouge at most a micrometre.
fn assert_keeps(spec: &Spec, verified: &Verified) {
    let error = verified.sampling_error_mm.unwrap();
    let (excess, gouge) = (verified.largest_excess_mm.unwrap(), verified.largest_gouge_mm.unwrap());
    assert!(
        excess <= spec.tolerance.scallop_mm + error,
        "{}: {excess} of {}, at {:?}",
        spec.name,
        spec.tolerance.scallop_mm,
        verified.largest_excess_at
    );
    assert!(gouge >= -0.001, "{}: {gouge} at {:?}", spec.name, verified.largest_gouge_at);
    assert!(verified.uncut_area_mm2 <= 0.0, "{}: {} mm² uncut", spec.name, verified.uncut_area_mm2);
}

#[test]
fn gallery_keeps_its_promise() {
    for example in job::gallery() {
        let plan = planned(&example.spec, None);
        assert_keeps(&example.spec, &proven(&plan));
    }
}

/// Every strategy for surfaces over every kind of analytic surface, with yaw and without.
#[test]
fn strategies_keep_their_promise_on_analytic_surfaces() {
    let sources = [
        r#"{"kind": "plane", "size_mm": [30, 20]}"#,
        r#"{"kind": "cylinder", "radius_mm": 30, "angle_deg": 50, "length_mm": 20}"#,
        r#"{"kind": "cylinder", "radius_mm": 40, "angle_deg": 40, "length_mm": 20, "side": "back"}"#,
        r#"{"kind": "cone", "radius_start_mm": 12, "radius_end_mm": 20, "angle_deg": 70, "length_mm": 20}"#,
        r#"{"kind": "sphere", "radius_mm": 60, "angle_deg": [25, 20], "side": "back"}"#,
        r#"{"kind": "torus", "major_mm": 30, "minor_mm": 25, "angle_deg": [25, 40]}"#,
        r#"{"kind": "cylinder", "radius_mm": 8, "angle_deg": 360, "length_mm": 12}"#,
    ];
    let strategies = [
        r#"{"kind": "iso_parametric", "along": "u", "lead_deg": 10}"#,
        r#"{"kind": "iso_parametric", "along": "v", "lead_deg": 15, "yaw_deg": 25, "order": "zig"}"#,
        r#"{"kind": "iso_planar", "angle_deg": 35, "lead_deg": 12}"#,
    ];
    for source in sources {
        for strategy in strategies {
            // A section of a closed tube by parallel planes runs through places where plane and surface touch.
            if source.contains("360") && strategy.contains("planar") {
                continue;
            }
            let text = format!(
                r#"{{"name": "{} {}", "source": {source}, "strategy": {strategy},
                "cutter": {{"kind": "bull_nose", "diameter_mm": 8, "corner_radius_mm": 2}},
                "tolerance": {{"scallop_mm": 0.02}}, "verify": {{"spacing_mm": 0.2}}}}"#,
                source.replace('"', "'"),
                strategy.replace('"', "'")
            );
            let spec = Spec::from_json(&text).unwrap();
            assert_keeps(&spec, &proven(&planned(&spec, None)));
        }
    }
}

/// Strips grow with the root of the height.
#[test]
fn a_safety_factor_keeps_the_rest_in_reserve() {
    let [whole, part] = [1.0, 0.8].map(|safety| {
        let mut spec = job::gallery().remove(0).spec;
        spec.tolerance.safety = safety;
        let plan = planned(&spec, None);
        let verified = proven(&plan);
        assert_keeps(&spec, &verified);
        let limit = safety * spec.tolerance.scallop_mm + verified.sampling_error_mm.unwrap();
        assert!(verified.largest_excess_mm.unwrap() <= limit, "{verified:?}");
        assert_eq!(plan.report(None).scallop_mm, spec.tolerance.scallop_mm);
        plan.emitted.toolpath.length(Role::Cut)
    });
    let share = part / whole * 0.8f64.sqrt();
    assert!((share - 1.0).abs() < 0.04, "{share}");
}

#[test]
fn chords_are_judged_beside_what_is_planned_for() {
    let mut spec = job::gallery().remove(0).spec;
    (spec.tolerance.safety, spec.tolerance.chord_mm) = (0.5, 0.02);
    let error = job::plan(&spec, None, &Stage::silent()).err().unwrap();
    assert_eq!(error.field_path(), Some("tolerance.chord_mm"));
    assert!(error.to_string().contains("0.0125"), "{error}");
}

/// Planes end in the corners of a face, which is bent there.
#[test]
fn planes_at_any_angle_keep_their_promise() {
    let wave = job::gallery().remove(0).spec;
    for angle in [0, 15, 30, 45, 60, 90, 150] {
        let mut spec: serde_json::Value = serde_json::from_str(&wave.to_json()).unwrap();
        spec["name"] = format!("Wave by planes at {angle}°").into();
        spec["strategy"] = serde_json::json!({"kind": "iso_planar", "angle_deg": angle});
        let spec = Spec::from_json(&spec.to_string()).unwrap();
        assert_keeps(&spec, &proven(&planned(&spec, None)));
    }
}

#[test]
fn any_number_of_workers_writes_the_same_bytes() {
    let spec = &job::gallery()[1].spec;
    let alone = planned(spec, None);
    let many = job::plan(spec, None, &Stage::whole(&Silent, NonZeroUsize::new(3).unwrap())).unwrap();
    assert!(alone.apt == many.apt && alone.csv == many.csv);
}

/// Cancels when it has been told of half of the work.
struct HalfWay(std::sync::atomic::AtomicBool);

impl Monitor for HalfWay {
    fn progress(&self, _phase: &str, fraction: f64) {
        if fraction > 0.5 {
            self.0.store(true, std::sync::atomic::Ordering::Relaxed);
        }
    }
    fn is_cancelled(&self) -> bool {
        self.0.load(std::sync::atomic::Ordering::Relaxed)
    }
}

#[test]
fn a_job_can_be_cancelled_half_way() {
    let spec = &job::gallery()[0].spec;
    let half = HalfWay(false.into());
    let result = job::plan(spec, None, &Stage::whole(&half, NonZeroUsize::MIN));
    assert_eq!(result.err(), Some(job::JobError::Cancelled(Cancelled)));
}

#[test]
fn a_cutter_that_fits_nowhere_is_an_error_that_says_so() {
    let spec = Spec::from_json(
        r#"{"source": {"kind": "cylinder", "radius_mm": 5, "angle_deg": 360, "length_mm": 40, "side": "back"},
            "cutter": {"kind": "bull_nose", "diameter_mm": 20, "corner_radius_mm": 3}}"#,
    )
    .unwrap();
    let error = job::plan(&spec, None, &Stage::silent()).err().unwrap();
    assert_eq!(error.code(), "strategy");
    assert!(error.to_string().contains("fits nowhere"), "{error}");
}

#[test]
fn a_strategy_for_another_kind_of_shape_is_an_error_at_its_field() {
    let spec = Spec::from_json(
        r#"{"source": {"kind": "plane", "size_mm": [10, 10]}, "strategy": {"kind": "raster"}}"#,
    )
    .unwrap();
    let error = job::plan(&spec, None, &Stage::silent()).err().unwrap();
    assert_eq!(error.field_path(), Some("strategy.kind"));
}
