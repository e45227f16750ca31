//! Passes one after the other, each moved, piece by piece, to where its strips meet those of the last.

use super::offset::Offset;
use super::upwind::Upwind;
use crate::geometry::{Field, Fronts, Table, Uv};
use crate::monitor::{Cancelled, Stage};
use crate::strategy::StrategyError;
use crate::strategy::family::{Candidate, Detail, Family};
use crate::strategy::placing::{MOST_PASSES, too_many};
use crate::strategy::probe::{Probe, Reach};
use crate::strategy::spacing::Toward;
use glam::DVec3;
use std::sync::Arc;

/// What a person reads meanwhile.
const PHASE: &str = "Spacing passes";
/// How often a pass is moved.
const MOVES: usize = 6;
/// Overlap that is aimed at, and from what is left of a gap or an overlap on a pass is good, in strips.
const OVERLAP: f64 = 0.003;
const GOOD: f64 = 0.0025;
/// Overlap that a whole pass keeps, in strips: what moves later passes moves it by less.
const MARGIN: f64 = 0.001;
/// Beyond this part of a step lines are moved: what lies nearer to the last pass belongs to it.
const MOVED: f64 = 0.3;
/// Over how many strips along a pass what moves it is evened out.
const EVEN: f64 = 1.2;
/// The widest strip that counts for that, in strips on flat ground.
const WIDE: f64 = 4.0;
/// The most that a pass is moved at once, in strips.
const MOST: f64 = 0.3;
/// How far from a start curve that fronts leave to both sides, and meet again, the first passes lie, in strips.
const BESIDE: f64 = 0.485;
/// The least step of whole passes, in strips; beyond that partial passes fill in.
const LEAST: f64 = 0.2;
/// How far beyond the last of passes that do not go on the face is theirs, in strips: others run on into its strip.
const OWN: f64 = 0.2;
/// How often a pass that leaves something open is moved back as a whole.
const SETTLINGS: usize = 12;
/// What partial passes cost, as a share of a whole pass: at least, to begin with, and for the share of columns they are for,
/// beside which they run on a little.
const PARTIAL: f64 = 0.05;
const LENGTH: f64 = 1.5;

/// Passes being laid.
pub(super) struct March<'a, 'b> {
    family: Family<'a>,
    offset: &'b Offset,
    values: Vec<f64>,
}

/// A place on a pass, and by how much the pass lies too far out there, in strips.
struct Pull {
    uv: Uv,
    point: DVec3,
    gap: f64,
}

impl<'a, 'b> March<'a, 'b> {
    /// `family` is that of a table on the grid of `front`, with these `values`.
    pub(super) fn new(family: Family<'a>, offset: &'b Offset, values: Vec<f64>) -> Self {
        Self { family, offset, values }
    }

    /// The family, its passes in the order of their levels, as far as each `goes_on`, and between which levels the face is theirs.
    ///
    /// From a border the first pass is a half strip inside it; from any other start curve it runs along that; and where
    /// fronts run round the face and meet again, beside it.
    pub(super) fn laid(
        mut self,
        is_border: bool,
        goes_on: &dyn Fn(&Family, &Candidate) -> bool,
        stage: &Stage,
    ) -> Result<(Family<'a>, Vec<Candidate>, [f64; 2]), StrategyError> {
        let first = if self.offset.is_round {
            self.family.candidate(BESIDE, 0, Detail::Full, &stage.quiet())?
        } else if is_border {
            self.family.first(&stage.quiet())?
        } else {
            self.family.candidate(0.0, 0, Detail::Full, &stage.quiet())?
        };
        let mut levels = Vec::new();
        let mut own = [f64::NEG_INFINITY, f64::INFINITY];
        if !is_border && !self.offset.is_round {
            own[0] = self.run(&first, Toward::Lower, &mut levels, goes_on, &stage.part(PHASE, 0.0, 0.5))?;
            levels.reverse();
        }
        levels.push(first.level);
        let here = levels.len() - 1;
        own[1] = self.run(&first, Toward::Higher, &mut levels, goes_on, &stage.part(PHASE, 0.5, 1.0))?;
        let index = |i: usize| here % 2 + i;
        let placed = levels
            .iter()
            .enumerate()
            .map(|(i, &level)| self.family.candidate(level, index(i), Detail::Full, &stage.quiet()));
        let placed = placed.collect::<Result<_, _>>()?;
        Ok((self.family, placed, own))
    }

    /// Appends the levels of the passes after `first` towards one side, as far as each `goes_on`; and up to which level the face is
    /// theirs there.
    fn run(
        &mut self,
        first: &Candidate,
        toward: Toward,
        levels: &mut Vec<f64>,
        goes_on: &dyn Fn(&Family, &Candidate) -> bool,
        stage: &Stage,
    ) -> Result<f64, StrategyError> {
        let (sign, before) = (if toward == Toward::Higher { 1.0 } else { -1.0 }, levels.len());
        let fronts = Fronts::new(&self.offset.domain, &self.offset.grid);
        let upwind = Upwind::new(&fronts, &self.offset.grid, &self.values, sign);
        let mut last = self.family.candidate(first.level, 0, Detail::Full, &stage.quiet())?;
        loop {
            stage.at((last.level - first.level).abs() / self.family.levels.length())?;
            let end = if sign > 0.0 { self.family.levels.hi } else { self.family.levels.lo };
            if self.family.ends_family(&last, toward) || sign * (end - last.level) <= self.family.margin() {
                return Ok(sign * f64::INFINITY);
            }
            let index = levels.len() - before + 1;
            if index >= MOST_PASSES {
                return Err(too_many());
            }
            if sign * (end - last.level) < 1.0 {
                // Where fronts meet there is no border to end at, and short passes take what is left.
                let end = self.family.last_toward(&last, toward, index, &stage.quiet())?;
                levels.extend(end.map(|end| end.level));
                return Ok(sign * f64::INFINITY);
            }
            let next = self.next(&last, toward, index, &upwind, stage)?;
            if !goes_on(&self.family, &next) {
                return Ok(last.level + sign * OWN);
            }
            levels.push(next.level);
            last = next;
        }
    }

    fn next(
        &mut self,
        last: &Candidate,
        toward: Toward,
        index: usize,
        upwind: &Upwind,
        stage: &Stage,
    ) -> Result<Candidate, Cancelled> {
        let sign = if toward == Toward::Higher { 1.0 } else { -1.0 };
        let level = last.level + sign;
        let mut next = self.family.candidate(level, index, Detail::Full, &stage.quiet())?;
        for _ in 0..MOVES {
            let pulls = self.pulls(last, &next, toward);
            if pulls.iter().all(|p| p.gap.abs() <= GOOD) {
                break;
            }
            self.shift(&pulls, (last.level, sign), upwind);
            next = self.family.candidate(level, index, Detail::Full, &stage.quiet())?;
        }
        self.settled(last, next, toward, index, stage)
    }

    /// By how much `next` is too far from `last`, wherever its strips can be compared.
    fn pulls(&self, last: &Candidate, next: &Candidate, toward: Toward) -> Vec<Pull> {
        let (sign, back) = match toward {
            Toward::Higher => (1.0, Toward::Lower),
            Toward::Lower => (-1.0, Toward::Higher),
        };
        let setup = &self.family.setup;
        let front = self.family.front(&self.family.relevelled(last), toward);
        let mine = self.family.front(next, back);
        let mut pulls = Vec::new();
        for (line, probes) in next.lines.iter().zip(&next.probes) {
            for (uv, probe) in line.nodes.iter().zip(probes) {
                if let Some(Reach::To { level, column, point, .. }) = probe.reach(back)
                    && let Some(abreast) = front.abreast(level, column, point)
                    && abreast.is_finite()
                    && !mine.is_behind(level, column, point)
                {
                    let gap = sign * (level - abreast) + OVERLAP;
                    let gap = gap.clamp(-MOST, MOST);
                    pulls.push(Pull { uv: *uv, point: setup.face.surface.point(*uv), gap });
                }
            }
        }
        pulls
    }

    /// Moves the level lines beyond `level` by what pulls at the next pass.
    fn shift(&mut self, pulls: &[Pull], (level, sign): (f64, f64), upwind: &Upwind) {
        if pulls.is_empty() {
            return;
        }
        let points = self.offset.grid.points();
        let setup = &self.family.setup;
        // Chosen postures have strips of all widths: here they are what the passes lie apart.
        let apart = |pull: &Pull| {
            let rise = setup.field.surface_gradient(pull.uv, &setup.face.jet(pull.uv)).length();
            if rise > 0.0 { (1.0 / rise).min(WIDE * setup.strip) } else { setup.strip }
        };
        let mean = pulls.iter().map(apart).sum::<f64>() / pulls.len() as f64;
        let width = EVEN * if setup.postures.is_fixed() { setup.strip } else { mean.max(setup.strip) };
        let change = upwind.carried(|node| {
            let t = sign * (self.values[node] - level);
            if t <= 0.0 {
                return Some(0.0);
            }
            if t > 1.7 {
                return None;
            }
            let here = points[node];
            let nearest = pulls.iter().map(|p| p.point.distance_squared(here)).fold(f64::INFINITY, f64::min);
            let (mut sum, mut weights) = (0.0, 0.0);
            for pull in pulls {
                let beyond = (pull.point.distance_squared(here) - nearest) / (2.0 * width * width);
                if beyond < 12.0 {
                    let weight = libm::exp(-beyond);
                    sum += weight * pull.gap;
                    weights += weight;
                }
            }
            let t = ((t - MOVED) / (1.0 - MOVED)).clamp(0.0, 1.0);
            Some(t * t * (3.0 - 2.0 * t) * sum / weights)
        });
        for (value, change) in self.values.iter_mut().zip(change) {
            *value += sign * change;
        }
        let table = Table::new(self.offset.domain, &self.offset.grid, &self.values);
        self.family.set_table(Field::Given(Arc::new(table)), &self.values);
    }

    /// What a partial pass costs beside the length it is for, as a share of the pass `whole`: it runs on at both ends by
    /// about a strip.
    fn overhead(&self, whole: &Candidate) -> f64 {
        let edge = |probe: &Probe, toward| match probe.reach(toward) {
            Some(Reach::To { point, .. }) => Some(point),
            _ => None,
        };
        let strip = |probe: &Probe| Some(edge(probe, Toward::Higher)?.distance(edge(probe, Toward::Lower)?));
        let strips: Vec<f64> = whole.probes.iter().flatten().filter_map(strip).collect();
        let length: f64 = whole.lines.iter().map(|line| line.length(self.family.setup.face)).sum();
        if strips.is_empty() {
            0.0
        } else {
            2.0 * strips.iter().sum::<f64>() / (strips.len() as f64 * length)
        }
    }

    /// `next` as far out as leaves nothing open, or little enough for partial passes.
    fn settled(
        &self,
        last: &Candidate,
        mut next: Candidate,
        toward: Toward,
        index: usize,
        stage: &Stage,
    ) -> Result<Candidate, Cancelled> {
        let (sign, back) = match toward {
            Toward::Higher => (1.0, Toward::Lower),
            Toward::Lower => (-1.0, Toward::Higher),
        };
        let front = self.family.front(&self.family.relevelled(last), toward);
        let overhead = PARTIAL.max(self.overhead(&next));
        for _ in 0..SETTLINGS {
            let gaps = front.gaps(&self.family.front(&next, back)).sorted(sign);
            let Some(&most) = gaps.last() else { return Ok(next) };
            if most <= -0.5 * MARGIN {
                break;
            }
            let count = gaps.len() as f64;
            let mut best = (most, 0.0);
            let mut least = most;
            for (i, &gap) in gaps.iter().enumerate() {
                let open = (gaps.len() - 1 - i) as f64 / count;
                let partial = if open > 0.0 { overhead + LENGTH * open } else { 0.0 };
                let cost = gap.max(-MARGIN) + partial;
                if cost < least {
                    (least, best) = (cost, (gap, open));
                }
            }
            if best.0 <= -0.5 * MARGIN {
                break;
            }
            let away = (sign * (next.level - last.level) - best.0 - MARGIN).max(LEAST);
            let level = last.level + sign * away;
            next = self.family.candidate(level, index, Detail::Full, &stage.quiet())?;
        }
        Ok(next)
    }
}
