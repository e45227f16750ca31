//! The tip's path over one straight line, lowered on the mesh all along.

use crate::contact::{DropMesh, Touch, Underside, drop_cutter};
use glam::{DVec2, DVec3};

/// A lowered cutter at `x` on a line. The tip may stand higher than the contact asks for: then it passes over a wall.
#[derive(Debug, Clone, Copy)]
pub(super) struct Drop {
    pub x: f64,
    pub tip: f64,
    /// Where the cutter touches, and the normal there.
    pub point: DVec3,
    pub normal: DVec3,
}

/// What lowering along a line needs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lowering<'a> {
    pub mesh: &'a DropMesh,
    pub under: &'a Underside,
    /// Radius of the cutter's corner: how sharply the tip's path may bend over an edge.
    pub corner: f64,
    /// How far the path may pass above the mesh, mm.
    pub chord: f64,
}

/// How far a move may pass below a lowered tip that was looked at, mm, and as much again where none was: together below
/// a micrometre.
const GOUGE: f64 = 4e-4;

/// Steps shorter than this, mm, are not halved: where the tip still jumps, at a wall, it rises before it crosses.
const SHORTEST: f64 = 5e-4;

/// Below this, mm, lowered tips stand close enough for any corner: narrower peaks lift the tip by less than a sharp
/// corner is true.
const DENSEST: f64 = 0.01;

/// On a slope of 45° a level step is longer by this, and is still short enough not to be halved.
const LENGTH: f64 = 1.4143;

/// Widest step, mm, on cutters of any size: a pit or peak that would change a chord's middle is seen at this distance.
const WIDEST: f64 = 0.25;

impl Lowering<'_> {
    pub(super) fn at(&self, x: f64, y: f64) -> Option<Drop> {
        drop_cutter(self.mesh, self.under, x, y).map(|touch| {
            let Touch { tip_z: tip, point, normal, .. } = touch;
            Drop { x, tip, point, normal }
        })
    }

    /// The stretches of x over which the cutter on the line at `y` meets the mesh.
    pub(super) fn covered(&self, y: f64) -> Vec<(f64, f64)> {
        self.mesh.covered(y, self.under.reach())
    }

    /// Lowered tips along `y` from `from` to `to`, so close that straight moves between them keep to the tolerances.
    /// Empty where the cutter meets nothing.
    pub(super) fn along(&self, y: f64, from: f64, to: f64) -> Vec<Drop> {
        let widest = self.step();
        let count = ((to - from) / widest).ceil().max(1.0) as usize;
        let mut path: Vec<Drop> = Vec::new();
        for i in 0..=count {
            let x = if i == count { to } else { from + (to - from) * i as f64 / count as f64 };
            let Some(next) = self.at(x, y) else { continue };
            if let Some(&last) = path.last() {
                self.refine(y, last, next, &mut path);
            }
            path.push(next);
        }
        path
    }

    /// The length of a move over whose middle a peak, seen from neither end, stands into the cutter by less than
    /// [`GOUGE`]: no part of the cutter is sharper than its corner.
    fn step(&self) -> f64 {
        (8.0 * GOUGE * self.corner).sqrt().clamp(DENSEST, WIDEST)
    }

    /// Pushes what must stand between `a` and `b`, halving where the move between them strays.
    fn refine(&self, y: f64, a: Drop, b: Drop, path: &mut Vec<Drop>) {
        let width = b.x - a.x;
        if width <= SHORTEST {
            if (b.tip - a.tip).abs() > GOUGE {
                let (low, high) = if a.tip < b.tip { (a, b) } else { (b, a) };
                path.push(Drop { x: low.x, ..high });
            }
            return;
        }
        let Some(middle) = self.at(0.5 * (a.x + b.x), y) else { return };
        let above = -depth(&a, &b, &middle);
        let length = DVec2::new(width, b.tip - a.tip).length();
        if above > 0.5 * self.chord || above < -0.5 * GOUGE || length > LENGTH * self.step() {
            self.refine(y, a, middle, path);
            path.push(middle);
            self.refine(y, middle, b, path);
        } else {
            path.push(middle);
        }
    }

    /// The path without the tips that straight moves between the others pass closely enough.
    pub(super) fn thin(&self, path: &[Drop]) -> Vec<Drop> {
        let mut keep = vec![false; path.len()];
        let (Some(first), Some(last)) = (keep.first().map(|_| 0), path.len().checked_sub(1)) else {
            return Vec::new();
        };
        (keep[first], keep[last]) = (true, true);
        let mut open = vec![(first, last)];
        while let Some((i, j)) = open.pop() {
            let mut worst = (1.0, None);
            for (k, drop) in path.iter().enumerate().take(j).skip(i + 1) {
                let depth = depth(&path[i], &path[j], drop);
                let strain = if depth > 0.0 { depth / GOUGE } else { -2.0 * depth / self.chord };
                if strain > worst.0 {
                    worst = (strain, Some(k));
                }
            }
            if let (_, Some(k)) = worst {
                keep[k] = true;
                open.push((i, k));
                open.push((k, j));
            }
        }
        path.iter().zip(keep).filter_map(|(drop, keep)| keep.then_some(*drop)).collect()
    }
}

/// How deep below `p` the move from `a` to `b` passes, square to the move; negative where it passes above.
fn depth(a: &Drop, b: &Drop, p: &Drop) -> f64 {
    let along = DVec2::new(b.x - a.x, b.tip - a.tip);
    let length = along.length();
    let to = DVec2::new(p.x - a.x, p.tip - a.tip);
    if length > 0.0 { along.perp_dot(to) / length } else { to.length() }
}
