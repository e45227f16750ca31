//! The cutter's outline in the half plane of radius and height.

use super::Cutter;

impl Cutter {
    /// Radius and height of the corner's lower end, where the bottom line is tangent to it.
    pub fn corner_start(&self) -> (f64, f64) {
        let (s, c) = libm::sincos(self.bottom_angle);
        (self.center_radius + self.corner_radius * s, self.center_height - self.corner_radius * c)
    }

    /// Radius and height of the corner's upper end, where the side line is tangent to it.
    pub fn corner_end(&self) -> (f64, f64) {
        let (s, c) = libm::sincos(self.taper);
        (self.center_radius + self.corner_radius * c, self.center_height - self.corner_radius * s)
    }

    /// Largest radius anywhere below the height `h`.
    pub fn largest_radius(&self) -> f64 {
        let equator = self.center_radius + self.corner_radius;
        if self.taper < 0.0 { equator } else { self.side_radius(self.height) }
    }

    fn side_radius(&self, z: f64) -> f64 {
        let (rho, z0) = self.corner_end();
        rho + (z - z0) * libm::tan(self.taper)
    }

    /// Height of the underside at `radius` from the axis; `None` outside the cutter's shadow. For a side that
    /// narrows upwards the shadow ends at the corner's equator.
    pub fn height_at(&self, radius: f64) -> Option<f64> {
        let (start, _) = self.corner_start();
        let (end, end_height) = self.corner_end();
        let arc = |rho: f64| {
            let x = rho - self.center_radius;
            self.center_height - (self.corner_radius * self.corner_radius - x * x).max(0.0).sqrt()
        };
        if !(0.0..=self.largest_radius() * (1.0 + 1e-12)).contains(&radius) {
            None
        } else if radius <= start {
            Some(radius * libm::tan(self.bottom_angle))
        } else if self.taper <= 0.0 || radius <= end {
            Some(arc(radius))
        } else {
            Some(end_height + (radius - end) / libm::tan(self.taper))
        }
    }

    /// Radius of the outline at height `z` above the tip; `None` below the tip or above the height `h`. On a flat
    /// bottom (`z = 0`) it is the radius where the corner begins.
    pub fn radius_at(&self, z: f64) -> Option<f64> {
        let (start, start_height) = self.corner_start();
        let (_, end_height) = self.corner_end();
        if !(0.0..=self.height).contains(&z) {
            None
        } else if z < start_height {
            Some(z / libm::tan(self.bottom_angle))
        } else if z <= end_height && self.corner_radius > 0.0 {
            let y = self.center_height - z;
            let across = (self.corner_radius * self.corner_radius - y * y).max(0.0).sqrt();
            Some((self.center_radius + across).max(start))
        } else {
            Some(self.side_radius(z))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shapes() -> Vec<Cutter> {
        vec![
            Cutter::flat(10.0, 30.0).unwrap(),
            Cutter::ball(10.0, 30.0).unwrap(),
            Cutter::bull_nose(10.0, 2.0, 30.0).unwrap(),
            Cutter::tapered(4.0, 1.0, 0.1, 25.0).unwrap(),
            Cutter::conical(12.0, 1.5, 0.3, 20.0).unwrap(),
            Cutter::new(8.0, 1.0, 0.2, 0.15, 20.0).unwrap(),
        ]
    }

    #[test]
    fn profile_and_inverse_agree() {
        for cutter in shapes() {
            let (start, _) = cutter.corner_start();
            for i in 1..200 {
                let radius = cutter.largest_radius() * f64::from(i) / 200.0;
                let z = cutter.height_at(radius).unwrap();
                let flat_bottom = radius <= start && cutter.bottom_angle == 0.0;
                if !flat_bottom {
                    let back = cutter.radius_at(z).unwrap();
                    assert!((back - radius).abs() < 1e-9, "{cutter:?} {radius} {z} {back}");
                }
            }
        }
    }

    #[test]
    fn lines_and_corner_are_tangent() {
        for cutter in shapes() {
            let slope = |rho: f64| {
                let d = 1e-6;
                (cutter.height_at(rho + d).unwrap() - cutter.height_at(rho - d).unwrap()) / (2.0 * d)
            };
            let (start, z) = cutter.corner_start();
            assert!((z - start * libm::tan(cutter.bottom_angle)).abs() < 1e-12);
            if cutter.corner_radius > 0.0 {
                assert!((slope(start.max(1e-6)) - libm::tan(cutter.bottom_angle)).abs() < 1e-5);
            }
            // The diameter is measured where bottom and side lines meet.
            let (end, end_height) = cutter.corner_end();
            let half = 0.5 * cutter.diameter;
            let meet = end + (half * libm::tan(cutter.bottom_angle) - end_height) * libm::tan(cutter.taper);
            assert!((meet - half).abs() < 1e-9, "{cutter:?}");
        }
    }

    #[test]
    fn impossible_cutters_name_the_field() {
        assert_eq!(Cutter::flat(0.0, 1.0).unwrap_err().field, "diameter");
        assert_eq!(Cutter::flat(f64::NAN, 1.0).unwrap_err().field, "diameter");
        assert_eq!(Cutter::bull_nose(10.0, 5.1, 30.0).unwrap_err().field, "corner_radius");
        assert_eq!(Cutter::bull_nose(10.0, 2.0, 1.0).unwrap_err().field, "height");
        assert_eq!(Cutter::tapered(10.0, 2.0, 1.6, 30.0).unwrap_err().field, "taper");
        assert_eq!(Cutter::conical(10.0, 2.0, -0.1, 30.0).unwrap_err().field, "bottom_angle");
    }
}
