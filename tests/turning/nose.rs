//! Where the nose stands: planted contacts, the offset by formula against that by the normal, and how far out it must go.

use crate::support::{PLANE_INSERT, held, near, order, planned, toric};
use stepover::toolpath::Nose;
use stepover::turning::sag::{Biconic, Conic, Sag, Toric, ToricKind};
use stepover::turning::{Aperture, Outline, Placed, fit, innermost, locate, outermost};

fn parts() -> Vec<(&'static str, Placed)> {
    let biconic = Biconic { curvature: [1.0 / 60.0, -1.0 / 35.0], conic: [-0.5, 0.7] };
    vec![
        ("toric", held(toric())),
        ("bowl", held(Conic::new(1.0 / 50.0, -0.8, vec![1e-7], 40.0))),
        ("saddle", Placed::new(std::sync::Arc::new(biconic), [2.0, -1.0], 0.6)),
    ]
}

#[test]
fn planted_contacts_come_back() {
    for (name, part) in parts() {
        for (x, y) in [(0.0, 0.0), (4.0, 1.0), (-12.0, 9.0), (3.0, -21.0)] {
            let r = 6.0;
            let f = part.at(x, y);
            let w = f.stretch();
            // A ball stands on the normal.
            let q = [x - r * f.g[0] / w, y - r * f.g[1] / w];
            let far = libm::hypot(q[0], q[1]);
            let (cos, sin) = if far > 0.0 { (q[0] / far, q[1] / far) } else { (1.0, 0.0) };
            let found = locate(&part, Nose::Ball(r), far, (cos, sin), [0.0; 2]).unwrap();
            near(found.center.z, f.z + r / w, 1e-9);
            near(libm::hypot(found.touch[0] - x, found.touch[1] - y), 0.0, 1e-7);
            // An insert stands on the normal of its section.
            let rho = libm::hypot(x, y);
            let (cos, sin) = if rho > 0.0 { (x / rho, y / rho) } else { (1.0, 0.0) };
            let slope = f.polar(rho, cos, sin).r;
            let v = (1.0 + slope * slope).sqrt();
            let found = locate(&part, Nose::Insert(r), rho - r * slope / v, (cos, sin), [0.0; 2]).unwrap();
            assert!((found.center.z - (f.z + r / v)).abs() < 1e-9, "{name} {x} {y}");
        }
    }
}

#[test]
fn slopes_and_bends_of_the_centre_are_those_of_its_height() {
    for (name, part) in parts() {
        for nose in [Nose::Ball(6.0), Nose::Insert(6.0)] {
            let at = |x: f64, c: f64| {
                let (sin, cos) = libm::sincos(c);
                locate(&part, nose, x, (cos, sin), [0.0; 2]).unwrap().center
            };
            let h = 1e-4;
            for (x, c) in [(0.0, 0.3), (5.0, 1.1), (17.0, 4.0)] {
                let f = at(x, c);
                let [e, w, n, s] = [at(x + h, c), at(x - h, c), at(x, c + h), at(x, c - h)];
                let close = |found: f64, wanted: f64, what: &str| {
                    assert!(
                        (found - wanted).abs() < 1e-5,
                        "{name} {nose:?} {what} at {x}, {c}: {found} {wanted}"
                    );
                };
                close((e.z - w.z) / (2.0 * h), f.r, "r");
                close((n.z - s.z) / (2.0 * h), f.t, "t");
                close((e.r - w.r) / (2.0 * h), f.rr, "rr");
                close((e.t - w.t) / (2.0 * h), f.rt, "rt");
                close((n.t - s.t) / (2.0 * h), f.tt, "tt");
            }
        }
    }
}

/// a → a + r_d for a ball, in all four kinds, to rounding.
#[test]
fn offset_by_formula_and_by_the_normal_agree_on_torics() {
    for kind in
        [ToricKind::Convex, ToricKind::Concave, ToricKind::SaddleConvexBase, ToricKind::SaddleConcaveBase]
    {
        for rotation in [60.0, 150.0] {
            let surface = Toric::new(kind, 40.0, rotation).unwrap();
            let radius = 9.0;
            let formula = surface.offset(radius).unwrap();
            let part = held(surface);
            let mut guess = [0.0; 2];
            for i in 0..300 {
                let (x, c) = (0.03 * f64::from(i), 0.37 * f64::from(i));
                let (sin, cos) = libm::sincos(c);
                let found = locate(&part, Nose::Ball(radius), x, (cos, sin), guess).unwrap();
                guess = found.offset;
                let wanted = formula.at(x * cos, x * sin).polar(x, cos, sin);
                near(found.center.z, wanted.z, 1e-12);
                near(found.center.r, wanted.r, 1e-9);
                near(found.center.tt, wanted.tt, 1e-6);
            }
        }
    }
    assert!(Toric::new(ToricKind::Concave, 10.0, 100.0).unwrap().offset(10.0).is_none());
}

/// A ball at 41.25 mm finishes the rim at 90°, at 32.37 mm that at 0°; one that only goes out to 30 mm finishes an ellipse
/// of 27.80 × 21.82 mm.
#[test]
fn the_nose_goes_far_enough_out() {
    let order = order(0.5, 3.0);
    near(outermost(&order.part, &order.aperture, Nose::Ball(15.0)), 41.25, 1e-9);
    let touch = |x: f64, (cos, sin)| {
        let [u, v] = locate(&order.part, Nose::Ball(15.0), x, (cos, sin), [0.0; 2]).unwrap().touch;
        libm::hypot(u, v)
    };
    near(touch(41.25, (0.0, 1.0)), 30.0, 1e-9);
    near(touch(30.0 * 205.0 / 190.0, (1.0, 0.0)), 30.0, 1e-9);
    near(30.0 * 205.0 / 190.0, 32.37, 0.005);
    near(touch(30.0, (1.0, 0.0)), 27.80, 0.005);
    near(touch(30.0, (0.0, 1.0)), 21.82, 0.005);
    let ellipse = Aperture { outline: Outline::Ellipse([27.8, 21.8]), ..order.aperture };
    near(outermost(&order.part, &ellipse, Nose::Ball(15.0)), 30.0, 0.03);
    assert!(planned(&order).guide.farthest() >= 41.25 + 0.5);
}

/// A lens held off the axis is reached from where it begins; one that holds the axis from the axis.
#[test]
fn the_nose_goes_no_further_in_than_it_must() {
    let order = order(0.5, 3.0);
    let away = |x: f64| Aperture { outline: Outline::Round(5.0), center: [x, 0.0], angle: 0.0 };
    for nose in [Nose::Ball(15.0), Nose::Insert(15.0)] {
        assert!(innermost(&order.part, &away(3.0), nose) == 0.0);
        near(innermost(&order.part, &away(20.0), nose), 15.0 * 205.0 / 190.0, 1e-6);
    }
}

/// The ball's path leaves this much under an insert at X 30 mm, C 45°, along the normal of the section.
#[test]
fn a_balls_path_is_wrong_for_an_insert() {
    let part = held(toric());
    let direction = libm::sincos(std::f64::consts::FRAC_PI_4);
    for (radius, wanted) in [(15.0, 0.388), (1.5, 0.070), (0.5, 0.0245)] {
        let at = |nose| locate(&part, nose, 30.0, direction, [0.0; 2]).unwrap();
        let (ball, insert) = (at(Nose::Ball(radius)), at(Nose::Insert(radius)));
        // Seen in the section, along its normal.
        let normal = 1.0 / (1.0 + insert.center.r * insert.center.r).sqrt();
        near((ball.center.z - insert.center.z) * normal, wanted, 0.0006);
    }
}

#[test]
fn what_the_cut_sees_is_reported() {
    let order = order(0.5, 3.0);
    let found = fit(&order.part, &order.aperture, &PLANE_INSERT).unwrap();
    assert!(found.hollow.is_infinite());
    near(found.section, libm::asin(30.0 / 40.0), 1e-9);
    // Slopes along the cut are alike up and down, and what they take from the clearance they add to the rake.
    near(found.along[0], found.along[1], 1e-9);
    let [clearance, least, most] = found.effective.unwrap();
    near(0.6 - clearance, found.along[0], 1e-12);
    near(-least, most, 1e-9);
}
