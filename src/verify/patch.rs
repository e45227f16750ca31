//! Pieces of surface that the cutter provably leaves alone.

use super::cells::{Cell, Seen, halve, share_out};
use super::cut::{Scene, TASK};
use super::entry::{Line, TOUCH};
use super::motion::{Piece, Probe};
use super::samples::Sample;
use super::sweeps::Candidate;
use crate::monitor::{Cancelled, Stage};
use glam::DVec3;

/// Halvings in time of a part that may reach a patch: what its turn leaves in doubt falls with each by a half.
const HALVINGS: u32 = 6;
/// Ways along which the nearest place is sought, and looks on each: the body is far blunter across one way than the other,
/// so two ways find it nearly, and a look costs less than another sample.
const LINES: usize = 2;
const LOOKS: usize = 3;

/// The surface between three samples.
#[derive(Debug, Clone, Copy)]
pub(super) struct Patch {
    lines: [Line; 3],
    /// How far the surface may be from the plane of its corners.
    bow: f64,
    number: u32,
}

impl Patch {
    fn middle(&self) -> DVec3 {
        let [a, b, c] = self.lines.map(|line| line.point);
        (a + b + c) / 3.0
    }
}

impl Scene {
    /// For each triangle of samples and its bow whether nothing, anywhere on the surface between them and at any time, goes
    /// deeper than `depth`. A `false` proves nothing.
    ///
    /// A patch is a cell like any other: the tangents that rule out a body for all of its lines do so for those between
    /// the samples too, with what their surface may bend. The bound is as sharp as the cutter is blunt *there*: its foot,
    /// at a small lead, is far flatter than its corner.
    pub(super) fn spares(
        &self,
        triangles: &[([&Sample; 3], f64)],
        depth: f64,
        stage: &Stage,
    ) -> Result<Vec<bool>, Cancelled> {
        let line = |sample: &Sample| Line {
            point: sample.point,
            direction: sample.normal,
            from: self.from,
            to: -depth,
        };
        if -depth <= self.from {
            // Below that nothing is looked for.
            return Ok(vec![true; triangles.len()]);
        }
        let patch = |(i, (samples, bow)): (usize, &([&Sample; 3], f64))| Patch {
            lines: samples.map(line),
            bow: *bow,
            number: i as u32,
        };
        let mut patches: Vec<Patch> = triangles.iter().enumerate().map(patch).collect();
        let tasks = share_out(&mut patches, TASK, |p| [p.middle(); 2], |p| p.number);
        let spared = stage.map(tasks.len(), |task| {
            let mut spared = Vec::new();
            let mut near = Vec::from_iter(self.sweeps.root());
            self.spare(&mut tasks[task].to_vec(), &mut near, 0, &mut spared);
            spared
        })?;
        let mut all = vec![false; triangles.len()];
        spared.into_iter().flatten().for_each(|number| all[number as usize] = true);
        Ok(all)
    }

    /// Appends the numbers of those `patches` that nothing in `near` from `begin` on reaches.
    fn spare(&self, patches: &mut [Patch], near: &mut Vec<Candidate>, begin: usize, spared: &mut Vec<u32>) {
        let bow = patches.iter().map(|p| p.bow).fold(0.0, f64::max);
        let cell = Cell::around(patches.iter().flat_map(|p| &p.lines)).between(bow);
        let (end, last) = (near.len(), patches.len() <= 1);
        for i in begin..end {
            self.sweeps.sift(&self.body, &cell, near[i], last, near);
        }
        let reached = near[end..].iter().any(|candidate| match candidate {
            Candidate::Part(number, _) if last => self.reaches(&cell, self.sweeps.part(*number), HALVINGS),
            _ => true,
        });
        if !reached {
            spared.extend(patches.iter().map(|p| p.number));
        } else if !last {
            let middle = halve(patches, |p| [p.middle(); 2], |p| p.number);
            let (left, right) = patches.split_at_mut(middle);
            self.spare(left, near, end, spared);
            self.spare(right, near, end, spared);
        }
        near.truncate(end);
    }

    /// Whether the body may enter `cell` during `piece`, looked at closer while only its motion leaves a doubt.
    fn reaches(&self, cell: &Cell, piece: &Piece, left: u32) -> bool {
        let look = |x: DVec3| piece.probe(&self.body, 0.5, x, cell.direction);
        let first = look(cell.place());
        if cell.least(&seen(piece, &first)) >= -TOUCH {
            return false;
        }
        // Then from beside the middle, where the body comes nearest: there the tangent is level.
        let square = |probe: &Probe| probe.gradient - cell.direction * probe.by_line;
        let (mut aside, mut here) = (DVec3::ZERO, first);
        for _ in 0..LINES {
            let Some(downhill) = (-square(&here)).try_normalize() else { return true };
            let (from, mut step) = (aside, cell.reach(aside, downhill));
            let (mut near, mut far) = ((0.0, here), None::<(f64, Probe)>);
            for _ in 0..LOOKS {
                let place = from + downhill * step;
                let probe = look(cell.place() + place);
                let lateral = square(&probe);
                if cell.least_aside(&seen(piece, &probe), place, lateral) >= -TOUCH {
                    return false;
                }
                let still = Seen { nearer: 0.0, turn: 0.0, ..seen(piece, &probe) };
                if cell.least_aside(&still, place, lateral) >= -TOUCH {
                    let halves = || [0, 1].map(|half| piece.part(half, 2)).into_iter();
                    return left == 0 || halves().any(|half| self.reaches(cell, &half, left - 1));
                }
                (aside, here) = (place, probe);
                if lateral.dot(downhill) > 0.0 {
                    far = Some((step, probe));
                } else {
                    near = (step, probe);
                }
                let Some(far) = far else { break };
                let slope = |end: &(f64, Probe)| square(&end.1).dot(downhill);
                let (a, b) = (slope(&near), slope(&far));
                step = near.0 + (far.0 - near.0) * a / (a - b);
            }
        }
        true
    }
}

fn seen(piece: &Piece, probe: &Probe) -> Seen {
    let nearer = 0.5 * probe.by_time.abs() + piece.sag(probe.lever);
    Seen { distance: probe.distance, by_line: probe.by_line, nearer, turn: piece.half_turn() }
}
