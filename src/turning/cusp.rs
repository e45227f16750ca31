//! The cusp between neighbouring turns.

use super::aperture::Aperture;
use super::error::Spot;
use super::placed::Placed;
use crate::toolpath::Nose;

/// The highest cusp of the aperture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cusp {
    /// mm along the normal.
    pub height: f64,
    /// Where.
    pub at: Spot,
}

/// The highest cusp along the surface normal that turns `step` mm apart leave, to second order in the step.
///
/// Centres `step` apart along X lie `D` apart on their own surface, square to the turn. A nose of radius r on a surface of
/// curvature κ (positive where hollow) then leaves `D²/(8 r (1 − r κ))`: its contacts are `D/(1 − r κ)` apart and the nose
/// bends by `1/r − κ` against the surface. For an insert all of it is within its section.
pub fn highest_cusp(part: &Placed, aperture: &Aperture, nose: Nose, step: f64) -> Cusp {
    let mut highest = Cusp { height: 0.0, at: Spot { x: 0.0, y: 0.0 } };
    for [x, y] in aperture.lattice() {
        let height = cusp(part, nose, step, [x, y]);
        if height > highest.height {
            highest = Cusp { height, at: Spot { x, y } };
        }
    }
    highest
}

fn cusp(part: &Placed, nose: Nose, step: f64, [x, y]: [f64; 2]) -> f64 {
    let f = part.at(x, y);
    let [gx, gy] = f.g;
    let w = f.stretch();
    match nose {
        Nose::Insert(r) => {
            let rho = libm::hypot(x, y);
            let (cos, sin) = if rho > 0.0 { (x / rho, y / rho) } else { (1.0, 0.0) };
            let s = f.polar(rho, cos, sin);
            let stretch = (1.0 + s.r * s.r).sqrt();
            let bend = 1.0 - r * s.rr / (stretch * stretch * stretch);
            // Within the section; seen along the normal in space it is smaller by what the section leans.
            let spread = step * stretch;
            spread * spread / (8.0 * r * bend) * stretch / w
        }
        Nose::Ball(r) => {
            // Turns run about the axis through the centres, not through the contacts.
            let center = [x - r * gx / w, y - r * gy / w];
            let far = libm::hypot(center[0], center[1]);
            let (cos, sin) = if far > 0.0 { (center[0] / far, center[1] / far) } else { (1.0, 0.0) };
            // How steep X is on the centres' surface, whose normal is the part's.
            let along = (gx * cos + gy * sin) / w;
            let steep = 1.0 - along * along;
            let spread = step / steep.sqrt();
            // Square to the turn, in the plane: e − n (n·e), of which x and y are what the curvature needs.
            let (ux, uy) = (cos - along * gx / w, sin - along * gy / w);
            let [xx, xy, yy] = f.h;
            let bend = (xx * ux * ux + 2.0 * xy * ux * uy + yy * uy * uy) / (w * steep);
            spread * spread / (8.0 * r * (1.0 - r * bend))
        }
    }
}
