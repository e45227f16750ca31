//! A sag map on a regular grid, as a bicubic B-spline.

use super::Sag;
use crate::turning::height_jet::HeightJet;

/// What the numbers of a grid are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stated {
    /// Heights that the surface goes through.
    Heights,
    /// Coefficients (control heights) of the uniform cubic B-spline; the outermost ring lies one spacing outside the surface.
    Coefficients,
}

/// Why a grid cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GridError {
    /// The count of numbers is no whole number of rows, or there are too few.
    #[error("{count} numbers in rows of {columns} are no grid: at least 5 rows and 5 columns are needed")]
    Shape {
        /// Numbers given.
        count: usize,
        /// Numbers in a row.
        columns: usize,
    },
    /// A number is not finite.
    #[error("number {index} in row {row} is not finite")]
    NotFinite {
        /// Counted from 1 within the row.
        index: usize,
        /// Counted from 1.
        row: usize,
    },
    /// A spacing is not above 0.
    #[error("both spacings must be above 0 mm")]
    Spacing,
}

/// A height map centred on the origin; rows run along x, the first row at the lowest y. C² inside; beyond the border it goes
/// on linearly across it.
#[derive(Debug, Clone, PartialEq)]
pub struct GridMap {
    /// Coefficients along x and y, one ring more than heights.
    counts: [usize; 2],
    spacing: [f64; 2],
    coefficients: Vec<f64>,
}

impl GridMap {
    /// The surface of `numbers`, in rows of `columns`, `spacing` mm apart along x and y.
    ///
    /// Heights are interpolated; slopes at the border are those of the quartic through the five heights next to it, so the error
    /// is of the order of the fourth power of the spacing up to the border.
    pub fn new(
        stated: Stated,
        numbers: &[f64],
        columns: usize,
        spacing: [f64; 2],
    ) -> Result<Self, GridError> {
        let rows = numbers.len().checked_div(columns).unwrap_or(0);
        if rows < 5 || columns < 5 || rows * columns != numbers.len() {
            return Err(GridError::Shape { count: numbers.len(), columns });
        }
        if let Some(at) = numbers.iter().position(|z| !z.is_finite()) {
            return Err(GridError::NotFinite { index: at % columns + 1, row: at / columns + 1 });
        }
        if !spacing.iter().all(|s| *s > 0.0 && s.is_finite()) {
            return Err(GridError::Spacing);
        }
        if stated == Stated::Coefficients {
            return Ok(Self { counts: [columns, rows], spacing, coefficients: numbers.to_vec() });
        }
        let wide = columns + 2;
        let along: Vec<f64> = numbers.chunks_exact(columns).flat_map(coefficients).collect();
        let mut all = vec![0.0; wide * (rows + 2)];
        for i in 0..wide {
            let column: Vec<f64> = (0..rows).map(|j| along[j * wide + i]).collect();
            for (j, c) in coefficients(&column).into_iter().enumerate() {
                all[j * wide + i] = c;
            }
        }
        Ok(Self { counts: [wide, rows + 2], spacing, coefficients: all })
    }

    /// Half of the size along x and y.
    fn half(&self, axis: usize) -> f64 {
        0.5 * (self.counts[axis] - 3) as f64 * self.spacing[axis]
    }

    /// The first of four coefficients that count at `x`, their weights and these' derivatives.
    fn weights(&self, axis: usize, x: f64) -> (usize, [[f64; 4]; 3]) {
        let half = self.half(axis);
        let inside = x.clamp(-half, half);
        let s = (inside + half) / self.spacing[axis];
        let first = (s.floor() as usize).min(self.counts[axis] - 4);
        let t = s - first as f64;
        let u = 1.0 - t;
        let k = 1.0 / self.spacing[axis];
        let mut w =
            [u * u * u, 3.0 * t * t * t - 6.0 * t * t + 4.0, 3.0 * u * u * u - 6.0 * u * u + 4.0, t * t * t]
                .map(|w| w / 6.0);
        let w1 = [-u * u, 3.0 * t * t - 4.0 * t, -3.0 * u * u + 4.0 * u, t * t].map(|w| 0.5 * k * w);
        let mut w2 = [u, 3.0 * t - 2.0, 3.0 * u - 2.0, t].map(|w| k * k * w);
        let beyond = x - inside;
        if beyond != 0.0 {
            for i in 0..4 {
                w[i] += w1[i] * beyond;
            }
            w2 = [0.0; 4];
        }
        (first, [w, w1, w2])
    }
}

impl Sag for GridMap {
    fn at(&self, x: f64, y: f64) -> HeightJet {
        let (i, [a, a1, a2]) = self.weights(0, x);
        let (j, [b, b1, b2]) = self.weights(1, y);
        let mut sum = HeightJet::default();
        for row in 0..4 {
            let start = (j + row) * self.counts[0] + i;
            let four = &self.coefficients[start..start + 4];
            let dot = |w: &[f64; 4]| four.iter().zip(w).map(|(c, w)| c * w).sum::<f64>();
            let (z, z1, z2) = (dot(&a), dot(&a1), dot(&a2));
            sum.z += b[row] * z;
            sum.g[0] += b[row] * z1;
            sum.g[1] += b1[row] * z;
            sum.h[0] += b[row] * z2;
            sum.h[1] += b1[row] * z1;
            sum.h[2] += b2[row] * z;
        }
        sum
    }

    fn reaches(&self, x: f64, y: f64) -> bool {
        let slack = 1e-9;
        x.abs() <= self.half(0) + slack && y.abs() <= self.half(1) + slack
    }

    fn reach(&self) -> String {
        format!("this map reaches to |x| = {:.3} mm and |y| = {:.3} mm", self.half(0), self.half(1))
    }
}

/// The coefficients of the uniform cubic B-spline through `f`, two more than heights.
fn coefficients(f: &[f64]) -> Vec<f64> {
    let n = f.len();
    let edge = |at: [f64; 5]| -> f64 {
        [-25.0, 48.0, -36.0, 16.0, -3.0].iter().zip(at).map(|(w, z)| w * z).sum::<f64>() / 12.0
    };
    let low = edge([f[0], f[1], f[2], f[3], f[4]]);
    let high = -edge([f[n - 1], f[n - 2], f[n - 3], f[n - 4], f[n - 5]]);
    // c[i−1] + 4 c[i] + c[i+1] = 6 f[i]; the slopes at both ends do away with the outermost two.
    let mut right: Vec<f64> = f.iter().map(|z| 6.0 * z).collect();
    right[0] += 2.0 * low;
    right[n - 1] -= 2.0 * high;
    let mut upper = vec![0.0; n];
    for i in 0..n {
        let above = if i == 0 { 2.0 } else { 1.0 };
        let below = if i == n - 1 { 2.0 } else { 1.0 };
        let (before, z) = if i == 0 { (0.0, 0.0) } else { (upper[i - 1], right[i - 1]) };
        let pivot = 4.0 - below * before * f64::from(u8::from(i > 0));
        right[i] = (right[i] - if i > 0 { below * z } else { 0.0 }) / pivot;
        upper[i] = above / pivot;
    }
    for i in (0..n - 1).rev() {
        right[i] -= upper[i] * right[i + 1];
    }
    let mut all = Vec::with_capacity(n + 2);
    all.push(right[1] - 2.0 * low);
    all.extend_from_slice(&right);
    all.push(right[n - 2] + 2.0 * high);
    all
}
