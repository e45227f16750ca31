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
        let samples: Vec<Sample> =
            grid.v.iter().flat_map(|&v| grid.u.iter().map(move |&u| sample(Uv::new(u, v)))).collect();
        let (nu, nv) = (grid.u.len() as u32, grid.v.len() as u32);
        let quad = |i: u32, j: u32| {
            let a = i + j * nu;
            let (b, c, d) = (a + 1, a + 1 + nu, a + nu);
            let apart = |i: u32, j: u32| samples[i as usize].point.distance(samples[j as usize].point);
            // Along the shorter diagonal: where the parameters are skew, the other one makes slivers. Rounding decides nothing.
            if apart(b, d) < (1.0 - 1e-9) * apart(a, c) {
                [[a, b, d], [b, c, d]]
            } else {
                [[a, b, c], [a, c, d]]
            }
        };
        let numbers = (0..nv - 1).flat_map(|j| (0..nu - 1).map(move |i| (i, j)));
        let triangles = numbers.flat_map(|(i, j)| quad(i, j)).collect();
        Self { samples, areas: Vec::new(), triangles, grid: Some(grid), face: Some(face.clone()) }.weighed()
    }

    /// Samples of `mesh`: each triangle by itself, with its own normal, in columns square to its longest side; columns, and
    /// samples in a column, are at most `spacing` (mm) apart, so that needles do not have as many rows as columns. Points
    /// on a shared edge come once for each of its triangles.
    pub fn of_mesh(mesh: &TriMesh, spacing: f64) -> Result<Self, SampleError> {
        if !(spacing > 0.0 && spacing.is_finite()) {
            return Err(SampleError::Spacing);
        }
        let facets: Vec<[DVec3; 3]> = (0..mesh.triangles.len()).map(|i| mesh.corners(i)).collect();
        let sampled = || facets.iter().enumerate().filter_map(|(i, f)| Some((*f, mesh.normal(i)?)));
        // The longest sides bound the work of counting.
        let longest = |[a, b, c]: [DVec3; 3]| a.distance(b).max(b.distance(c)).max(c.distance(a));
        check_count(sampled().map(|(facet, _)| longest(facet) / spacing).sum(), spacing)?;
        let count = |facet| columns(facet, spacing).map(|c| f64::from(c.parts) + 1.0).sum::<f64>();
        check_count(sampled().map(|(facet, _)| count(facet)).sum(), spacing)?;
        let mut all =
            Self { samples: Vec::new(), areas: Vec::new(), triangles: Vec::new(), grid: None, face: None };
        sampled().for_each(|(facet, normal)| all.add_columns(facet, normal, spacing));
        Ok(all.weighed())
    }

    fn add_columns(&mut self, facet: [DVec3; 3], normal: DVec3, spacing: f64) {
        let mut left: Option<(Column, u32)> = None;
        for column in columns(facet, spacing) {
            let first = self.samples.len() as u32;
            let point = |k| column.foot.lerp(column.top, f64::from(k) / f64::from(column.parts.max(1)));
            self.samples.extend((0..=column.parts).map(|k| Sample { point: point(k), normal }));
            if let Some((before, begin)) = left {
                self.join((begin, before.parts), (first, column.parts));
            }
            left = Some((column, first));
        }
    }

    /// Triangles between two columns, each given by its first sample and its parts, upwards on whichever side is lower.
    fn join(&mut self, (left, m): (u32, u32), (right, n): (u32, u32)) {
        let (mut i, mut j) = (0, 0);
        while i < m || j < n {
            let (a, b) = (left + i, right + j);
            // The next of either side, as parts of the way up.
            let left_next =
                j == n || (i < m && u64::from(i + 1) * u64::from(n) <= u64::from(j + 1) * u64::from(m));
            self.triangles.push(if left_next { [a, b, a + 1] } else { [a, b, b + 1] });
            if left_next { i += 1 } else { j += 1 }
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

/// Samples across a triangle.
#[derive(Clone, Copy)]
struct Column {
    foot: DVec3,
    top: DVec3,
    parts: u32,
}

/// The columns of a triangle from one end of its longest side to the other, one of them through its third corner.
fn columns([a, b, c]: [DVec3; 3], spacing: f64) -> impl Iterator<Item = Column> {
    let sides = [a.distance(b), b.distance(c), c.distance(a)];
    let longest = sides[0].max(sides[1]).max(sides[2]);
    let [a, b, c] = match sides.iter().position(|side| *side == longest) {
        Some(1) => [b, c, a],
        Some(2) => [c, a, b],
        _ => [a, b, c],
    };
    // The third corner's foot, as a part of the longest side. A triangle with no need of columns is left whole.
    let whole = longest <= spacing;
    let under = if whole { 0.0 } else { ((c - a).dot(b - a) / (longest * longest)).clamp(0.0, 1.0) };
    // Where a side is steep over the longest one, columns stand closer, so that its triangles do not become needles.
    let height = if whole { 0.0 } else { c.distance(a.lerp(b, under)) };
    let count = |share: f64| ((share * longest).max(0.5 * height) / spacing).ceil() as u32;
    let (before, after) = (count(under), count(1.0 - under));
    let column = move |share: f64, top: DVec3| {
        let foot = a.lerp(b, share);
        Column { foot, top, parts: (foot.distance(top) / spacing).ceil() as u32 }
    };
    let rising = (0..before).map(move |k| f64::from(k) / f64::from(before));
    let falling = (1..=after).map(move |k| f64::from(k) / f64::from(after));
    rising
        .map(move |t| column(under * t, a.lerp(c, t)))
        .chain(std::iter::once(column(under, c)))
        .chain(falling.map(move |t| column(under + (1.0 - under) * t, c.lerp(b, t))))
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn facet(corners: [DVec3; 3]) -> TriMesh {
        TriMesh { vertices: corners.to_vec(), triangles: vec![[0, 1, 2]] }
    }

    proptest! {
        #[test]
        fn samples_of_a_facet_are_nowhere_far_and_stand_for_its_area(
            c in proptest::array::uniform9(-1.0..1.0f64),
            flat in 0.001..1.0f64,
            spacing in 0.05..0.8f64,
            spots in proptest::collection::vec((0.0..1.0f64, 0.0..1.0f64), 8),
        ) {
            let corners = [0, 3, 6].map(|i| DVec3::new(c[i], flat * c[i + 1], c[i + 2]));
            let mesh = facet(corners);
            let (Some(_), area) = (mesh.normal(0), mesh.area(0)) else { return Ok(()) };
            let samples = Samples::of_mesh(&mesh, spacing).unwrap();
            prop_assert!((samples.area() - area).abs() <= 1e-12);
            for corner in corners {
                prop_assert!(samples.samples.iter().any(|s| s.point.distance(corner) <= 1e-12));
            }
            for (s, t) in spots {
                let (s, t) = if s + t > 1.0 { (1.0 - s, 1.0 - t) } else { (s, t) };
                let p = corners[0] + s * (corners[1] - corners[0]) + t * (corners[2] - corners[0]);
                prop_assert!(samples.samples.iter().any(|sample| sample.point.distance(p) <= spacing));
            }
            let normal = mesh.normal(0).unwrap();
            for [i, j, k] in &samples.triangles {
                let [i, j, k] = [i, j, k].map(|n| samples.samples[*n as usize].point);
                prop_assert!((j - i).cross(k - i).dot(normal) >= -1e-12);
                prop_assert!(i.distance(j).max(j.distance(k)).max(k.distance(i)) <= 3.5 * spacing);
            }
        }
    }

    #[test]
    fn a_needle_has_samples_along_it_and_few_across() {
        let needle = facet([DVec3::ZERO, DVec3::X * 100.0, DVec3::new(60.0, 0.01, 0.0)]);
        assert!(Samples::of_mesh(&needle, 0.1).unwrap().samples.len() <= 2 * 1002);
    }
}
