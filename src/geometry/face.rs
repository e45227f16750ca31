//! A surface with the side that is cut.

use super::{Domain, Jet, Surface, Uv};
use glam::DVec3;
use std::sync::Arc;

/// Which side of a surface faces the cutter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Side {
    /// The side that `du × dv` points to.
    #[default]
    Front,
    /// The other side.
    Back,
}

/// A surface and the side of it that is cut.
#[derive(Debug, Clone)]
pub struct Face {
    /// The surface.
    pub surface: Arc<dyn Surface>,
    /// The side that is cut.
    pub side: Side,
}

impl Face {
    /// The face of `surface` cut from `side`.
    pub fn new(surface: impl Surface + 'static, side: Side) -> Self {
        Self { surface: Arc::new(surface), side }
    }

    /// The surface's parameter rectangle.
    pub fn domain(&self) -> Domain {
        self.surface.domain()
    }

    /// The surface's jet.
    pub fn jet(&self, uv: Uv) -> Jet {
        self.surface.jet(uv)
    }

    /// The unit normal out of the material read from `jet`; `None` at a pole.
    pub fn normal(&self, jet: &Jet) -> Option<DVec3> {
        jet.normal().map(|n| match self.side {
            Side::Front => n,
            Side::Back => -n,
        })
    }

    /// The jet and outward normal at `uv`. At a pole the normal is the limit from inside the domain, taken a
    /// millionth of the domain away; `None` where even that has none (the surface is collapsed there).
    pub fn at(&self, uv: Uv) -> Option<(Jet, DVec3)> {
        let jet = self.jet(uv);
        if let Some(n) = self.normal(&jet) {
            return Some((jet, n));
        }
        let domain = self.domain();
        let centre = domain.at(0.5, 0.5);
        let nudge = 1e-6;
        let inside = Uv::new(uv.u + (centre.u - uv.u) * nudge, uv.v + (centre.v - uv.v) * nudge);
        self.normal(&self.jet(inside)).map(|n| (jet, n))
    }
}
