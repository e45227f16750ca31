//! Stepover against tilt at a constant scallop: the circle model, the exact strip, and what a simulated cut leaves.
//!
//! The surfaces behind the numbers are bent across the feed alone (planes, and cylinders fed along their axis), and a
//! stepover is the chord between neighbouring contacts.

use stepover::contact::{
    Lean, circle_stepover, effective_radius, matching_lead, straight_strip, two_contact, widest_two_contact,
};
use stepover::cutter::Cutter;
use stepover::geometry::Curvature;
use stepover::job::{Spec, TwoPasses, cut_two_passes, stepover_chart};

fn mill(center_radius: f64, corner_radius: f64) -> Cutter {
    Cutter::bull_nose(2.0 * (center_radius + corner_radius), corner_radius, 40.0).unwrap()
}

fn lead(degrees: f64) -> Lean {
    Lean::Lead(degrees.to_radians())
}

fn lateral(degrees: f64) -> Lean {
    Lean::Lateral(degrees.to_radians())
}

fn exact(cutter: &Cutter, lean: Lean, curvature: f64, scallop: f64) -> f64 {
    straight_strip(cutter, lean, curvature, scallop).unwrap().stepover
}

fn assert_near(found: f64, expected: f64, within: f64, what: &str) {
    assert!((found - expected).abs() <= within, "{what}: {found}, expected {expected}");
}

#[test]
fn stepovers_on_a_plane() {
    let cutter = mill(1.0, 2.0);
    assert!(effective_radius(1.0, 2.0, 0.0).is_infinite());
    assert_eq!(circle_stepover(&cutter, lead(0.0), 0.0, 0.5), None);
    for (tilt, circle) in [(15.0, 4.7387), (30.0, 3.8730), (45.0, 3.5576)] {
        let found = circle_stepover(&cutter, lead(tilt), 0.0, 0.5).unwrap();
        assert_near(found, circle, 5e-5, &format!("circle {tilt}"));
    }
    for (tilt, by_lead, by_side) in
        [(0.0, 4.6458, 4.646), (15.0, 4.0801, 3.452), (30.0, 3.7083, 2.725), (45.0, 3.5036, 2.646)]
    {
        assert_near(exact(&cutter, lead(tilt), 0.0, 0.5), by_lead, 6e-5, &format!("lead {tilt}"));
        assert_near(exact(&cutter, lateral(tilt), 0.0, 0.5), by_side, 5e-4, &format!("lateral {tilt}"));
    }
    let slender = mill(3.0, 2.0);
    assert_near(exact(&slender, lead(5.0), 0.0, 0.01), 1.6923, 5e-5, "plane, 5°");
    assert_near(circle_stepover(&slender, lead(5.0), 0.0, 0.01).unwrap(), 1.7068, 5e-5, "circle, 5°");
}

#[test]
fn stepovers_over_cylinders_by_lead() {
    // Curvature radius above 0 where concave.
    for (r1, h, radius, tilt, expected) in [
        (1.0, 0.5, -30.0, 15.0, 3.8201),
        (1.0, 0.5, -30.0, 30.0, 3.4813),
        (1.0, 0.5, -30.0, 45.0, 3.2999),
        (1.0, 0.5, 30.0, 15.0, 4.3745),
        (1.0, 0.5, 30.0, 30.0, 3.9694),
        (1.0, 0.5, 30.0, 45.0, 3.7378),
        (1.0, 0.5, 15.0, 15.0, 4.7073),
        (1.0, 0.5, 15.0, 30.0, 4.2725),
        (1.0, 0.5, 15.0, 45.0, 4.0104),
        (3.0, 0.01, -30.0, 5.0, 1.1449),
        (3.0, 0.01, 30.0, 15.0, 1.3996),
        (3.0, 0.01, 15.0, 15.0, 2.8933),
    ] {
        let found = exact(&mill(r1, 2.0), lead(tilt), 1.0 / radius, h);
        assert_near(found, expected, 6e-5, &format!("R1 {r1}, Ra {radius}, {tilt}°"));
    }
    let circle = circle_stepover(&mill(3.0, 2.0), lead(15.0), 1.0 / 15.0, 0.01).unwrap();
    assert_near(circle, 3.3974, 5e-5, "circle, Ra 15, 15°");
}

#[test]
fn circle_model_promises_too_much_near_curvature_match() {
    let (cutter, radius) = (mill(3.0, 2.0), 50.0);
    for (ratio, percent) in [(1.05, 105.0), (1.1, 55.0), (1.2, 24.0), (1.5, 6.4)] {
        let tilt = libm::asin(3.0 / (radius / ratio - 2.0));
        let circle = circle_stepover(&cutter, Lean::Lead(tilt), 1.0 / radius, 0.01).unwrap();
        let over = 100.0 * (circle / exact(&cutter, Lean::Lead(tilt), 1.0 / radius, 0.01) - 1.0);
        assert_near(over, percent, if percent < 10.0 { 0.05 } else { 0.6 }, &format!("Ra/Re {ratio}"));
    }
    // At the match and below it there is no circle to meet.
    let matching = matching_lead(&cutter, &Curvature::across(1.0 / radius), 0.0).unwrap();
    assert_eq!(circle_stepover(&cutter, Lean::Lead(matching - 1e-3), 1.0 / radius, 0.01), None);
    assert_eq!(straight_strip(&cutter, Lean::Lead(matching - 1e-3), 1.0 / radius, 0.01), None);
}

#[test]
fn lateral_circle_model_is_the_profile_itself() {
    // Every case of Figs. 4 to 6, by tilt and height: corner with corner, with the bottom, with the far corner, side with bottom.
    let cutter = mill(1.0, 2.0);
    for (tilt, h) in [(45.0, 0.5), (20.0, 0.5), (10.0, 0.8), (65.0, 1.4), (65.0, 0.5), (30.0, 1.2)] {
        let circle = circle_stepover(&cutter, lateral(tilt), 0.0, h).unwrap();
        assert_near(circle, exact(&cutter, lateral(tilt), 0.0, h), 1e-9, &format!("{tilt}°, h {h}"));
    }
    for curvature in [1.0 / 30.0, -1.0 / 30.0] {
        let circle = circle_stepover(&cutter, lateral(45.0), curvature, 0.3).unwrap();
        assert_near(circle, exact(&cutter, lateral(45.0), curvature, 0.3), 1e-9, "corners on a cylinder");
        // The bottom meets the corner: not in the paper.
        assert_eq!(circle_stepover(&cutter, lateral(15.0), curvature, 0.5), None);
    }
}

#[test]
fn two_contacts_are_wider_than_curvature_match() {
    for (r1, r, radius, h, at_match, best, ratio) in [
        (9.5, 3.0, 50.0, 0.01, 9.03, 12.39, 1.372),
        (9.5, 3.0, 100.0, 0.01, 10.27, 13.90, 1.354),
        (3.0, 2.0, 50.0, 0.01, 4.67, 5.95, 1.274),
        (9.5, 3.0, 50.0, 0.05, 13.13, 17.32, 1.319),
    ] {
        let (cutter, k) = (mill(r1, r), 1.0 / radius);
        let matching = matching_lead(&cutter, &Curvature::across(k), 0.0).unwrap();
        let one = exact(&cutter, Lean::Lead(matching), k, h);
        let two = widest_two_contact(&cutter, k, h).unwrap();
        assert_near(one / at_match, 1.0, 0.01, &format!("match, Ra {radius}, h {h}"));
        assert_near(two.strip.stepover / best, 1.0, 0.01, &format!("two contacts, Ra {radius}, h {h}"));
        assert_near(two.strip.stepover / one, ratio, 0.01 * ratio, &format!("ratio, Ra {radius}, h {h}"));
        assert!(two_contact(&cutter, two.lead - 1e-3, k, h).is_none(), "the middle is above the limit");
    }
    let first = widest_two_contact(&mill(9.5, 3.0), 1.0 / 50.0, 0.01).unwrap();
    assert_near(first.lead.to_degrees(), 10.49, 0.02, "lead");
    let matching = matching_lead(&mill(9.5, 3.0), &Curvature::across(1.0 / 50.0), 0.0).unwrap();
    assert_near(matching.to_degrees(), 11.66, 0.005, "matching lead");
}

/// Cuts two passes and checks that nothing is gouged and that the bound on what was found is tight.
fn cut(cutter: &Cutter, lean: Lean, curvature: f64, stepover: f64, lift: f64, scallop: f64) -> f64 {
    let TwoPasses { scallop: found, gouge, error } =
        cut_two_passes(cutter, lean, curvature, stepover, lift, scallop).unwrap();
    assert!(error <= 1e-3 * scallop && gouge > -1e-4, "{lean:?} {curvature}: {gouge} {error}");
    found
}

#[test]
fn twelve_cuts_leave_the_scallop() {
    // The published test cuts: R1 = 1, r = 2, h = 0.5, four leads over a plane and, for want of published radii, cylinders
    // of 30 mm.
    let cutter = mill(1.0, 2.0);
    for curvature in [0.0, -1.0 / 30.0, 1.0 / 30.0] {
        for tilt in [0.0, 15.0, 30.0, 45.0] {
            // Flat in a hollow the cutter stands on both sides of its bottom.
            let strip = straight_strip(&cutter, lead(tilt), curvature, 0.5)
                .or_else(|| Some(two_contact(&cutter, 0.0, curvature, 0.5)?.strip))
                .unwrap();
            assert_eq!(strip.lift > 0.0, tilt == 0.0 && curvature > 0.0);
            let found = cut(&cutter, lead(tilt), curvature, strip.stepover, strip.lift, 0.5);
            assert_near(found, 0.5, 0.005, &format!("curvature {curvature}, {tilt}°"));
        }
    }
}

#[test]
fn circle_model_leaves_more() {
    let cutter = mill(1.0, 2.0);
    for (tilt, left) in [(15.0, 0.767), (30.0, 0.554), (45.0, 0.5175)] {
        let stepover = circle_stepover(&cutter, lead(tilt), 0.0, 0.5).unwrap();
        let found = cut(&cutter, lead(tilt), 0.0, stepover, 0.0, 0.5);
        assert_near(found, left, 0.001, &format!("plane, {tilt}°"));
    }
}

#[test]
fn lateral_cuts_leave_the_scallop() {
    // Corner with corner, with the bottom, with the far corner, side with bottom; planes and cylinders.
    let cutter = mill(1.0, 2.0);
    for (tilt, h, curvature) in [
        (45.0, 0.5, 0.0),
        (20.0, 0.5, 0.0),
        (10.0, 0.8, 0.0),
        (65.0, 0.5, 0.0),
        (20.0, 0.5, 1.0 / 30.0),
        (20.0, 0.5, -1.0 / 30.0),
        (10.0, 0.8, -1.0 / 30.0),
        (65.0, 0.5, 1.0 / 30.0),
    ] {
        let stepover = exact(&cutter, lateral(tilt), curvature, h);
        let found = cut(&cutter, lateral(tilt), curvature, stepover, 0.0, h);
        assert_near(found, h, 0.01 * h, &format!("curvature {curvature}, {tilt}°, h {h}"));
    }
    // In a hollow a bottom nearly as flat as the chord under it is within the limit as a whole, until its middle is not.
    let cutter = mill(2.0, 2.0);
    let [flat, steep] = [2.5, 3.5].map(|tilt| {
        let stepover = exact(&cutter, lateral(tilt), 1.0 / 50.0, 0.05);
        let found = cut(&cutter, lateral(tilt), 1.0 / 50.0, stepover, 0.0, 0.05);
        assert_near(found, 0.05, 0.0005, &format!("{tilt}°"));
        stepover
    });
    assert!(flat > 4.0 && steep < 2.0, "{flat} {steep}");
}

#[test]
fn two_contacts_leave_the_scallop_and_gouge_nothing() {
    let (cutter, k, h) = (mill(9.5, 3.0), 1.0 / 50.0, 0.01);
    let two = widest_two_contact(&cutter, k, h).unwrap();
    let found =
        cut_two_passes(&cutter, Lean::Lead(two.lead), k, two.strip.stepover, two.strip.lift, h).unwrap();
    assert_near(found.scallop, h, 1e-4, "scallop");
    assert!(found.gouge > -2e-5, "{found:?}");
    // Without the lift both sides dig in.
    let sunk = cut_two_passes(&cutter, Lean::Lead(two.lead), k, two.strip.stepover, 0.0, h).unwrap();
    assert_near(sunk.gouge, -two.strip.lift, 1e-3, "gouge");
}

#[test]
fn chart_holds_the_curves() {
    let spec = r#"{"version": 1, "source": {"kind": "plane", "size_mm": [1, 1]},
        "cutter": {"kind": "bull_nose", "diameter_mm": 10, "corner_radius_mm": 2}, "tolerance": {"scallop_mm": 0.01}}"#;
    let spec = Spec::from_json(spec).unwrap();
    let chart = stepover_chart(&spec, &[0.0, 50.0, -50.0]).unwrap();
    for (curves, radius) in chart.curves.iter().zip([None, Some(50.0), Some(-50.0)]) {
        assert_eq!(curves.radius_mm, radius);
        assert_eq!(curves.tilt_deg.last(), Some(&60.0));
        assert!(curves.tilt_deg.is_sorted());
        for values in [&curves.circle_mm, &curves.lead_mm, &curves.lateral_mm, &curves.two_contact_mm] {
            assert_eq!(values.len(), curves.tilt_deg.len());
        }
        // Every lead is exact from the match on; two contacts end where one begins.
        let matching = curves.matching_deg.unwrap();
        for (i, tilt) in curves.tilt_deg.iter().enumerate() {
            assert_eq!(curves.lead_mm[i].is_some(), *tilt >= matching, "{radius:?} {tilt}");
            if let Some(two) = curves.two_contact_mm[i] {
                let widest = curves.widest.unwrap();
                assert!(*tilt <= matching && *tilt >= widest.lead_deg && two <= widest.stepover_mm);
            }
        }
    }
    assert!(chart.curves[1].widest.is_some() && chart.curves[2].widest.is_none());
    assert!(stepover_chart(&spec, &[f64::NAN]).is_err());
}
