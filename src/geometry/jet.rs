//! A surface at one parameter: point, tangents and second derivatives.

use glam::DVec3;

/// Point and derivatives of a surface at one parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jet {
    /// The point, millimetres.
    pub p: DVec3,
    /// ∂/∂u.
    pub du: DVec3,
    /// ∂/∂v.
    pub dv: DVec3,
    /// ∂²/∂u².
    pub duu: DVec3,
    /// ∂²/∂u∂v.
    pub duv: DVec3,
    /// ∂²/∂v².
    pub dvv: DVec3,
}

/// Tangents whose sine of the enclosed angle is below this span no plane: at a pole rounding alone decides it.
const SINGULAR_SINE: f64 = 1e-9;

impl Jet {
    /// The unit normal `du × dv`; `None` where the tangents vanish or are parallel (a pole, a collapsed edge).
    pub fn normal(&self) -> Option<DVec3> {
        let cross = self.du.cross(self.dv);
        let scale = self.du.length() * self.dv.length();
        let length = cross.length();
        (length > SINGULAR_SINE * scale && length > 0.0 && length.is_finite()).then(|| cross / length)
    }

    /// First fundamental form `(E, F, G)`.
    pub fn first_form(&self) -> (f64, f64, f64) {
        (self.du.dot(self.du), self.du.dot(self.dv), self.dv.dot(self.dv))
    }

    /// Second fundamental form `(L, M, N)` for the unit normal `n`: positive where the surface bends towards `n`.
    pub fn second_form(&self, n: DVec3) -> (f64, f64, f64) {
        (self.duu.dot(n), self.duv.dot(n), self.dvv.dot(n))
    }

    /// Area per unit of parameter area, `√(EG − F²)`.
    pub fn area_density(&self) -> f64 {
        self.du.cross(self.dv).length()
    }

    /// The parameter step `(Δu, Δv)` whose image under the tangents is the tangent part of the world vector `w`;
    /// `None` where the tangents span no plane.
    pub fn pull_back(&self, w: DVec3) -> Option<(f64, f64)> {
        self.raise(self.du.dot(w), self.dv.dot(w))
    }

    /// The parameter step `(Δu, Δv)` whose image has the inner products `a` with ∂/∂u and `b` with ∂/∂v; `None` where the
    /// tangents span no plane.
    pub fn raise(&self, a: f64, b: f64) -> Option<(f64, f64)> {
        let (e, f, g) = self.first_form();
        let det = e * g - f * f;
        if !(det > SINGULAR_SINE * SINGULAR_SINE * e * g && det > 0.0) {
            return None;
        }
        Some(((g * a - f * b) / det, (e * b - f * a) / det))
    }
}
