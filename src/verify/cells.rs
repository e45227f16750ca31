//! Samples gathered into cubes of space, to be judged together.

use super::entry::Line;
use super::sweeps::Box3;
use glam::DVec3;

/// The lines of a cube's samples and bounds that hold for all of them.
#[derive(Debug, Clone)]
pub(super) struct Cell {
    pub(super) centre: DVec3,
    /// Mean direction, unit.
    pub(super) direction: DVec3,
    /// How far any line's direction is from the mean.
    pub(super) spread: f64,
    /// How far any point is from the centre, square to the mean direction.
    pub(super) radius: f64,
    /// How far any point is from the centre along the mean direction.
    pub(super) height: f64,
    /// Box around all lines from their lower to their upper ends.
    pub(super) region: Box3,
}

impl Cell {
    pub(super) fn around(lines: &[Line]) -> Self {
        let count = lines.len().max(1) as f64;
        let centre = lines.iter().map(|l| l.point).sum::<DVec3>() / count;
        let direction = lines.iter().map(|l| l.direction).sum::<DVec3>().normalize_or(DVec3::Z);
        let mut cell = Self { centre, direction, spread: 0.0, radius: 0.0, height: 0.0, region: Box3::EMPTY };
        for line in lines {
            let off = line.point - centre;
            let along = off.dot(direction);
            cell.spread = cell.spread.max(line.direction.distance(direction));
            cell.height = cell.height.max(along.abs());
            cell.radius = cell.radius.max((off - direction * along).length());
            cell.region = cell.region.with(line.at(line.from)).with(line.at(line.to));
        }
        cell
    }
}

/// The numbers of `points`, cube by cube of edge `size`, in an order that depends on nothing else; the second list says
/// where each cube begins, and ends with the count.
pub(super) fn gather(points: &[DVec3], size: f64, wanted: impl Fn(usize) -> bool) -> (Vec<u32>, Vec<u32>) {
    let key = |i: u32| (points[i as usize] / size).floor().to_array().map(|c| c as i32);
    let mut keyed: Vec<([i32; 3], u32)> =
        (0..points.len() as u32).filter(|&i| wanted(i as usize)).map(|i| (key(i), i)).collect();
    keyed.sort_unstable();
    let mut starts: Vec<u32> = Vec::new();
    for (at, pair) in keyed.iter().enumerate() {
        if at == 0 || keyed[at - 1].0 != pair.0 {
            starts.push(at as u32);
        }
    }
    starts.push(keyed.len() as u32);
    (keyed.into_iter().map(|(_, i)| i).collect(), starts)
}
