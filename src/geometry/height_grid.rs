//! Heights over a regular grid, and the smooth surface through them.

use super::{Along, MAX_POINTS, NurbsError, NurbsSurface};
use glam::{DVec2, DVec3};

/// Heights over a regular grid of x and y, millimetres.
#[derive(Debug, Clone, PartialEq)]
pub struct HeightGrid {
    origin: DVec2,
    spacing: DVec2,
    counts: [usize; 2],
    heights: Vec<f64>,
}

/// Why a grid of heights cannot be made into a surface.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum HeightGridError {
    /// Fewer than two places along x or y.
    #[error("a grid of heights needs at least 2 × 2 places, found {} × {}", found[0], found[1])]
    TooSmall {
        /// Places along x and y.
        found: [usize; 2],
    },
    /// Not one height for each place.
    #[error("a grid of {} × {} places needs as many heights, found {found}", counts[0], counts[1])]
    HeightCount {
        /// Places along x and y.
        counts: [usize; 2],
        /// Number of heights given.
        found: usize,
    },
    /// Origin or spacing are not finite, or a spacing is not above 0.
    #[error("origin and spacing must be finite, the spacing above 0")]
    Spacing,
    /// A height is infinite or no number.
    #[error("height ({i}, {j}), counted from 0 along x and y, is not finite")]
    NotFinite {
        /// Number along x.
        i: usize,
        /// Number along y.
        j: usize,
    },
}

impl HeightGrid {
    /// The grid with its first place at `origin`, `counts` places `spacing` apart along x and y, and `heights[i · counts_y + j]`
    /// over place `(i, j)`.
    pub fn new(
        origin: DVec2,
        spacing: DVec2,
        counts: [usize; 2],
        heights: Vec<f64>,
    ) -> Result<Self, HeightGridError> {
        let far = origin + spacing * DVec2::new(counts[0] as f64, counts[1] as f64);
        // A spacing lost in the origin's rounding would leave places on top of one another.
        let distinct = origin.x + spacing.x > origin.x && origin.y + spacing.y > origin.y;
        if !(origin.is_finite() && far.is_finite() && spacing.min_element() > 0.0 && distinct) {
            return Err(HeightGridError::Spacing);
        }
        if counts[0] < 2 || counts[1] < 2 {
            return Err(HeightGridError::TooSmall { found: counts });
        }
        if counts[0].checked_mul(counts[1]) != Some(heights.len()) {
            return Err(HeightGridError::HeightCount { counts, found: heights.len() });
        }
        match heights.iter().position(|h| !h.is_finite()) {
            Some(k) => Err(HeightGridError::NotFinite { i: k / counts[1], j: k % counts[1] }),
            None => Ok(Self { origin, spacing, counts, heights }),
        }
    }

    /// Places along x and y.
    pub fn counts(&self) -> [usize; 2] {
        self.counts
    }

    /// Distance of neighbouring places along x and y, millimetres.
    pub fn spacing(&self) -> DVec2 {
        self.spacing
    }

    /// The bicubic spline through all heights, twice continuously differentiable, whose parameters are x and y in
    /// millimetres and whose front (`du × dv`) is its upper side.
    ///
    /// The ends are not-a-knot, so that polynomials up to degree three in x and in y come back exactly; with two or three
    /// places along a side the degree there is one or two. Fails only for a grid of more than [`MAX_POINTS`] places.
    ///
    /// Source: C. de Boor, A Practical Guide to Splines, rev. ed. 2001, ch. IV and XVII.
    pub fn surface(&self) -> Result<NurbsSurface, NurbsError> {
        let [nx, ny] = self.counts;
        if nx * ny > MAX_POINTS {
            return Err(NurbsError::ManyPoints { found: nx * ny });
        }
        let along_x = Interpolation::uniform(nx);
        let along_y = Interpolation::uniform(ny);
        let mut coefficients = self.heights.clone();
        for row in coefficients.chunks_exact_mut(ny) {
            along_y.solve(row);
        }
        let mut column = vec![0.0; nx];
        for j in 0..ny {
            for (i, c) in column.iter_mut().enumerate() {
                *c = coefficients[i * ny + j];
            }
            along_x.solve(&mut column);
            for (i, c) in column.iter().enumerate() {
                coefficients[i * ny + j] = *c;
            }
        }
        let x = |s: f64| self.origin.x + self.spacing.x * s;
        let y = |s: f64| self.origin.y + self.spacing.y * s;
        let mut points = Vec::with_capacity(nx * ny);
        for i in 0..nx {
            for j in 0..ny {
                let z = coefficients[i * ny + j];
                // Points over the means of their knots reproduce x and y themselves.
                points.push(DVec3::new(x(along_x.greville(i)), y(along_y.greville(j)), z));
            }
        }
        let knots =
            [along_x.knots.iter().map(|&k| x(k)).collect(), along_y.knots.iter().map(|&k| y(k)).collect()];
        let surface = NurbsSurface::new([along_x.degree, along_y.degree], knots, &points, None)?;
        debug_assert_eq!([surface.count(Along::U), surface.count(Along::V)], self.counts);
        Ok(surface)
    }
}

/// Diagonals of the matrix on either side of the main one: place k lies in the support of at most the functions k − 2 to k + 2,
/// reached where not-a-knot ends leave out the second knot.
const BAND: usize = 2;

/// Spline interpolation at 0, 1, …, n − 1, factorised once for many right-hand sides.
struct Interpolation {
    degree: usize,
    knots: Vec<f64>,
    /// `L` below and `U` on and above the diagonal, entry `(k, k + d − BAND)` at `[k][d]`. The matrix is totally positive,
    /// so elimination needs no pivots (de Boor, ch. XIII).
    factors: Vec<[f64; 2 * BAND + 1]>,
}

impl Interpolation {
    fn uniform(n: usize) -> Self {
        let degree = (n - 1).min(3);
        let last = (n - 1) as f64;
        let mut knots = vec![0.0; degree + 1];
        if degree == 3 {
            // Neither the second nor the last but one place is a knot.
            knots.extend((2..n - 2).map(|k| k as f64));
        }
        knots.extend(std::iter::repeat_n(last, degree + 1));
        let mut factors = vec![[0.0; 2 * BAND + 1]; n];
        for (k, row) in factors.iter_mut().enumerate() {
            let at = k as f64;
            let span = super::span(&knots, degree, n, at);
            let basis = super::Basis::<4>::at(&knots, degree, span, at);
            for (r, value) in basis.value.iter().enumerate().filter(|(_, value)| **value != 0.0) {
                let function = span - degree + r;
                row[function + BAND - k] = *value;
            }
        }
        for k in 0..n {
            let (above, below) = factors.split_at_mut(k + 1);
            let pivot = above[k];
            for (distance, row) in (1..=BAND).zip(below) {
                let place = BAND - distance;
                let factor = row[place] / pivot[BAND];
                row[place] = factor;
                for d in 1..=BAND {
                    row[place + d] -= factor * pivot[BAND + d];
                }
            }
        }
        Self { degree, knots, factors }
    }

    /// Replaces the values at the places by the coefficients of the spline through them.
    fn solve(&self, values: &mut [f64]) {
        let n = values.len();
        for k in 0..n {
            for d in 1..=BAND.min(k) {
                values[k] -= self.factors[k][BAND - d] * values[k - d];
            }
        }
        for k in (0..n).rev() {
            for d in 1..=BAND.min(n - 1 - k) {
                values[k] -= self.factors[k][BAND + d] * values[k + d];
            }
            values[k] /= self.factors[k][BAND];
        }
    }

    /// Mean of the inner knots of function `i`.
    fn greville(&self, i: usize) -> f64 {
        self.knots[i + 1..=i + self.degree].iter().sum::<f64>() / self.degree as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Surface, Uv};

    fn grid(counts: [usize; 2], f: impl Fn(f64, f64) -> f64) -> HeightGrid {
        let (origin, spacing) = (DVec2::new(-3.0, 10.0), DVec2::new(0.5, 1.25));
        let at = |i: usize, j: usize| origin + spacing * DVec2::new(i as f64, j as f64);
        let heights = (0..counts[0]).flat_map(|i| (0..counts[1]).map(move |j| at(i, j))).map(|p| f(p.x, p.y));
        HeightGrid::new(origin, spacing, counts, heights.collect()).unwrap()
    }

    #[test]
    fn all_heights_lie_on_the_surface() {
        for counts in [[2, 2], [3, 2], [2, 4], [4, 5], [5, 3], [6, 7], [24, 31]] {
            let rough = |x: f64, y: f64| 100.0 * libm::sin(17.3 * x * x + 31.1 * y);
            let surface = grid(counts, rough).surface().unwrap();
            for i in 0..counts[0] {
                for j in 0..counts[1] {
                    let (x, y) = (-3.0 + 0.5 * i as f64, 10.0 + 1.25 * j as f64);
                    let p = surface.point(Uv::new(x, y));
                    let error = p.distance(DVec3::new(x, y, rough(x, y)));
                    assert!(error < 1e-11 * 100.0, "{counts:?} ({i}, {j}): {error:e}");
                }
            }
        }
    }

    #[test]
    fn cubic_polynomials_come_back_exactly() {
        let f =
            |x: f64, y: f64| 2.0 - x + 0.3 * x * x * y - 0.07 * x * x * x + 0.02 * y * y * y * x - 0.5 * y;
        let surface = grid([9, 8], f).surface().unwrap();
        for k in 0..50 {
            let (x, y) = (-3.0 + 4.0 * k as f64 / 49.0, 10.0 + 8.75 * ((k * 7) % 50) as f64 / 49.0);
            let jet = surface.jet(Uv::new(x, y));
            assert!(jet.p.distance(DVec3::new(x, y, f(x, y))) < 1e-10);
            assert!(
                (jet.du - DVec3::new(1.0, 0.0, -1.0 + 0.6 * x * y - 0.21 * x * x + 0.02 * y * y * y))
                    .length()
                    < 1e-9
            );
            assert!((jet.duv.z - (0.6 * x + 0.06 * y * y)).abs() < 1e-9);
            assert!((jet.dvv - DVec3::Z * (0.12 * y * x)).length() < 1e-9);
            assert!(jet.normal().unwrap().z > 0.0);
        }
    }

    #[test]
    fn what_is_wrong_is_named() {
        let new =
            |spacing, counts, heights| HeightGrid::new(DVec2::ZERO, DVec2::splat(spacing), counts, heights);
        assert_eq!(new(0.0, [2, 2], vec![0.0; 4]), Err(HeightGridError::Spacing));
        assert_eq!(new(1.0, [1, 4], vec![0.0; 4]), Err(HeightGridError::TooSmall { found: [1, 4] }));
        assert_eq!(
            new(1.0, [2, 3], vec![0.0; 4]),
            Err(HeightGridError::HeightCount { counts: [2, 3], found: 4 })
        );
        assert_eq!(
            new(1.0, [2, 2], vec![0.0, 0.0, f64::NAN, 0.0]),
            Err(HeightGridError::NotFinite { i: 1, j: 0 })
        );
    }
}
