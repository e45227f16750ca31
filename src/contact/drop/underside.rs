//! The underside of a cutter as a function of the radius.

use crate::cutter::Cutter;

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
    center_height: f64,
    /// Radius of the corner.
    pub(super) corner: f64,
    /// Slope of the bottom line.
    pub(super) bottom: f64,
    /// Slope of the side line; infinite unless the side widens upwards.
    pub(super) side: f64,
    end_height: f64,
}

impl Underside {
    /// The underside of `cutter`.
    pub fn new(cutter: &Cutter) -> Self {
        let (end, end_height) = cutter.corner_end();
        let widens = cutter.taper > 0.0;
        let reach = cutter.largest_radius();
        Self {
            reach,
            start: cutter.corner_start().0.min(reach),
            end: if widens { end } else { reach },
            center_radius: cutter.center_radius,
            center_height: cutter.center_height,
            corner: cutter.corner_radius,
            bottom: libm::tan(cutter.bottom_angle),
            side: if widens { 1.0 / libm::tan(cutter.taper) } else { f64::INFINITY },
            end_height,
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

    /// The radius that touches a plane of slope `m`, where `q` is √(1 + m²). Where a whole stretch touches, the
    /// smallest.
    pub(super) fn radius_of_slope(&self, m: f64, q: f64) -> f64 {
        if m <= self.bottom {
            0.0
        } else if m < self.side {
            self.center_radius + self.corner * m / q
        } else {
            self.reach
        }
    }

    /// How much lower than the tip a plane of slope `m` that touches the underside crosses the axis, where `q` is
    /// √(1 + m²).
    pub(super) fn lift(&self, m: f64, q: f64) -> f64 {
        if m <= self.bottom {
            0.0
        } else if m < self.side {
            m * self.center_radius + self.corner * q - self.center_height
        } else {
            m * self.reach - self.height(self.reach)
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
    fn lift_is_the_highest_plane_over_the_underside() {
        for cutter in [
            Cutter::flat(10.0, 30.0),
            Cutter::bull_nose(10.0, 2.0, 30.0),
            Cutter::conical(12.0, 0.0, 0.3, 20.0),
            Cutter::new(8.0, 1.0, 0.2, 0.15, 20.0),
        ] {
            let under = Underside::new(&cutter.unwrap());
            for m in [0.0, 0.1, 0.25, 1.0, 3.0, 6.0, 7.0, 50.0_f64] {
                let q = (1.0 + m * m).sqrt();
                let at = under.radius_of_slope(m, q);
                assert!((under.lift(m, q) - (m * at - under.height(at))).abs() < 1e-9);
                for i in 0..=500 {
                    let radius = under.reach() * f64::from(i) / 500.0;
                    assert!(m * radius - under.height(radius) <= under.lift(m, q) + 1e-9);
                }
            }
        }
    }
}
