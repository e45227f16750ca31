//! Sphere, conic and even asphere.

use super::Sag;
use super::root::END;
use crate::turning::height_jet::HeightJet;

/// A surface of revolution about z: `z = c s/(1 + √(1 − (1 + k) c² s)) + A₄ s² + A₆ s³ + …` with `s = ρ²`.
#[derive(Debug, Clone, PartialEq)]
pub struct Conic {
    /// Curvature at the vertex, 1/mm: positive where it bends towards the tool, 0 for a plane.
    curvature: f64,
    /// Conic constant: 0 for a sphere, −1 for a paraboloid.
    conic: f64,
    /// A₄, A₆, …: of ρ⁴, ρ⁶, …, positive upwards.
    even: Vec<f64>,
    /// Beyond this s it goes on linearly in s.
    end: f64,
}

impl Conic {
    /// The surface with curvature (1/mm, positive where hollow), conic constant and even coefficients of ρ⁴, ρ⁶, … (positive
    /// upwards). `extent` is how far out, mm, it is stated: beyond, and beyond where the root ends, it goes on as a paraboloid.
    pub fn new(curvature: f64, conic: f64, even: Vec<f64>, extent: f64) -> Self {
        let q = (1.0 + conic) * curvature * curvature;
        let root = if q > 0.0 { (1.0 - END) / q } else { f64::INFINITY };
        Self { curvature, conic, even, end: root.min(extent * extent) }
    }

    /// z, dz/ds, d²z/ds² at `s`, which is not beyond the end.
    fn along(&self, s: f64) -> [f64; 3] {
        let c = self.curvature;
        let q = (1.0 + self.conic) * c * c;
        let w = (1.0 - q * s).sqrt();
        let mut sum = [c * s / (1.0 + w), 0.5 * c / w, 0.25 * c * q / (w * w * w)];
        let mut power = 1.0;
        for (i, a) in self.even.iter().enumerate() {
            // The term a sⁿ, n = i + 2; `power` is s^(n − 2).
            let n = (i + 2) as f64;
            sum[2] += a * n * (n - 1.0) * power;
            sum[1] += a * n * power * s;
            sum[0] += a * power * s * s;
            power *= s;
        }
        sum
    }
}

impl Sag for Conic {
    fn at(&self, x: f64, y: f64) -> HeightJet {
        let s = HeightJet::distance_squared(x, y);
        if s.z <= self.end {
            return s.map(self.along(s.z));
        }
        let [z, slope, _] = self.along(self.end);
        s.map([z + slope * (s.z - self.end), slope, 0.0])
    }

    fn reaches(&self, x: f64, y: f64) -> bool {
        // A rim that is the extent itself must not fall out by rounding.
        x * x + y * y <= self.end * (1.0 + 1e-9)
    }

    fn reach(&self) -> String {
        format!("this conic reaches to {:.3} mm from its axis", self.end.sqrt())
    }
}
