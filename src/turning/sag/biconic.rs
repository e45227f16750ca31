//! Biconic: two conics, one along x and one along y.

use super::Sag;
use super::root::{END, root_fade};
use crate::turning::height_jet::HeightJet;

/// `z = (cₓ x² + c_y y²)/(1 + √(1 − (1 + kₓ) cₓ² x² − (1 + k_y) c_y² y²))`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Biconic {
    /// Curvatures along x and y at the vertex, 1/mm, positive where hollow.
    pub curvature: [f64; 2],
    /// Conic constants along x and y.
    pub conic: [f64; 2],
}

impl Biconic {
    fn factors(&self) -> [f64; 2] {
        [0, 1].map(|i| (1.0 + self.conic[i]) * self.curvature[i] * self.curvature[i])
    }

    fn under(&self, x: f64, y: f64) -> HeightJet {
        let [qx, qy] = self.factors();
        HeightJet {
            z: 1.0 - qx * x * x - qy * y * y,
            g: [-2.0 * qx * x, -2.0 * qy * y],
            h: [-2.0 * qx, 0.0, -2.0 * qy],
        }
    }
}

impl Sag for Biconic {
    fn at(&self, x: f64, y: f64) -> HeightJet {
        let [cx, cy] = self.curvature;
        let top = HeightJet {
            z: cx * x * x + cy * y * y,
            g: [2.0 * cx * x, 2.0 * cy * y],
            h: [2.0 * cx, 0.0, 2.0 * cy],
        };
        let under = self.under(x, y);
        let bottom = HeightJet::constant(1.0) + under.map(root_fade(under.z, END));
        let b = bottom.z;
        top * bottom.map([1.0 / b, -1.0 / (b * b), 2.0 / (b * b * b)])
    }

    fn reaches(&self, x: f64, y: f64) -> bool {
        self.under(x, y).z >= END
    }

    fn reach(&self) -> String {
        let far = |q: f64| if q > 0.0 { format!("{:.3} mm", ((1.0 - END) / q).sqrt()) } else { "any".into() };
        let [qx, qy] = self.factors();
        format!("this biconic reaches to |x| = {} and |y| = {}", far(qx), far(qy))
    }
}
