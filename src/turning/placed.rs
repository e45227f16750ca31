//! The part as it is held in the machine.

use super::height_jet::HeightJet;
use super::sag::Sag;
use std::sync::Arc;

/// A sag held on the spindle: shifted and turned about the spindle axis.
#[derive(Clone)]
pub struct Placed {
    sag: Arc<dyn Sag>,
    shift: [f64; 2],
    cos: f64,
    sin: f64,
}

impl Placed {
    /// `sag` with its own origin at `shift` (mm) from the spindle axis and its x axis turned by `angle` (radians) from C = 0.
    pub fn new(sag: Arc<dyn Sag>, shift: [f64; 2], angle: f64) -> Self {
        let (sin, cos) = libm::sincos(angle);
        Self { sag, shift, cos, sin }
    }

    /// Height and derivatives at `(x, y)` on the workpiece.
    pub fn at(&self, x: f64, y: f64) -> HeightJet {
        let [u, v] = self.own([x, y]);
        let own = self.sag.at(u, v);
        let (c, s) = (self.cos, self.sin);
        let [gu, gv] = own.g;
        let [uu, uv, vv] = own.h;
        HeightJet {
            z: own.z,
            g: [c * gu - s * gv, s * gu + c * gv],
            h: [
                c * c * uu - 2.0 * c * s * uv + s * s * vv,
                c * s * (uu - vv) + (c * c - s * s) * uv,
                s * s * uu + 2.0 * c * s * uv + c * c * vv,
            ],
        }
    }

    /// Whether the surface is there.
    pub fn reaches(&self, x: f64, y: f64) -> bool {
        let [u, v] = self.own([x, y]);
        self.sag.reaches(u, v)
    }

    /// How far it reaches, in words.
    pub fn reach(&self) -> String {
        self.sag.reach()
    }

    /// The sag's own coordinates of a place on the workpiece.
    pub fn own(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (dx, dy) = (x - self.shift[0], y - self.shift[1]);
        [self.cos * dx + self.sin * dy, self.cos * dy - self.sin * dx]
    }

    /// The place on the workpiece of the sag's own coordinates.
    pub fn world(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        [self.shift[0] + self.cos * u - self.sin * v, self.shift[1] + self.sin * u + self.cos * v]
    }
}
