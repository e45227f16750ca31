//! B-spline basis functions and their first two derivatives.

/// Highest degree: one more than CAD systems exchange, and small enough for arrays on the stack.
pub const MAX_DEGREE: usize = 15;

/// Functions that differ from zero on one span, at the most.
pub(super) const MAX_ORDER: usize = MAX_DEGREE + 1;

/// Value, first and second derivative of each of the `degree + 1` functions that differ from zero on a span;
/// entries beyond are zero.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Basis<const ORDER: usize> {
    pub(crate) value: [f64; ORDER],
    pub(crate) first: [f64; ORDER],
    pub(crate) second: [f64; ORDER],
}

/// The number `k` of the span with `knots[k] ≤ x < knots[k + 1]` among the spans of the domain of a spline with `count`
/// control points; the last span with some length where `x` is the domain's end or beyond, the first below it.
pub(crate) fn span(knots: &[f64], degree: usize, count: usize, x: f64) -> usize {
    let inner = &knots[degree + 1..=count];
    // Counting knots below the domain's end keeps the span found from being empty at the end.
    let end = knots[count];
    degree + inner.partition_point(|&knot| knot <= x && knot < end)
}

/// The values of [`Basis::at`] alone, to the last bit the same.
#[inline]
pub(super) fn values<const ORDER: usize>(knots: &[f64], degree: usize, span: usize, x: f64) -> [f64; ORDER] {
    let mut value = [0.0; ORDER];
    value[0] = 1.0;
    for j in 1..=degree.min(ORDER - 1) {
        let mut rising = 0.0;
        for r in 0..j {
            let (lo, hi) = (knots[span + 1 + r - j], knots[span + 1 + r]);
            let v = value[r] * (1.0 / (hi - lo));
            value[r] = rising + (hi - x) * v;
            rising = (x - lo) * v;
        }
        value[j] = rising;
    }
    value
}

impl<const ORDER: usize> Basis<ORDER> {
    /// The functions of `degree` (at least 1, below `ORDER`) at `x` on the span number `span`, which must have some length.
    ///
    /// Source: L. Piegl, W. Tiller, The NURBS Book, 2nd ed. 1997, eqs. 2.5 and 2.7; the derivatives are taken in the same
    /// sweep, since those of degree j need only the quotients that degree j − 1 leaves behind.
    #[inline]
    pub(crate) fn at(knots: &[f64], degree: usize, span: usize, x: f64) -> Self {
        let mut value = [0.0; ORDER];
        let mut first = [0.0; ORDER];
        let mut second = [0.0; ORDER];
        value[0] = 1.0;
        for j in 1..=degree.min(ORDER - 1) {
            let factor = j as f64;
            // Of the function before (numbered r − 1): its value and slope over the length of its support, and the
            // share of its value that rises into function r.
            let (mut value_over, mut slope_over, mut rising) = (0.0, 0.0, 0.0);
            for r in 0..j {
                let (lo, hi) = (knots[span + 1 + r - j], knots[span + 1 + r]);
                let inverse = 1.0 / (hi - lo);
                let (v, d) = (value[r] * inverse, first[r] * inverse);
                value[r] = rising + (hi - x) * v;
                first[r] = factor * (value_over - v);
                second[r] = factor * (slope_over - d);
                rising = (x - lo) * v;
                (value_over, slope_over) = (v, d);
            }
            value[j] = rising;
            first[j] = factor * value_over;
            second[j] = factor * slope_over;
        }
        Self { value, first, second }
    }
}
