//! The best that any position of an upright cutter can do for one point of the mesh.

use super::line::Lowering;
use crate::contact::{DropMesh, drop_cutter_above, is_in_mesh};
use crate::geometry::TriMesh;
use crate::math::angle::direction;
use crate::monitor::{Cancelled, Stage};
use glam::{DVec2, DVec3};
use std::f64::consts::FRAC_PI_4;

/// A point of the mesh, to be finished.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spot {
    pub point: DVec3,
    pub normal: DVec3,
}

impl Spot {
    /// Where the axis stands when the cutter touches the spot's plane here.
    pub(super) fn axis(&self, lowering: &Lowering<'_>) -> DVec2 {
        let gradient = -self.normal.truncate() / self.normal.z;
        self.point.truncate() - lowering.under.touch_plane(gradient)
    }
}

impl Lowering<'_> {
    /// Whether a cutter at `axis` may be so low that `p` is inside it.
    fn lets_through(&self, p: DVec3, axis: DVec2) -> bool {
        let radius = (p.truncate() - axis).length();
        radius <= self.under.reach()
            && !is_in_mesh(self.mesh, self.under, axis.extend(p.z - self.under.height(radius)))
    }
}

/// What all positions of the cutter, taken together, leave: the tip's heights on a grid, upside down, as a
/// mesh to lower the same cutter on. It touches where the position stands that cuts deepest.
#[derive(Debug)]
pub(super) struct Closing {
    tips: DropMesh,
    pitch: f64,
}

/// Positions on the grid in one cutter radius.
const GRID: f64 = 15.0;
/// Most positions along a side of the grid: seconds of work.
const MOST: f64 = 1500.0;

/// By how much, in grid steps and along the normal, a spot must lie beyond what the grid reaches to be given up without
/// a closer search.
const SURE: f64 = 0.25;

impl Closing {
    pub(super) fn new(
        lowering: &Lowering<'_>,
        (lo, hi): (DVec3, DVec3),
        stage: &Stage<'_>,
    ) -> Result<Self, Cancelled> {
        let beyond = DVec2::splat(lowering.under.reach()).extend(0.0);
        let (lo, size) = (lo - beyond, hi - lo + 2.0 * beyond);
        let pitch = (lowering.under.reach() / GRID).max(size.x.max(size.y) / MOST);
        let count = |length: f64| (length / pitch).ceil().max(1.0) as u32 + 1;
        let (nx, ny) = (count(size.x), count(size.y));
        let at = |lo: f64, length: f64, i: u32, n: u32| lo + length * f64::from(i) / f64::from(n - 1);
        let rows = stage.map(ny as usize, |j| {
            let y = at(lo.y, size.y, j as u32, ny);
            let tip = |i| {
                let x = at(lo.x, size.x, i, nx);
                lowering.at(x, y).map(|drop| DVec3::new(x, y, -drop.tip))
            };
            (0..nx).map(tip).collect::<Vec<_>>()
        })?;
        let tips: Vec<Option<DVec3>> = rows.concat();
        let mut triangles = Vec::new();
        for j in 0..ny - 1 {
            for i in 0..nx - 1 {
                let a = j * nx + i;
                for triangle in [[a, a + 1, a + nx + 1], [a, a + nx + 1, a + nx]] {
                    if triangle.iter().all(|&k| tips[k as usize].is_some()) {
                        triangles.push(triangle);
                    }
                }
            }
        }
        let vertices = tips.into_iter().map(Option::unwrap_or_default).collect();
        Ok(Self { tips: DropMesh::new(&TriMesh { vertices, triangles }), pitch })
    }

    /// A place of the axis from which the lowered cutter leaves at most `limit` on the spot; `None` if
    /// there is none as far as the search sees. The place where the cutter would touch the spot is tried first, then
    /// the deepest cut on the grid, then rings around that.
    pub(super) fn reach(&self, lowering: &Lowering<'_>, spot: &Spot, limit: f64) -> Option<DVec2> {
        let contact = spot.axis(lowering);
        let p = spot.point + limit * spot.normal;
        if lowering.lets_through(p, contact) {
            return Some(contact);
        }
        let hopeless = p.z + SURE * self.pitch / spot.normal.z;
        let deepest = drop_cutter_above(&self.tips, lowering.under, p.x, p.y, -hopeless)?.point.truncate();
        let ring =
            |radius: f64| (0..8).map(move |i| direction(f64::from(i) * FRAC_PI_4) * radius * self.pitch);
        std::iter::once(DVec2::ZERO)
            .chain(RINGS.into_iter().flat_map(ring))
            .map(|off| deepest + off)
            .find(|&axis| lowering.lets_through(p, axis))
    }
}

/// Radii of the rings, in grid steps. A third ring, of a whole step, found one place in a thousand more on rough terrain.
const RINGS: [f64; 2] = [0.5, 0.25];
