//! Numbers that a person is told.

/// `x`, above 0, down to three digits: what is named must do.
pub(super) fn round_down(x: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    let unit = libm::pow(10.0, libm::log10(x).floor() - 2.0);
    (x / unit).floor() * unit
}
