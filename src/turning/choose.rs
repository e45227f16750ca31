//! Steps chosen from what may be left.

use super::aperture::Aperture;
use super::chord::probed;
use super::cusp::highest_cusp;
use super::error::TurningError;
use super::guide::Guide;
use super::placed::Placed;
use super::spacing::Spacing;
use crate::toolpath::{Interpolation, Nose};

/// What a path must keep, mm along the normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Asked {
    /// What may be left anywhere, above `chord`.
    pub residue: f64,
    /// What interpolation may be off, either way; above 0.
    pub chord: f64,
}

/// Share of a limit that is planned for. Cusps are known to second order: on the paper's lens the highest is within 2 % of what
/// that says at a residue of 10 µm, and nearer below.
const SHARE: f64 = 0.95;

/// The largest step between turns, mm, that leaves no more than `asked` allows: cusps may be what the residue is more than the
/// chord error.
pub fn chosen_step(part: &Placed, aperture: &Aperture, nose: Nose, asked: &Asked) -> f64 {
    let unit = highest_cusp(part, aperture, nose, 1.0).height;
    (SHARE * (asked.residue - asked.chord) / unit).sqrt()
}

/// Farthest that points are put apart where nothing asks for less: eight to a turn.
const WIDEST: f64 = std::f64::consts::FRAC_PI_4;

/// `spacing` with points as far apart as the chord error allows, at most 45° at the rim; equal angles divide a turn evenly.
pub fn chosen_angle(
    part: &Placed,
    aperture: &Aperture,
    nose: Nose,
    interpolation: Interpolation,
    guide: &Guide,
    spacing: &Spacing,
    asked: &Asked,
) -> Result<Spacing, TurningError> {
    let power = match interpolation {
        Interpolation::Linear => 0.5,
        Interpolation::Pvt => 0.25,
    };
    let rim = |s: &Spacing| s.angle(guide.farthest());
    // From 3° at the rim, as in the paper; each round comes nearer, since only higher orders are left out.
    let mut now = spacing.scaled(3.0_f64.to_radians() / rim(spacing));
    for _ in 0..4 {
        let error = probed(part, aperture, nose, interpolation, guide, &now)?;
        let share = libm::pow(SHARE * asked.chord / error.max(f64::MIN_POSITIVE), power);
        now = now.scaled(share.min(WIDEST / rim(&now)));
    }
    Ok(whole_turn(now))
}

/// `spacing`, where it is by equal angles, a little closer, so that a turn is a whole number of them.
pub(super) fn whole_turn(spacing: Spacing) -> Spacing {
    let turn = std::f64::consts::TAU;
    match spacing {
        Spacing::Angle(angle) => Spacing::Angle(turn / (turn / angle * (1.0 - 1e-9)).ceil()),
        other => other,
    }
}
