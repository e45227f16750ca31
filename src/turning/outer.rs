//! How far out the nose must go, and how far in.

use super::aperture::{Aperture, highest_around};
use super::locate::touching;
use super::placed::Placed;
use crate::toolpath::Nose;

/// The largest distance from the spindle axis, mm, of a nose centre that touches the aperture: over its rim, and over places
/// inside, which count where the surface waves.
pub fn outermost(part: &Placed, aperture: &Aperture, nose: Nose) -> f64 {
    let center = |place: [f64; 2]| distance(part, nose, place);
    let rim = highest_around(|t| center(aperture.place(t, 1.0))).1;
    aperture.lattice().map(center).fold(rim, f64::max)
}

/// Directions in which is looked where the nose touches when it stands on the axis: a ball touches at one place, an insert at one for each.
const DIRECTIONS: usize = 24;

/// The smallest such distance, mm: 0 where a nose on the axis touches the aperture, or cannot touch at all within it.
pub fn innermost(part: &Placed, aperture: &Aperture, nose: Nose) -> f64 {
    let mut guess = [0.0; 2];
    for i in 0..DIRECTIONS {
        let (sin, cos) = libm::sincos(std::f64::consts::TAU * i as f64 / DIRECTIONS as f64);
        let found = touching(part, nose, 0.0, (cos, sin), guess);
        let [x, y] = found.map_or([0.0; 2], |at| at.touch);
        if aperture.contains(x, y) {
            return 0.0;
        }
        guess = found.map_or([0.0; 2], |at| at.offset);
    }
    let center = |place: [f64; 2]| distance(part, nose, place);
    let rim = -highest_around(|t| -center(aperture.place(t, 1.0))).1;
    aperture.lattice().map(center).fold(rim, f64::min)
}

/// The distance from the axis of a nose centre that touches at a place.
fn distance(part: &Placed, nose: Nose, [x, y]: [f64; 2]) -> f64 {
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
}
