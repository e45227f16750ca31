//! What holds the cutter.

use super::{Cutter, CutterError};

/// A holder as the cylinder that contains it, around the cutter's axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Holder {
    /// From the tip up to its lower end, mm.
    pub stickout: f64,
    /// Its diameter, mm.
    pub diameter: f64,
    /// How far up it goes, mm. Clearance is kept beside all that is above its lower end, with or without end.
    pub height: f64,
}

/// Rounds the lower edge of [`Holder::solid`], mm: what is looked at between samples has none that is sharp.
const EDGE: f64 = 2.0;
/// How far a rounded edge must stand out for a sharp one to be inside: `1 − 1/√2` of its radius.
const STAND_OUT: f64 = 0.293;

impl Holder {
    /// A holder of the given stick-out, diameter and height, mm, for `cutter`.
    ///
    /// Errors name the parameter: a diameter or a height that is not above 0, a stick-out that is less than the cutting height.
    pub fn new(stickout: f64, diameter: f64, height: f64, cutter: &Cutter) -> Result<Self, CutterError> {
        let err = |field, message| Err(CutterError { field, message });
        if !(diameter > 0.0 && height > 0.0) {
            return err("diameter", "and height must be above 0 mm".into());
        }
        if stickout.is_nan() || stickout < cutter.height {
            let least = cutter.height;
            return err("stickout", format!("must be at least {least} mm, the cutting height of the cutter"));
        }
        Ok(Self { stickout, diameter, height })
    }

    /// A body of revolution around the holder, as a cutter, and how far above the cutter's tip its own tip is, mm.
    pub fn solid(&self) -> (Cutter, f64) {
        let out = STAND_OUT * EDGE;
        let radius = 0.5 * self.diameter + out;
        let edge = EDGE.min(radius);
        let solid = Cutter {
            diameter: 2.0 * radius,
            corner_radius: edge,
            center_radius: radius - edge,
            center_height: edge,
            bottom_angle: 0.0,
            taper: 0.0,
            height: self.height + out,
        };
        (solid, self.stickout - out)
    }
}
