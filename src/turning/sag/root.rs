//! Square roots that go on below where a surface would end.

/// Share of its value at the vertex below which what stands under a root counts as the end of the surface: there a sphere
/// is 80° steep, which no nose that has a shank reaches.
pub(super) const END: f64 = 0.03;

/// `√u` with its derivatives; below `u0` its tangent there.
pub(super) fn root_line(u: f64, u0: f64) -> [f64; 3] {
    if u >= u0 {
        let w = u.sqrt();
        [w, 0.5 / w, -0.25 / (w * u)]
    } else {
        let w = u0.sqrt();
        [w + 0.5 * (u - u0) / w, 0.5 / w, 0.0]
    }
}

/// `√u` with its derivatives; below `u0` it fades to 0 and stays positive, so that one may divide by it.
pub(super) fn root_fade(u: f64, u0: f64) -> [f64; 3] {
    if u >= u0 {
        return root_line(u, u0);
    }
    let (w, k) = (u0.sqrt(), 0.5 / u0);
    let q = 1.0 + (u0 - u) * k;
    [w / q, w * k / (q * q), 2.0 * w * k * k / (q * q * q)]
}
