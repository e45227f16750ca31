//! Scalar fields on a face, whose level lines become passes.

use super::{Face, FaceGrid, Jet, Table, Uv};
use crate::math::frame::Frame;
use glam::DVec3;
use std::sync::Arc;

/// A smooth function on a face.
#[derive(Debug, Clone, PartialEq)]
pub enum Field {
    /// The first parameter: its level lines run along v.
    U,
    /// The second parameter: its level lines run along u.
    V,
    /// The coordinate along a unit vector, mm: its level lines are sections by parallel planes.
    Along(DVec3),
    /// A function given at the nodes of a grid.
    Given(Arc<Table>),
}

impl Field {
    /// The values at the nodes of `grid`, u running fastest.
    pub fn at_nodes(&self, grid: &FaceGrid) -> Vec<f64> {
        let nu = grid.size().0;
        let points = grid.points().iter().enumerate();
        points.map(|(k, p)| self.value(grid.uv(k % nu, k / nu), *p)).collect()
    }

    /// The field's value at `uv`, where the face's point is `p`.
    pub fn value(&self, uv: Uv, p: DVec3) -> f64 {
        match self {
            Self::U => uv.u,
            Self::V => uv.v,
            Self::Along(d) => d.dot(p),
            Self::Given(table) => table.at(uv).value,
        }
    }

    /// Partial derivatives with respect to u and v at `uv`, where the face has this jet.
    pub fn gradient(&self, uv: Uv, jet: &Jet) -> (f64, f64) {
        match self {
            Self::U => (1.0, 0.0),
            Self::V => (0.0, 1.0),
            Self::Along(d) => (d.dot(jet.du), d.dot(jet.dv)),
            Self::Given(table) => table.at(uv).slope,
        }
    }

    /// The tangent vector of steepest rise, per mm; zero or not finite where the field stands still or at a pole.
    pub fn surface_gradient(&self, uv: Uv, jet: &Jet) -> DVec3 {
        let (gu, gv) = self.gradient(uv, jet);
        let (e, f, g) = jet.first_form();
        let det = e * g - f * f;
        (jet.du * (g * gu - f * gv) + jet.dv * (e * gv - f * gu)) / det
    }

    /// Geodesic curvature of the level line through `uv`, where the face has this jet, 1/mm, positive where it bends towards
    /// the frame's `b`; the frame's `f` must be tangent to the line, and `feed_curvature` the normal curvature along it.
    ///
    /// Not finite where a plane of the family touches the face.
    pub fn geodesic_curvature(&self, uv: Uv, jet: &Jet, frame: &Frame, feed_curvature: f64) -> f64 {
        match self {
            Self::U => jet.dvv.dot(frame.b) / jet.dv.length_squared(),
            Self::V => jet.duu.dot(frame.b) / jet.du.length_squared(),
            // The line's curvature vector lies in the plane, square to f; its part along n is the normal curvature.
            Self::Along(d) => -feed_curvature * d.dot(frame.n) / d.dot(frame.b),
            Self::Given(table) => {
                let (Some((fu, fv)), Some((bu, bv))) = (jet.pull_back(frame.f), jet.pull_back(frame.b))
                else {
                    return f64::NAN;
                };
                let local = table.at(uv);
                // Twice along the line the function does not change: what it bends by, the line turns away.
                let (uu, uv, vv) = local.bend;
                let bend = uu * fu * fu + 2.0 * uv * fu * fv + vv * fv * fv;
                let turn = -bend / (local.slope.0 * bu + local.slope.1 * bv);
                let given = jet.duu * (fu * fu) + jet.duv * (2.0 * fu * fv) + jet.dvv * (fv * fv);
                given.dot(frame.b) + turn
            }
        }
    }

    /// `uv` moved along the steepest rise onto the level line `level`; `None` where the field stands still or the line
    /// is not found within a few steps.
    pub fn onto_level(&self, face: &Face, level: f64, mut uv: Uv) -> Option<Uv> {
        match self {
            Self::U => return Some(Uv::new(level, uv.v)),
            Self::V => return Some(Uv::new(uv.u, level)),
            Self::Along(_) | Self::Given(_) => {}
        }
        let domain = face.domain();
        for _ in 0..20 {
            let jet = face.jet(uv);
            let miss = level - self.value(uv, jet.p);
            // A nanometre, or a billionth of a pass: far below what any program states.
            if miss.abs() < 1e-9 {
                return Some(uv);
            }
            let rise = self.surface_gradient(uv, &jet);
            let (du, dv) = jet.pull_back(rise * (miss / rise.length_squared()))?;
            uv = domain.clamp(Uv::new(uv.u + du, uv.v + dv));
        }
        let miss = level - self.value(uv, face.surface.point(uv));
        (miss.abs() < 1e-6).then_some(uv)
    }
}
