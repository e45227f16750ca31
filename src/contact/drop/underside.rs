//! The underside of a cutter as a function of the radius.

use crate::cutter::Cutter;
use glam::DVec2;

/// Height above the tip of a cutter's underside, as a convex function of the distance from its axis, made ready for
/// many evaluations.
///
/// APT's bottom line, corner and side line rise ever more steeply, so the underside is convex for every cutter that
/// [`Cutter::new`] accepts. Above the largest radius nothing is met: shank and holder are not part of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Underside {
    /// Radius of the shadow.
    pub(super) reach: f64,
    /// Radius where the corner begins.
    pub(super) start: f64,
    /// Radius where the corner ends.
    pub(super) end: f64,
    /// Distance of the corner's centre from the axis.
    pub(super) center_radius: f64,
    pub(super) center_height: f64,
    /// Radius of the corner.
    pub(super) corner: f64,
    /// Slope of the bottom line.
    pub(super) bottom: f64,
    /// Slope of the side line; infinite unless the side widens upwards.
    pub(super) side: f64,
    end_height: f64,
    /// Steepest slope at which tangents are taken, and the radius where the corner has it.
    pub(super) steepest: f64,
    pub(super) tangent_end: f64,
}

/// The underside's tangent is taken no steeper than this: towards the rim it would become infinite, and with it the
/// bound over a rectangle that reaches across the rim.
const STEEPEST: f64 = 4.0;

impl Underside {
    /// The underside of `cutter`.
    pub fn new(cutter: &Cutter) -> Self {
        let (end, end_height) = cutter.corner_end();
        let widens = cutter.taper > 0.0;
        let reach = cutter.largest_radius();
        let side = if widens { 1.0 / libm::tan(cutter.taper) } else { f64::INFINITY };
        let steepest = STEEPEST.min(side);
        Self {
            reach,
            start: cutter.corner_start().0.min(reach),
            end: if widens { end } else { reach },
            center_radius: cutter.center_radius,
            center_height: cutter.center_height,
            corner: cutter.corner_radius,
            bottom: libm::tan(cutter.bottom_angle),
            side,
            end_height,
            steepest,
            tangent_end: cutter.center_radius
                + cutter.corner_radius * steepest / (1.0 + steepest * steepest).sqrt(),
        }
    }

    /// Radius of the cutter's shadow, mm.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// Height above the tip at `radius`, which must lie between 0 and [`Underside::reach`], mm.
    pub fn height(&self, radius: f64) -> f64 {
        if radius <= self.start {
            radius * self.bottom
        } else if radius <= self.end || self.side == f64::INFINITY {
            self.center_height - self.arc_height(radius)
        } else {
            self.end_height + (radius - self.end) * self.side
        }
    }

    /// How far the corner at `radius` lies below the corner's centre.
    pub(super) fn arc_height(&self, radius: f64) -> f64 {
        let x = radius - self.center_radius;
        (self.corner * self.corner - x * x).max(0.0).sqrt()
    }

    /// Slope at `radius`: the lower one where it jumps, except at the rim of a side that does not widen, where it is
    /// infinite.
    pub fn slope(&self, radius: f64) -> f64 {
        if radius <= self.start && radius < self.reach {
            self.bottom
        } else if radius <= self.end {
            let y = self.arc_height(radius);
            if y > 0.0 { (radius - self.center_radius) / y } else { self.side }
        } else {
            self.side
        }
    }

    /// Where, seen from the axis, the underside touches a plane with this gradient. Where a whole stretch touches, at
    /// its inner end.
    pub fn touch_plane(&self, gradient: DVec2) -> DVec2 {
        let square = gradient.length_squared();
        if square <= self.bottom * self.bottom {
            DVec2::ZERO
        } else if square < self.side * self.side {
            gradient * (self.center_radius / square.sqrt() + self.corner / (1.0 + square).sqrt())
        } else {
            gradient * (self.reach / square.sqrt())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_are_those_of_the_profile_and_slopes_their_derivative() {
        for cutter in [
            Cutter::flat(10.0, 30.0),
            Cutter::ball(10.0, 30.0),
            Cutter::bull_nose(10.0, 2.0, 30.0),
            Cutter::tapered(4.0, 1.0, 0.1, 25.0),
            Cutter::tapered(9.0, 1.0, -0.1, 25.0),
            Cutter::conical(12.0, 1.5, 0.3, 20.0),
            Cutter::conical(12.0, 0.0, 0.3, 20.0),
            Cutter::new(8.0, 1.0, 0.2, 0.15, 20.0),
        ] {
            let cutter = cutter.unwrap();
            let under = Underside::new(&cutter);
            assert_eq!(under.reach(), cutter.largest_radius());
            for i in 1..400 {
                let radius = under.reach() * f64::from(i) / 400.0;
                let height = under.height(radius);
                assert!((height - cutter.height_at(radius).unwrap()).abs() < 1e-12);
                let d = 1e-7;
                let slope = (under.height(radius + d) - under.height(radius - d)) / (2.0 * d);
                let near_kink = [under.start, under.end].iter().any(|k| (k - radius).abs() < 2.0 * d);
                assert!(near_kink || (slope - under.slope(radius)).abs() < 1e-5 * (1.0 + slope * slope));
            }
        }
    }

    #[test]
    fn a_touched_plane_lies_below_the_underside() {
        for cutter in [
            Cutter::flat(10.0, 30.0),
            Cutter::bull_nose(10.0, 2.0, 30.0),
            Cutter::conical(12.0, 0.0, 0.3, 20.0),
            Cutter::new(8.0, 1.0, 0.2, 0.15, 20.0),
        ] {
            let under = Underside::new(&cutter.unwrap());
            for m in [0.0, 0.1, 0.25, 1.0, 3.0, 6.0, 7.0, 50.0_f64] {
                let at = under.touch_plane(DVec2::new(0.6, -0.8) * m);
                assert!(at.perp_dot(DVec2::new(0.6, -0.8)).abs() < 1e-12);
                let most = m * at.length() - under.height(at.length());
                for i in 0..=500 {
                    let radius = under.reach() * f64::from(i) / 500.0;
                    assert!(m * radius - under.height(radius) <= most + 1e-9);
                }
            }
        }
    }
}
