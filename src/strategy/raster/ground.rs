//! The ground as it is seen from above, looked at in slices across the lines.

use super::cut::Lines;
use super::line::Lowering;
use super::reach::{Closing, Spot};
use crate::geometry::TriMesh;
use glam::{DVec2, DVec3};

/// How finely the mesh is looked at, mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grain {
    /// Along the lines.
    pub along: f64,
    /// Across them, over the ground.
    pub across: f64,
}

/// What must be left below, mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    /// What the lines may leave at a closely looked at spot.
    pub lines: f64,
    /// What they may leave at a spot of the grain without a closer look around.
    pub strict: f64,
    /// What any single position of the cutter must be able to stay below for a spot to count as within reach.
    pub single: f64,
}

/// A facet whose normal's z is at most this is a wall.
pub(super) const WALL: f64 = 0.02;

/// What is cut and with what.
#[derive(Clone, Copy)]
pub(super) struct Ground<'a> {
    pub mesh: &'a TriMesh,
    pub lowering: &'a Lowering<'a>,
    pub best: &'a Closing,
    pub grain: Grain,
    pub limits: Limits,
    pub bounds: (DVec3, DVec3),
}

/// A spot and what it stands for: from where to where across.
#[derive(Debug, Clone, Copy)]
pub(super) struct Patch {
    pub spot: Spot,
    pub from: f64,
    pub to: f64,
}

/// Spots to a closer look at a patch.
const CLOSELY: u32 = 4;
/// A step across that takes the ground farther than this many grains is halved: it went over a riser.
const FARTHEST: f64 = 1.5;
/// The shortest step across, in grains: on steep ground, and to find the foot of a riser.
const SHORTEST: f64 = 0.05;

impl Ground<'_> {
    /// Number of slices, and their width.
    pub(super) fn slices(&self) -> (usize, f64) {
        let length = self.bounds.1.x - self.bounds.0.x;
        let count = (length / self.grain.along).ceil().max(1.0);
        (count as usize, length / count)
    }

    /// The x of a slice.
    pub(super) fn x(&self, slice: usize) -> f64 {
        self.bounds.0.x + self.slices().1 * (slice as f64 + 0.5)
    }

    /// The patches of a slice by rising y, spaced evenly over the ground.
    pub(super) fn patches(&self, slice: usize) -> Vec<Patch> {
        let (x, grain) = (self.x(slice), self.grain.across);
        let shortest = SHORTEST * grain;
        let end = self.bounds.1.y;
        let mut patches: Vec<Patch> = Vec::new();
        let mut y = self.bounds.0.y + 0.5 * shortest;
        let mut seen = self.spot(x, y);
        while y < end {
            let Some(spot) = seen else {
                y += 2.0 * shortest;
                seen = self.spot(x, y);
                continue;
            };
            let rise = spot.normal.y / spot.normal.z;
            let mut step = (grain / (1.0 + rise * rise).sqrt()).max(shortest);
            seen = self.spot(x, y + step);
            while step > 2.0 * shortest
                && seen.is_none_or(|next| next.point.distance(spot.point) > FARTHEST * grain)
            {
                step *= 0.5;
                seen = self.spot(x, y + step);
            }
            let from = patches
                .last()
                .filter(|p| p.to >= y)
                .map_or(y - 0.5 * step.min(grain), |p| 0.5 * (p.spot.point.y + y));
            if let Some(last) = patches.last_mut().filter(|p| p.to >= y) {
                last.to = from;
            }
            patches.push(Patch { spot, from: from.max(self.bounds.0.y), to: y + step });
            y += step;
        }
        // Where ground ended, the last patch reaches half a step and no farther.
        for i in 0..patches.len() {
            let joined = patches.get(i + 1).is_some_and(|next| next.from <= patches[i].to);
            if !joined {
                let patch = &mut patches[i];
                patch.to = (0.5 * (patch.spot.point.y + patch.to)).min(end);
            }
        }
        patches
    }

    /// Closer parts of a patch.
    pub(super) fn closely(&self, patch: &Patch) -> impl Iterator<Item = Patch> {
        let (x, from, width) = (patch.spot.point.x, patch.from, (patch.to - patch.from) / f64::from(CLOSELY));
        (0..CLOSELY).filter_map(move |i| {
            let from = from + width * f64::from(i);
            let spot = self.spot(x, from + 0.5 * width)?;
            Some(Patch { spot, from, to: from + width })
        })
    }

    /// The spot seen at `(x, y)`; `None` beside the mesh and on walls.
    fn spot(&self, x: f64, y: f64) -> Option<Spot> {
        let (z, triangle) = self.lowering.mesh.top(x, y)?;
        let normal = self.mesh.normal(triangle as usize).filter(|n| n.z > WALL)?;
        Some(Spot { point: DVec3::new(x, y, z), normal })
    }

    /// Area of a patch, mm².
    pub(super) fn area(&self, patch: &Patch) -> f64 {
        (patch.to - patch.from) * self.slices().1 / patch.spot.normal.z
    }

    /// Whether the lines leave less than `limit` on the spot; `axis` is where the cutter that cuts it most likely stands.
    pub(super) fn is_low(&self, lines: &Lines, limit: f64, spot: &Spot, axis: DVec2) -> bool {
        lines.cuts(self.lowering.under, spot.point + limit * spot.normal, axis)
    }
}
