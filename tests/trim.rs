//! Passes end where nothing is left for them: no sooner, as the proof shows, and not much later.

use serde_json::{Value, json};
use stepover::job::{self, Plan, Spec};
use stepover::monitor::Stage;

fn planned(source: &Value, strategy: &Value) -> Plan {
    let spec = json!({
        "version": 1,
        "name": "ends",
        "source": source,
        "cutter": {"kind": "bull_nose", "diameter_mm": 10, "corner_radius_mm": 2, "height_mm": 40},
        "strategy": strategy,
        "tolerance": {"scallop_mm": 0.01},
    });
    let plan = job::plan(&Spec::from_json(&spec.to_string()).unwrap(), None, &Stage::silent()).unwrap();
    let verified = plan.prove(&Stage::silent()).unwrap().unwrap().verified;
    assert!(verified.largest_excess_mm.unwrap() <= 0.01, "{verified:?}");
    plan
}

/// Without yaw strips are square to the feed; with it they lie aslant by about as much: one side is cut before the contact, the other
/// behind it.
#[test]
fn on_a_plane_passes_run_out_as_far_as_their_strips_lie_aslant() {
    let source = json!({"kind": "plane", "size_mm": [24, 12]});
    for yaw in [0.0f64, 15.0, -30.0] {
        let strategy = json!({"kind": "iso_parametric", "along": "u", "lead_deg": 5, "yaw_deg": yaw});
        let plan = planned(&source, &strategy);
        let contacts: Vec<_> = plan.touches.iter().filter_map(|t| Some((t.point, t.contact?))).collect();
        let width = contacts.iter().find_map(|(_, (_, work))| work.strip).unwrap();
        let beyond = contacts.iter().map(|(p, _)| p.x.abs() - 12.0).fold(f64::NEG_INFINITY, f64::max);
        let aslant = 0.5 * width * libm::tan(yaw.to_radians().abs());
        assert!((-0.2 * width..=aslant + 0.2 * width).contains(&beyond), "{yaw}: {beyond} of {width}");
    }
}
