//! Cuts keep the holder clear of the part: a posture is chosen that does, or the place is left, and told.

use glam::DVec3;
use serde_json::{Value, json};
use stepover::job::{self, Plan, Shape, Spec};
use stepover::monitor::Stage;
use stepover::toolpath::Role;
use stepover::verify::Samples;

const STICKOUT: f64 = 10.0;
const RADIUS: f64 = 13.0;

fn source() -> Value {
    json!({"kind": "cylinder", "radius_mm": 20, "angle_deg": 120, "length_mm": 12, "side": "back"})
}

/// A trough of radius 20 mm cut round it. Leaning by 7° the holder has 1 mm to the wall, by 20° it is 1.7 mm inside.
fn planned(posture: &Value, holder: &Value) -> Plan {
    planned_on(source(), posture, holder)
}

fn planned_on(source: Value, posture: &Value, holder: &Value) -> Plan {
    let mut strategy = json!({"kind": "iso_parametric", "along": "u"});
    for (key, value) in posture.as_object().unwrap() {
        strategy[key] = value.clone();
    }
    let spec = json!({
        "source": source,
        "cutter": {"kind": "bull_nose", "diameter_mm": 6, "corner_radius_mm": 1, "height_mm": 8},
        "holder": holder,
        "strategy": strategy,
        "tolerance": {"scallop_mm": 0.05},
    });
    job::plan(&Spec::from_json(&spec.to_string()).unwrap(), None, &Stage::silent()).unwrap()
}

fn held() -> Value {
    json!({"shape": "cylinder", "stickout_mm": STICKOUT, "diameter_mm": 2.0 * RADIUS, "height_mm": 60})
}

/// How deep the holder reaches into the part at any cut, mm: by the places of the surface inside its cylinder.
fn depth(plan: &Plan) -> f64 {
    let spec = Spec::from_json(&json!({"source": source()}).to_string()).unwrap();
    let (Shape::Face(face), _) = spec.source.shape(None).unwrap() else { panic!("a surface") };
    let points: Vec<DVec3> = Samples::of_face(&face, 0.5).unwrap().samples.iter().map(|s| s.point).collect();
    let cuts = plan.emitted.toolpath.moves.iter().filter(|m| m.role == Role::Cut);
    let inside = |p: &DVec3, tip: DVec3, axis: DVec3| {
        let v = *p - tip;
        let up = v.dot(axis);
        (up - STICKOUT).min(RADIUS - (v - axis * up).length())
    };
    cuts.flat_map(|m| points.iter().map(move |p| inside(p, m.to.tip, m.to.axis))).fold(0.0, f64::max)
}

#[test]
fn where_the_holder_would_meet_the_part_nothing_is_cut_and_that_is_told() {
    let free = planned(&json!({"lead_deg": 20}), &json!({"shape": "none"}));
    assert!(free.unreached().is_empty() && depth(&free) > 0.5, "{}", depth(&free));
    let plan = planned(&json!({"lead_deg": 20}), &held());
    assert_eq!(depth(&plan), 0.0);
    assert!(plan.unreached().area() > 50.0, "{}", plan.unreached().area());
    let warnings = plan.report(None).warnings;
    assert!(warnings.iter().any(|w| w.contains("more stick-out")), "{warnings:?}");
}

/// How many moves lean as they do for the holder.
fn for_holder(plan: &Plan) -> usize {
    plan.csv.lines().filter(|line| line.ends_with(",holder")).count()
}

#[test]
fn what_keeps_the_lead_is_told_to_be_the_holder() {
    // A flat trough asks for hardly any lead. Where it begins there is a wall ahead and none behind: leaning back takes a wide
    // holder out of it.
    let trough =
        json!({"kind": "cylinder", "radius_mm": 60, "angle_deg": 80, "length_mm": 12, "side": "back"});
    let chosen = json!({"rule": "matched"});
    let wide = json!({"shape": "cylinder", "stickout_mm": STICKOUT, "diameter_mm": 70, "height_mm": 60});
    let free = planned_on(trough.clone(), &chosen, &json!({"shape": "none"}));
    let held = planned_on(trough, &chosen, &wide);
    assert_eq!(for_holder(&free), 0);
    assert!(for_holder(&held) > 20, "{}", for_holder(&held));
    // Where the cutter's own body asks for lead, a holder that is far off is not to blame.
    let far = json!({"shape": "cylinder", "stickout_mm": 60, "diameter_mm": 10, "height_mm": 60});
    let narrow = planned(&chosen, &far);
    assert!(narrow.csv.lines().filter(|line| line.ends_with(",body")).count() > 20);
    assert_eq!(for_holder(&narrow), 0);
}

#[test]
fn postures_are_chosen_that_keep_it_clear() {
    for posture in [json!({"lead_deg": 7}), json!({"rule": "widest"})] {
        let plan = planned(&posture, &held());
        assert!(plan.unreached().is_empty(), "{posture}: {} mm²", plan.unreached().area());
        assert_eq!(depth(&plan), 0.0, "{posture}");
    }
}
