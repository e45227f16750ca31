//! The best that any position of an upright cutter can do for one point of the mesh.

use super::line::Lowering;
use crate::contact::{DropMesh, drop_cutter_above, is_in_mesh};
use crate::geometry::TriMesh;
use crate::monitor::{Cancelled, Stage};
use glam::{DVec2, DVec3};

/// A point of the mesh, to be finished.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spot {
    pub point: DVec3,
    pub normal: DVec3,
    /// What it stands for, mm².
    pub area: f64,
}

impl Spot {
    /// Where the axis stands when the cutter touches the spot's plane here.
    pub(super) fn axis(&self, lowering: &Lowering<'_>) -> DVec2 {
        let gradient = -self.normal.truncate() / self.normal.z;
        self.point.truncate() - lowering.under.touch_plane(gradient)
    }
}

/// Newton's steps towards the cutter; it doubles its digits each step once near.
const STEPS: usize = 12;

impl Lowering<'_> {
    /// Whether a cutter at `axis`, over the mesh, may be so low that `p` is inside it.
    fn lets_through(&self, p: DVec3, axis: DVec2) -> bool {
        let radius = (p.truncate() - axis).length();
        radius <= self.under.reach()
            && self.mesh.top(axis.x, axis.y).is_some()
            && !is_in_mesh(self.mesh, self.under, axis.extend(p.z - self.under.height(radius)))
    }

    /// What a cutter lowered at `axis` leaves on the spot, along its normal, mm; infinite where the normal misses the
    /// cutter or the cutter the mesh.
    ///
    /// Along the normal the room over the underside is concave, so that Newton's steps from the mesh stay short of the
    /// cutter and close in on it.
    fn excess(&self, spot: &Spot, axis: DVec2) -> f64 {
        if self.mesh.top(axis.x, axis.y).is_none() {
            return f64::INFINITY;
        }
        let Some(drop) = self.at(axis.x, axis.y) else { return f64::INFINITY };
        let mut t = 0.0;
        for _ in 0..STEPS {
            let p = spot.point + t * spot.normal;
            let from = p.truncate() - axis;
            let radius = from.length();
            if radius > self.under.reach() {
                return f64::INFINITY;
            }
            let room = p.z - drop.tip - self.under.height(radius);
            if room >= -1e-9 {
                break;
            }
            let outward = if radius > 0.0 { from / radius } else { DVec2::ZERO };
            let gain = spot.normal.z - self.under.slope(radius) * outward.dot(spot.normal.truncate());
            if gain <= 0.0 {
                return f64::INFINITY;
            }
            t -= room / gain;
        }
        t
    }
}

/// What all positions of the cutter over the mesh, taken together, leave: the tip's heights on a grid, upside down, as a
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
        let size = hi - lo;
        let pitch = (lowering.under.reach() / GRID).max(size.x.max(size.y) / MOST);
        let count = |length: f64| (length / pitch).ceil().max(1.0) as u32 + 1;
        let (nx, ny) = (count(size.x), count(size.y));
        let at = |lo: f64, length: f64, i: u32, n: u32| lo + length * f64::from(i) / f64::from(n - 1);
        let rows = stage.map(ny as usize, |j| {
            let y = at(lo.y, size.y, j as u32, ny);
            let tip = |i| {
                let x = at(lo.x, size.x, i, nx);
                lowering.mesh.top(x, y)?;
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

    /// A place of the axis, over the mesh, from which the lowered cutter leaves at most `limit` on the spot; `None` if
    /// there is none as far as the search sees. The place where the cutter would touch the spot is tried first, then
    /// the deepest cut on the grid, then, by ever shorter steps, whatever place around leaves less.
    pub(super) fn reach(&self, lowering: &Lowering<'_>, spot: &Spot, limit: f64) -> Option<DVec2> {
        let contact = spot.axis(lowering);
        let p = spot.point + limit * spot.normal;
        if lowering.lets_through(p, contact) {
            return Some(contact);
        }
        let hopeless = p.z + SURE * self.pitch / spot.normal.z;
        let deepest = drop_cutter_above(&self.tips, lowering.under, p.x, p.y, -hopeless)?.point.truncate();
        let mut best = (lowering.excess(spot, deepest), deepest);
        if best.0 <= limit {
            return Some(deepest);
        }
        let mut consider = |axis: DVec2| {
            let excess = lowering.excess(spot, axis);
            if excess < best.0 {
                best = (excess, axis);
            }
            best
        };
        let mut now = consider(contact);
        let mut step = self.pitch;
        while now.0 > limit && step > self.pitch * SEARCH_END {
            let old = now.0;
            for way in [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y] {
                now = consider(now.1 + way * step);
                if now.0 <= limit {
                    break;
                }
            }
            if now.0 >= old {
                step *= 0.5;
            }
        }
        (now.0 <= limit).then_some(now.1)
    }
}

/// Last step of the search in grid steps: at the bottom of a groove a hundredth of the radius changes what is left by
/// ten-thousandths of it.
const SEARCH_END: f64 = 0.2;
