//! Functions on a face whose gradients are as asked for, as nearly as can be.

use super::{Domain, FaceGrid};
use glam::DVec3;

/// Steps of the conjugate gradients, and the share of what is asked for that may be left over when they stop.
const STEPS: usize = 600;
const ENOUGH: f64 = 1e-4;

/// A least-squares fit of a function's gradient, triangle by triangle of a grid: in every cell all four triangles of three
/// corners count, so that neither diagonal is preferred. The seam of a periodic face is crossed like any other row.
#[derive(Debug)]
pub struct GradientFit<'a> {
    domain: Domain,
    grid: &'a FaceGrid,
    /// For every node its weights on itself and the eight around.
    weights: Vec<[f64; 9]>,
    right: Vec<f64>,
}

/// Three nodes of a cell.
#[derive(Debug, Clone, Copy)]
pub struct Triangle {
    corners: [(usize, usize); 3],
    /// The nodes' numbers.
    pub nodes: [usize; 3],
    /// Gradients of the three functions that are 1 at one of the nodes and 0 at the others, 1/mm.
    hats: [DVec3; 3],
    /// Along the normal, as long as twice the area (mm²).
    pub normal: DVec3,
}

impl Triangle {
    /// The gradient, per mm, of the function with `values` at the nodes of the grid, linear in the triangle.
    pub fn gradient(&self, values: &[f64]) -> DVec3 {
        (0..3).map(|k| self.hats[k] * values[self.nodes[k]]).sum()
    }

    /// By how much vectors at the nodes of the grid, linear in the triangle, change `along` a unit direction, per mm.
    pub fn change(&self, vectors: &[DVec3], along: DVec3) -> DVec3 {
        (0..3).map(|k| vectors[self.nodes[k]] * self.hats[k].dot(along)).sum()
    }

    /// The part of `direction` in the triangle's plane, of length 1; `None` where there is none.
    pub fn flat(&self, direction: DVec3) -> Option<DVec3> {
        let square = self.normal.length_squared();
        (direction - self.normal * (self.normal.dot(direction) / square)).try_normalize()
    }
}

/// What the gradient on a triangle should be.
#[derive(Debug, Clone, Copy)]
pub struct Wish {
    /// By how much it should change, per mm.
    pub change: DVec3,
    /// The unit direction in which that counts most.
    pub along: DVec3,
    /// How much what is square to it counts beside that.
    pub aside: f64,
    /// How much all of it counts.
    pub weight: f64,
}

/// The triangles of `grid`.
pub fn triangles(grid: &FaceGrid) -> impl Iterator<Item = Triangle> {
    let (nu, nv) = grid.size();
    let cells = (0..nv - 1).flat_map(move |j| (0..nu - 1).map(move |i| (i, j)));
    cells.flat_map(move |(i, j)| {
        let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
        (0..4).filter_map(move |skipped| {
            let corners = [1, 2, 3].map(|k| corners[(skipped + k) % 4]);
            let nodes = corners.map(|(i, j)| j * nu + i);
            let p = nodes.map(|k| grid.points()[k]);
            let normal = (p[1] - p[0]).cross(p[2] - p[0]);
            let square = normal.length_squared();
            let hats = [0, 1, 2].map(|k| normal.cross(p[(k + 2) % 3] - p[(k + 1) % 3]) / square);
            // At a pole it is a line.
            (square > 0.0).then_some(Triangle { corners, nodes, hats, normal })
        })
    })
}

/// A node's weights on itself and the eight around.
struct Row {
    node: usize,
    around: [usize; 9],
    weights: [f64; 9],
}

impl<'a> GradientFit<'a> {
    /// Nothing asked for yet.
    pub fn new(domain: Domain, grid: &'a FaceGrid) -> Self {
        let count = grid.points().len();
        Self { domain, grid, weights: vec![[0.0; 9]; count], right: vec![0.0; count] }
    }

    /// The node that stands for the node `(i, j)`, whose numbers may lie a step beyond a seam; `None` beyond a border.
    pub fn node(&self, i: i64, j: i64) -> Option<usize> {
        let (nu, nv) = self.grid.size();
        let place = |k: i64, count: usize, periodic: bool| {
            let count = count as i64;
            if periodic { Some(k.rem_euclid(count - 1)) } else { (0..count).contains(&k).then_some(k) }
        };
        let (i, j) = (place(i, nu, self.domain.u.periodic)?, place(j, nv, self.domain.v.periodic)?);
        Some(j as usize * nu + i as usize)
    }

    /// Asks for that on the triangle.
    pub fn add(&mut self, triangle: &Triangle, wish: &Wish) {
        let Wish { change, along, aside, weight } = *wish;
        let forth = along * along.dot(change);
        let wanted = forth + (change - forth) * aside;
        for a in 0..3 {
            let (i, j) = triangle.corners[a];
            let Some(node) = self.node(i as i64, j as i64) else { continue };
            let hat = triangle.hats[a];
            self.right[node] += weight * hat.dot(wanted);
            for b in 0..3 {
                let other = triangle.hats[b];
                let (both, forth) = (hat.dot(other), hat.dot(along) * other.dot(along));
                let (di, dj) = (1 + triangle.corners[b].0 - i, 1 + triangle.corners[b].1 - j);
                self.weights[node][dj * 3 + di] += weight * (forth + aside * (both - forth));
            }
        }
    }

    /// The weights of a node on those around; where there is none the node itself stands with a weight of 0.
    fn row(&self, node: usize) -> Row {
        let nu = self.grid.size().0;
        let (i, j) = ((node % nu) as i64, (node / nu) as i64);
        let mut row = Row { node, around: [node; 9], weights: [0.0; 9] };
        for w in 0..9 {
            if let Some(k) = self.node(i + (w % 3) as i64 - 1, j + (w / 3) as i64 - 1) {
                (row.around[w], row.weights[w]) = (k, self.weights[node][w]);
            }
        }
        row
    }

    /// The change at every node that comes nearest to what was asked, 0 at the nodes `held`; by conjugate gradients.
    pub fn solved(&self, held: impl IntoIterator<Item = usize>) -> Vec<f64> {
        self.solved_near(&vec![0.0; self.right.len()], held)
    }

    /// The same, begun at `near`, where there is less to do.
    pub fn solved_near(&self, near: &[f64], held: impl IntoIterator<Item = usize>) -> Vec<f64> {
        let nu = self.grid.size().0;
        let count = self.right.len();
        let mut is_free: Vec<bool> = (0..count)
            .map(|k| self.weights[k][4] > 0.0 && self.node((k % nu) as i64, (k / nu) as i64) == Some(k))
            .collect();
        for k in held {
            is_free[k] = false;
            if let Some(k) = self.node((k % nu) as i64, (k / nu) as i64) {
                is_free[k] = false;
            }
        }
        let rows: Vec<Row> = (0..count).filter(|&k| is_free[k]).map(|k| self.row(k)).collect();
        let apply = |x: &[f64]| -> Vec<f64> {
            let mut y = vec![0.0; count];
            for Row { node, around, weights } in &rows {
                y[*node] = around.iter().zip(weights).map(|(&k, weight)| weight * x[k]).sum();
            }
            y
        };
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let scaled = |r: &[f64]| -> Vec<f64> {
            (0..count).map(|k| if is_free[k] { r[k] / self.weights[k][4] } else { 0.0 }).collect()
        };
        let right: Vec<f64> = (0..count).map(|k| if is_free[k] { self.right[k] } else { 0.0 }).collect();
        let enough = dot(&right, &scaled(&right)) * ENOUGH * ENOUGH;
        let mut x: Vec<f64> = (0..count).map(|k| if is_free[k] { near[k] } else { 0.0 }).collect();
        let mut r: Vec<f64> = right.iter().zip(apply(&x)).map(|(right, have)| right - have).collect();
        let mut z = scaled(&r);
        let mut p = z.clone();
        let mut rz = dot(&r, &z);
        for _ in 0..STEPS {
            let q = apply(&p);
            let pq = dot(&p, &q);
            if !(rz > enough && pq > 0.0) {
                break;
            }
            let step = rz / pq;
            for k in 0..count {
                x[k] += step * p[k];
                r[k] -= step * q[k];
            }
            z = scaled(&r);
            let next = dot(&r, &z);
            let turn = next / rz;
            rz = next;
            for k in 0..count {
                p[k] = z[k] + turn * p[k];
            }
        }
        (0..count).for_each(|k| {
            // Over a seam a node and its twin are one.
            if let Some(node) = self.node((k % nu) as i64, (k / nu) as i64) {
                x[k] = x[node];
            }
        });
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Cylinder, Face, Side, Sphere};
    use crate::math::frame::Frame;
    use std::f64::consts::TAU;

    const WORLD: Frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };

    /// The fit to the gradients of `f`, less `f`: how far it varies.
    fn spread(face: &Face, f: impl Fn(DVec3) -> f64) -> f64 {
        let grid = FaceGrid::new(face, 0.5, 4, 400);
        let values: Vec<f64> = grid.points().iter().map(|p| f(*p)).collect();
        let mut fit = GradientFit::new(face.domain(), &grid);
        for triangle in triangles(&grid) {
            let change = triangle.gradient(&values);
            let Some(along) = triangle.flat(DVec3::new(0.3, 0.5, 0.8)) else { continue };
            fit.add(&triangle, &Wish { change, along, aside: 0.2, weight: triangle.normal.length() });
        }
        let misses: Vec<f64> = fit.solved([]).iter().zip(&values).map(|(x, f)| x - f).collect();
        let (low, high) =
            misses.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), x| (lo.min(*x), hi.max(*x)));
        high - low
    }

    #[test]
    fn a_function_comes_back_from_its_gradient() {
        let cap = Sphere::new(DVec3::ZERO, WORLD, 10.0, [0.2, 1.7], [-0.4, 0.9]).unwrap();
        assert!(spread(&Face::new(cap, Side::Front), |p| p.x * p.y + p.z) < 0.02);
        let pipe = Cylinder::new(DVec3::ZERO, WORLD, 5.0, [0.0, TAU], [0.0, 9.0]).unwrap();
        assert!(spread(&Face::new(pipe, Side::Front), |p| p.x * p.z + p.y) < 0.02);
    }
}
