//! Where the axes are between two points of the text.

use crate::toolpath::{AxisPoint, Interpolation};

/// One move: X, Z and C as cubics in its share `u` from 0 to 1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Move {
    /// Coefficients of 1, u, u², u³ for X, Z and C.
    poly: [[f64; 4]; 3],
}

impl Move {
    pub(super) fn new(a: &AxisPoint, b: &AxisPoint, interpolation: Interpolation) -> Self {
        let ends = [[a.x, b.x], [a.z, b.z], [a.c, b.c]];
        let time = b.time - a.time;
        let mut poly = [[0.0; 4]; 3];
        for axis in 0..3 {
            let [p, q] = ends[axis];
            poly[axis] = match interpolation {
                Interpolation::Linear => [p, q - p, 0.0, 0.0],
                Interpolation::Pvt => {
                    let (v, w) = (a.rates[axis] * time, b.rates[axis] * time);
                    [p, v, 3.0 * (q - p) - 2.0 * v - w, 2.0 * (p - q) + v + w]
                }
            };
        }
        Self { poly }
    }

    /// X, Z and C at the share `u`.
    pub(super) fn at(&self, u: f64) -> [f64; 3] {
        self.poly.map(|[a, b, c, d]| a + u * (b + u * (c + u * d)))
    }

    fn first(&self, u: f64) -> [f64; 3] {
        self.poly.map(|[_, b, c, d]| b + u * (2.0 * c + 3.0 * u * d))
    }

    fn second(&self, u: f64) -> [f64; 3] {
        self.poly.map(|[_, _, c, d]| 2.0 * c + 6.0 * u * d)
    }

    /// The place of the nose centre over the part at the share `u`, with its first and second derivatives along `u`.
    pub(super) fn place(&self, u: f64) -> [[f64; 3]; 3] {
        let ([x, z, c], [x1, z1, c1], [x2, z2, c2]) = (self.at(u), self.first(u), self.second(u));
        let (sin, cos) = libm::sincos(c);
        let (out, around) = (x2 - x * c1 * c1, 2.0 * x1 * c1 + x * c2);
        [
            [x * cos, x * sin, z],
            [x1 * cos - x * c1 * sin, x1 * sin + x * c1 * cos, z1],
            [out * cos - around * sin, out * sin + around * cos, z2],
        ]
    }

    /// How far the nose centre is at most from the straight line between the move's ends, mm: an eighth of the largest second
    /// derivative, which is no larger than what its parts reach at either end or, for the cubic's bend, between them.
    pub(super) fn bulge(&self) -> f64 {
        let most = |f: fn(&Self, f64) -> [f64; 3], axis: usize| {
            f(self, 0.0)[axis].abs().max(f(self, 1.0)[axis].abs()).max(f(self, 0.5)[axis].abs())
        };
        let [x, _, _] = [0, 1, 2].map(|axis| most(Self::at, axis));
        let [x1, _, c1] = [0, 1, 2].map(|axis| most(Self::first, axis));
        let [x2, z2, c2] = [0, 1, 2].map(|axis| most(Self::second, axis));
        let flat = x2 + x * c1 * c1 + 2.0 * x1 * c1 + x * c2;
        libm::hypot(flat, z2) / 8.0
    }

    /// X and Z when C is `c`, which must lie between the C of both ends.
    pub(super) fn at_angle(&self, c: f64) -> [f64; 2] {
        let [a, b, c2, c3] = self.poly[2];
        let whole = b + c2 + c3;
        let mut u = if whole != 0.0 { ((c - a) / whole).clamp(0.0, 1.0) } else { 0.0 };
        if c2 != 0.0 || c3 != 0.0 {
            // C is near to linear in time: Newton from there doubles its digits with each step.
            for _ in 0..6 {
                let slope = b + u * (2.0 * c2 + 3.0 * u * c3);
                if slope == 0.0 {
                    break;
                }
                u = (u - (a + u * (b + u * (c2 + u * c3)) - c) / slope).clamp(0.0, 1.0);
            }
        }
        let [x, z, _] = self.at(u);
        [x, z]
    }
}
