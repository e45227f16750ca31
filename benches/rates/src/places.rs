//! Places where cutters are lowered.

/// Evenly spread over the inner 95 mm, each far from the one before (Kronecker's sequence on the plastic number).
pub(crate) fn scattered(i: usize) -> (f64, f64) {
    let at = |step: f64| -47.5 + 95.0 * (i as f64 * step).fract();
    (at(0.754_877_666_246_693), at(0.569_840_290_998_053_3))
}
