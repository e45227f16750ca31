//! Rational tensor-product B-spline surfaces.

mod basis;
mod closed;
mod edit;
mod error;
#[cfg(test)]
mod tests;

pub use basis::MAX_DEGREE;
pub(super) use basis::{Basis, span};
pub use error::{MAX_POINTS, NurbsError};

use super::{Domain, Jet, Range, Surface, Uv};
use basis::{MAX_ORDER, values};
use glam::{DVec3, DVec4};

/// One of the two parameters of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Along {
    /// The first.
    U,
    /// The second.
    V,
}

impl std::fmt::Display for Along {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Along::U => "u",
            Along::V => "v",
        })
    }
}

/// A rational tensor-product B-spline surface of any degree from 1 to [`MAX_DEGREE`].
///
/// The domain is `[knots[degree], knots[count]]` in each parameter, so knot vectors need not be clamped. A parameter is
/// periodic where the two end curves coincide and the surface goes on over them without a crease. At a knot inside, the
/// derivatives are those of the side above it.
#[derive(Debug, Clone, PartialEq)]
pub struct NurbsSurface {
    degrees: [usize; 2],
    counts: [usize; 2],
    knots: [Vec<f64>; 2],
    /// Homogeneous `(w x, w y, w z, w)`, number along v running fastest.
    net: Vec<DVec4>,
    rational: bool,
    domain: Domain,
}

impl NurbsSurface {
    /// The surface of `degrees` over `knots` (each in u and v) with the control points `points` in millimetres, u-major:
    /// the point numbered `(i, j)` along u and v stands at `i · count_v + j`, where a count is the number of knots less
    /// degree less 1. Without `weights`, in the same order, all are 1.
    ///
    /// Errors name the first thing found wrong.
    pub fn new(
        degrees: [usize; 2],
        knots: [Vec<f64>; 2],
        points: &[DVec3],
        weights: Option<&[f64]>,
    ) -> Result<Self, NurbsError> {
        let counts = [
            error::check_knots(Along::U, degrees[0], &knots[0])?,
            error::check_knots(Along::V, degrees[1], &knots[1])?,
        ];
        error::check_net(counts, points, weights)?;
        let net = match weights {
            Some(weights) => points.iter().zip(weights).map(|(&p, &w)| (p * w).extend(w)).collect(),
            None => points.iter().map(|p| p.extend(1.0)).collect(),
        };
        Ok(Self::from_net(degrees, counts, knots, net))
    }

    /// The surface of parts that are known to be right.
    fn from_net(degrees: [usize; 2], counts: [usize; 2], knots: [Vec<f64>; 2], net: Vec<DVec4>) -> Self {
        let range = |a: usize| Range::open(knots[a][degrees[a]], knots[a][counts[a]]);
        let domain = Domain { u: range(0), v: range(1) };
        let first = net[0].w;
        let rational = net.iter().any(|p| p.w != first);
        let net = if rational || first == 1.0 { net } else { net.iter().map(|p| *p / first).collect() };
        let mut surface = Self { degrees, counts, knots, net, rational, domain };
        surface.domain.u.periodic = closed::is_smoothly_closed(&surface, Along::U);
        surface.domain.v.periodic = closed::is_smoothly_closed(&surface, Along::V);
        surface
    }

    /// Degree in `along`.
    pub fn degree(&self, along: Along) -> usize {
        self.degrees[along as usize]
    }

    /// Number of control points in `along`.
    pub fn count(&self, along: Along) -> usize {
        self.counts[along as usize]
    }

    /// Knots in `along`.
    pub fn knots(&self, along: Along) -> &[f64] {
        &self.knots[along as usize]
    }

    /// Whether weights differ, so that the surface is not a polynomial one.
    pub fn is_rational(&self) -> bool {
        self.rational
    }

    /// The control points in millimetres and their weights, u-major.
    pub fn control_points(&self) -> impl Iterator<Item = (DVec3, f64)> + '_ {
        self.net.iter().map(|p| (p.truncate() / p.w, p.w))
    }

    /// Lowest and highest coordinates of the control points, which hold the whole surface.
    pub fn hull_bounds(&self) -> (DVec3, DVec3) {
        let all = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        self.control_points().fold(all, |(lo, hi), (p, _)| (lo.min(p), hi.max(p)))
    }

    /// Lowest and highest coordinates over `samples` points (at least 2) a knot span and parameter. A bulge between samples
    /// is missed by at most an eighth of the second derivative times the step squared.
    pub fn bounds(&self, samples: usize) -> (DVec3, DVec3) {
        let [us, vs] = [Along::U, Along::V].map(|along| self.parameters(along, samples));
        let mut bounds = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for &u in &us {
            for &v in &vs {
                let p = self.point(Uv::new(u, v));
                bounds = (bounds.0.min(p), bounds.1.max(p));
            }
        }
        bounds
    }

    /// The borders of the knot spans in the domain, rising.
    pub fn breaks(&self, along: Along) -> Vec<f64> {
        let a = along as usize;
        let mut breaks = self.knots[a][self.degrees[a]..=self.counts[a]].to_vec();
        breaks.dedup();
        breaks
    }

    /// `samples` parameters (at least 2) on each knot span, its ends among them; shared ends stand once.
    fn parameters(&self, along: Along, samples: usize) -> Vec<f64> {
        let breaks = self.breaks(along);
        let steps = samples.max(2) - 1;
        let inside = |pair: &[f64]| {
            let (lo, hi) = (pair[0], pair[1]);
            (0..steps).map(move |k| lo + (hi - lo) * (k as f64 / steps as f64))
        };
        let mut parameters: Vec<f64> = breaks.windows(2).flat_map(inside).collect();
        parameters.extend(breaks.last());
        parameters
    }

    /// The sums over the net at `uv`, which lies in the domain. `ORDER` is above both degrees: the smallest that
    /// does keeps arrays small and loops short.
    #[inline]
    fn sums<const ORDER: usize>(&self, uv: Uv) -> Sums {
        let ([pu, pv], [nu, nv]) = (self.degrees, self.counts);
        let (span_u, span_v) = (span(&self.knots[0], pu, nu, uv.u), span(&self.knots[1], pv, nv, uv.v));
        let bu = Basis::<ORDER>::at(&self.knots[0], pu, span_u, uv.u);
        let bv = Basis::<ORDER>::at(&self.knots[1], pv, span_v, uv.v);
        let mut sums = [DVec4::ZERO; 6];
        for i in 0..=pu.min(ORDER - 1) {
            let start = (span_u - pu + i) * nv + span_v - pv;
            let row = &self.net[start..=start + pv];
            let (mut s, mut sv, mut svv) = (DVec4::ZERO, DVec4::ZERO, DVec4::ZERO);
            for (((&p, n), n1), n2) in row.iter().zip(bv.value).zip(bv.first).zip(bv.second) {
                s += p * n;
                sv += p * n1;
                svv += p * n2;
            }
            sums[0] += s * bu.value[i];
            sums[1] += s * bu.first[i];
            sums[2] += sv * bu.value[i];
            sums[3] += s * bu.second[i];
            sums[4] += sv * bu.first[i];
            sums[5] += svv * bu.value[i];
        }
        let largest = |first: [f64; ORDER]| first.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
        Sums { sums, slopes: [largest(bu.first), largest(bv.first)] }
    }

    /// The first of [`NurbsSurface::sums`], the homogeneous value at `uv`, alone.
    #[inline]
    fn sum<const ORDER: usize>(&self, uv: Uv) -> DVec4 {
        let ([pu, pv], [nu, nv]) = (self.degrees, self.counts);
        let (span_u, span_v) = (span(&self.knots[0], pu, nu, uv.u), span(&self.knots[1], pv, nv, uv.v));
        let bu = values::<ORDER>(&self.knots[0], pu, span_u, uv.u);
        let bv = values::<ORDER>(&self.knots[1], pv, span_v, uv.v);
        let row = |i: usize| {
            let start = (span_u - pu + i) * nv + span_v - pv;
            self.net[start..=start + pv].iter().zip(bv).fold(DVec4::ZERO, |sum, (&p, n)| sum + p * n)
        };
        (0..=pu.min(ORDER - 1)).fold(DVec4::ZERO, |sum, i| sum + row(i) * bu[i])
    }
}

/// What one evaluation adds up.
struct Sums {
    /// Homogeneous value, ∂u, ∂v, ∂uu, ∂uv, ∂vv.
    sums: [DVec4; 6],
    /// The largest slope of a basis function in u and in v.
    slopes: [f64; 2],
}

/// Rounding of a tangent, over the coordinates that cancelled in it: a few units in the last place each.
const CANCELLED: f64 = 16.0 * f64::EPSILON;

/// `tangent` unless it is nothing but the rounding of coordinates as large as those of `p`, as at a pole, where it would
/// pretend to a direction.
fn above_rounding(tangent: DVec3, p: DVec3, slope: f64) -> DVec3 {
    let noise = CANCELLED * slope;
    if tangent.length_squared() <= noise * noise * p.length_squared() { DVec3::ZERO } else { tangent }
}

/// The jet of `A/w` from homogeneous sums of `(A, w)`.
///
/// Source: Piegl, Tiller, The NURBS Book, eq. 4.20, for total order two.
fn quotient([s, su, sv, suu, suv, svv]: [DVec4; 6]) -> Jet {
    let inverse = 1.0 / s.w;
    let p = s.truncate() * inverse;
    let du = (su.truncate() - p * su.w) * inverse;
    let dv = (sv.truncate() - p * sv.w) * inverse;
    let duu = (suu.truncate() - du * (2.0 * su.w) - p * suu.w) * inverse;
    let duv = (suv.truncate() - du * sv.w - dv * su.w - p * suv.w) * inverse;
    let dvv = (svv.truncate() - dv * (2.0 * sv.w) - p * svv.w) * inverse;
    Jet { p, du, dv, duu, duv, dvv }
}

impl Surface for NurbsSurface {
    fn domain(&self) -> Domain {
        self.domain
    }

    fn jet(&self, uv: Uv) -> Jet {
        let uv = self.domain.hold(uv);
        let Sums { sums, slopes } = match self.degrees[0].max(self.degrees[1]) {
            0..=3 => self.sums::<4>(uv),
            4..=7 => self.sums::<8>(uv),
            _ => self.sums::<MAX_ORDER>(uv),
        };
        let jet = if self.rational {
            quotient(sums)
        } else {
            let [p, du, dv, duu, duv, dvv] = sums.map(DVec4::truncate);
            Jet { p, du, dv, duu, duv, dvv }
        };
        Jet {
            du: above_rounding(jet.du, jet.p, slopes[0]),
            dv: above_rounding(jet.dv, jet.p, slopes[1]),
            ..jet
        }
    }

    fn point(&self, uv: Uv) -> DVec3 {
        let uv = self.domain.hold(uv);
        let sum = match self.degrees[0].max(self.degrees[1]) {
            0..=3 => self.sum::<4>(uv),
            4..=7 => self.sum::<8>(uv),
            _ => self.sum::<MAX_ORDER>(uv),
        };
        if self.rational { sum.truncate() * (1.0 / sum.w) } else { sum.truncate() }
    }
}
