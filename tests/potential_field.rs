//! The planner of the machining potential field: proven, and no longer than what a person would pick.

use serde_json::{Value, json};
use std::num::NonZeroUsize;
use stepover::job::{self, Plan, Spec};
use stepover::monitor::{Silent, Stage};
use stepover::toolpath::Role;

fn planned(job: &Value, strategy: Value) -> Plan {
    let mut job = job.clone();
    job["strategy"] = strategy;
    let spec = Spec::from_json(&job.to_string()).unwrap();
    job::plan(&spec, None, &Stage::whole(&Silent, NonZeroUsize::new(2).unwrap())).unwrap()
}

fn job(source: Value) -> Value {
    json!({
        "source": source,
        "cutter": {"kind": "bull_nose", "diameter_mm": 10, "corner_radius_mm": 2, "height_mm": 40},
        "strategy": {"kind": "flow"},
        "tolerance": {"scallop_mm": 0.05},
    })
}

/// A bicubic patch over 40 mm with these heights at its net.
fn patch(z: impl Fn(f64, f64) -> f64) -> Value {
    let knots = [0.0, 0.0, 0.0, 0.0, 0.25, 0.5, 0.75, 1.0, 1.0, 1.0, 1.0];
    let at = |k: i32| f64::from(k) / 6.0 - 0.5;
    let net = (0..7).flat_map(|i| (0..7).map(move |j| (at(i), at(j))));
    let points: Vec<[f64; 3]> = net.map(|(x, y)| [40.0 * x, 40.0 * y, z(x, y)]).collect();
    job(json!({"kind": "nurbs", "degrees": [3, 3], "knots_u": knots, "knots_v": knots, "points_mm": points}))
}

fn length(plan: &Plan) -> f64 {
    plan.emitted.toolpath.length(Role::Cut)
}

fn assert_holds(plan: &Plan) {
    let verified = plan.prove(&Stage::silent()).unwrap().unwrap().verified;
    let report = plan.report(None);
    assert!(job::holds(&verified, report.scallop_mm), "{verified:?}");
    // What is told to be out of reach is not proven.
    assert!(report.unreachable.area_mm2 <= 0.0, "{}", report.unreachable.area_mm2);
}

/// On a saddle strips are widest along its diagonals, and one family covers it.
#[test]
fn a_saddle_is_cut_along_its_diagonals() {
    let saddle = patch(|x, y| 24.0 * x * y);
    let field = planned(&saddle, json!({"kind": "potential_field", "lead_deg": 5}));
    assert_holds(&field);
    for along in ["u", "v"] {
        let plain = planned(&saddle, json!({"kind": "iso_parametric", "along": along, "lead_deg": 5}));
        assert!(length(&field) < 0.9 * length(&plain), "{along}: {} {}", length(&field), length(&plain));
    }
    let flow = planned(&saddle, json!({"kind": "flow", "lead_deg": 5}));
    assert!((0.99..1.03).contains(&(length(&field) / length(&flow))), "{} {}", length(&field), length(&flow));
}

/// Round a hump strips are widest along closed lines, which no parameter and no plane follows.
#[test]
fn a_hump_is_cut_round() {
    let hump = patch(|x, y| 5.6 * libm::exp(-14.0 * (x * x + y * y)));
    let border = json!({"kind": "constant_scallop", "start": "u_low", "lead_deg": 5});
    let border = planned(&hump, border);
    for kind in ["potential_field", "flow"] {
        let round = planned(&hump, json!({"kind": kind, "lead_deg": 5}));
        assert_holds(&round);
        assert!(length(&round) < 0.97 * length(&border), "{kind}: {} {}", length(&round), length(&border));
    }
}

/// On hills and hollows a new family begins where passes have become inefficient.
#[test]
fn families_meet_without_a_scar() {
    let hills = patch(|x, y| 3.0 * libm::sin(6.0 * x) * libm::cos(6.0 * y + 0.5));
    let with = |percent: i32| json!({"kind": "potential_field", "lead_deg": 15, "least_efficiency_percent": percent});
    let [once, often] = [50, 95].map(|percent| planned(&hills, with(percent)));
    assert_holds(&once);
    assert_holds(&often);
    let passes = |plan: &Plan| plan.report(None).passes;
    assert!(passes(&often) > passes(&once), "{} {}", passes(&often), passes(&once));
    // What families gain in width they lose again where they meet, on a face that is no larger than this.
    assert!((0.9..1.1).contains(&(length(&often) / length(&once))), "{} {}", length(&often), length(&once));
}

/// Bent round, a tube is closed: lines along the widest strips run round it and into themselves.
#[test]
fn a_bent_tube_is_cut_round_by_less_than_its_parameters() {
    let source = json!({"kind": "torus", "major_mm": 20, "minor_mm": 8, "angle_deg": [40, 360]});
    let tube = job(source);
    let flow = planned(&tube, json!({"kind": "flow", "lead_deg": 25}));
    assert_holds(&flow);
    for along in ["u", "v"] {
        let plain = planned(&tube, json!({"kind": "iso_parametric", "along": along, "lead_deg": 25}));
        assert!(length(&flow) < 0.97 * length(&plain), "{along}: {} {}", length(&flow), length(&plain));
    }
}

/// At a fixed lead a blade with rolled edges is out of reach in places, others in every direction of feed: what one family cannot reach
/// but another cuts is not left out, nor kept from the proof.
#[test]
fn what_another_family_cuts_is_reached() {
    let source = json!({"kind": "file", "path": "bladex_lower.iges", "face": 0, "side": "back"});
    let bytes = std::fs::read("tests/data/bladex_lower.iges").unwrap();
    let [field, plain] = [
        json!({"kind": "potential_field", "lead_deg": 5}),
        json!({"kind": "iso_parametric", "along": "v", "lead_deg": 5}),
    ]
    .map(|strategy| {
        let mut job = job(source.clone());
        (job["strategy"], job["tolerance"]) = (strategy, json!({"scallop_mm": 0.4}));
        let spec = Spec::from_json(&job.to_string()).unwrap();
        let stage = Stage::whole(&Silent, NonZeroUsize::new(2).unwrap());
        job::plan(&spec, Some(&bytes), &stage).unwrap().unreached().area()
    });
    assert!(plain > 100.0 && field < 1.5 * plain, "{field} {plain}");
}
