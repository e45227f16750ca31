//! How far out the nose must go.

use super::aperture::{Aperture, highest_around};
use super::placed::Placed;
use crate::toolpath::Nose;

/// The largest distance from the spindle axis, mm, of a nose centre that touches the aperture: over its rim, and over places
/// inside, which count where the surface waves.
pub fn outermost(part: &Placed, aperture: &Aperture, nose: Nose) -> f64 {
    let center = |[x, y]: [f64; 2]| {
        let f = part.at(x, y);
        match nose {
            Nose::Ball(r) => {
                let k = r / f.stretch();
                libm::hypot(x - k * f.g[0], y - k * f.g[1])
            }
            Nose::Insert(r) => {
                let rho = libm::hypot(x, y);
                let (cos, sin) = if rho > 0.0 { (x / rho, y / rho) } else { (1.0, 0.0) };
                let slope = f.g[0] * cos + f.g[1] * sin;
                (rho - r * slope / (1.0 + slope * slope).sqrt()).abs()
            }
        }
    };
    let rim = highest_around(|t| center(aperture.place(t, 1.0))).1;
    aperture.lattice().map(center).fold(rim, f64::max)
}
