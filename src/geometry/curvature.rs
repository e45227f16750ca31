//! Curvature of a surface in a tangent frame.

use super::Jet;
use crate::math::frame::Frame;
use glam::DVec2;

/// The curvature tensor in an orthonormal tangent frame `(f, b)`, 1/mm, positive where concave.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Curvature {
    /// Normal curvature along `f`.
    pub ff: f64,
    /// Geodesic torsion term between `f` and `b`.
    pub fb: f64,
    /// Normal curvature along `b`.
    pub bb: f64,
}

/// Principal curvatures and the direction of the smaller one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Principal {
    /// Smaller principal curvature.
    pub min: f64,
    /// Larger principal curvature.
    pub max: f64,
    /// Unit direction of the smaller curvature in the frame `(f, b)`; at an umbilic every direction is principal
    /// and `f` itself is returned.
    pub direction: DVec2,
}

impl Curvature {
    /// Of a surface that is straight along `f` and has this curvature (1/mm) along `b`.
    pub fn across(bb: f64) -> Self {
        Self { bb, ..Self::default() }
    }

    /// The curvature of the surface with the jet `jet` in `frame`, whose `n` must be the jet's unit normal or its
    /// opposite; `None` at a pole.
    pub fn of(jet: &Jet, frame: &Frame) -> Option<Self> {
        let (fu, fv) = jet.pull_back(frame.f)?;
        let (bu, bv) = jet.pull_back(frame.b)?;
        let (l, m, n) = jet.second_form(frame.n);
        Some(Self {
            ff: l * fu * fu + 2.0 * m * fu * fv + n * fv * fv,
            fb: l * fu * bu + m * (fu * bv + fv * bu) + n * fv * bv,
            bb: l * bu * bu + 2.0 * m * bu * bv + n * bv * bv,
        })
    }

    /// Product of the principal curvatures.
    pub fn det(&self) -> f64 {
        self.ff * self.bb - self.fb * self.fb
    }

    /// Half the sum of the principal curvatures.
    pub fn mean(&self) -> f64 {
        0.5 * (self.ff + self.bb)
    }

    /// Principal curvatures and direction.
    pub fn principal(&self) -> Principal {
        let half_difference = 0.5 * (self.ff - self.bb);
        let radius = libm::hypot(half_difference, self.fb);
        let mean = self.mean();
        // Twice the angle from f to the larger curvature is atan2(fb, half_difference); the smaller is square to it.
        let direction = if radius <= 1e-12 * (mean.abs() + radius) {
            DVec2::X
        } else {
            let angle = 0.5 * libm::atan2(self.fb, half_difference);
            DVec2::new(-libm::sin(angle), libm::cos(angle))
        };
        Principal { min: mean - radius, max: mean + radius, direction }
    }

    /// The tensor in the frame turned by `angle` (radians, from `f` towards `b`).
    #[must_use]
    pub fn turned(&self, angle: f64) -> Self {
        let (s, c) = libm::sincos(angle);
        Self {
            ff: c * c * self.ff + 2.0 * s * c * self.fb + s * s * self.bb,
            fb: s * c * (self.bb - self.ff) + (c * c - s * s) * self.fb,
            bb: s * s * self.ff - 2.0 * s * c * self.fb + c * c * self.bb,
        }
    }
}

impl std::ops::Sub for Curvature {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { ff: self.ff - other.ff, fb: self.fb - other.fb, bb: self.bb - other.bb }
    }
}
