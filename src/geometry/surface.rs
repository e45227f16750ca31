//! What a parametric surface is.

use super::Jet;
use glam::DVec3;

/// A point of a surface's parameter domain.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Uv {
    /// First parameter.
    pub u: f64,
    /// Second parameter.
    pub v: f64,
}

impl Uv {
    /// The parameters `(u, v)`.
    pub fn new(u: f64, v: f64) -> Self {
        Self { u, v }
    }

    /// The parameters a share `t` of the way to `other`; seams are not looked for.
    #[must_use]
    pub fn lerp(self, other: Self, t: f64) -> Self {
        Self { u: self.u + (other.u - self.u) * t, v: self.v + (other.v - self.v) * t }
    }
}

/// The interval of one parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Lower end.
    pub lo: f64,
    /// Upper end, above the lower.
    pub hi: f64,
    /// Whether the surface closes smoothly over the ends: `lo` and `hi` are the same curve.
    pub periodic: bool,
}

impl Range {
    /// An interval whose ends are borders.
    pub fn open(lo: f64, hi: f64) -> Self {
        Self { lo, hi, periodic: false }
    }

    /// An interval whose ends are one curve.
    pub fn periodic(lo: f64, hi: f64) -> Self {
        Self { lo, hi, periodic: true }
    }

    /// Upper end less lower end.
    pub fn length(&self) -> f64 {
        self.hi - self.lo
    }

    /// The parameter at the fraction `t` of the interval.
    pub fn at(&self, t: f64) -> f64 {
        self.lo + (self.hi - self.lo) * t
    }

    /// `x` brought into the interval: wrapped where periodic, clamped elsewhere.
    pub fn hold(&self, x: f64) -> f64 {
        if self.periodic {
            let turns = ((x - self.lo) / self.length()).floor();
            (x - turns * self.length()).clamp(self.lo, self.hi)
        } else {
            x.clamp(self.lo, self.hi)
        }
    }

    /// `x` moved by whole periods to within half a period of `near`; as it is where not periodic.
    pub fn turned(&self, x: f64, near: f64) -> f64 {
        if self.periodic { x + ((near - x) / self.length()).round() * self.length() } else { x }
    }

    /// Whether `x` lies within a hundredth of the interval of one of its ends; never so where periodic.
    pub fn is_near_end(&self, x: f64) -> bool {
        !self.periodic && (x - self.lo).min(self.hi - x) < 0.01 * self.length()
    }

    /// Whether `x` lies in the interval; always so where periodic.
    pub fn contains(&self, x: f64) -> bool {
        self.periodic || (self.lo <= x && x <= self.hi)
    }
}

/// The rectangle of parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Domain {
    /// Interval of the first parameter.
    pub u: Range,
    /// Interval of the second parameter.
    pub v: Range,
}

impl Domain {
    /// The parameters at the fractions `(s, t)` of the two intervals.
    pub fn at(&self, s: f64, t: f64) -> Uv {
        Uv::new(self.u.at(s), self.v.at(t))
    }

    /// `uv` wrapped or clamped into the rectangle.
    pub fn hold(&self, uv: Uv) -> Uv {
        Uv::new(self.u.hold(uv.u), self.v.hold(uv.v))
    }

    /// `uv` clamped where the rectangle has borders and left alone where it is periodic, so that a point that goes
    /// round keeps its count of turns.
    pub fn clamp(&self, uv: Uv) -> Uv {
        let clamp = |range: &Range, x: f64| if range.periodic { x } else { x.clamp(range.lo, range.hi) };
        Uv::new(clamp(&self.u, uv.u), clamp(&self.v, uv.v))
    }

    /// Whether `uv` lies in the rectangle.
    pub fn contains(&self, uv: Uv) -> bool {
        self.u.contains(uv.u) && self.v.contains(uv.v)
    }
}

/// A parametric surface, twice differentiable but for isolated lines and poles.
pub trait Surface: Send + Sync + std::fmt::Debug {
    /// The rectangle over which the surface is defined.
    fn domain(&self) -> Domain;

    /// Point, first and second derivatives at `uv`, millimetres per parameter. A `uv` outside the domain is
    /// wrapped where periodic and clamped elsewhere.
    fn jet(&self, uv: Uv) -> Jet;

    /// The point at `uv`.
    fn point(&self, uv: Uv) -> DVec3 {
        self.jet(uv).p
    }
}
