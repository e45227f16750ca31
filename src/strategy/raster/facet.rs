//! What slices across the lines miss of facets: the rims, where the mesh has its pits and peaks, and steep ground, which
//! they meet at heights far apart.

use super::ground::{Ground, WALL};
use super::reach::Spot;
use super::turn::Turn;
use crate::geometry::{self, Zone};
use crate::monitor::{Cancelled, Stage};
use glam::DVec3;

/// A piece of a facet, and the spot that tells for it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    pub spot: Spot,
    pub corners: [DVec3; 3],
    /// Whether the spot lies below another facet.
    pub covered: bool,
}

impl Piece {
    /// With the middle as its spot.
    fn of(corners: [DVec3; 3], normal: DVec3) -> Self {
        let point = (corners[0] + corners[1] + corners[2]) / 3.0;
        Self { spot: Spot { point, normal }, corners, covered: false }
    }

    /// Smaller ones, no longer than `longest`.
    pub(super) fn parts(&self, longest: f64) -> impl Iterator<Item = Self> {
        let normal = self.spot.normal;
        geometry::pieces(self.corners, longest).into_iter().map(move |corners| Self::of(corners, normal))
    }
}

/// Facets less steep than this, their normal's z, are seen by the slices well enough but for their rims.
const STEEP: f64 = 0.85;
/// How far inside the spots of a rim stand, in lengths of a piece, so that the facet is the one they are seen on.
const INSIDE: f64 = 0.001;
/// What lies deeper than this below the top, mm, is another layer and not rounding.
pub(super) const COVERED: f64 = 1e-4;
/// Facets a task.
const TASK: usize = 1000;

/// Pieces, about as long as slices are apart, of the rims of all facets and the inside of steep ones, but for those
/// wholly in `beyond`.
pub(super) fn pieces(
    ground: &Ground<'_>,
    beyond: &Zone,
    turn: &Turn,
    stage: &Stage<'_>,
) -> Result<Vec<Piece>, Cancelled> {
    let count = ground.mesh.triangles.len();
    let tasks = stage.map(count.div_ceil(TASK), |task| {
        let facets = task * TASK..count.min((task + 1) * TASK);
        facets.flat_map(|i| of_facet(ground, i, beyond, turn)).collect::<Vec<_>>()
    })?;
    Ok(tasks.concat())
}

fn of_facet(ground: &Ground<'_>, facet: usize, beyond: &Zone, turn: &Turn) -> Vec<Piece> {
    let Some(normal) = ground.mesh.normal(facet).filter(|n| n.z > WALL) else { return Vec::new() };
    let corners = ground.mesh.corners(facet);
    let length = ground.grain.along;
    let steep = if normal.z < STEEP { geometry::pieces(corners, length) } else { Vec::new() };
    let inside = steep.into_iter().map(|corners| Piece::of(corners, normal));
    let look = |piece: Piece| {
        if beyond.holds(&piece.corners.map(|p| turn.to_world(p))) {
            return None;
        }
        let p = piece.spot.point;
        let (z, top) = ground.lowering.mesh.top(p.x, p.y)?;
        let covered = top as usize != facet && z > p.z + COVERED;
        Some(Piece { covered, ..piece })
    };
    rim(corners, normal, length).chain(inside).filter_map(look).collect()
}

/// Pieces along the sides of a facet, at most `length` long and half as deep; spots stand at their beginnings, so that each
/// corner has one.
fn rim(corners: [DVec3; 3], normal: DVec3, length: f64) -> impl Iterator<Item = Piece> {
    let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    let inwards = move |p: DVec3, by: f64| p + (middle - p).clamp_length_max(by);
    (0..3).flat_map(move |side| {
        let (a, b) = (corners[side], corners[(side + 1) % 3]);
        let count = (a.distance(b) / length).ceil().max(1.0);
        let at = move |k: f64| a.lerp(b, (k / count).clamp(0.0, 1.0));
        (0..count as u32).map(move |k| {
            let (k, p) = (f64::from(k), at(f64::from(k)));
            let corners = [at(k - 0.5), at(k + 0.5), inwards(p, 0.5 * length)];
            Piece { spot: Spot { point: inwards(p, INSIDE * length), normal }, corners, covered: false }
        })
    })
}
