//! All lines against all moves.

use super::body::Body;
use super::cells::{Cell, gather};
use super::entry::{Line, TOUCH, first_entry};
use super::motion::{Motion, Piece};
use super::sweeps::Sweeps;
use crate::monitor::{Cancelled, Stage};
use crate::toolpath::Toolpath;
use glam::DVec3;

/// What a sample's line met first.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hit {
    /// Where on the line; infinite where nothing entered it.
    pub(super) t: f64,
    /// Centre of the ball inside the cutter that touches there.
    pub(super) ball: DVec3,
}

impl Hit {
    pub(super) const NONE: Self = Self { t: f64::INFINITY, ball: DVec3::NAN };
}

/// A body on its path, made ready to cut any number of samples.
#[derive(Debug, Clone)]
pub(super) struct Scene {
    pub(super) body: Body,
    motion: Motion,
    sweeps: Sweeps,
    /// Lowest and highest `t` of interest, millimetres.
    from: f64,
    to: f64,
}

/// Samples in one task: small enough that cancelling is prompt and workers share evenly.
const TASK: usize = 2048;

impl Scene {
    pub(super) fn new(body: Body, path: &Toolpath, from: f64, to: f64) -> Self {
        let motion = Motion::new(&body, path);
        let sweeps = Sweeps::new(&body, &motion);
        Self { body, motion, sweeps, from, to }
    }

    /// The first entry of each line `points[i] + t·directions[i]`, in cubes of edge `size`. A direction that is zero
    /// meets nothing.
    pub(super) fn cut(
        &self,
        points: &[DVec3],
        directions: &[DVec3],
        size: f64,
        stage: &Stage,
    ) -> Result<Vec<Hit>, Cancelled> {
        let (order, starts) = gather(points, size, |i| directions[i] != DVec3::ZERO);
        // Whole cells to a task.
        let mut tasks = vec![0];
        for cell in 1..starts.len() {
            let begun = starts[tasks[tasks.len() - 1]] as usize;
            if starts[cell] as usize - begun >= TASK || cell + 1 == starts.len() {
                tasks.push(cell);
            }
        }
        let cut_task = |task: usize| -> Vec<Hit> {
            let mut hits = Vec::new();
            let mut room = Room::default();
            for cell in tasks[task]..tasks[task + 1] {
                let members = &order[starts[cell] as usize..starts[cell + 1] as usize];
                let line = |i: &u32| {
                    let (point, direction) = (points[*i as usize], directions[*i as usize]);
                    Line { point, direction, from: self.from, to: self.to }
                };
                room.lines.clear();
                room.lines.extend(members.iter().map(line));
                self.cut_cell(&mut room, &mut hits);
            }
            hits
        };
        let parts = stage.map(tasks.len() - 1, cut_task)?;
        let mut all = vec![Hit::NONE; points.len()];
        for (i, hit) in order.iter().zip(parts.into_iter().flatten()) {
            all[*i as usize] = hit;
        }
        Ok(all)
    }

    /// Appends the hits of the lines in `room`. Each line's upper end comes down to the best entry found so far, so the
    /// moves nearest to the cell go first.
    fn cut_cell(&self, room: &mut Room, hits: &mut Vec<Hit>) {
        let begin = hits.len();
        hits.resize(begin + room.lines.len(), Hit::NONE);
        let cell = Cell::around(&room.lines);
        self.sweeps.near(&cell.region, &mut room.near);
        room.ranked.clear();
        for &number in &room.near {
            let (least, distance) = self.least(&self.motion.moves()[number as usize], &cell, self.to);
            if least < -TOUCH {
                room.ranked.push((distance, number));
            }
        }
        room.ranked.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut top = self.to;
        for &(_, number) in &room.ranked {
            if self.least(&self.motion.moves()[number as usize], &cell, top).0 >= -TOUCH {
                continue;
            }
            let pieces = self.motion.pieces(number);
            for piece in pieces {
                if pieces.len() > 1 && self.least(piece, &cell, top).0 >= -TOUCH {
                    continue;
                }
                top = f64::NEG_INFINITY;
                for (line, hit) in room.lines.iter_mut().zip(&mut hits[begin..]) {
                    if let Some(entry) = first_entry(&self.body, piece, line) {
                        *hit = Hit { t: entry.t, ball: entry.ball };
                        line.to = entry.t;
                    }
                    top = top.max(line.to);
                }
            }
        }
    }

    /// A lower bound of the distance between the body during `piece` and all lines of `cell` below `top`, and the
    /// distance at mid time that it comes from.
    ///
    /// The distance is convex in space, and in time but for the sag, so the tangent at one point and time bounds it.
    fn least(&self, piece: &Piece, cell: &Cell, top: f64) -> (f64, f64) {
        let x = cell.centre + cell.direction * top;
        let probe = piece.probe(&self.body, 0.5, x, cell.direction);
        let along = probe.by_line;
        let across = (1.0 - along * along).max(0.0).sqrt();
        let turn = piece.half_turn();
        let size = cell.radius + cell.height + top.abs() * cell.spread;
        // Lines also run down from `top`; that brings them closer only where the body is not above.
        let down = (along + cell.spread + turn).max(0.0) * (top - self.from);
        let lateral = across * cell.radius + along.abs() * cell.height + top.abs() * cell.spread;
        let time = 0.5 * probe.by_time.abs() + turn * size + piece.sag(probe.lever);
        (probe.distance - lateral - down - time, probe.distance)
    }
}

/// Working memory of a task.
#[derive(Default)]
struct Room {
    lines: Vec<Line>,
    near: Vec<u32>,
    ranked: Vec<(f64, u32)>,
}
