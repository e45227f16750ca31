//! Functions whose level lines lie edge to edge from one line on.

use super::potential::Potential;
use crate::geometry::{Domain, FaceGrid, Fronts, triangles};
use glam::DVec3;

/// Rounds in which directions and widths come to agree.
const ROUNDS: usize = 4;

/// The function that is 0 on the line of `values` at `level` and rises by about one over every strip; `None` where that line is a
/// point.
pub(super) fn offset(
    (grid, domain): (&FaceGrid, &Domain),
    potential: &Potential,
    values: &[f64],
    level: f64,
) -> Option<Vec<f64>> {
    let fronts = Fronts::new(domain, grid);
    let points = grid.points();
    let away: Vec<f64> = values.iter().map(|value| value - level).collect();
    // How far the line is along the edges that it crosses.
    let crossing = |k: usize| {
        let crossed = fronts.around(k).into_iter().flatten().filter(|&n| away[k] * away[n] <= 0.0);
        let way = |n: usize| match away[k].abs() {
            0.0 => 0.0,
            here => here / (here + away[n].abs()) * points[k].distance(points[n]),
        };
        crossed.map(way).reduce(f64::min).map(|way| (k, way))
    };
    let near: Vec<(usize, f64)> = (0..away.len()).filter_map(crossing).collect();
    let on = || near.iter().filter(|(_, way)| *way <= 0.0).count();
    // At its ends a function is a border, along all of one side, or a point.
    let is_end = away.iter().all(|a| *a <= 0.0) || away.iter().all(|a| *a >= 0.0);
    if is_end && on() < 3 {
        return None;
    }
    let mut offset = away.clone();
    for _ in 0..ROUNDS {
        let slowness: Vec<f64> = widths(grid, potential, &offset).into_iter().map(f64::recip).collect();
        let seeds: Vec<(usize, f64)> = near.iter().map(|&(k, way)| (k, way * slowness[k])).collect();
        let times = fronts.times(&seeds, &slowness);
        offset =
            times.iter().zip(&away).map(|(time, away)| if *away < 0.0 { -time } else { *time }).collect();
    }
    offset.iter().all(|value| value.is_finite()).then_some(offset)
}

/// The widths of strips at the nodes for feed along the level lines of `values`, mm.
fn widths(grid: &FaceGrid, potential: &Potential, values: &[f64]) -> Vec<f64> {
    let mut feeds = vec![DVec3::ZERO; values.len()];
    for triangle in triangles(grid) {
        let feed = triangle.normal.cross(triangle.gradient(values));
        if feed.is_finite() {
            triangle.nodes.iter().for_each(|&k| feeds[k] += feed);
        }
    }
    let widths: Vec<Option<f64>> =
        feeds.iter().enumerate().map(|(k, feed)| potential.width(k, *feed).filter(|w| *w > 0.0)).collect();
    let (sum, count) = widths.iter().flatten().fold((0.0, 0.0), |(sum, count), w| (sum + w, count + 1.0));
    let mean: f64 = if count > 0.0 { sum / count } else { 1.0 };
    widths.into_iter().map(|width| width.unwrap_or(mean)).collect()
}
