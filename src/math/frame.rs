//! Right-handed orthonormal frames.

use glam::DVec3;

/// A right-handed orthonormal frame; as a contact frame: feed `f`, `b = n × f`, normal `n`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// First axis: the feed direction of a contact frame.
    pub f: DVec3,
    /// Second axis, `n × f`: the left of a pass.
    pub b: DVec3,
    /// Third axis: the outward normal of a contact frame.
    pub n: DVec3,
}

impl Frame {
    /// The frame with third axis `n` (unit) and first axis along the part of `toward` that is square to `n`;
    /// `None` where `toward` is parallel to `n` or zero.
    pub fn from_normal(n: DVec3, toward: DVec3) -> Option<Self> {
        let f = (toward - n * n.dot(toward)).try_normalize()?;
        Some(Self { f, b: n.cross(f), n })
    }

    /// A frame with third axis `n` (unit), its first axis chosen along the coordinate axis least aligned with `n`.
    pub fn any(n: DVec3) -> Self {
        let a = n.abs();
        let toward = if a.x <= a.y && a.x <= a.z {
            DVec3::X
        } else if a.y <= a.z {
            DVec3::Y
        } else {
            DVec3::Z
        };
        Self::from_normal(n, toward).unwrap_or(Self { f: DVec3::X, b: DVec3::Y, n: DVec3::Z })
    }

    /// World vector of the local components `v`.
    pub fn to_world(&self, v: DVec3) -> DVec3 {
        self.f * v.x + self.b * v.y + self.n * v.z
    }

    /// Local components (along f, b, n) of the world vector `v`.
    pub fn to_local(&self, v: DVec3) -> DVec3 {
        DVec3::new(self.f.dot(v), self.b.dot(v), self.n.dot(v))
    }
}
