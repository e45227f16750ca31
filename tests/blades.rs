//! Chosen postures against a fixed lead of 5° on a blade, from the same start curve.

use serde_json::{Value, json};
use stepover::job::{self, Plan, Shape, Spec};
use stepover::monitor::Stage;

#[path = "support/cusps.rs"]
mod cusps;
#[path = "support/widths.rs"]
mod widths;

/// The gallery's blade at constant scallop from a border: R1 = 3 mm, r = 2 mm, h = 0.01 mm.
fn blade(start: &str, posture: &Value) -> (Spec, Plan) {
    let mut job: Value = serde_json::from_str(&job::gallery()[1].spec.to_json()).unwrap();
    job["strategy"] = json!({"kind": "constant_scallop", "start": start});
    for (key, value) in posture.as_object().unwrap() {
        job["strategy"][key] = value.clone();
    }
    let spec = Spec::from_json(&job.to_string()).unwrap();
    let plan = job::plan(&spec, None, &Stage::silent()).unwrap();
    (spec, plan)
}

/// What chosen postures save from a border: at least `least`, and nearly all that widths allow.
fn assert_saves(start: &str, least: f64) {
    let (spec, fixed) = blade(start, &json!({"lead_deg": 5}));
    let (_, chosen) = blade(start, &json!({"rule": "widest", "least_lead_deg": 2}));
    for plan in [&fixed, &chosen] {
        let verified = plan.prove(&Stage::silent()).unwrap().unwrap().verified;
        assert!(verified.largest_excess_mm.unwrap() <= 0.01, "{verified:?}");
        assert!(verified.largest_gouge_mm.unwrap() >= -0.001, "{verified:?}");
        assert!(verified.uncut_area_mm2 <= 0.0 && plan.unreached().is_empty(), "{verified:?}");
    }
    let Ok((Shape::Face(face), _)) = spec.source.shape(None) else { panic!() };
    let saving = widths::Saving::of([&fixed, &chosen], &face, 1.0);
    assert!(saving.made() >= least, "{saving:?}");
    assert!((0.95..=1.0).contains(&(saving.made() / saving.possible())), "{saving:?}");
    // Strips of chosen postures end steeply: places lie closer together.
    let median = cusps::median_cusp(&chosen, &face, 0.01, 0.05, &Stage::silent());
    assert!(median >= 0.9, "{median}");
}

/// Lines of the parameter come closer to one another towards one end, by a third: passes that keep apart save more.
#[test]
fn chosen_postures_save_more_than_half_along_the_blade() {
    assert_saves("u_low", 0.56);
}

#[test]
fn chosen_postures_save_nearly_half_across_the_blade() {
    assert_saves("v_low", 0.47);
}
