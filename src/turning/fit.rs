//! Whether surface, aperture and tool go together.

use super::aperture::Aperture;
use super::error::{Spot, TurningError};
use super::placed::Placed;
use super::round::round_down;
use super::tool::Tool;
use crate::toolpath::Nose;

/// How tool and surface go together. Angles in radians.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Fit {
    /// The smallest radius of a hollow that the nose meets, mm: infinite where there is none.
    pub hollow: f64,
    /// The steepest section through the axis.
    pub section: f64,
    /// The steepest fall and rise along the cut, both positive.
    pub along: [f64; 2],
    /// The smallest clearance left, and the smallest and largest rake, against the direction of cutting; nothing for a ball.
    pub effective: Option<[f64; 3]>,
}

/// What the aperture's places say, gathered.
struct Steepest {
    curvature: (f64, Spot),
    section: (f64, Spot),
    fall: (f64, Spot),
    rise: (f64, Spot),
}

/// Checks that the aperture lies on the surface and that the tool fits it; looked for at 4,500 places, the rim among them.
///
/// Errors name the worst place and a value that would do.
pub fn fit(part: &Placed, aperture: &Aperture, tool: &Tool) -> Result<Fit, TurningError> {
    // From the centre outwards: the first place that is missing is the nearest.
    if let Some([x, y]) = aperture.lattice().find(|[x, y]| !part.reaches(*x, *y)) {
        let percent = 100.0 * aperture.largest_share(|[x, y]| part.reaches(x, y));
        // Down, so that what is said does.
        let percent = (10.0 * percent).floor() / 10.0;
        return Err(TurningError::Reach { at: Spot { x, y }, reach: part.reach(), percent });
    }
    let nose = tool.nose();
    let worst = steepest(part, aperture, nose);
    let hollow = if worst.curvature.0 > 0.0 { 1.0 / worst.curvature.0 } else { f64::INFINITY };
    let radius = nose.radius();
    if radius >= hollow {
        // Safely below: between the places looked at it may be a little hollower.
        let most = round_down(0.98 * hollow);
        return Err(TurningError::Hollow { radius, hollow, most, at: worst.curvature.1 });
    }
    let [section, fall, rise] = [worst.section, worst.fall, worst.rise].map(|(s, at)| (libm::atan(s), at));
    let mut found = Fit { hollow, section: section.0, along: [fall.0, rise.0], effective: None };
    if let Tool::Insert { rake, least_rake, clearance, sweep, .. } = *tool {
        let up = |angle: f64| (angle.to_degrees() * 10.0).ceil() / 10.0;
        if section.0 > sweep {
            return Err(TurningError::Sweep {
                slope: section.0.to_degrees(),
                sweep: sweep.to_degrees(),
                least: up(section.0),
                at: section.1,
            });
        }
        if fall.0 >= clearance {
            return Err(TurningError::Clearance {
                slope: fall.0.to_degrees(),
                clearance: clearance.to_degrees(),
                least: up(fall.0) + 0.1,
                at: fall.1,
            });
        }
        if rake - rise.0 < least_rake {
            return Err(TurningError::Rake {
                slope: rise.0.to_degrees(),
                rake: (rake - rise.0).to_degrees(),
                limit: least_rake.to_degrees(),
                least: up(least_rake + rise.0),
                at: rise.1,
            });
        }
        // Where the surface falls along the cut, the cut goes down: less clearance, more rake.
        found.effective = Some([clearance - fall.0, rake - rise.0, rake + fall.0]);
    }
    Ok(found)
}

fn steepest(part: &Placed, aperture: &Aperture, nose: Nose) -> Steepest {
    let none = (0.0, Spot { x: 0.0, y: 0.0 });
    let mut worst = Steepest { curvature: none, section: none, fall: none, rise: none };
    let keep = |kept: &mut (f64, Spot), value: f64, at: Spot| {
        if value > kept.0 {
            *kept = (value, at);
        }
    };
    for [x, y] in aperture.lattice() {
        let at = Spot { x, y };
        let f = part.at(x, y);
        let rho = libm::hypot(x, y);
        // At the axis every direction is one of the section's.
        let directions: &[(f64, f64)] = if rho > 0.0 {
            &[(x / rho, y / rho)]
        } else {
            &[(1.0, 0.0), (0.0, 1.0), (std::f64::consts::FRAC_1_SQRT_2, std::f64::consts::FRAC_1_SQRT_2)]
        };
        for &(cos, sin) in directions {
            let p = f.polar(rho, cos, sin);
            keep(&mut worst.section, p.r.abs(), at);
            let across = f.g[1] * cos - f.g[0] * sin;
            keep(&mut worst.fall, -across, at);
            keep(&mut worst.rise, across, at);
            let curvature = match nose {
                Nose::Ball(_) => f.largest_curvature(),
                Nose::Insert(_) => p.rr / libm::pow(1.0 + p.r * p.r, 1.5),
            };
            keep(&mut worst.curvature, curvature, at);
        }
    }
    worst
}
