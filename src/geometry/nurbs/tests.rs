//! Splines against closed forms, differences and their own invariances.

use super::*;
use glam::{DAffine3, DMat3};
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

/// Numbers that look random and are the same on every run.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn clamped(degree: usize, inner: &[f64]) -> Vec<f64> {
    let mut knots = vec![0.0; degree + 1];
    knots.extend_from_slice(inner);
    knots.extend(vec![1.0; degree + 1]);
    knots
}

fn random_surface(degrees: [usize; 2], rational: bool) -> NurbsSurface {
    let mut noise = Noise(7 + degrees[0] as u64 * 31 + degrees[1] as u64);
    let knots = [clamped(degrees[0], &[0.2, 0.55, 0.7]), clamped(degrees[1], &[0.35, 0.6])];
    let counts = [degrees[0] + 4, degrees[1] + 3];
    let mut points = Vec::new();
    let mut weights = Vec::new();
    for i in 0..counts[0] {
        for j in 0..counts[1] {
            points.push(DVec3::new(10.0 * i as f64, 10.0 * j as f64, 8.0 * noise.next()));
            weights.push(0.5 + noise.next());
        }
    }
    NurbsSurface::new(degrees, knots, &points, rational.then_some(&weights)).unwrap()
}

fn sample(surface: &NurbsSurface, count: usize) -> Vec<Uv> {
    let mut noise = Noise(3);
    (0..count).map(|_| surface.domain().at(noise.next(), noise.next())).collect()
}

fn difference(a: &Jet, b: &Jet) -> f64 {
    let pairs = [(a.p, b.p), (a.du, b.du), (a.dv, b.dv), (a.duu, b.duu), (a.duv, b.duv), (a.dvv, b.dvv)];
    pairs.iter().map(|(x, y)| x.distance(*y) / (1.0 + x.length())).fold(0.0, f64::max)
}

/// The full circle of eight weighted points, of degree two, in the plane of `x` and `y`.
fn circle() -> ([(f64, f64, f64); 9], Vec<f64>) {
    let corner = FRAC_1_SQRT_2;
    let points = [
        (1.0, 0.0, 1.0),
        (1.0, 1.0, corner),
        (0.0, 1.0, 1.0),
        (-1.0, 1.0, corner),
        (-1.0, 0.0, 1.0),
        (-1.0, -1.0, corner),
        (0.0, -1.0, 1.0),
        (1.0, -1.0, corner),
        (1.0, 0.0, 1.0),
    ];
    (points, vec![0.0, 0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0, 1.0])
}

/// The section `(radius, height, weight)` over `knots` of degree two, turned about z.
fn revolved(section: &[(f64, f64, f64)], knots: Vec<f64>) -> NurbsSurface {
    let (circle, around) = circle();
    let mut points = Vec::new();
    let mut weights = Vec::new();
    for (x, y, w) in circle {
        for (r, z, v) in section {
            points.push(DVec3::new(r * x, r * y, *z));
            weights.push(w * v);
        }
    }
    NurbsSurface::new([2, 2], [around, knots], &points, Some(&weights)).unwrap()
}

fn sphere(radius: f64) -> NurbsSurface {
    let (r, w) = (radius, FRAC_1_SQRT_2);
    let section = [(0.0, -r, 1.0), (r, -r, w), (r, 0.0, 1.0), (r, r, w), (0.0, r, 1.0)];
    revolved(&section, vec![0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0])
}

#[test]
fn a_rational_sphere_is_a_sphere() {
    let surface = sphere(7.0);
    assert!(surface.domain().u.periodic && !surface.domain().v.periodic);
    for uv in sample(&surface, 300) {
        let jet = surface.jet(uv);
        assert!((jet.p.length() - 7.0).abs() < 1e-13 * 7.0, "{uv:?}: {}", jet.p.length() - 7.0);
        let n = jet.normal().unwrap();
        assert!(n.distance(jet.p / 7.0) < 1e-10);
        let frame = crate::math::frame::Frame::any(n);
        let curvature = crate::geometry::Curvature::of(&jet, &frame).unwrap();
        assert!(
            (curvature.ff + 1.0 / 7.0).abs() < 1e-9 && curvature.fb.abs() < 1e-9,
            "{uv:?}: {curvature:?}"
        );
    }
    assert_eq!(surface.jet(Uv::new(0.3, 0.0)).normal(), None, "a pole has no normal");
}

#[test]
fn a_torus_closes_both_ways_and_wraps() {
    let (circle, around) = circle();
    let section: Vec<_> = circle.iter().map(|(x, y, w)| (10.0 + 3.0 * x, 3.0 * y, *w)).collect();
    let surface = revolved(&section, around);
    assert!(surface.domain().u.periodic && surface.domain().v.periodic);
    let (a, b) = (surface.jet(Uv::new(0.1, 0.9)), surface.jet(Uv::new(-1.9, 3.9)));
    assert!(difference(&a, &b) < 1e-12);
    let area: f64 = {
        let n = 64;
        let at = |k: usize| (k as f64 + 0.5) / n as f64;
        let cells = (0..n).flat_map(|i| (0..n).map(move |j| Uv::new(at(i), at(j))));
        cells.map(|uv| surface.jet(uv).area_density()).sum::<f64>() / (n * n) as f64
    };
    assert!((area / (TAU * TAU * 30.0) - 1.0).abs() < 1e-3, "{area}");
}

#[test]
fn a_seam_with_a_crease_is_not_periodic() {
    // A drop-shaped cylinder: closed, but its ends meet at a right angle.
    let section = [(0.0, 0.0), (4.0, -4.0), (8.0, 0.0), (4.0, 4.0), (0.0, 0.0)];
    let points: Vec<_> =
        section.iter().flat_map(|(x, y)| [0.0, 5.0].map(|z| DVec3::new(*x, *y, z))).collect();
    let knots = [clamped(3, &[0.5]), vec![0.0, 0.0, 1.0, 1.0]];
    let surface = NurbsSurface::new([3, 1], knots, &points, None).unwrap();
    assert!(!surface.domain().u.periodic);
    assert_eq!(surface.jet(Uv::new(7.0, 0.5)).p, surface.jet(Uv::new(1.0, 0.5)).p, "clamped");
}

#[test]
fn an_unclamped_ring_is_periodic() {
    // A uniform cubic over six points that repeat: no knot is doubled anywhere.
    let ring = |i: usize| libm::sincos(TAU * (i % 6) as f64 / 6.0);
    let points: Vec<_> =
        (0..9).flat_map(|i| [0.0, 5.0].map(|z| DVec3::new(10.0 * ring(i).1, 10.0 * ring(i).0, z))).collect();
    let knots = [(0..13).map(f64::from).collect(), vec![0.0, 0.0, 1.0, 1.0]];
    let surface = NurbsSurface::new([3, 1], knots, &points, None).unwrap();
    assert_eq!(surface.domain().u, Range::periodic(3.0, 9.0));
    assert!(difference(&surface.jet(Uv::new(3.0, 0.4)), &surface.jet(Uv::new(9.0, 0.4))) < 1e-12);
}

#[test]
fn derivatives_match_central_differences() {
    let h = 1e-5;
    for degrees in [[1, 1], [1, 3], [2, 2], [3, 3], [5, 4], [7, 2], [9, 15]] {
        for rational in [false, true] {
            let surface = random_surface(degrees, rational);
            for uv in sample(&surface, 40) {
                let near_break =
                    |along, x: f64| surface.breaks(along).iter().any(|k| (k - x).abs() < 2.0 * h);
                if near_break(Along::U, uv.u) || near_break(Along::V, uv.v) {
                    continue;
                }
                let at = |du: f64, dv: f64| surface.jet(Uv::new(uv.u + du, uv.v + dv));
                let (jet, over) = (at(0.0, 0.0), 0.5 / h);
                let (right, left, up, down) = (at(h, 0.0), at(-h, 0.0), at(0.0, h), at(0.0, -h));
                let measured = Jet {
                    p: jet.p,
                    du: (right.p - left.p) * over,
                    dv: (up.p - down.p) * over,
                    duu: (right.du - left.du) * over,
                    duv: (right.dv - left.dv) * over,
                    dvv: (up.dv - down.dv) * over,
                };
                let error = difference(&jet, &measured);
                assert!(error < 3e-6, "{degrees:?} rational {rational} {uv:?}: {error:e}");
            }
        }
    }
}

#[test]
fn inserting_a_knot_changes_nothing() {
    for degrees in [[2, 3], [3, 3], [5, 1]] {
        let surface = random_surface(degrees, true);
        let refined = surface.with_knot(Along::U, 0.41).unwrap().with_knot(Along::V, 0.1).unwrap();
        assert_eq!(refined.count(Along::U), surface.count(Along::U) + 1);
        for uv in sample(&surface, 60) {
            let error = difference(&surface.jet(uv), &refined.jet(uv));
            assert!(error < 1e-11, "{degrees:?} {uv:?}: {error:e}");
        }
    }
    let surface = random_surface([2, 3], false);
    let twice = surface.with_knot(Along::U, 0.2).unwrap();
    assert!(matches!(twice.with_knot(Along::U, 0.2), Err(NurbsError::Multiplicity { along: Along::U, .. })));
    assert!(matches!(surface.with_knot(Along::U, 1.0), Err(NurbsError::Outside { along: Along::U, .. })));
}

#[test]
fn exchanging_u_and_v_exchanges_the_derivatives() {
    let surface = random_surface([3, 2], true);
    let swapped = surface.swapped();
    for uv in sample(&surface, 30) {
        let (a, b) = (surface.jet(uv), swapped.jet(Uv::new(uv.v, uv.u)));
        let back = Jet { p: b.p, du: b.dv, dv: b.du, duu: b.dvv, duv: b.duv, dvv: b.duu };
        assert!(difference(&a, &back) < 1e-12);
    }
    assert_eq!(swapped.swapped(), surface);
}

#[test]
fn affine_maps_go_through_the_control_points() {
    let surface = random_surface([3, 3], true);
    let map = DAffine3 {
        matrix3: DMat3::from_cols_array(&[1.0, 0.2, -3.0, 0.0, 2.0, 0.4, 0.7, -1.0, 0.3]),
        translation: DVec3::new(5.0, -2.0, 30.0),
    };
    let moved = surface.transformed(&map);
    for uv in sample(&surface, 30) {
        let (a, b) = (surface.jet(uv), moved.jet(uv));
        assert!(map.transform_point3(a.p).distance(b.p) < 1e-11);
        assert!((map.matrix3 * a.duv).distance(b.duv) < 1e-9);
    }
}

#[test]
fn every_fault_has_its_name() {
    let points = vec![DVec3::ZERO; 4];
    let flat = || vec![0.0, 0.0, 1.0, 1.0];
    let new =
        |degrees, u: Vec<f64>, v: Vec<f64>| NurbsSurface::new(degrees, [u, v], &points, None).unwrap_err();
    assert_eq!(new([0, 1], flat(), flat()), NurbsError::Degree { along: Along::U, found: 0 });
    assert_eq!(new([1, 16], flat(), flat()), NurbsError::Degree { along: Along::V, found: 16 });
    assert!(matches!(new([1, 2], flat(), flat()), NurbsError::FewKnots { along: Along::V, least: 6, .. }));
    let wide = vec![0.0, 0.0, 0.5, 1.0, 1.0];
    assert_eq!(new([1, 1], wide, flat()), NurbsError::PointCount { across_u: 3, across_v: 2, found: 4 });
    let falls = vec![0.0, 0.0, 1.0, 0.5];
    assert_eq!(new([1, 1], flat(), falls), NurbsError::KnotFalls { along: Along::V, index: 3 });
    let nan = vec![0.0, f64::NAN, 1.0, 1.0];
    assert_eq!(new([1, 1], nan, flat()), NurbsError::KnotNotFinite { along: Along::U, index: 1 });
    let broken = vec![0.0, 0.0, 0.5, 0.5, 1.0, 1.0];
    let fault = NurbsError::Multiplicity { along: Along::U, value: 0.5, found: 2, most: 1 };
    assert_eq!(new([1, 1], broken, flat()), fault);
    let tripled = vec![0.0, 0.0, 0.0, 1.0];
    assert!(matches!(new([1, 1], tripled, flat()), NurbsError::Multiplicity { found: 3, most: 2, .. }));
    let net = |points: &[DVec3], weights: &[f64]| {
        NurbsSurface::new([1, 1], [flat(), flat()], points, Some(weights)).unwrap_err()
    };
    assert_eq!(net(&points, &[1.0; 3]), NurbsError::WeightCount { points: 4, found: 3 });
    assert_eq!(net(&points, &[1.0, 1.0, 0.0, 1.0]), NurbsError::Weight { i: 1, j: 0, value: 0.0 });
    let mut bad = points.clone();
    bad[1].y = f64::INFINITY;
    assert_eq!(net(&bad, &[1.0; 4]), NurbsError::PointNotFinite { i: 0, j: 1 });
}

#[test]
fn a_point_alone_is_that_of_the_jet_to_the_last_bit() {
    for degrees in [[1, 1], [3, 2], [5, 7], [9, 3]] {
        for rational in [false, true] {
            let surface = random_surface(degrees, rational);
            for uv in sample(&surface, 200) {
                assert_eq!(surface.point(uv), surface.jet(uv).p, "{degrees:?} {uv:?}");
            }
        }
    }
}

#[test]
fn no_parameter_breaks_the_evaluation() {
    let surface = sphere(1.0);
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300] {
        surface.jet(Uv::new(x, x));
    }
    assert_eq!(surface.jet(Uv::new(0.25, 9.0)).p, surface.jet(Uv::new(0.25, 1.0)).p);
}
