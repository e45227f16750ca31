//! How far the motion between points is from the surface.

use super::aperture::Aperture;
use super::error::TurningError;
use super::guide::Guide;
use super::locate::locate;
use super::placed::Placed;
use super::spacing::Spacing;
use crate::toolpath::{AxisPoint, Interpolation, Nose};
use std::f64::consts::TAU;

/// The largest error of interpolation.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Chord {
    /// Along the surface normal, mm: positive where too much is left.
    pub error: f64,
    /// Distance from the axis, mm.
    pub x: f64,
    /// Angle, radians.
    pub c: f64,
    /// The angle between the two points, radians.
    pub apart: f64,
}

impl Chord {
    /// The larger of the two.
    #[must_use]
    fn worse(self, other: Self) -> Self {
        if other.error.abs() > self.error.abs() { other } else { self }
    }
}

/// The largest errors of what lies between the points of a path, where the nose touches the aperture: what leaves
/// material and what digs in. Looked for in the middle between each two points, where both linear and cubic motion are farthest off.
pub fn chord_error(
    part: &Placed,
    aperture: &Aperture,
    nose: Nose,
    interpolation: Interpolation,
    points: &[AxisPoint],
) -> Result<[Chord; 2], TurningError> {
    let mut worst = [Chord::default(); 2];
    let mut guess = [0.0; 2];
    for pair in points.windows(2) {
        let [x, z, c] = middle(interpolation, &pair[0], &pair[1]);
        let (sin, cos) = libm::sincos(c);
        let at = locate(part, nose, x, (cos, sin), guess)?;
        guess = at.offset;
        if !aperture.contains(at.touch[0], at.touch[1]) {
            continue;
        }
        let error = (z - at.center.z) * at.normal_z;
        let side = usize::from(error < 0.0);
        worst[side] = worst[side].worse(Chord { error, x, c, apart: pair[1].c - pair[0].c });
    }
    Ok(worst)
}

/// X, Z and C halfway in time from `a` to `b`.
fn middle(interpolation: Interpolation, a: &AxisPoint, b: &AxisPoint) -> [f64; 3] {
    let even = [0.5 * (a.x + b.x), 0.5 * (a.z + b.z), 0.5 * (a.c + b.c)];
    match interpolation {
        Interpolation::Linear => even,
        Interpolation::Pvt => {
            let eighth = 0.125 * (b.time - a.time);
            [0, 1, 2].map(|i| even[i] + eighth * (a.rates[i] - b.rates[i]))
        }
    }
}

/// Distances from the axis and angles at which [`probed`] looks.
const PROBES: [usize; 2] = [24, 180];

/// The largest error that points so far apart would have on circles through the aperture, mm along the normal, either way.
/// A quick look before a path is laid.
pub(super) fn probed(
    part: &Placed,
    aperture: &Aperture,
    nose: Nose,
    interpolation: Interpolation,
    guide: &Guide,
    spacing: &Spacing,
) -> Result<f64, TurningError> {
    let [rings, rays] = PROBES;
    let mut worst: f64 = 0.0;
    let mut guess = [0.0; 2];
    for ring in 1..=rings {
        let x = guide.farthest() * ring as f64 / rings as f64;
        let apart = spacing.angle(x);
        for ray in 0..rays {
            let c = TAU * ray as f64 / rays as f64;
            let mut at = |c: f64| {
                let (sin, cos) = libm::sincos(c);
                let found = locate(part, nose, x, (cos, sin), guess)?;
                guess = found.offset;
                Ok::<_, TurningError>(found)
            };
            let (a, m, b) = (at(c - 0.5 * apart)?, at(c)?, at(c + 0.5 * apart)?);
            if !aperture.contains(m.touch[0], m.touch[1]) {
                continue;
            }
            let mut z = 0.5 * (a.center.z + b.center.z);
            if interpolation == Interpolation::Pvt {
                z += 0.125 * apart * (a.center.t - b.center.t);
            }
            worst = worst.max(((z - m.center.z) * m.normal_z).abs());
        }
    }
    Ok(worst)
}
