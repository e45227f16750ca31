//! What stays unfinished, as zones.

use super::facet::COVERED;
use super::ground::{Grain, WALL};
use super::line::Lowering;
use super::reach::Spot;
use super::turn::Turn;
use crate::geometry::{Cubes, TriMesh, Zone, pieces};
use crate::monitor::{Cancelled, Stage};
use glam::DVec3;

/// Most cubes of a zone: two dozen megabytes.
const MOST_CUBES: usize = 2_000_000;
/// Cubes that a surface meets for each square of their edge that its area holds: one lying flat, two and more askew,
/// margins included.
const CUBES_A_SQUARE: f64 = 2.5;
/// Parts of a cube by which what is out of reach may lie beside what was looked at.
const MARGIN: f64 = 0.25;
/// Parts of a cube that rounding may take a point of a facet away from it.
const ROUNDING: f64 = 1e-6;

/// Cubes for zones of at most about `area` (mm²), of edge `cell` (mm) or larger if there would be too many. Where they
/// begin is no round number, so that level ground of a round height does not run along their faces.
pub(super) fn cubes(area: f64, cell: f64) -> Cubes {
    let cell = cell.max((CUBES_A_SQUARE * area / MOST_CUBES as f64).sqrt());
    Cubes::new(DVec3::splat(OFFSET * cell), cell, MOST_CUBES)
}

/// Any number without a round neighbour.
const OFFSET: f64 = 0.382;

/// Adds a patch of sloping ground: what lies above the rectangle of x and y between `low` and `high` in the plane through
/// `point` with this `normal`.
pub(super) fn add_patch(
    cubes: &mut Cubes,
    (point, normal): (DVec3, DVec3),
    (low, high): ([f64; 2], [f64; 2]),
    turn: &Turn,
) {
    let corner = |x: f64, y: f64| {
        let rise = -(normal.x * (x - point.x) + normal.y * (y - point.y)) / normal.z;
        turn.to_world(DVec3::new(x, y, point.z + rise))
    };
    let corners =
        [corner(low[0], low[1]), corner(high[0], low[1]), corner(high[0], high[1]), corner(low[0], high[1])];
    let area = (high[0] - low[0]) * (high[1] - low[1]) / normal.z;
    cubes.add(&corners, MARGIN * cubes.cell(), area);
}

/// Adds what a spot of the grain stands for.
pub(super) fn add_spot(cubes: &mut Cubes, spot: &Spot, grain: Grain, turn: &Turn) {
    let (x, y) = (spot.point.x, spot.point.y);
    let (along, across) = (0.5 * grain.along, 0.5 * grain.across * spot.normal.z);
    let (low, high) = ([x - along, y - across], [x + along, y + across]);
    add_patch(cubes, (spot.point, spot.normal), (low, high), turn);
}

/// Adds a piece of a facet whose area is counted elsewhere.
pub(super) fn add_piece(cubes: &mut Cubes, corners: [DVec3; 3], turn: &Turn) {
    cubes.add(&corners.map(|p| turn.to_world(p)), MARGIN * cubes.cell(), 0.0);
}

/// Area of the facets that are surely not seen from above, mm².
pub(super) fn hidden_area(mesh: &TriMesh) -> f64 {
    let hidden = |&i: &usize| mesh.normal(i).is_some_and(|n| n.z <= WALL);
    (0..mesh.triangles.len()).filter(hidden).map(|i| mesh.area(i)).sum()
}

/// What no upright cutter sees: walls, undersides, and what lies below other facets.
pub(super) fn unseen(
    mesh: &TriMesh,
    lowering: &Lowering<'_>,
    cubes: &Cubes,
    turn: &Turn,
    stage: &Stage<'_>,
) -> Result<Zone, Cancelled> {
    let tasks = mesh.triangles.len().div_ceil(TASK);
    let parts = stage.map(tasks, |task| {
        let mut part = cubes.clone();
        for i in task * TASK..mesh.triangles.len().min((task + 1) * TASK) {
            let Some(normal) = mesh.normal(i) else { continue };
            let corners = mesh.corners(i);
            if normal.z <= WALL {
                add(&mut part, corners, turn);
            } else {
                add_covered(&mut part, corners, lowering, turn);
            }
        }
        part
    })?;
    let mut all = cubes.clone();
    parts.into_iter().for_each(|part| all.absorb(part));
    Ok(all.zone())
}

/// Triangles a task.
const TASK: usize = 1000;

fn add(cubes: &mut Cubes, corners: [DVec3; 3], turn: &Turn) {
    let [a, b, c] = corners;
    let area = 0.5 * (b - a).cross(c - a).length();
    cubes.add(&corners.map(|p| turn.to_world(p)), ROUNDING * cubes.cell(), area);
}

/// Adds what of a facet lies below others, in small pieces.
fn add_covered(cubes: &mut Cubes, corners: [DVec3; 3], lowering: &Lowering<'_>, turn: &Turn) {
    for [a, b, c] in pieces(corners, cubes.cell()) {
        let p = (a + b + c) / 3.0;
        if lowering.mesh.top(p.x, p.y).is_some_and(|(z, _)| z > p.z + COVERED) {
            add(cubes, [a, b, c], turn);
        }
    }
}
