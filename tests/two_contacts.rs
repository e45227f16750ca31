//! Two contacts at once: strips in troughs, what programs leave, and where nothing is hollow.

use serde_json::{Value, json};
use stepover::job::{self, Plan, Spec};
use stepover::monitor::Stage;
use stepover::toolpath::Role;

fn planned(job: &Value) -> Plan {
    let spec = Spec::from_json(&job.to_string()).unwrap();
    job::plan(&spec, None, &Stage::silent()).unwrap()
}

fn length(plan: &Plan) -> f64 {
    plan.emitted.toolpath.length(Role::Cut)
}

/// Excess at most the scallop plus what sampling can miss, gouge at most a micrometre.
fn assert_keeps(plan: &Plan) {
    let report = plan.report(None);
    let verified = plan.prove(&Stage::silent()).unwrap().unwrap().verified;
    let (name, h) = (&report.name, report.scallop_mm);
    let (excess, gouge) = (verified.largest_excess_mm.unwrap(), verified.largest_gouge_mm.unwrap());
    let limit = h + verified.sampling_error_mm.unwrap();
    assert!(excess <= limit, "{name}: {excess} of {h} at {:?}", verified.largest_excess_at);
    assert!(gouge >= -0.001, "{name}: {gouge} at {:?}", verified.largest_gouge_at);
    assert!(verified.uncut_area_mm2 <= 0.0, "{name}: {} mm² uncut", verified.uncut_area_mm2);
}

/// A trough along x with a bull-nose mill of centre radius `r1`.
fn trough(radius: f64, width: f64, r1: f64, r: f64, rule: &str) -> Value {
    json!({
        "name": format!("trough {radius} {r1} {rule}"),
        "source": {
            "kind": "cylinder", "radius_mm": radius, "angle_deg": (width / radius).to_degrees(), "length_mm": 30,
            "side": "back",
        },
        "cutter": {"kind": "bull_nose", "diameter_mm": 2.0 * (r1 + r), "corner_radius_mm": r, "height_mm": 60},
        "strategy": {"kind": "iso_parametric", "along": "v", "rule": rule},
        "tolerance": {"scallop_mm": 0.01},
        "verify": {"spacing_mm": 0.5},
    })
}

/// The table's strips are the widest of all, with all of the scallop height as lift. Here 3 % of it and a fifth of a micrometre are
/// kept back at the nodes, and passes keep up to 1 % of the distance that they could have; all together half a percent.
#[test]
fn passes_in_a_trough_lie_as_far_apart_as_strips_are_wide() {
    for (radius, width, r1, r, expected) in
        [(50.0, 56.0, 9.5, 3.0, 12.39), (100.0, 60.0, 9.5, 3.0, 13.90), (50.0, 26.0, 3.0, 2.0, 5.95)]
    {
        let plan = planned(&trough(radius, width, r1, r, "two_contacts"));
        // With feed along the trough the axis tells where around it a pass lies.
        let mut around: Vec<f64> = (plan.emitted.toolpath.moves.iter())
            .filter(|m| m.role == Role::Cut)
            .map(|m| libm::atan2(-m.to.axis.y, -m.to.axis.z))
            .collect();
        around.sort_by(f64::total_cmp);
        around.dedup_by(|a, b| (*a - *b).abs() < 1e-4);
        let step = |w: &[f64]| 2.0 * radius * libm::sin(0.5 * (w[1] - w[0]));
        let whole = around.windows(2).map(step).filter(|step| *step > 0.9 * expected);
        let shares: Vec<f64> = whole.map(|step| step / expected).collect();
        // The first or the last one may lie anywhere, and a short one beside a border.
        assert!(shares.len() + 3 >= around.len() && shares.len() >= 3, "{radius} {r1}: {around:?}");
        assert!(shares.iter().all(|share| (0.99..1.002).contains(share)), "{radius} {r1}: {shares:?}");
        assert_keeps(&plan);
    }
}

#[test]
fn parallel_planes_along_a_hollow_save_a_tenth() {
    let [two, matched] = ["two_contacts", "matched"].map(|rule| {
        let mut job = trough(50.0, 60.0, 9.5, 3.0, rule);
        job["strategy"] = json!({"kind": "iso_planar", "angle_deg": 0, "rule": rule});
        planned(&job)
    });
    assert!(length(&two) < 0.9 * length(&matched), "{} {}", length(&two), length(&matched));
    assert_keeps(&two);
}

#[test]
fn where_nothing_is_hollow_it_is_the_matched_path() {
    let [two, matched] = ["two_contacts", "matched"].map(|rule| {
        let mut job = trough(30.0, 30.0, 3.0, 2.0, rule);
        job["source"]["side"] = "front".into();
        job["name"] = "".into();
        planned(&job).apt
    });
    assert!(two == matched);
}

#[test]
fn the_wave_is_cut_on_no_longer_path() {
    no_longer(0);
}

#[test]
fn the_blade_is_cut_on_no_longer_path() {
    no_longer(1);
}

fn no_longer(example: usize) {
    let mut job: Value = serde_json::from_str(&job::gallery()[example].spec.to_json()).unwrap();
    let [two, matched] = ["two_contacts", "matched"].map(|rule| {
        job["strategy"]["rule"] = rule.into();
        planned(&job)
    });
    assert!(length(&two) <= length(&matched), "{} {}", length(&two), length(&matched));
    assert_keeps(&two);
}
