//! Links keep clear of the part with cutter and holder, and above what the part stands on.

use glam::DVec3;
use std::num::NonZeroUsize;
use stepover::job::{self, Plan, Shape, Spec};
use stepover::monitor::{Silent, Stage};
use stepover::toolpath::{ClPoint, Rate, Role};
use stepover::verify::Samples;

/// The wave of the gallery, coarser, with other settings: `holder` and what stands in `links`, JSON; and the order of its passes.
fn planned(holder: &str, links: &str, order: &str) -> (Plan, Vec<DVec3>) {
    let stage = Stage::whole(&Silent, NonZeroUsize::MIN);
    let wave = job::gallery().into_iter().find(|example| example.id == "wave").unwrap();
    let mut json: serde_json::Value = serde_json::from_str(&wave.spec.to_json()).unwrap();
    json["tolerance"]["scallop_mm"] = 0.2.into();
    json["tolerance"]["chord_mm"] = 0.02.into();
    json["strategy"]["order"] = order.into();
    json["holder"] = serde_json::from_str(holder).unwrap();
    for (key, value) in serde_json::from_str::<serde_json::Value>(links).unwrap().as_object().unwrap() {
        json["links"][key] = value.clone();
    }
    let spec = Spec::from_json(&json.to_string()).unwrap();
    let plan = job::plan(&spec, None, &stage).unwrap();
    let (Shape::Face(face), _) = spec.source.shape(None).unwrap() else { panic!("a surface") };
    let samples = Samples::of_face(&face, 1.0).unwrap();
    (plan, samples.samples.iter().map(|sample| sample.point).collect())
}

/// How deep any of `points` is in a cylinder around the axis from `low` to `high` above the tip, mm, 0 where none is.
fn depth(points: &[DVec3], cl: &ClPoint, [low, high, radius]: [f64; 3]) -> f64 {
    let inside = |p: &DVec3| {
        let v = *p - cl.tip;
        let up = v.dot(cl.axis);
        (radius - (v - up * cl.axis).length()).min(up - low).min(high - up)
    };
    points.iter().map(inside).fold(0.0, f64::max)
}

/// Places on the links of a plan, half a millimetre apart.
fn links(plan: &Plan) -> Vec<ClPoint> {
    let mut places = Vec::new();
    for pair in plan.emitted.toolpath.moves.windows(2).filter(|pair| pair[1].role == Role::Link) {
        let (a, b) = (pair[0].to, pair[1].to);
        let steps = (a.tip.distance(b.tip) / 0.5).ceil().clamp(1.0, 400.0) as u32;
        places.extend((0..=steps).map(|k| {
            let t = f64::from(k) / f64::from(steps);
            ClPoint { tip: a.tip.lerp(b.tip, t), axis: a.axis.lerp(b.axis, t).normalize() }
        }));
    }
    places
}

const SHORT: &str = r#"{"shape": "cylinder", "stickout_mm": 31, "diameter_mm": 63, "height_mm": 80}"#;
const NONE: &str = r#"{"shape": "none"}"#;

#[test]
fn links_clear_the_part_with_cutter_and_holder() {
    let (plan, points) = planned(SHORT, "{}", "zigzag");
    assert!(
        !plan.report(None).warnings.iter().any(|w| w.contains("holder")),
        "{:?}",
        plan.report(None).warnings
    );
    for cl in links(&plan) {
        let held = depth(&points, &cl, [31.0, 111.0, 31.5]);
        assert!(held == 0.0, "the holder is {held} mm in the part at {cl:?}");
        // The cutter touches where a link begins and ends.
        assert!(depth(&points, &cl, [2.0, 31.0, 4.0]) < 0.01, "{cl:?}");
    }
}

#[test]
fn links_stay_above_what_the_part_stands_on() {
    let fixture = r#"{"fixture": "plane", "fixture_z_mm": -12}"#;
    let (plan, _) = planned(NONE, fixture, "zigzag");
    assert!(
        !plan.report(None).warnings.iter().any(|w| w.contains("fixture")),
        "{:?}",
        plan.report(None).warnings
    );
    for cl in links(&plan) {
        let sine = (1.0 - cl.axis.z * cl.axis.z).max(0.0).sqrt();
        assert!(cl.tip.z - 4.0 * sine > -12.0, "{cl:?}");
    }
    let (plan, _) = planned(NONE, r#"{"fixture": "plane", "fixture_z_mm": 0}"#, "zigzag");
    let warnings = plan.report(None).warnings;
    assert!(warnings.iter().any(|w| w.contains("the tool goes below the fixture at")), "{warnings:?}");
}

#[test]
fn climb_and_conventional_leave_what_is_uncut_on_their_sides() {
    for (order, is_right) in [("climb", true), ("conventional", false)] {
        let (plan, _) = planned(NONE, "{}", order);
        // The middle of each pass, its feed and its axis.
        let moves = &plan.emitted.toolpath.moves;
        let mut middles: Vec<(DVec3, DVec3, DVec3)> = Vec::new();
        let mut at = 0;
        while at < moves.len() {
            let count = moves[at..].iter().take_while(|step| step.role == Role::Cut).count();
            if count > 4 {
                let k = at + count / 2;
                let feed = (moves[k].to.tip - moves[k - 1].to.tip).normalize();
                middles.push((moves[k].to.tip, feed, moves[k].to.axis));
                assert!(matches!(moves[k].rate, Rate::Feed(_)));
            }
            at += count.max(1);
        }
        assert!(middles.len() > 5);
        for pair in middles.windows(2) {
            let ((from, feed, axis), (to, next, _)) = (pair[0], pair[1]);
            assert!(feed.dot(next) > 0.9, "one way");
            let right = feed.cross(axis);
            assert_eq!((to - from).dot(right) > 0.0, is_right, "{order}");
        }
    }
}
