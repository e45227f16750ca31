//! How long a front takes to every node of a grid.

use super::{Domain, FaceGrid};
use crate::math::order::rank;
use glam::DVec3;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The steps round a node, each next to the last.
const AROUND: [(i64, i64); 8] = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)];

/// The nodes of a grid with their neighbours in space, over the seams of a periodic face too.
#[derive(Debug)]
pub struct Fronts<'a> {
    grid: &'a FaceGrid,
    periodic: [bool; 2],
}

impl<'a> Fronts<'a> {
    /// On `grid`, which must be of a face with the parameters `domain`.
    pub fn new(domain: &Domain, grid: &'a FaceGrid) -> Self {
        Self { grid, periodic: [domain.u.periodic, domain.v.periodic] }
    }

    /// The nodes next to a node, over edges and corners of cells, in a circle; `None` beyond a border.
    pub fn around(&self, node: usize) -> [Option<usize>; 8] {
        let (nu, nv) = self.grid.size();
        let (i, j) = ((node % nu) as i64, (node / nu) as i64);
        AROUND.map(|(di, dj)| {
            let i = step(i, di, nu as i64, self.periodic[0])?;
            let j = step(j, dj, nv as i64, self.periodic[1])?;
            Some(j as usize * nu + i as usize)
        })
    }

    /// The first of the nodes that are one and the same point of a periodic face.
    pub fn first(&self, node: usize) -> usize {
        let (nu, nv) = self.grid.size();
        let (i, j) = (node % nu, node / nu);
        let i = if self.periodic[0] && i == nu - 1 { 0 } else { i };
        let j = if self.periodic[1] && j == nv - 1 { 0 } else { j };
        j * nu + i
    }

    /// Travel times from `seeds`, nodes with their own times, to all nodes, at a slowness (time per mm) that may differ
    /// from node to node; infinite where nothing leads.
    ///
    /// Fast marching on the triangles round a node (Kimmel and Sethian 1998), first order in the grid's cells.
    pub fn times(&self, seeds: &[(usize, f64)], slowness: &[f64]) -> Vec<f64> {
        let points = self.grid.points();
        let mut times = vec![f64::INFINITY; points.len()];
        let mut is_done = vec![false; points.len()];
        let mut open = BinaryHeap::new();
        for &(node, time) in seeds {
            let node = self.first(node);
            if time < times[node] {
                times[node] = time;
                open.push(Reverse((rank(time), node)));
            }
        }
        while let Some(Reverse((_, node))) = open.pop() {
            if is_done[node] {
                continue;
            }
            is_done[node] = true;
            for next in self.around(node).into_iter().flatten().map(|n| self.first(n)) {
                if is_done[next] {
                    continue;
                }
                let ring = self.around(next).map(|n| n.map(|n| self.first(n)));
                let known = |k: usize| ring[k % 8].filter(|&n| is_done[n]).map(|n| (points[n], times[n]));
                let mine = (0..8).filter(|&k| ring[k] == Some(node));
                let through = mine
                    .flat_map(|k| [known(k + 7), known(k + 1)])
                    .map(|beside| arrival((points[node], times[node]), beside, points[next], slowness[next]));
                let time = through.fold(f64::INFINITY, f64::min);
                if time < times[next] {
                    times[next] = time;
                    open.push(Reverse((rank(time), next)));
                }
            }
        }
        (0..times.len()).for_each(|node| times[node] = times[self.first(node)]);
        times
    }
}

fn step(at: i64, by: i64, count: i64, periodic: bool) -> Option<i64> {
    let next = at + by;
    if periodic {
        // The last node is the first.
        Some(next.rem_euclid(count - 1))
    } else {
        (0..count).contains(&next).then_some(next)
    }
}

/// When a front that passes `a`, and `b` if that is known, with its time linear between them, comes to `c`.
fn arrival(a: (DVec3, f64), b: Option<(DVec3, f64)>, c: DVec3, slowness: f64) -> f64 {
    let alone = a.1 + slowness * a.0.distance(c);
    let Some(b) = b else { return alone };
    let (e, d, rise) = (b.0 - a.0, c - a.0, b.1 - a.1);
    let (ee, de) = (e.length_squared(), d.dot(e));
    // The way is shortest in time where its own rise along the edge balances that of the front.
    let square = slowness * slowness * ee - rise * rise;
    if square <= 0.0 {
        return alone;
    }
    let away = (ee * d.length_squared() - de * de).max(0.0).sqrt();
    let t = ((de - rise * away / square.sqrt()) / ee).clamp(0.0, 1.0);
    let through = a.1 + rise * t + slowness * (a.0 + e * t).distance(c);
    through.min(alone)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Cylinder, Face, Plane, Range, Side, Sphere};
    use crate::math::frame::Frame;
    use std::f64::consts::TAU;

    const WORLD: Frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };

    fn far(face: &Face, cell: f64, seed: impl Fn(DVec3) -> f64) -> (FaceGrid, Vec<f64>) {
        let grid = FaceGrid::new(face, cell, 4, 600);
        let seeds: Vec<(usize, f64)> =
            grid.points().iter().map(|p| seed(*p)).enumerate().filter(|(_, d)| *d < 2.5 * cell).collect();
        let slowness = vec![2.0; grid.points().len()];
        let times = Fronts::new(&face.domain(), &grid)
            .times(&seeds.iter().map(|s| (s.0, 2.0 * s.1)).collect::<Vec<_>>(), &slowness);
        (grid, times)
    }

    #[test]
    fn a_straight_front_is_exact_and_a_round_one_close() {
        let plane =
            Plane { origin: DVec3::ZERO, frame: WORLD, u: Range::open(0.0, 20.0), v: Range::open(0.0, 12.0) };
        let face = Face::new(plane, Side::Front);
        let (grid, times) = far(&face, 0.25, |p| p.x);
        assert!(grid.points().iter().zip(&times).all(|(p, t)| (t - 2.0 * p.x).abs() < 1e-9));
        let middle = DVec3::new(7.0, 5.0, 0.0);
        let (grid, times) = far(&face, 0.25, |p| p.distance(middle));
        let worst = grid
            .points()
            .iter()
            .zip(&times)
            .map(|(p, t)| (t - 2.0 * p.distance(middle)).abs())
            .fold(0.0, f64::max);
        assert!(worst < 0.2, "{worst}");
    }

    #[test]
    fn fronts_run_over_seams_and_meet_behind() {
        let face =
            Face::new(Cylinder::new(DVec3::ZERO, WORLD, 5.0, [0.0, TAU], [0.0, 9.0]).unwrap(), Side::Front);
        // From the line over x = 5, which is the seam.
        let along = |p: DVec3| 5.0 * libm::atan2(p.y.abs(), p.x);
        let (grid, times) = far(&face, 0.1, along);
        for (p, t) in grid.points().iter().zip(&times) {
            assert!((t - 2.0 * along(*p)).abs() < 0.01, "{p} {t}");
        }
    }

    #[test]
    fn a_pole_is_no_hindrance() {
        let sphere =
            Sphere::new(DVec3::ZERO, WORLD, 10.0, [0.0, TAU], [-1.2, 0.5 * std::f64::consts::PI]).unwrap();
        let face = Face::new(sphere, Side::Front);
        let from_pole = |p: DVec3| 10.0 * libm::acos((p.z / 10.0).clamp(-1.0, 1.0));
        let (grid, times) = far(&face, 0.2, from_pole);
        for (p, t) in grid.points().iter().zip(&times) {
            assert!((t - 2.0 * from_pole(*p)).abs() < 0.05, "{p} {t} {}", from_pole(*p));
        }
    }
}
