//! Steep, narrow facets, which slices across the lines may step over.

use super::ground::{Ground, WALL};
use super::reach::Spot;
use crate::geometry::pieces;
use crate::monitor::{Cancelled, Stage};
use glam::DVec3;

/// A piece of a facet, and the spot in its middle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sliver {
    pub spot: Spot,
    pub corners: [DVec3; 3],
}

/// Facets less steep than this, their normal's z, are seen by the slices well enough: their neighbours' cusps run on over
/// them.
const STEEP: f64 = 0.6;
/// Facets a task.
const TASK: usize = 1000;

/// Pieces, no longer than two slices are wide, of all steep facets that are seen from above and too narrow along x for the slices.
pub(super) fn slivers(ground: &Ground<'_>, stage: &Stage<'_>) -> Result<Vec<Sliver>, Cancelled> {
    let count = ground.mesh.triangles.len();
    let tasks = stage.map(count.div_ceil(TASK), |task| {
        let facets = task * TASK..count.min((task + 1) * TASK);
        facets.flat_map(|i| of_facet(ground, i)).collect::<Vec<_>>()
    })?;
    Ok(tasks.concat())
}

fn of_facet(ground: &Ground<'_>, facet: usize) -> Vec<Sliver> {
    let Some(normal) = ground.mesh.normal(facet).filter(|n| n.z > WALL && n.z < STEEP) else {
        return Vec::new();
    };
    let corners = ground.mesh.corners(facet);
    let xs = corners.map(|c| c.x);
    let width = xs[0].max(xs[1]).max(xs[2]) - xs[0].min(xs[1]).min(xs[2]);
    if width > ground.grain.along {
        return Vec::new();
    }
    let seen = |p: DVec3| ground.lowering.mesh.top(p.x, p.y).is_some_and(|(_, top)| top as usize == facet);
    pieces(corners, 2.0 * ground.grain.along)
        .into_iter()
        .map(|corners| Sliver {
            spot: Spot { point: (corners[0] + corners[1] + corners[2]) / 3.0, normal },
            corners,
        })
        .filter(|sliver| seen(sliver.spot.point))
        .collect()
}
