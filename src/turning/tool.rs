//! What cuts.

use crate::toolpath::Nose;

/// A tool with what limits its use. Lengths in mm, angles in radians.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tool {
    /// A ball-nose mill whose axis is parallel to the spindle's.
    Ball {
        /// Radius of the sphere.
        radius: f64,
    },
    /// A round-nose turning insert. Its edge is an arc of a circle in the X-Z plane; with a rake other than 0 the
    /// arc is that of the edge seen along the direction of cutting.
    Insert {
        /// Radius of the nose.
        radius: f64,
        /// Inclination of the rake face: positive where it falls back behind the edge.
        rake: f64,
        /// The least rake that must be left against the direction of cutting where the surface rises along it.
        least_rake: f64,
        /// Angle between the flank below the edge and the direction of cutting.
        clearance: f64,
        /// The arc of the edge that may cut reaches so far to either side of the nose's lowest point.
        sweep: f64,
    },
}

impl Tool {
    /// What it is in the machine's vocabulary.
    pub fn nose(&self) -> Nose {
        match *self {
            Self::Ball { radius } => Nose::Ball(radius),
            Self::Insert { radius, .. } => Nose::Insert(radius),
        }
    }
}
