//! Bracketed root finding.

/// Where a bracketed search ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Root {
    /// The best argument found.
    pub x: f64,
    /// The function there.
    pub y: f64,
    /// Whether the bracket shrank below the asked width before the calls ran out.
    pub converged: bool,
}

/// A root of `f` in `[a, b]`, given `ya = f(a)` and `yb = f(b)` of opposite sign (or zero), to within `tolerance` in
/// the argument, by the ITP method with at most `max_calls` calls.
///
/// Not promised: which root, if there are several. If the signs agree, the end with the smaller `|f|` comes back
/// with `converged` false.
///
/// Source: I. F. D. Oliveira, R. H. C. Takahashi, An enhancement of the bisection method average performance
/// preserving minmax optimality, ACM TOMS 47 (2020), with κ₁ = 0.2/(b − a), κ₂ = 2, n₀ = 1.
pub fn bracketed(
    mut f: impl FnMut(f64) -> f64,
    (mut a, mut ya): (f64, f64),
    (mut b, mut yb): (f64, f64),
    tolerance: f64,
    max_calls: usize,
) -> Root {
    if ya == 0.0 {
        return Root { x: a, y: ya, converged: true };
    }
    if yb == 0.0 {
        return Root { x: b, y: yb, converged: true };
    }
    if (ya > 0.0) == (yb > 0.0) || !(b - a).is_finite() {
        let (x, y) = if ya.abs() <= yb.abs() { (a, ya) } else { (b, yb) };
        return Root { x, y, converged: false };
    }
    let rising = yb > 0.0;
    let width0 = (b - a).abs();
    let k1 = 0.2 / width0;
    // Bisection would need this many calls; ITP may use one more, and the minmax radius shrinks with it.
    let bisections = (width0 / (2.0 * tolerance)).max(1.0).log2_ceil();
    let mut radius = tolerance * (1u64 << (bisections + 1).min(62)) as f64;
    for _ in 0..max_calls {
        if (b - a).abs() <= 2.0 * tolerance {
            break;
        }
        let middle = 0.5 * (a + b);
        let secant = (yb * a - ya * b) / (yb - ya);
        let toward = (middle - secant).signum();
        let truncation = k1 * (b - a) * (b - a);
        let truncated =
            if truncation <= (middle - secant).abs() { secant + toward * truncation } else { middle };
        let slack = (radius - 0.5 * (b - a).abs()).max(0.0);
        let x = if (truncated - middle).abs() <= slack { truncated } else { middle - toward * slack };
        let y = f(x);
        if y == 0.0 {
            return Root { x, y, converged: true };
        }
        if (y > 0.0) == rising {
            (b, yb) = (x, y);
        } else {
            (a, ya) = (x, y);
        }
        radius *= 0.5;
    }
    let (x, y) = if ya.abs() <= yb.abs() { (a, ya) } else { (b, yb) };
    Root { x, y, converged: (b - a).abs() <= 2.0 * tolerance }
}

trait Log2Ceil {
    fn log2_ceil(self) -> u32;
}

impl Log2Ceil for f64 {
    /// The exponent of the smallest power of two that is not below this number (at least 1).
    fn log2_ceil(self) -> u32 {
        (self.min(1e18).ceil() as u64).next_power_of_two().trailing_zeros()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn find(f: impl Fn(f64) -> f64, a: f64, b: f64) -> Root {
        bracketed(&f, (a, f(a)), (b, f(b)), 1e-12, 80)
    }

    #[test]
    fn planted_roots_come_back() {
        for planted in [-0.9, -1e-3, 0.0, 0.3, 0.999] {
            for f in [
                &(|x: f64| x - planted) as &dyn Fn(f64) -> f64,
                &|x: f64| planted - x,
                &|x: f64| (x - planted) * (x - planted) * (x - planted),
                &|x: f64| libm::tanh(50.0 * (x - planted)),
                &|x: f64| if x < planted { -1.0 } else { 1e6 },
            ] {
                let root = find(f, -1.0, 1.1);
                assert!(root.converged && (root.x - planted).abs() < 3e-12, "{planted}: {root:?}");
            }
        }
    }

    #[test]
    fn agreeing_signs_are_reported() {
        assert!(!find(|x| x * x + 1.0, -1.0, 2.0).converged);
    }
}
