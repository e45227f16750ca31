//! Heights and their derivatives in all forms.

use crate::support::{near, toric};
use proptest::prelude::*;
use stepover::turning::HeightJet;
use stepover::turning::sag::{
    Biconic, Conic, Freeform, GridError, GridMap, Sag, Stated, Term, Toric, ToricKind, ZernikeTerm, zernike,
};

const KINDS: [ToricKind; 4] =
    [ToricKind::Convex, ToricKind::Concave, ToricKind::SaddleConvexBase, ToricKind::SaddleConcaveBase];

fn wave() -> GridMap {
    let heights: Vec<f64> = (0..15 * 13)
        .map(|k| libm::sin(0.3 * f64::from(k % 13)) * libm::cos(0.2 * f64::from(k / 13)))
        .collect();
    GridMap::new(Stated::Heights, &heights, 13, [1.5, 1.25]).unwrap()
}

/// One of each; none reaches farther than 14 mm everywhere, so that places beyond are looked at too.
fn all() -> Vec<(&'static str, Box<dyn Sag>)> {
    let conic = |c, k, even| Conic::new(c, k, even, 12.0);
    let terms = [(2, 0, 0.1), (3, -3, 0.02), (4, 2, -0.05), (8, 0, 0.01)];
    let terms: Vec<ZernikeTerm> =
        terms.map(|(order, frequency, height)| ZernikeTerm { order, frequency, height }).into();
    let mut all: Vec<(&'static str, Box<dyn Sag>)> = vec![
        ("sphere", Box::new(conic(-1.0 / 20.0, 0.0, vec![]))),
        ("hyperboloid", Box::new(conic(1.0 / 9.0, -3.0, vec![]))),
        ("asphere", Box::new(conic(-1.0 / 30.0, -0.7, vec![1e-5, -2e-8]))),
        ("biconic", Box::new(Biconic { curvature: [-1.0 / 11.0, 1.0 / 25.0], conic: [0.3, -1.5] })),
        ("zernike", Box::new(Freeform::new(conic(0.01, 0.0, vec![]), zernike(&terms).unwrap(), 10.0, 10.0))),
        ("grid", Box::new(wave())),
    ];
    for kind in KINDS {
        all.push(("toric", Box::new(Toric::new(kind, 12.0, 19.0).unwrap())));
    }
    all.push(("lemon", Box::new(Toric::new(ToricKind::Convex, 40.0, -25.0).unwrap())));
    all
}

#[test]
fn derivatives_are_those_of_the_height() {
    let h = 1e-4;
    for (name, sag) in all() {
        for (x, y) in [(0.0, 0.0), (3.1, -2.2), (-7.3, 5.9), (10.7, 1.3), (1.1, -13.9), (17.0, 15.0)] {
            let f = sag.at(x, y);
            let [e, w, n, s] =
                [(h, 0.0), (-h, 0.0), (0.0, h), (0.0, -h)].map(|(dx, dy)| sag.at(x + dx, y + dy));
            let close = |found: f64, wanted: f64, what: &str| {
                assert!(
                    (found - wanted).abs() < 2e-5 * (1.0 + wanted.abs()),
                    "{name} {what} at {x}, {y}: {found} {wanted}"
                );
            };
            close((e.z - w.z) / (2.0 * h), f.g[0], "x");
            close((n.z - s.z) / (2.0 * h), f.g[1], "y");
            close((e.g[0] - w.g[0]) / (2.0 * h), f.h[0], "xx");
            close((n.g[0] - s.g[0]) / (2.0 * h), f.h[1], "xy");
            close((e.g[1] - w.g[1]) / (2.0 * h), f.h[1], "yx");
            close((n.g[1] - s.g[1]) / (2.0 * h), f.h[2], "yy");
        }
    }
}

#[test]
fn polar_derivatives_are_those_along_radius_and_angle() {
    let lens = toric();
    let at = |rho: f64, t: f64| {
        let (s, c) = libm::sincos(t);
        lens.at(rho * c, rho * s).polar(rho, c, s)
    };
    let h = 1e-4;
    for (rho, t) in [(20.0, 0.4), (-5.0, 2.0), (29.0, 1.5)] {
        let f = at(rho, t);
        near((at(rho + h, t).z - at(rho - h, t).z) / (2.0 * h), f.r, 1e-6);
        near((at(rho, t + h).z - at(rho, t - h).z) / (2.0 * h), f.t, 1e-5);
        near((at(rho + h, t).r - at(rho - h, t).r) / (2.0 * h), f.rr, 1e-6);
        near((at(rho, t + h).r - at(rho, t - h).r) / (2.0 * h), f.rt, 1e-5);
        near((at(rho, t + h).t - at(rho, t - h).t) / (2.0 * h), f.tt, 1e-4);
    }
}

/// Eqs. 4 and 9 of the paper, as they stand there.
#[test]
fn the_toric_is_the_papers() {
    let (a, r, ball) = (40.0, 150.0, 15.0);
    let printed = |tube: f64, rho: f64, t: f64| {
        let (s, c) = libm::sincos(t);
        let inner: f64 = r + f64::sqrt(tube * tube - rho * rho * s * s);
        -(r + a) + f64::sqrt(inner * inner - rho * rho * c * c)
    };
    let offset = toric().offset(ball).unwrap();
    for i in 0..60 {
        let (rho, t) = (0.5 * f64::from(i), 0.37 * f64::from(i));
        let (s, c) = libm::sincos(t);
        near(toric().at(rho * c, rho * s).z, printed(a, rho, t), 1e-12);
        near(offset.at(rho * c, rho * s).z, printed(a + ball, rho, t), 1e-12);
    }
}

#[test]
fn either_radius_of_a_toric_may_be_larger_and_either_bend_may_turn() {
    for kind in KINDS {
        for rotation in [19.0, 150.0] {
            let f = Toric::new(kind, 12.0, rotation).unwrap().at(0.0, 0.0);
            let (base, sweep) = match kind {
                ToricKind::Convex => (-1.0 / 12.0, -1.0 / (rotation + 12.0)),
                ToricKind::Concave => (1.0 / 12.0, 1.0 / (rotation + 12.0)),
                ToricKind::SaddleConvexBase => (-1.0 / 12.0, 1.0 / (rotation - 12.0)),
                ToricKind::SaddleConcaveBase => (1.0 / 12.0, -1.0 / (rotation - 12.0)),
            };
            near(f.h[2], base, 1e-12);
            near(f.h[0], sweep, 1e-12);
        }
    }
    let lemon = Toric::new(ToricKind::Convex, 40.0, -25.0).unwrap();
    near(lemon.at(0.0, 0.0).h[0], -1.0 / 15.0, 1e-12);
    assert!(Toric::new(ToricKind::Convex, 40.0, -40.0).is_none());
    assert!(Toric::new(ToricKind::SaddleConvexBase, 40.0, 40.0).is_none());
}

#[test]
fn special_forms_are_those_of_general_ones() {
    let sphere = Conic::new(-0.02, 0.0, vec![], 1e3);
    let biconic = Biconic { curvature: [-0.02; 2], conic: [0.0; 2] };
    let ring = Toric::new(ToricKind::Convex, 50.0, 0.0).unwrap();
    // A conic in powers of ρ² is an even asphere on a plane.
    let c: f64 = 0.001;
    let even = Conic::new(0.0, 0.0, vec![c * c * c / 8.0, c.powi(5) / 16.0], 1e3);
    let paraboloid = Conic::new(c, -1.0, vec![], 1e3);
    let round = Conic::new(c, 0.0, vec![], 1e3);
    for (x, y) in [(3.0, 4.0), (-20.0, 11.0), (0.0, 31.0)] {
        let s = x * x + y * y;
        near(sphere.at(x, y).z, f64::sqrt(2500.0 - s) - 50.0, 1e-12);
        near(biconic.at(x, y).z, sphere.at(x, y).z, 1e-12);
        near(ring.at(x, y).z, sphere.at(x, y).z, 1e-12);
        near(round.at(x, y).z, paraboloid.at(x, y).z + even.at(x, y).z, 1e-10);
    }
}

/// R_n^m by its own sum, with angles.
#[test]
fn zernike_terms_are_zernike_terms() {
    type Term = (usize, i64, fn(f64) -> f64);
    let radial: [Term; 6] = [
        (0, 0, |_| 1.0),
        (1, -1, |p| p),
        (2, 0, |p| 2.0 * p * p - 1.0),
        (3, 1, |p| 3.0 * p * p * p - 2.0 * p),
        (4, -2, |p| 4.0 * p.powi(4) - 3.0 * p * p),
        (6, 0, |p| 20.0 * p.powi(6) - 30.0 * p.powi(4) + 12.0 * p * p - 1.0),
    ];
    for (order, frequency, along) in radial {
        let terms = zernike(&[ZernikeTerm { order, frequency, height: 0.5 }]).unwrap();
        let sag = Freeform::new(Conic::new(0.0, 0.0, vec![], 100.0), terms, 20.0, 100.0);
        for (rho, t) in [(0.0, 0.0), (0.3, 0.7), (0.9, 2.5), (1.0, -1.0)] {
            let (s, c) = libm::sincos(t);
            let m = frequency.unsigned_abs() as f64;
            let around = if frequency < 0 { libm::sin(m * t) } else { libm::cos(m * t) };
            near(sag.at(20.0 * rho * c, 20.0 * rho * s).z, 0.5 * along(rho) * around, 1e-13);
        }
    }
    let bad = |order, frequency| zernike(&[ZernikeTerm { order, frequency, height: 1.0 }]);
    assert_eq!((bad(3, 2), bad(2, 3), bad(22, 0)), (Err(0), Err(0), Err(0)));
}

#[test]
fn grids_go_through_their_heights_and_close_in_with_the_fourth_power() {
    let lens = toric();
    let map = |n: usize| {
        let step = 40.0 / (n - 1) as f64;
        let heights: Vec<f64> = (0..n * n)
            .map(|k| lens.at((k % n) as f64 * step - 20.0, (k / n) as f64 * step - 20.0).z)
            .collect();
        GridMap::new(Stated::Heights, &heights, n, [step; 2]).unwrap()
    };
    near(map(21).at(-20.0 + 14.0, -20.0 + 36.0).z, lens.at(-6.0, 16.0).z, 1e-12);
    let worst = |n: usize| {
        let map = map(n);
        (0..400).fold(0.0, |worst: f64, k| {
            let (x, y) = (2.0 * f64::from(k % 20) - 19.3, 2.0 * f64::from(k / 20) - 19.3);
            worst.max((map.at(x, y).z - lens.at(x, y).z).abs())
        })
    };
    let (coarse, fine) = (worst(21), worst(41));
    assert!(fine < coarse / 12.0 && fine < 1e-6, "{coarse} {fine}");
    assert!(!map(21).reaches(20.1, 0.0) && map(21).reaches(20.0, -20.0));
    assert!(matches!(GridMap::new(Stated::Heights, &[0.0; 24], 5, [1.0; 2]), Err(GridError::Shape { .. })));
    let mut holed = [0.0; 25];
    holed[7] = f64::NAN;
    let error = GridMap::new(Stated::Heights, &holed, 5, [1.0; 2]).unwrap_err();
    assert_eq!(error, GridError::NotFinite { index: 3, row: 2 });
}

proptest! {
    /// Products and compositions carry derivatives as calculus says: √(f·f) = f.
    #[test]
    fn jets_obey_calculus(z in 0.5..3.0f64, g in prop::array::uniform2(-2.0..2.0f64), h in prop::array::uniform3(-2.0..2.0f64)) {
        let f = HeightJet { z, g, h };
        let square = f * f;
        let w = square.z.sqrt();
        let back = square.map([w, 0.5 / w, -0.25 / (w * square.z)]);
        for (a, b) in [(back.z, f.z), (back.g[0], g[0]), (back.g[1], g[1]), (back.h[0], h[0]), (back.h[1], h[1]), (back.h[2], h[2])] {
            prop_assert!((a - b).abs() < 1e-12);
        }
    }

    #[test]
    fn powers_beyond_twenty_count_as_twenty(x in -1.0..1.0f64, i in 20..60usize) {
        let sag = |i| Freeform::new(Conic::new(0.0, 0.0, vec![], 2.0), vec![Term { powers: [i, 0], height: 1.0 }], 1.0, 2.0);
        prop_assert_eq!(sag(i).at(x, 0.0), sag(20).at(x, 0.0));
    }
}
