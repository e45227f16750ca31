//! Where a surface is sampled.

use crate::geometry::{Face, TriMesh, Uv};
use glam::DVec3;

/// A point of the surface and the unit normal out of the material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// The point, millimetres.
    pub point: DVec3,
    /// Outward normal; zero where the surface has none, and such a sample is never cut.
    pub normal: DVec3,
}

/// The parameters of a face's samples: sample `i + j·u.len()` lies at `(u[i], v[j])`.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// First parameters, rising, both ends of the domain included.
    pub u: Vec<f64>,
    /// Second parameters, rising, both ends of the domain included.
    pub v: Vec<f64>,
}

/// Samples of a surface with the triangles between them; borders and rims carry samples like the inside.
#[derive(Debug, Clone)]
pub struct Samples {
    /// Points and normals.
    pub samples: Vec<Sample>,
    /// The area each sample stands for, mm²: a third of the triangles around it.
    pub areas: Vec<f64>,
    /// Samples' numbers, three a triangle, covering the surface.
    pub triangles: Vec<[u32; 3]>,
    /// The parameter grid of a face; `None` for a mesh.
    pub grid: Option<Grid>,
    pub(super) face: Option<Face>,
}

/// Why a surface cannot be sampled.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SampleError {
    /// The spacing is not a positive length.
    #[error("spacing: must be above 0 mm")]
    Spacing,
    /// There would be too many samples.
    #[error("spacing: would give more than {limit} samples; {coarser:.4} mm would do")]
    TooMany {
        /// The most there may be.
        limit: usize,
        /// A spacing that gives about as many.
        coarser: f64,
    },
}

/// Most samples: they take about 150 bytes each.
const MOST: usize = 20_000_000;
/// Points along each parameter at which a face's speed is looked up.
const LOOKS: usize = 65;

impl Samples {
    /// Samples of `face` on a grid of parameters whose lines are at most `spacing` (mm) apart in space, spread so that
    /// they are about evenly apart even where the parameters are not. Where two samples turned out further apart (the
    /// surface is faster between the 65 × 65 points looked at), the grid is made finer and tried again, up to three times.
    pub fn of_face(face: &Face, spacing: f64) -> Result<Self, SampleError> {
        if !(spacing > 0.0 && spacing.is_finite()) {
            return Err(SampleError::Spacing);
        }
        let mut wanted = [spacing; 2];
        for _ in 0..3 {
            let samples = Self::on_grid(face, speeds(face, wanted, spacing)?);
            let Some(grid) = &samples.grid else { return Ok(samples) };
            let widest = samples.widest(grid);
            // Rounding alone must not make a grid finer.
            if widest.iter().all(|w| *w <= spacing * (1.0 + 1e-9)) {
                return Ok(samples);
            }
            wanted = std::array::from_fn(|i| wanted[i] * (0.98 * spacing / widest[i]).min(1.0));
        }
        Ok(Self::on_grid(face, speeds(face, wanted, spacing)?))
    }

    fn on_grid(face: &Face, grid: Grid) -> Self {
        let sample = |uv: Uv| match face.at(uv) {
            Some((jet, normal)) => Sample { point: jet.p, normal },
            None => Sample { point: face.jet(uv).p, normal: DVec3::ZERO },
        };
        let samples =
            grid.v.iter().flat_map(|&v| grid.u.iter().map(move |&u| sample(Uv::new(u, v)))).collect();
        let (nu, nv) = (grid.u.len() as u32, grid.v.len() as u32);
        let quad = |i: u32, j: u32| {
            let a = i + j * nu;
            [[a, a + 1, a + 1 + nu], [a, a + 1 + nu, a + nu]]
        };
        let triangles = (0..nv - 1).flat_map(|j| (0..nu - 1).flat_map(move |i| quad(i, j))).collect();
        Self { samples, areas: Vec::new(), triangles, grid: Some(grid), face: Some(face.clone()) }.weighed()
    }

    /// Samples of `mesh`: each triangle by itself, on a regular lattice whose neighbours are at most `spacing` (mm) apart,
    /// with the triangle's own normal. Points on a shared edge come once for each of its triangles.
    pub fn of_mesh(mesh: &TriMesh, spacing: f64) -> Result<Self, SampleError> {
        if !(spacing > 0.0 && spacing.is_finite()) {
            return Err(SampleError::Spacing);
        }
        let parts = |i: usize| {
            let [a, b, c] = mesh.corners(i);
            (a.distance(b).max(b.distance(c)).max(c.distance(a)) / spacing).ceil().max(1.0)
        };
        let cut: Vec<usize> = (0..mesh.triangles.len()).filter(|i| mesh.normal(*i).is_some()).collect();
        let count: f64 = cut.iter().map(|&i| 0.5 * (parts(i) + 1.0) * (parts(i) + 2.0)).sum();
        check_count(count, spacing)?;
        let mut all =
            Self { samples: Vec::new(), areas: Vec::new(), triangles: Vec::new(), grid: None, face: None };
        for i in cut {
            let [a, b, c] = mesh.corners(i);
            all.add_lattice(a, b, c, mesh.normal(i).unwrap_or(DVec3::ZERO), parts(i) as u32);
        }
        Ok(all.weighed())
    }

    fn add_lattice(&mut self, a: DVec3, b: DVec3, c: DVec3, normal: DVec3, parts: u32) {
        let base = self.samples.len() as u32;
        // Row j holds parts + 1 − j points.
        let row = |j: u32| base + j * (2 * parts + 3 - j) / 2;
        for j in 0..=parts {
            for i in 0..=parts - j {
                let (s, t) = (f64::from(i) / f64::from(parts), f64::from(j) / f64::from(parts));
                self.samples.push(Sample { point: a * (1.0 - s - t) + b * s + c * t, normal });
                if i + j < parts {
                    self.triangles.push([row(j) + i, row(j) + i + 1, row(j + 1) + i]);
                }
                if i + j + 1 < parts {
                    self.triangles.push([row(j) + i + 1, row(j + 1) + i + 1, row(j + 1) + i]);
                }
            }
        }
    }

    fn weighed(mut self) -> Self {
        self.areas = vec![0.0; self.samples.len()];
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|i| self.samples[i as usize].point);
            let third = (b - a).cross(c - a).length() / 6.0;
            triangle.iter().for_each(|&i| self.areas[i as usize] += third);
        }
        self
    }

    /// Largest distances between neighbours along u and along v.
    fn widest(&self, grid: &Grid) -> [f64; 2] {
        let nu = grid.u.len();
        let apart = |i: usize, j: usize| self.samples[i].point.distance(self.samples[j].point);
        let count = self.samples.len();
        let along_u = (0..count).filter(|i| (i + 1) % nu != 0).map(|i| apart(i, i + 1)).fold(0.0, f64::max);
        let along_v = (0..count - nu).map(|i| apart(i, i + nu)).fold(0.0, f64::max);
        [along_u, along_v]
    }

    /// Sum of the samples' areas, mm².
    pub fn area(&self) -> f64 {
        self.areas.iter().sum()
    }

    /// The parameters of a face's samples, in their order.
    pub(super) fn parameters(&self) -> Option<Vec<Uv>> {
        let grid = self.grid.as_ref()?;
        Some(grid.v.iter().flat_map(|&v| grid.u.iter().map(move |&u| Uv::new(u, v))).collect())
    }
}

fn check_count(count: f64, spacing: f64) -> Result<(), SampleError> {
    if count > MOST as f64 {
        return Err(SampleError::TooMany {
            limit: MOST,
            coarser: 1.05 * spacing * (count / MOST as f64).sqrt(),
        });
    }
    Ok(())
}

/// The grid whose lines are `wanted` apart where the surface is fastest along them.
fn speeds(face: &Face, wanted: [f64; 2], spacing: f64) -> Result<Grid, SampleError> {
    let domain = face.domain();
    let at = |i: usize| i as f64 / (LOOKS - 1) as f64;
    let mut fastest = [[0.0_f64; LOOKS]; 2];
    for i in 0..LOOKS {
        for j in 0..LOOKS {
            let (e, _, g) = face.jet(domain.at(at(i), at(j))).first_form();
            fastest[0][i] = fastest[0][i].max(e.sqrt() * domain.u.length());
            fastest[1][j] = fastest[1][j].max(g.sqrt() * domain.v.length());
        }
    }
    let counts = [0, 1].map(|k| (length(&fastest[k]) / wanted[k]).ceil().max(1.0));
    check_count((counts[0] + 1.0) * (counts[1] + 1.0), spacing)?;
    let [u, v] = [0, 1].map(|k| even(&fastest[k], counts[k] as usize));
    let held = |t: Vec<f64>, range: crate::geometry::Range| t.into_iter().map(|t| range.at(t)).collect();
    Ok(Grid { u: held(u, domain.u), v: held(v, domain.v) })
}

/// Integral of a speed given at even steps over [0, 1].
fn length(speed: &[f64]) -> f64 {
    speed.windows(2).map(|w| 0.5 * (w[0] + w[1])).sum::<f64>() / (speed.len() - 1) as f64
}

/// `count + 1` fractions from 0 to 1 between which the integral of `speed` is the same.
fn even(speed: &[f64], count: usize) -> Vec<f64> {
    let steps = (speed.len() - 1) as f64;
    let total = length(speed);
    let mut fractions = Vec::with_capacity(count + 1);
    let (mut step, mut before) = (0, 0.0);
    for k in 0..=count {
        let target = total * k as f64 / count as f64;
        let piece = |step: usize| 0.5 * (speed[step] + speed[step + 1]) / steps;
        while step + 2 < speed.len() && before + piece(step) < target {
            before += piece(step);
            step += 1;
        }
        let share = if piece(step) > 0.0 { ((target - before) / piece(step)).clamp(0.0, 1.0) } else { 0.0 };
        fractions.push((step as f64 + share) / steps);
    }
    fractions[0] = 0.0;
    fractions[count] = 1.0;
    fractions
}
