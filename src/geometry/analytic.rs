//! Plane, cylinder, cone, sphere and torus. The front of each (`du × dv`) is its outside.

use super::{Domain, Jet, Range, Surface, Uv};
use crate::math::frame::Frame;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// A rectangle in the plane through `origin` spanned by the frame's `f` (u) and `b` (v); parameters are millimetres.
#[derive(Debug, Clone, PartialEq)]
pub struct Plane {
    /// The point at `(0, 0)`.
    pub origin: DVec3,
    /// `f` and `b` span the plane, `n` is its front.
    pub frame: Frame,
    /// Extent along `f`, millimetres.
    pub u: Range,
    /// Extent along `b`, millimetres.
    pub v: Range,
}

impl Surface for Plane {
    fn domain(&self) -> Domain {
        Domain { u: self.u, v: self.v }
    }

    fn jet(&self, uv: Uv) -> Jet {
        let uv = self.domain().hold(uv);
        Jet {
            p: self.origin + self.frame.f * uv.u + self.frame.b * uv.v,
            du: self.frame.f,
            dv: self.frame.b,
            duu: DVec3::ZERO,
            duv: DVec3::ZERO,
            dvv: DVec3::ZERO,
        }
    }
}

/// The outward radial direction at angle `u` and its derivative.
fn radial(frame: &Frame, u: f64) -> (DVec3, DVec3) {
    let (s, c) = libm::sincos(u);
    (frame.f * c + frame.b * s, frame.b * c - frame.f * s)
}

/// Whether an interval of angles is a full turn.
fn angle_range(lo: f64, hi: f64) -> Range {
    Range { lo, hi, periodic: (hi - lo - TAU).abs() < 1e-9 }
}

/// A piece of a cone or cylinder about the frame's `n`: u is the angle (radians), v the height along `n` (mm).
#[derive(Debug, Clone, PartialEq)]
pub struct Cone {
    origin: DVec3,
    frame: Frame,
    radius: f64,
    slope: f64,
    domain: Domain,
}

impl Cone {
    /// The cone with `radius` at height 0 (mm) that grows by `slope` (mm per mm of height), between the `angles`
    /// (radians) and `heights` (mm); `None` where the radius is not positive over all heights.
    pub fn new(
        origin: DVec3,
        frame: Frame,
        radius: f64,
        slope: f64,
        angles: [f64; 2],
        heights: [f64; 2],
    ) -> Option<Self> {
        let positive = heights.iter().all(|h| radius + slope * h >= 0.0) && radius > 0.0;
        let domain = Domain { u: angle_range(angles[0], angles[1]), v: Range::open(heights[0], heights[1]) };
        let grows = domain.u.length() > 0.0 && domain.v.length() > 0.0;
        (positive && grows).then_some(Self { origin, frame, radius, slope, domain })
    }
}

impl Surface for Cone {
    fn domain(&self) -> Domain {
        self.domain
    }

    fn jet(&self, uv: Uv) -> Jet {
        let uv = self.domain.hold(uv);
        let (e, t) = radial(&self.frame, uv.u);
        let radius = self.radius + self.slope * uv.v;
        Jet {
            p: self.origin + e * radius + self.frame.n * uv.v,
            du: t * radius,
            dv: e * self.slope + self.frame.n,
            duu: -e * radius,
            duv: t * self.slope,
            dvv: DVec3::ZERO,
        }
    }
}

/// A piece of a cylinder about the frame's `n`: u is the angle (radians), v the height along `n` (mm).
#[derive(Debug, Clone, PartialEq)]
pub struct Cylinder(Cone);

impl Cylinder {
    /// The cylinder of `radius` (mm) between the `angles` (radians) and `heights` (mm); `None` for an empty piece or
    /// a radius that is not positive.
    pub fn new(
        origin: DVec3,
        frame: Frame,
        radius: f64,
        angles: [f64; 2],
        heights: [f64; 2],
    ) -> Option<Self> {
        Cone::new(origin, frame, radius, 0.0, angles, heights).map(Self)
    }
}

impl Surface for Cylinder {
    fn domain(&self) -> Domain {
        self.0.domain()
    }

    fn jet(&self, uv: Uv) -> Jet {
        self.0.jet(uv)
    }
}

/// A piece of a torus about the frame's `n`, or of a sphere where the major radius is 0: u is the angle about the
/// axis, v the angle of the tube, 0 on the equator and π/2 towards `n`.
#[derive(Debug, Clone, PartialEq)]
pub struct Torus {
    origin: DVec3,
    frame: Frame,
    major: f64,
    minor: f64,
    domain: Domain,
}

impl Torus {
    /// The torus with centre circle `major` and tube `minor` (mm) between `angles` about the axis and `tube` angles
    /// (radians); `None` for an empty piece, a tube that is not positive, or a negative major radius.
    pub fn new(
        origin: DVec3,
        frame: Frame,
        major: f64,
        minor: f64,
        angles: [f64; 2],
        tube: [f64; 2],
    ) -> Option<Self> {
        let domain = Domain { u: angle_range(angles[0], angles[1]), v: angle_range(tube[0], tube[1]) };
        let valid = minor > 0.0 && major >= 0.0 && domain.u.length() > 0.0 && domain.v.length() > 0.0;
        valid.then_some(Self { origin, frame, major, minor, domain })
    }
}

impl Surface for Torus {
    fn domain(&self) -> Domain {
        self.domain
    }

    fn jet(&self, uv: Uv) -> Jet {
        let uv = self.domain.hold(uv);
        let (e, t) = radial(&self.frame, uv.u);
        let (sv, cv) = libm::sincos(uv.v);
        let radius = self.major + self.minor * cv;
        Jet {
            p: self.origin + e * radius + self.frame.n * (self.minor * sv),
            du: t * radius,
            dv: e * (-self.minor * sv) + self.frame.n * (self.minor * cv),
            duu: -e * radius,
            duv: t * (-self.minor * sv),
            dvv: e * (-self.minor * cv) - self.frame.n * (self.minor * sv),
        }
    }
}

/// A piece of a sphere: u is the longitude, v the latitude (radians), with poles at v = ±π/2, where `du` vanishes.
#[derive(Debug, Clone, PartialEq)]
pub struct Sphere(Torus);

impl Sphere {
    /// The sphere of `radius` (mm) between the given longitudes and latitudes (radians, within ±π/2); `None` for an
    /// empty piece or a radius that is not positive.
    pub fn new(
        origin: DVec3,
        frame: Frame,
        radius: f64,
        longitudes: [f64; 2],
        latitudes: [f64; 2],
    ) -> Option<Self> {
        let within = latitudes.iter().all(|v| v.abs() <= FRAC_PI_2 + 1e-12);
        within.then(|| Torus::new(origin, frame, 0.0, radius, longitudes, latitudes)).flatten().map(Self)
    }
}

impl Surface for Sphere {
    fn domain(&self) -> Domain {
        self.0.domain()
    }

    fn jet(&self, uv: Uv) -> Jet {
        self.0.jet(uv)
    }
}
