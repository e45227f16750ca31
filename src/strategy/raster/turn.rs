//! Between the world and a frame whose x runs along the lines.

use glam::{DVec2, DVec3};

/// A turn about z between the world and a frame whose x runs along the lines.
pub(super) struct Turn {
    along: DVec2,
}

impl Turn {
    pub(super) fn new(angle: f64) -> Self {
        let (s, c) = libm::sincos(angle);
        Self { along: DVec2::new(c, s) }
    }

    pub(super) fn to_lines(&self, v: DVec3) -> DVec3 {
        let flat = v.truncate();
        DVec3::new(self.along.dot(flat), self.along.perp_dot(flat), v.z)
    }

    pub(super) fn to_world(&self, v: DVec3) -> DVec3 {
        (self.along * v.x + self.along.perp() * v.y).extend(v.z)
    }
}
