//! APT's seven cutter parameters and the usual shapes by name.

use std::f64::consts::FRAC_PI_2;

/// A cutter of revolution: a bottom line, a rounded corner and a side line, tangent to one another.
///
/// Lengths in millimetres, angles in radians, heights counted from the tip along the axis.
///
/// Source: I. H. Kral, Numerical Control Programming in APT, Prentice-Hall, 1986, ch. 7 (`CUTTER/d,r,e,f,α,β,h`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cutter {
    /// d: diameter where bottom line and side line would meet without a corner.
    pub diameter: f64,
    /// r: radius of the corner.
    pub corner_radius: f64,
    /// e: distance of the corner's centre from the axis; the `R1` of the centre circle.
    pub center_radius: f64,
    /// f: height of the corner's centre above the tip.
    pub center_height: f64,
    /// α: rise of the bottom line from the tip, 0 for a flat bottom.
    pub bottom_angle: f64,
    /// β: taper of the side line, 0 for a cylinder, positive where it widens upwards.
    pub taper: f64,
    /// h: height of the side line's end.
    pub height: f64,
}

/// Why a cutter cannot exist.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{field}: {message}")]
pub struct CutterError {
    /// The parameter that is wrong: `diameter`, `corner_radius`, `bottom_angle`, `taper` or `height`.
    pub field: &'static str,
    /// What would be right.
    pub message: String,
}

impl Cutter {
    /// The cutter with diameter `d`, corner radius `r`, bottom angle `alpha`, taper `beta` and height `h`; the corner's
    /// centre follows from tangency.
    ///
    /// Errors name the parameter and the range that would do.
    pub fn new(d: f64, r: f64, alpha: f64, beta: f64, h: f64) -> Result<Self, CutterError> {
        let err = |field, message: String| Err(CutterError { field, message });
        if !(d > 0.0 && d.is_finite()) {
            return err("diameter", "must be above 0 mm".into());
        }
        if !(r >= 0.0 && r.is_finite()) {
            return err("corner_radius", "must be 0 mm or more".into());
        }
        if !(0.0..FRAC_PI_2).contains(&alpha) {
            return err("bottom_angle", "must be at least 0° and below 90°".into());
        }
        if !(beta > -FRAC_PI_2 && beta < FRAC_PI_2 - alpha) {
            return err("taper", "must be above −90° and below 90° less the bottom angle".into());
        }
        let (sa, ca) = libm::sincos(alpha);
        let (sb, cb) = libm::sincos(beta);
        // With the corner's centre at (e, f), f = r/cos α + e tan α. The side line through the corner's upper end meets
        // the bottom line at radius d/2: (d/2)(1 − tan α tan β) = e(1 − tan α tan β) + r(1/cos β − tan β/cos α).
        let bend = 1.0 - sa * sb / (ca * cb);
        let e = 0.5 * d - r * (1.0 / cb - sb / (cb * ca)) / bend;
        if e < -1e-9 * d {
            let most = 0.5 * d * bend / (1.0 / cb - sb / (cb * ca));
            return err("corner_radius", format!("must be at most {most:.4} mm for this diameter"));
        }
        let e = e.max(0.0);
        let f = r / ca + e * sa / ca;
        let lowest = f - r * sb;
        if !(h >= lowest && h.is_finite()) {
            return err("height", format!("must be at least {lowest:.4} mm, where the side begins"));
        }
        Ok(Self {
            diameter: d,
            corner_radius: r,
            center_radius: e,
            center_height: f,
            bottom_angle: alpha,
            taper: beta,
            height: h,
        })
    }

    /// A flat end mill.
    pub fn flat(diameter: f64, height: f64) -> Result<Self, CutterError> {
        Self::new(diameter, 0.0, 0.0, 0.0, height)
    }

    /// A ball end mill.
    pub fn ball(diameter: f64, height: f64) -> Result<Self, CutterError> {
        Self::new(diameter, 0.5 * diameter, 0.0, 0.0, height)
    }

    /// A bull-nose (toroidal) mill.
    pub fn bull_nose(diameter: f64, corner_radius: f64, height: f64) -> Result<Self, CutterError> {
        Self::new(diameter, corner_radius, 0.0, 0.0, height)
    }

    /// A flat-bottomed mill with a rounded corner whose side widens upwards by `taper` radians.
    pub fn tapered(d: f64, corner_radius: f64, taper: f64, height: f64) -> Result<Self, CutterError> {
        Self::new(d, corner_radius, 0.0, taper, height)
    }

    /// A mill with a conical bottom that rises by `bottom_angle` radians and a cylindrical side.
    pub fn conical(d: f64, corner_radius: f64, bottom_angle: f64, height: f64) -> Result<Self, CutterError> {
        Self::new(d, corner_radius, bottom_angle, 0.0, height)
    }

    /// `[d, r, e, f, α, β, h]` in millimetres and degrees, as `CUTTER/` states them.
    pub fn apt_parameters(&self) -> [f64; 7] {
        [
            self.diameter,
            self.corner_radius,
            self.center_radius,
            self.center_height,
            self.bottom_angle.to_degrees(),
            self.taper.to_degrees(),
            self.height,
        ]
    }
}
