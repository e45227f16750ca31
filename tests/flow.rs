//! Passes along the widest strips: shorter than the best of the plain families, proven, and no strip more where nothing can be gained.

use serde_json::{Value, json};
use std::num::NonZeroUsize;
use stepover::job::{self, Plan, Spec};
use stepover::monitor::{Silent, Stage};
use stepover::toolpath::Role;

fn planned(job: &Value) -> Plan {
    let spec = Spec::from_json(&job.to_string()).unwrap();
    job::plan(&spec, None, &Stage::whole(&Silent, NonZeroUsize::new(2).unwrap())).unwrap()
}

fn example(id: &str) -> Value {
    let gallery = job::gallery();
    let example = gallery.iter().find(|example| example.id == id).unwrap();
    serde_json::from_str(&example.spec.to_json()).unwrap()
}

fn length(plan: &Plan) -> f64 {
    plan.emitted.toolpath.length(Role::Cut)
}

fn with(job: &Value, strategy: Value) -> Value {
    let mut job = job.clone();
    job["strategy"] = strategy;
    job
}

fn assert_holds(plan: &Plan) {
    let verified = plan.prove(&Stage::silent()).unwrap().unwrap().verified;
    assert!(job::holds(&verified, plan.report(None).scallop_mm), "{verified:?}");
}

/// On the blade all strips are widest aslant, where neither parameter runs.
#[test]
fn where_strips_are_widest_aslant_passes_run_aslant() {
    let blade = example("blade");
    let flow = planned(&with(&blade, json!({"kind": "flow", "lead_deg": 5})));
    assert_holds(&flow);
    for along in ["u", "v"] {
        let plain = planned(&with(&blade, json!({"kind": "iso_parametric", "along": along, "lead_deg": 5})));
        assert!(length(&flow) < 0.86 * length(&plain), "{along}: {} {}", length(&flow), length(&plain));
    }
    let spec = Spec::from_json(&blade.to_string()).unwrap();
    let floor = job::least_length(&spec, None, &Stage::silent()).unwrap().unwrap();
    assert!((1.0..1.15).contains(&(length(&flow) / floor.length)), "{} of {floor:?}", length(&flow));
}

#[test]
fn on_hills_and_hollows_it_is_shorter_than_along_parameters() {
    let wave = example("wave");
    let flow = planned(&with(&wave, json!({"kind": "flow", "lead_deg": 8})));
    assert_holds(&flow);
    for along in ["u", "v"] {
        let plain = planned(&with(&wave, json!({"kind": "iso_parametric", "along": along, "lead_deg": 8})));
        assert!(length(&flow) < 0.95 * length(&plain), "{along}: {} {}", length(&flow), length(&plain));
    }
}

/// Between hills and hollows strips are widest in four directions by turns: families share the face, and meet without a scar.
#[test]
fn several_families_cut_less_than_one() {
    let mut wave = example("wave");
    wave["cutter"] = json!({"kind": "bull_nose", "diameter_mm": 10, "corner_radius_mm": 2, "height_mm": 40});
    wave["tolerance"] = json!({"scallop_mm": 0.02});
    let strategy = |families: &str| json!({"kind": "flow", "lead_deg": 15, "families": families});
    let [one, several] = ["one", "several"].map(|families| planned(&with(&wave, strategy(families))));
    assert_holds(&several);
    assert!(length(&several) < 0.97 * length(&one), "{} {}", length(&several), length(&one));
    let passes = |plan: &Plan| plan.report(None).passes;
    assert!(passes(&several) > passes(&one), "{} {}", passes(&several), passes(&one));
}

/// On a plane and in a trough that is cut along there is nothing to gain.
#[test]
fn where_nothing_can_be_gained_nothing_is_lost() {
    let plane = json!({"kind": "plane", "size_mm": [40, 25]});
    let trough =
        json!({"kind": "cylinder", "radius_mm": 60, "angle_deg": 30, "length_mm": 40, "side": "back"});
    for (name, source, along) in [("plane", plane, "u"), ("trough", trough, "v")] {
        let mut job = example("wave");
        job["name"] = name.into();
        job["source"] = source;
        let flow = planned(&with(&job, json!({"kind": "flow", "lead_deg": 8})));
        let plain = planned(&with(&job, json!({"kind": "iso_parametric", "along": along, "lead_deg": 8})));
        assert!(length(&flow) <= 1.02 * length(&plain), "{name}: {} {}", length(&flow), length(&plain));
        assert_holds(&flow);
    }
}

/// What is chosen is no slower than any of those it was chosen from.
#[test]
fn auto_takes_the_quickest_that_holds() {
    let mut job = with(&example("wave"), json!({"kind": "auto", "lead_deg": 8}));
    job["source"] = json!({"kind": "sphere", "radius_mm": 40, "angle_deg": [30, 20]});
    let auto = planned(&job);
    assert_holds(&auto);
    let minutes = auto.report(None).time_min;
    assert_ne!(auto.report(None).strategy, "auto");
    let spec = Spec::from_json(&job.to_string()).unwrap();
    for contender in job::contenders(&spec, None).unwrap() {
        let other = job::plan(&contender.spec, None, &Stage::silent()).unwrap().report(None);
        assert!(minutes <= other.time_min, "{}: {minutes} {}", contender.name, other.time_min);
    }
}
