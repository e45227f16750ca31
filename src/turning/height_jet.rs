//! A height over the plane with its first and second derivatives, and the arithmetic that carries them along.

use std::ops::{Add, Mul, Neg, Sub};

/// A height with its derivatives along x and y.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct HeightJet {
    /// Height.
    pub z: f64,
    /// First derivatives along x and y.
    pub g: [f64; 2],
    /// Second derivatives xx, xy, yy.
    pub h: [f64; 3],
}

/// A height with its derivatives along the radius ρ and the angle θ (radians).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PolarJet {
    /// Height.
    pub z: f64,
    /// Derivative along ρ.
    pub r: f64,
    /// Derivative along θ.
    pub t: f64,
    /// Second derivatives ρρ, ρθ, θθ.
    pub rr: f64,
    /// ρθ.
    pub rt: f64,
    /// θθ.
    pub tt: f64,
}

impl HeightJet {
    /// The same height everywhere.
    pub fn constant(z: f64) -> Self {
        Self { z, ..Self::default() }
    }

    /// The square of the distance from the z axis.
    pub fn distance_squared(x: f64, y: f64) -> Self {
        Self { z: x * x + y * y, g: [2.0 * x, 2.0 * y], h: [2.0, 0.0, 2.0] }
    }

    /// `f` of this height, given `f`, `f′` and `f″` at it.
    #[must_use]
    pub fn map(self, [f, f1, f2]: [f64; 3]) -> Self {
        let [x, y] = self.g;
        let [xx, xy, yy] = self.h;
        Self {
            z: f,
            g: [f1 * x, f1 * y],
            h: [f1 * xx + f2 * x * x, f1 * xy + f2 * x * y, f1 * yy + f2 * y * y],
        }
    }

    /// `√(1 + |∇z|²)`: what a unit normal `(−∇z, 1)` is divided by.
    pub fn stretch(&self) -> f64 {
        (1.0 + self.g[0] * self.g[0] + self.g[1] * self.g[1]).sqrt()
    }

    /// The largest curvature over all directions, 1/mm, positive where the surface is hollow.
    pub fn largest_curvature(&self) -> f64 {
        let w = self.stretch();
        let [gx, gy] = self.g;
        let [xx, xy, yy] = self.h.map(|h| h / w);
        // Eigenvalues of second over first fundamental form.
        let (e, f, g) = (1.0 + gx * gx, gx * gy, 1.0 + gy * gy);
        let mean = (xx * g - 2.0 * xy * f + yy * e) / (2.0 * w * w);
        let gauss = (xx * yy - xy * xy) / (w * w);
        mean + (mean * mean - gauss).max(0.0).sqrt()
    }

    /// The jet in polar coordinates about the z axis, at radius `rho` (which may be negative) in the direction `(cos, sin)`.
    pub fn polar(&self, rho: f64, cos: f64, sin: f64) -> PolarJet {
        let [gx, gy] = self.g;
        let [xx, xy, yy] = self.h;
        let (along, across) = (gx * cos + gy * sin, gy * cos - gx * sin);
        let e = |ax: f64, ay: f64, bx: f64, by: f64| ax * (xx * bx + xy * by) + ay * (xy * bx + yy * by);
        PolarJet {
            z: self.z,
            r: along,
            t: rho * across,
            rr: e(cos, sin, cos, sin),
            rt: across + rho * e(cos, sin, -sin, cos),
            tt: rho * (rho * e(-sin, cos, -sin, cos) - along),
        }
    }
}

impl Add for HeightJet {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self {
            z: self.z + o.z,
            g: [self.g[0] + o.g[0], self.g[1] + o.g[1]],
            h: [self.h[0] + o.h[0], self.h[1] + o.h[1], self.h[2] + o.h[2]],
        }
    }
}

impl Neg for HeightJet {
    type Output = Self;
    fn neg(self) -> Self {
        self * -1.0
    }
}

impl Sub for HeightJet {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        self + -o
    }
}

impl Mul<f64> for HeightJet {
    type Output = Self;
    fn mul(self, k: f64) -> Self {
        Self { z: k * self.z, g: self.g.map(|g| k * g), h: self.h.map(|h| k * h) }
    }
}

impl Mul for HeightJet {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        let ([ax, ay], [bx, by]) = (self.g, o.g);
        let second = |a: f64, b: f64, cross: f64| a * o.z + b * self.z + cross;
        Self {
            z: self.z * o.z,
            g: [ax * o.z + self.z * bx, ay * o.z + self.z * by],
            h: [
                second(self.h[0], o.h[0], 2.0 * ax * bx),
                second(self.h[1], o.h[1], ax * by + ay * bx),
                second(self.h[2], o.h[2], 2.0 * ay * by),
            ],
        }
    }
}
