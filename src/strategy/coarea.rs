//! How long passes along the level lines of a function are, before any is laid.
//!
//! By the co-area formula the lines of a function `φ` that rises by one from pass to pass are `∬ |∇φ| dA` long. Where passes
//! could lie as close as their strips need at every place, `|∇φ| = 1/w` and the length is `∬ dA/w`, with `w` for the feed along the
//! line; where whole passes are spaced by their narrowest strip it is what that asks for all along them.

use super::potential::Potential;
use crate::geometry::{Domain, FaceGrid, Triangle, triangles};
use crate::math::order::{rank, sort_by_key};
use glam::DVec3;

/// Bands of levels over which passes are alike.
const BANDS: usize = 48;
/// Share of a pass that its spacing does not go by: partial passes are for that.
const ODD: f64 = 0.02;
/// What partial passes cost beside whole ones, which lie edge to edge without ends.
const PARTIAL: f64 = 1.5;
/// What a border costs, as a share of its length, where lines meet it squarely and where they run along it: passes run out over it, the
/// farther the more aslant; and along it half of the last strip lies beyond.
const BORDER: [f64; 2] = [0.2, 0.9];

/// A piece of a face between two levels.
struct Piece {
    /// `|∇φ| dA`.
    lines: f64,
    /// Passes for a step of one in `φ`.
    rate: f64,
}

/// About how long the passes along the level lines of the function with `values` at the nodes of `grid` are, mm; `domain` tells which
/// sides of the grid are borders.
pub(super) fn expected_length(
    grid: &FaceGrid,
    domain: &Domain,
    potential: &Potential,
    values: &[f64],
) -> f64 {
    between_borders(grid, potential, values) + at_borders(grid, domain, values)
}

/// The same without what runs out over borders: where passes are few, that may be less.
pub(super) fn between_borders(grid: &FaceGrid, potential: &Potential, values: &[f64]) -> f64 {
    let (low, high) =
        values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), x| (lo.min(*x), hi.max(*x)));
    let mut bands: Vec<Vec<Piece>> = (0..BANDS).map(|_| Vec::new()).collect();
    let turns = Turns::new(grid, potential, values);
    for triangle in triangles(grid) {
        let rise = triangle.gradient(values);
        let (steep, width) = (rise.length(), potential.mean_width(&triangle, triangle.normal.cross(rise)));
        if !(steep > 0.0 && width > 0.0) {
            continue;
        }
        let level = triangle.nodes.iter().map(|&k| values[k]).sum::<f64>() / 3.0;
        let band = ((level - low) / (high - low) * BANDS as f64) as usize;
        // Half of twice the area, and triangles cover every place twice.
        let lines = 0.25 * triangle.normal.length() * steep * turns.longer(&triangle, rise);
        bands[band.min(BANDS - 1)].push(Piece { lines, rate: 1.0 / (width * steep) });
    }
    bands.iter_mut().map(|band| in_band(band)).sum::<f64>()
}

/// How the level lines of a function turn: the cutter's tip, off the contact by an arm along the feed, swings aside where they do.
struct Turns {
    /// Unit, at the nodes; zero where there is none.
    rises: Vec<DVec3>,
    arm: f64,
}

impl Turns {
    fn new(grid: &FaceGrid, potential: &Potential, values: &[f64]) -> Self {
        let mut rises = vec![DVec3::ZERO; values.len()];
        for triangle in triangles(grid) {
            let rise = triangle.gradient(values).normalize_or_zero() * triangle.normal.length();
            if rise.is_finite() {
                triangle.nodes.iter().for_each(|&k| rises[k] += rise);
            }
        }
        rises.iter_mut().for_each(|rise| *rise = rise.normalize_or_zero());
        Self { rises, arm: potential.arm() }
    }

    /// How much longer the way of the tip is than that of the contact.
    fn longer(&self, triangle: &Triangle, rise: DVec3) -> f64 {
        let Some(feed) = triangle.normal.cross(rise).try_normalize() else { return 1.0 };
        let turn = triangle.change(&self.rises, feed).dot(feed);
        (1.0 + (self.arm * turn) * (self.arm * turn)).sqrt()
    }
}

fn in_band(band: &mut [Piece]) -> f64 {
    sort_by_key(band, |piece| (rank(piece.rate), 0));
    let lines: f64 = band.iter().map(|piece| piece.lines).sum();
    let fitted: f64 = band.iter().map(|piece| piece.lines * piece.rate).sum();
    let mut below = 0.0;
    let typical = band.iter().find(|piece| {
        below += piece.lines;
        below >= (1.0 - ODD) * lines
    });
    typical.map_or(0.0, |piece| (lines * piece.rate).min(PARTIAL * fitted))
}

/// The share that every node has of the passes along the level lines of the function with `values`, where each lies as close as its
/// strips need, run-outs over borders included, mm.
pub(super) fn shares(grid: &FaceGrid, domain: &Domain, potential: &Potential, values: &[f64]) -> Vec<f64> {
    let mut shares = vec![0.0; values.len()];
    let turns = Turns::new(grid, potential, values);
    for triangle in triangles(grid) {
        let rise = triangle.gradient(values);
        let width = potential.mean_width(&triangle, triangle.normal.cross(rise));
        let area = 0.25 * triangle.normal.length();
        let lines = if width > 0.0 { area / width * turns.longer(&triangle, rise) } else { 0.0 };
        let share = (lines + at_border(grid, domain, &triangle, rise)) / 3.0;
        triangle.nodes.iter().for_each(|&k| shares[k] += share);
    }
    shares
}

/// What running out over the borders costs, mm.
fn at_borders(grid: &FaceGrid, domain: &Domain, values: &[f64]) -> f64 {
    triangles(grid).map(|triangle| at_border(grid, domain, &triangle, triangle.gradient(values))).sum()
}

/// What running out over those sides of a triangle that lie on a border costs, mm, for lines square to `rise`.
fn at_border(grid: &FaceGrid, domain: &Domain, triangle: &Triangle, rise: DVec3) -> f64 {
    let (nu, nv) = grid.size();
    let rise = rise.normalize_or_zero();
    let mut cost = 0.0;
    for k in 0..3 {
        let [a, b] = [triangle.nodes[k], triangle.nodes[(k + 1) % 3]];
        let along = |a: usize, b: usize, count: usize| a == b && (a == 0 || a + 1 == count);
        let is_border = (!domain.u.periodic && along(a % nu, b % nu, nu))
            || (!domain.v.periodic && along(a / nu, b / nu, nv));
        if is_border {
            let side = grid.points()[b] - grid.points()[a];
            let across = rise.dot(side).abs();
            let beside = (side.length_squared() - across * across).max(0.0).sqrt();
            // Of the four triangles of a cell two have this side.
            cost += 0.5 * (BORDER[0] * across + BORDER[1] * beside);
        }
    }
    cost
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cutter::Cutter;
    use crate::geometry::{Face, Plane, Range, Side};
    use crate::math::frame::Frame;
    use crate::monitor::Stage;
    use crate::posture::Rule;
    use crate::strategy::Finish;
    use crate::toolpath::Posture;
    use glam::DVec3;

    #[test]
    fn on_a_plane_it_is_the_area_by_the_width_and_the_borders() {
        let frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
        let (u, v) = (Range::open(0.0, 60.0), Range::open(0.0, 40.0));
        let face = Face::new(Plane { origin: DVec3::ZERO, frame, u, v }, Side::Front);
        let grid = FaceGrid::new(&face, 2.0, 4, 100);
        let cutter = Cutter::bull_nose(10.0, 2.0, 40.0).unwrap();
        let finish = Finish { scallop: 0.01, chord: 0.0002 };
        let rule = Rule::Fixed(Posture { lead: 0.1, yaw: 0.0 });
        let potential = Potential::new((&face, &grid), &cutter, &rule, &finish, &Stage::silent()).unwrap();
        let width = potential.width(0, DVec3::X).unwrap();
        for (direction, borders) in
            [(DVec3::X, 0.2 * 120.0 + 0.9 * 80.0), (DVec3::Y, 0.2 * 80.0 + 0.9 * 120.0)]
        {
            // Whatever a step of the function is called.
            let values: Vec<f64> = grid.points().iter().map(|p| 3.0 * p.dot(direction)).collect();
            let length = expected_length(&grid, &face.domain(), &potential, &values);
            assert!((length / (2400.0 / width + borders) - 1.0).abs() < 1e-6, "{length}");
        }
        // Lines that crowd at one side lie a strip apart there and at the other alike: only the width of a band shows.
        let crowded: Vec<f64> = grid.points().iter().map(|p| p.x * p.x).collect();
        let length = expected_length(&grid, &face.domain(), &potential, &crowded);
        let share = length / (2400.0 / width + 96.0);
        assert!((1.0..1.12).contains(&share), "{share}");
    }

    #[test]
    fn round_lines_swing_the_tip() {
        let frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
        let range = Range::open(-20.0, 20.0);
        let face = Face::new(Plane { origin: DVec3::ZERO, frame, u: range, v: range }, Side::Front);
        let grid = FaceGrid::new(&face, 0.5, 4, 100);
        let (cutter, finish) =
            (Cutter::bull_nose(10.0, 2.0, 40.0).unwrap(), Finish { scallop: 0.01, chord: 0.0002 });
        let rule = Rule::Fixed(Posture { lead: 0.1, yaw: 0.0 });
        let potential = Potential::new((&face, &grid), &cutter, &rule, &finish, &Stage::silent()).unwrap();
        let values: Vec<f64> = grid.points().iter().map(|p| p.length()).collect();
        let turns = Turns::new(&grid, &potential, &values);
        for triangle in triangles(&grid) {
            let middle = triangle.nodes.iter().map(|&k| grid.points()[k]).sum::<DVec3>() / 3.0;
            let (radius, arm) = (middle.length(), potential.arm());
            if radius > 4.0 {
                let longer = turns.longer(&triangle, triangle.gradient(&values));
                assert!((longer / libm::hypot(1.0, arm / radius) - 1.0).abs() < 0.02, "{middle} {longer}");
            }
        }
    }
}
