//! A face sampled on a grid of parameters, even in space rather than in parameters.

use super::{Face, Range, Uv};
use glam::DVec3;

/// Points of a face on a grid of parameters, no two neighbours much further apart than asked.
#[derive(Debug, Clone)]
pub struct FaceGrid {
    us: Vec<f64>,
    vs: Vec<f64>,
    points: Vec<DVec3>,
}

/// Probes along each direction that measure how fast the surface runs; a NURBS with hundreds of uneven knots needs them.
const PROBES: usize = 512;
/// Lines across on which the speed is measured; the fastest counts.
const LINES: usize = 17;

impl FaceGrid {
    /// The grid whose neighbours are at most about `cell` mm apart, with at least `least` and at most `most` cells each way.
    /// First and last rows lie on the borders (on a periodic face they coincide).
    pub fn new(face: &Face, cell: f64, least: usize, most: usize) -> Self {
        let domain = face.domain();
        let us = even_parameters(&domain.u, cell, least, most, |u, t| {
            face.surface.point(Uv::new(u, domain.v.at(t)))
        });
        let vs = even_parameters(&domain.v, cell, least, most, |v, t| {
            face.surface.point(Uv::new(domain.u.at(t), v))
        });
        let points = vs
            .iter()
            .flat_map(|&v| us.iter().map(move |&u| Uv::new(u, v)))
            .map(|uv| face.surface.point(uv))
            .collect();
        Self { us, vs, points }
    }

    /// Number of nodes along u and v.
    pub fn size(&self) -> (usize, usize) {
        (self.us.len(), self.vs.len())
    }

    /// Parameters of the node `(i, j)`.
    pub fn uv(&self, i: usize, j: usize) -> Uv {
        Uv::new(self.us[i], self.vs[j])
    }

    /// The cell that holds `uv`, by its lowest node; the nearest one if `uv` lies outside.
    pub fn cell_at(&self, uv: Uv) -> (usize, usize) {
        let find = |nodes: &[f64], x: f64| {
            nodes.partition_point(|&node| node <= x).saturating_sub(1).min(nodes.len() - 2)
        };
        (find(&self.us, uv.u), find(&self.vs, uv.v))
    }

    /// Point of the node `(i, j)`.
    pub fn point(&self, i: usize, j: usize) -> DVec3 {
        self.points[j * self.us.len() + i]
    }

    /// All points, u running fastest.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// Area of the cell between the nodes `(i, j)` and `(i + 1, j + 1)`, as two triangles, mm².
    pub fn cell_area(&self, i: usize, j: usize) -> f64 {
        let [a, b, c, d] =
            [self.point(i, j), self.point(i + 1, j), self.point(i + 1, j + 1), self.point(i, j + 1)];
        0.5 * ((b - a).cross(c - a).length() + (c - a).cross(d - a).length())
    }
}

/// Parameters of `range` between which the fastest of the lines `point(·, t)` runs at most `cell` mm.
fn even_parameters(
    range: &Range,
    cell: f64,
    least: usize,
    most: usize,
    point: impl Fn(f64, f64) -> DVec3,
) -> Vec<f64> {
    let at = |k: usize| range.at(k as f64 / PROBES as f64);
    let mut steps = vec![0.0f64; PROBES];
    for line in 0..LINES {
        let t = line as f64 / (LINES - 1) as f64;
        let mut last = point(at(0), t);
        for (k, step) in steps.iter_mut().enumerate() {
            let next = point(at(k + 1), t);
            *step = step.max(next.distance(last));
            last = next;
        }
    }
    let total: f64 = steps.iter().sum();
    let count = ((total / cell).ceil() as usize).clamp(least.max(1), most.max(1));
    // A floor under the speed keeps the parameters rising where a line stands still (a pole).
    let floor = 1e-3 * total / PROBES as f64;
    let run: f64 = steps.iter().map(|s| s + floor).sum();
    let mut parameters = Vec::with_capacity(count + 1);
    parameters.push(range.lo);
    let (mut k, mut before) = (0, 0.0);
    for i in 1..count {
        let target = run * i as f64 / count as f64;
        while k < PROBES - 1 && before + steps[k] + floor < target {
            before += steps[k] + floor;
            k += 1;
        }
        let fraction = ((target - before) / (steps[k] + floor)).clamp(0.0, 1.0);
        parameters.push(range.at((k as f64 + fraction) / PROBES as f64));
    }
    parameters.push(range.hi);
    parameters
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Side, Sphere};
    use crate::math::frame::Frame;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn cells_keep_to_their_size_and_cover_the_area() {
        let world = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
        let sphere = Sphere::new(DVec3::ZERO, world, 10.0, [0.0, PI], [-FRAC_PI_2, FRAC_PI_2]).unwrap();
        let grid = FaceGrid::new(&Face::new(sphere, Side::Front), 0.25, 4, 1000);
        let (nu, nv) = grid.size();
        let mut area = 0.0;
        for j in 0..nv - 1 {
            for i in 0..nu - 1 {
                assert!(grid.point(i, j).distance(grid.point(i + 1, j)) < 0.26);
                assert!(grid.point(i, j).distance(grid.point(i, j + 1)) < 0.26);
                area += grid.cell_area(i, j);
            }
        }
        assert!((area / (200.0 * PI) - 1.0).abs() < 1e-3, "{area}");
    }
}
