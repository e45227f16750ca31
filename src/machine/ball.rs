//! Where the path cuts, as a ball.

use crate::toolpath::{ClPoint, Role, Toolpath};
use glam::DVec3;

/// A ball that holds the tip wherever the path cuts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ball {
    center: DVec3,
    radius: f64,
}

impl Ball {
    /// Around the cuts of `path`; of radius 0 if there are none.
    pub(super) fn around(path: &Toolpath) -> Self {
        let tips = || path.moves.iter().filter(|step| step.role == Role::Cut).map(|step| step.to.tip);
        let low = tips().fold(DVec3::INFINITY, DVec3::min);
        let high = tips().fold(DVec3::NEG_INFINITY, DVec3::max);
        if low.x > high.x {
            return Self { center: DVec3::ZERO, radius: 0.0 };
        }
        Self { center: 0.5 * (low + high), radius: 0.5 * low.distance(high) }
    }

    /// How far a tool must draw back along its axis for its tip to be `clearance` outside of the ball, mm.
    pub(super) fn way_out(&self, from: &ClPoint, clearance: f64) -> f64 {
        let (off, radius) = (from.tip - self.center, self.radius + clearance);
        let beyond = radius * radius - off.length_squared();
        if beyond <= 0.0 {
            return 0.0;
        }
        let along = off.dot(from.axis);
        -along + (along * along + beyond).sqrt()
    }
}
