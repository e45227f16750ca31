//! All lines against all moves.

use super::body::Body;
use super::cells::{Cell, halve, share_out};
use super::entry::{Line, enter};
use super::samples::Sample;
use super::sweeps::{Candidate, Sweeps};
use crate::math::order::sort_by_key;
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
    /// The part of the motion that cut it, in [`Sweeps`]' order.
    pub(super) part: u32,
    /// That part's parameter then.
    pub(super) time: f64,
}

impl Hit {
    pub(super) const NONE: Self = Self { t: f64::INFINITY, ball: DVec3::NAN, part: 0, time: f64::NAN };
}

/// A body on its path, made ready to cut any number of samples.
#[derive(Debug, Clone)]
pub(super) struct Scene {
    pub(super) body: Body,
    pub(super) sweeps: Sweeps,
    /// Lowest and highest `t` of interest, millimetres.
    pub(super) from: f64,
    pub(super) to: f64,
}

/// Samples in one task at most: few enough that cancelling is prompt and workers share evenly, many enough that the
/// search for what comes near at all is shared.
pub(super) const TASK: usize = 1024;
/// A cell of so many lines, or down to half as many, is cut by the part nearest to it before it is halved: what is far
/// above that cut need not be looked at again. In larger cells one part is near to few. 32 and 128 are slower.
const TRIED: usize = 64;
/// Lines in the smallest cells, and parts so few that halving a cell again costs more than trying them on each of its
/// lines. Of 3 to 16 either way these were best on a dome with dense samples; on a blade with sparse ones all are alike.
const SMALLEST: usize = 6;
const FEW: usize = 8;

/// A line on its way through the cells, and what it met so far.
#[derive(Debug, Clone, Copy)]
struct Job {
    number: u32,
    line: Line,
    hit: Hit,
}

impl Scene {
    pub(super) fn new(body: Body, path: &Toolpath, from: f64, to: f64) -> Self {
        let sweeps = Sweeps::new(&body, path);
        Self { body, sweeps, from, to }
    }

    /// The line of interest through `sample`.
    pub(super) fn line(&self, sample: &Sample) -> Line {
        Line { point: sample.point, direction: sample.normal, from: self.from, to: self.to }
    }

    /// The first entry of each of `count` lines, which begin at the scene's lowest `t`. One without a direction meets nothing.
    pub(super) fn cut(
        &self,
        count: usize,
        line: impl Fn(usize) -> Line + Sync,
        stage: &Stage,
    ) -> Result<Vec<Hit>, Cancelled> {
        let ends = |i: &u32| {
            let Line { point, direction, from, .. } = line(*i as usize);
            [point, point + direction * from]
        };
        let mut order: Vec<u32> =
            (0..count as u32).filter(|&i| line(i as usize).direction != DVec3::ZERO).collect();
        let tasks = share_out(&mut order, TASK, ends, |i| *i);
        let cut_task = |task: usize| -> Vec<(u32, Hit)> {
            let job = |&i: &u32| Job { number: i, line: line(i as usize), hit: Hit::NONE };
            let mut jobs: Vec<Job> = tasks[task].iter().map(job).collect();
            let mut near = Vec::from_iter(self.sweeps.root());
            self.cut_cell(&mut jobs, &mut near, 0);
            jobs.iter().map(|job| (job.number, job.hit)).collect()
        };
        let mut all = vec![Hit::NONE; count];
        for (number, hit) in stage.map(tasks.len(), cut_task)?.into_iter().flatten() {
            all[number as usize] = hit;
        }
        Ok(all)
    }

    /// Cuts `jobs` with what is in `near` from `begin` on; leaves `near` as it was. Each line's upper end comes down to
    /// the best entry found so far.
    ///
    /// Cells are halved down to a few lines, and each half is left with what of its parent's candidates can still reach it.
    fn cut_cell(&self, jobs: &mut [Job], near: &mut Vec<Candidate>, begin: usize) {
        if jobs.is_empty() {
            return;
        }
        let smallest = jobs.len() <= SMALLEST;
        let cell = Cell::around(jobs.iter().map(|job| &job.line));
        let end = near.len();
        for i in begin..end {
            self.sweeps.sift(&self.body, &cell, near[i], smallest, near);
        }
        let is_part = |candidate: &Candidate| matches!(candidate, Candidate::Part(..));
        if smallest || (near.len() - end <= FEW && near[end..].iter().all(is_part)) {
            sort_by_key(&mut near[end..], Candidate::by_distance);
            for candidate in &near[end..] {
                self.try_on(jobs, *candidate);
            }
        } else if near.len() > end {
            if (TRIED / 2 + 1..=TRIED).contains(&jobs.len())
                && let Some(nearest) = near[end..].iter().min_by_key(|candidate| candidate.by_distance())
            {
                self.try_on(jobs, *nearest);
            }
            let ends = |job: &Job| [job.line.point, job.line.at(self.from)];
            let middle = halve(jobs, ends, |job| job.number);
            let (left, right) = jobs.split_at_mut(middle);
            self.cut_cell(left, near, end);
            self.cut_cell(right, near, end);
        }
        near.truncate(end);
    }

    fn try_on(&self, jobs: &mut [Job], candidate: Candidate) {
        let Candidate::Part(number, _) = candidate else { return };
        for job in jobs {
            if let Some(entry) = enter(&self.body, self.sweeps.part(number), &job.line) {
                job.hit = Hit { t: entry.t, ball: entry.ball, part: number, time: entry.time };
                job.line.to = entry.t;
            }
        }
    }
}
