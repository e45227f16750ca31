//! By which rule postures are chosen, and within which limits.

use crate::toolpath::Posture;
use std::f64::consts::PI;

/// How the cutter leans.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rule {
    /// The same lead and yaw in every contact frame.
    Fixed(Posture),
    /// Curvature matching: at yaw 0 the least lead at which the cutter bends nowhere less than the surface.
    ///
    /// Source: Liu and Liu, Tool path planning for high speed milling with toroidal cutter, 2013, eq. (3); they match the
    /// normal section square to the feed alone, here the surface's torsion counts too.
    Matched(Limits),
    /// The lead and yaw with the widest strips.
    Widest(Limits),
    /// Two contacts: in a hollow less lead than would match its curvature, and the cutter lifted until both its sides touch,
    /// by no more than the middle may stand above the surface. Elsewhere as [`Rule::Matched`].
    TwoContacts(Limits),
}

/// What a chosen posture keeps to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Least lead, radians, above 0: a flat bottom that lies on the surface drags.
    pub least_lead: f64,
    /// Largest lead, radians: the machine's range of tilt about the surface normal.
    pub most_lead: f64,
    /// Largest yaw to either side, radians.
    pub most_yaw: f64,
    /// The most that the axis turns per millimetre, radians: along the feed in space, where it may then change in the
    /// contact frame by what that frame's own turn leaves, or by a tenth of the limit where it leaves less; across the feed
    /// in the contact frame.
    pub most_turn: [f64; 2],
    /// Share of the cusps' height for whose strips yaws are chosen, above 0 and up to 1: near where curvatures match, a
    /// strip's profile rises, falls and rises again, and what only just stays below the limit breaks off at half the width
    /// beside it. See [`Rule::versions`].
    pub height: f64,
}

/// Degrees as radians, where functions are constant.
const DEGREE: f64 = PI / 180.0;

impl Default for Limits {
    /// Leads from 2° to 45°, up to 30° of yaw. A machine that turns its axis by 90° in a second keeps up with 4° a
    /// millimetre at 1350 mm/min.
    fn default() -> Self {
        Self {
            least_lead: 2.0 * DEGREE,
            most_lead: 45.0 * DEGREE,
            most_yaw: 30.0 * DEGREE,
            most_turn: [4.0 * DEGREE, 8.0 * DEGREE],
            height: 1.0,
        }
    }
}

/// Share of the scallop height that the middle of a strip may be lifted by; the rest is for what happens between nodes and
/// for rounding.
const LIFTED: f64 = 0.97;

/// Shares of the cusps' height that are tried. On a twisted blade passes come out a sixth shorter with the second, on a toric
/// lens twice as long.
const HEIGHTS: [f64; 2] = [1.0, 0.67];

impl Rule {
    /// The rule as it is, or in each way of which no formula tells which makes passes shorter.
    pub fn versions(&self) -> Vec<Self> {
        match *self {
            Self::Widest(limits) => {
                HEIGHTS.map(|share| Self::Widest(Limits { height: share * limits.height, ..limits })).to_vec()
            }
            rule => vec![rule],
        }
    }

    /// The limits of a rule that chooses; the rule of matching keeps yaw 0.
    pub(super) fn limits(&self) -> Result<Limits, Posture> {
        match *self {
            Self::Fixed(posture) => Err(posture),
            Self::Matched(limits) | Self::TwoContacts(limits) => Ok(Limits { most_yaw: 0.0, ..limits }),
            Self::Widest(limits) => Ok(limits),
        }
    }

    /// How far the cutter may be lifted off the middle of a hollow, mm: where the feed is straight or bends away from the
    /// cutter, and where it bends towards it, so that moves run above their path by up to `chord` (mm); for cusps of the height
    /// `scallop` (mm).
    pub fn most_lift(&self, scallop: f64, chord: f64) -> [f64; 2] {
        match self {
            Self::TwoContacts(_) => [scallop, scallop - chord].map(|most| LIFTED * most),
            Self::Fixed(_) | Self::Matched(_) | Self::Widest(_) => [0.0; 2],
        }
    }
}
