//! A cutter lowered on a straight edge.

use super::Underside;
use glam::{DVec2, DVec3};

/// Where on the edge the cutter touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Spot {
    /// At the first or second corner.
    Corner(usize),
    /// Between them, the underside standing there at this slope.
    Between(f64),
}

/// The cutter on an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct EdgeTouch {
    /// Height of the tip.
    pub tip: f64,
    /// Where it touches.
    pub point: DVec3,
    /// Where that is on the edge.
    pub spot: Spot,
}

/// Height errors below this, mm, end the search for a contact: a ten-thousandth of what a machine resolves.
const HEIGHT_ERROR: f64 = 1e-11;

/// The cutter with its axis through `axis` lowered on the edge from `a` to `b`, if it ends up higher than `floor`;
/// `None` if not, or where the shadow misses the edge.
///
/// Along the edge the height that each point lifts the tip to, `z − height(ρ)`, is concave: its slope
/// `k − height′(ρ) s/ρ`, with `s` counted from the foot of the axis, falls, and the only zero is the contact.
pub(super) fn touch_edge(
    under: &Underside,
    axis: DVec2,
    (a, b): (DVec3, DVec3),
    floor: f64,
) -> Option<EdgeTouch> {
    let from = a.truncate() - axis;
    let along = (b - a).truncate();
    let length = along.length();
    let corner = |i: usize| {
        let point = if i == 0 { a } else { b };
        let radius = (point.truncate() - axis).length();
        let tip = point.z - under.height(radius.min(under.reach));
        (radius <= under.reach && tip > floor).then_some(EdgeTouch { tip, point, spot: Spot::Corner(i) })
    };
    // Shorter than rounding at 100 mm: upright.
    if length < 1e-13 {
        return corner(usize::from(b.z > a.z));
    }
    let unit = along / length;
    let (d, sa) = (unit.perp_dot(from).abs(), unit.dot(from));
    let nearest = (d * d + 0f64.clamp(sa, sa + length).powi(2)).sqrt();
    if nearest > under.reach || a.z.max(b.z) - under.height(nearest) <= floor {
        return None;
    }
    let width = (under.reach * under.reach - d * d).max(0.0).sqrt();
    let k = (b.z - a.z) / length;
    // Mirrored so that the edge rises with s.
    let turn = if k < 0.0 { -1.0 } else { 1.0 };
    let (first, last) = if k < 0.0 { (-sa - length, -sa) } else { (sa, sa + length) };
    let (lo, hi) = (first.max(-width), last.min(width));
    if lo > hi {
        return None;
    }
    let line = Line { under, d, k: k.abs() };
    let s = line.highest(lo, hi);
    if s <= first || s >= last {
        return corner(usize::from((s <= first) != (k >= 0.0)));
    }
    let t = (s * turn - sa) / length;
    let radius = (d * d + s * s).sqrt().min(under.reach);
    let point = a + (b - a) * t.clamp(0.0, 1.0);
    let tip = point.z - under.height(radius);
    // At a sharp corner the slope is whatever the edge asks for.
    let slope = if s > 0.0 { line.k * radius / s } else { under.slope(radius) };
    (tip > floor).then_some(EdgeTouch { tip, point, spot: Spot::Between(slope) })
}

/// A straight line that rises by `k ≥ 0` with `s` and passes the axis at the distance `d`.
struct Line<'a> {
    under: &'a Underside,
    d: f64,
    k: f64,
}

impl Line<'_> {
    fn radius(&self, s: f64) -> f64 {
        (self.d * self.d + s * s).sqrt()
    }

    /// By how much the underside rises faster than the line at `s`.
    fn rise(&self, s: f64) -> f64 {
        let radius = self.radius(s);
        if radius > 0.0 { self.under.slope(radius) * s / radius - self.k } else { -self.k }
    }

    /// The `s` between `lo` and `hi` that lifts the tip most.
    fn highest(&self, lo: f64, hi: f64) -> f64 {
        if self.k == 0.0 {
            return 0f64.clamp(lo, hi);
        }
        if hi <= 0.0 || self.rise(hi) <= 0.0 {
            return hi;
        }
        if lo > 0.0 && self.rise(lo) >= 0.0 {
            return lo;
        }
        self.balance(lo.max(0.0), hi)
    }

    /// The zero of `rise` between `lo` and `hi`, where it is negative and positive.
    fn balance(&self, lo: f64, hi: f64) -> f64 {
        let Self { under, d, k } = *self;
        let reaches = |radius: f64| (radius * radius - d * d).max(0.0).sqrt();
        // s/ρ = k/slope on a straight part of the underside.
        let straight = |slope: f64| d * k / (slope * slope - k * k).sqrt();
        let (start, end) = (reaches(under.start), reaches(under.end));
        if d < under.start && under.bottom * start >= k * under.start {
            return straight(under.bottom).clamp(lo, hi);
        }
        if under.corner == 0.0 && d < under.start && start <= hi {
            // A sharp corner takes every slope between its two.
            if under.side * start >= k * under.start {
                return start.max(lo);
            }
            return straight(under.side).clamp(lo, hi);
        }
        if under.side < f64::INFINITY && d < under.end && under.side * end < k * under.end || d >= under.end {
            return straight(under.side).clamp(lo, hi);
        }
        let (lo, hi) = (lo.max(start), hi.min(end));
        if under.center_radius == 0.0 {
            let r = under.corner;
            return (k * ((r * r - d * d).max(0.0) / (1.0 + k * k)).sqrt()).clamp(lo, hi);
        }
        self.on_corner(lo, hi)
    }

    /// The zero of `rise` on the rounded corner. In `F = (ρ − e) s − k ρ y`, which has its sign, no denominator is
    /// left; Newton steps that leave the bracket become bisections. It ends when what the tip can still rise, at most
    /// slope times bracket, is below [`HEIGHT_ERROR`].
    fn on_corner(&self, mut lo: f64, mut hi: f64) -> f64 {
        let Self { under, d: _, k } = *self;
        let e = under.center_radius;
        let mut s = 0.5 * (lo + hi);
        // 60 halvings exhaust f64; Newton takes about five steps.
        for _ in 0..60 {
            let radius = self.radius(s);
            let (x, y) = (radius - e, under.arc_height(radius));
            let value = x * s - k * radius * y;
            if value > 0.0 {
                hi = s;
            } else {
                lo = s;
            }
            if value.abs() * (hi - lo) <= HEIGHT_ERROR * radius * y || hi - lo <= f64::EPSILON * hi {
                break;
            }
            let growth = s * s / radius + x - k * (s * y / radius - x * s / y);
            let next = s - value / growth;
            s = if next > lo && next < hi { next } else { 0.5 * (lo + hi) };
        }
        s
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cutter::Cutter;
    use proptest::prelude::*;

    fn cutters() -> impl Strategy<Value = Cutter> {
        prop_oneof![
            Just(Cutter::flat(6.0, 30.0)),
            Just(Cutter::ball(6.0, 30.0)),
            Just(Cutter::bull_nose(6.0, 0.01, 30.0)),
            Just(Cutter::bull_nose(6.0, 2.0, 30.0)),
            Just(Cutter::bull_nose(6.0, 2.999, 30.0)),
            Just(Cutter::tapered(4.0, 1.0, 0.2, 8.0)),
            Just(Cutter::conical(6.0, 0.0, 0.5, 8.0)),
            Just(Cutter::new(4.0, 0.0, 0.2, 0.4, 8.0)),
            Just(Cutter::new(4.0, 1.0, 0.2, 0.4, 8.0)),
        ]
        .prop_map(Result::unwrap)
    }

    fn point() -> impl Strategy<Value = DVec3> {
        let c = || -6.0..6.0f64;
        (c(), c(), c()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        #[test]
        fn no_point_of_the_edge_lifts_the_tip_higher(cutter in cutters(), a in point(), b in point(), steep in 0..3) {
            let b = if steep == 0 { a + (b - a) * DVec3::new(1e-3, 1e-3, 1.0) } else { b };
            let under = Underside::new(&cutter);
            let lifted = |p: DVec3| {
                let radius = p.truncate().length();
                (radius <= under.reach()).then(|| p.z - under.height(radius))
            };
            let found = touch_edge(&under, DVec2::ZERO, (a, b), f64::NEG_INFINITY);
            let n = 4000;
            let sampled = (0..=n).filter_map(|i| lifted(a.lerp(b, f64::from(i) / f64::from(n))));
            let sampled = sampled.fold(f64::NEG_INFINITY, f64::max);
            match found {
                None => prop_assert_eq!(sampled, f64::NEG_INFINITY),
                Some(touch) => {
                    prop_assert!(touch.tip >= sampled - 1e-9, "{} below {sampled}", touch.tip);
                    // The tip stands on the point that is named, on the edge.
                    let radius = touch.point.truncate().length();
                    prop_assert!((touch.point.z - under.height(radius.min(under.reach())) - touch.tip).abs() < 1e-9
                        || under.reach() - radius < 1e-9);
                    let t = (touch.point - a).dot(b - a) / (b - a).length_squared();
                    prop_assert!(touch.point.distance(a.lerp(b, t.clamp(0.0, 1.0))) < 1e-9);
                }
            }
        }
    }
}
