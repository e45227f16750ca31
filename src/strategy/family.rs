//! Passes along the level lines of a field, each as far from the last as its strips allow.

use super::probe::{Probe, Setup};
use super::spacing::{Front, Toward};
use super::walk;
use super::{Finish, Order, Planned, StrategyError};
use crate::contact::FaceObstacle;
use crate::cutter::Cutter;
use crate::geometry::{Domain, Face, FaceGrid, Field, FieldGrid, IsoLine, Range, Zone};
use crate::monitor::{Cancelled, Stage};
use crate::toolpath::{Pass, Posture};

/// Most passes of one plan: beyond it the limit and the part do not fit each other.
const MOST_PASSES: usize = 20_000;

/// A family of level lines and the strips on them.
pub(super) struct Family<'a> {
    setup: Setup<'a>,
    lines: FieldGrid,
    /// Levels run in here; periodic where the last pass meets the first again.
    levels: Range,
    column_period: Option<f64>,
    order: Order,
}

/// The lines of one level, probed.
struct Candidate {
    level: f64,
    probes: Vec<Vec<Probe>>,
}

impl<'a> Family<'a> {
    /// The level lines of `field` on `face`, for a cutter held at `posture`.
    pub(super) fn new(
        face: &'a Face,
        cutter: &'a Cutter,
        posture: Posture,
        finish: Finish,
        (field, column): (Field, Field),
        order: Order,
    ) -> Self {
        let cell = probe_spacing(cutter, posture, &finish);
        let lines = FieldGrid::new(face, field, FaceGrid::new(face, cell, 24, 1200));
        let obstacle = FaceObstacle::new(face, obstacle_cell(cutter));
        let domain = face.domain();
        let (low, high) = lines.range();
        let levels = parameter_range(&domain, field).unwrap_or(Range::open(low, high));
        let column_period = parameter_range(&domain, column).filter(|r| r.periodic).map(|r| r.length());
        let setup = Setup { face, obstacle, cutter, posture, finish, field, column };
        Self { setup, lines, levels, column_period, order }
    }

    /// The passes, from the lowest level to the highest.
    pub(super) fn plan(&self, stage: &Stage) -> Result<Planned, StrategyError> {
        let levels = self.place(&stage.part("Spacing passes", 0.0, 0.7))?;
        let passes = self.walk(&levels, &stage.part("Following the surface", 0.7, 0.95))?;
        let unreached = self.unreached(&stage.part("Mapping what is unreachable", 0.95, 1.0))?;
        if passes.is_empty() {
            let why = "it gouges at every point in this posture; try more lead, or a smaller cutter";
            return Err(StrategyError::FitsNowhere(why.into()));
        }
        Ok(Planned { passes, unreached })
    }

    /// The levels at which passes run.
    fn place(&self, stage: &Stage) -> Result<Vec<f64>, StrategyError> {
        let first = self.first(stage)?;
        let mut levels = vec![first.level];
        let mut front = self.front(&first, Toward::Higher);
        let start = self.front(&first, Toward::Lower).raised(self.levels.length());
        let mut step = (front.lowest() - first.level).min(self.levels.length());
        if !(step > 0.0) {
            step = 0.05 * self.levels.length();
        }
        loop {
            let from = *levels.last().unwrap_or(&self.levels.lo);
            stage.at((from - self.levels.lo) / self.levels.length())?;
            let done = if self.levels.periodic {
                front.gap(&start).is_none_or(|gap| gap <= 0.0)
            } else {
                front.is_empty()
            };
            if done || from >= self.levels.hi {
                return Ok(levels);
            }
            if levels.len() >= MOST_PASSES {
                let why = "raise the scallop limit, or take a larger cutter".into();
                return Err(StrategyError::TooMany { most: MOST_PASSES, why });
            }
            let next = self.next(&front, from, step, levels.len(), stage)?;
            step = next.level - from;
            front = self.front(&next, Toward::Higher);
            levels.push(next.level);
        }
    }

    /// The first pass: as far in as its strips still run over the border everywhere.
    fn first(&self, stage: &Stage) -> Result<Candidate, Cancelled> {
        let lo = self.levels.lo;
        // A hair inside, since a section through the very corner of a face is a point.
        let edge = self.candidate(lo + 1e-9 * self.levels.length(), 0, stage)?;
        if self.levels.periodic {
            return Ok(edge);
        }
        let reach = self.front(&edge, Toward::Higher).lowest() - lo;
        let reach = if reach.is_finite() { reach } else { 0.02 * self.levels.length() };
        let fits = |c: &Candidate| c.has_strips() && self.front(c, Toward::Lower).is_empty();
        let mut best = edge;
        let (mut inside, mut outside) = (0.0, reach.clamp(1e-6 * self.levels.length(), self.levels.length()));
        // A thousandth of the first strip is nothing in the length of a path.
        for _ in 0..12 {
            let middle = 0.5 * (inside + outside);
            let candidate = self.candidate(lo + middle, 0, stage)?;
            if fits(&candidate) {
                (inside, best) = (middle, candidate);
            } else {
                outside = middle;
            }
        }
        Ok(best)
    }

    /// The next pass after the one at `from`: the farthest whose strips still meet `front`.
    fn next(
        &self,
        front: &Front,
        from: f64,
        guess: f64,
        index: usize,
        stage: &Stage,
    ) -> Result<Candidate, Cancelled> {
        let most = self.levels.length() - (from - self.levels.lo);
        let gap_at = |step: f64| -> Result<(f64, Candidate), Cancelled> {
            let candidate = self.candidate(from + step, index, stage)?;
            let gap = front.gap(&self.front(&candidate, Toward::Lower));
            // Where nothing lies abreast a smaller step is tried, down to a quarter of the last.
            let gap = gap.unwrap_or(if step > 0.25 * guess { guess } else { -guess });
            Ok((gap, candidate))
        };
        let least = 1e-4 * guess.max(1e-6 * self.levels.length());
        let (mut low, mut low_gap) = (0.0, -guess);
        let mut best: Option<Candidate> = None;
        let mut high = None;
        let mut step = guess.min(most);
        for _ in 0..40 {
            let (gap, candidate) = gap_at(step)?;
            if gap > 0.0 {
                high = Some((step, gap));
                break;
            }
            (low, low_gap, best) = (step, gap, Some(candidate));
            if step >= most {
                break;
            }
            step = (step * 1.3).min(most);
        }
        let Some((mut high, mut high_gap)) = high else {
            return self.last(best, low, from, index, stage);
        };
        // The gap grows nearly linearly with the step; half a percent of a step is half a percent of the path.
        let tolerance = 0.005;
        for k in 0..30 {
            if (low > 0.0 && high - low < tolerance * high) || high < least {
                break;
            }
            let secant = (high_gap * low - low_gap * high) / (high_gap - low_gap);
            // Aim a little below the root, so that what comes back is mostly a step that holds.
            let aim = if k % 4 == 3 { 0.5 * (low + high) } else { secant - 0.3 * tolerance * high };
            let step = aim.clamp(low + 0.05 * (high - low), high - 0.05 * (high - low));
            let (gap, candidate) = gap_at(step)?;
            if gap > 0.0 {
                (high, high_gap) = (step, gap);
            } else {
                (low, low_gap, best) = (step, gap, Some(candidate));
                if gap > -tolerance * step {
                    break;
                }
            }
        }
        match best {
            Some(candidate) => Ok(candidate),
            // No step closes the gap (the field stands still there): go on by the smallest.
            None => self.candidate(from + high.max(least).min(most), index, stage),
        }
    }

    /// The last pass: as far from the border as its strips still run over it everywhere.
    fn last(
        &self,
        at_border: Option<Candidate>,
        step: f64,
        from: f64,
        index: usize,
        stage: &Stage,
    ) -> Result<Candidate, Cancelled> {
        let mut best = match at_border {
            Some(candidate) => candidate,
            None => self.candidate(self.levels.hi, index, stage)?,
        };
        let (mut outside, mut inside) = (0.0, step);
        for _ in 0..10 {
            let middle = 0.5 * (inside + outside);
            let candidate = self.candidate(from + middle, index, stage)?;
            if candidate.has_strips() && self.front(&candidate, Toward::Higher).is_empty() {
                (inside, best) = (middle, candidate);
            } else {
                outside = middle;
            }
        }
        Ok(best)
    }

    fn front(&self, candidate: &Candidate, toward: Toward) -> Front {
        Front::new(&candidate.probes, toward, self.column_period)
    }

    fn reversed(&self, index: usize) -> bool {
        self.order == Order::ZigZag && index % 2 == 1
    }

    fn candidate(&self, level: f64, index: usize, stage: &Stage) -> Result<Candidate, Cancelled> {
        // At the very ends a section may be a single point.
        let margin = 1e-9 * self.levels.length();
        let level = if self.levels.periodic {
            level
        } else {
            level.clamp(self.levels.lo + margin, self.levels.hi - margin)
        };
        let lines = self.lines.lines(level);
        let reversed = self.reversed(index);
        let nodes: Vec<_> = lines.iter().flat_map(|line| &line.nodes).collect();
        let mut flat = stage.quiet().map(nodes.len(), |i| self.setup.probe(*nodes[i], reversed))?.into_iter();
        let probes = lines.iter().map(|line| flat.by_ref().take(line.nodes.len()).collect()).collect();
        Ok(Candidate { level, probes })
    }

    /// The passes on the lines of `levels`.
    fn walk(&self, levels: &[f64], stage: &Stage) -> Result<Vec<Pass>, Cancelled> {
        let per_level = stage.map(levels.len(), |i| {
            let reversed = self.reversed(i);
            let mut lines: Vec<IsoLine> = self.lines.lines(levels[i]);
            if reversed {
                lines.reverse();
            }
            lines.iter().flat_map(|line| walk::passes(&self.setup, line, reversed)).collect::<Vec<_>>()
        })?;
        Ok(per_level.into_iter().flatten().collect())
    }

    /// Where the cutter cannot go on the lines of this family.
    fn unreached(&self, stage: &Stage) -> Result<Zone, Cancelled> {
        let Setup { face, cutter, posture, finish, .. } = &self.setup;
        let cell = probe_spacing(cutter, *posture, finish);
        let grid = FaceGrid::new(face, cell, 24, 400);
        let (nu, nv) = grid.size();
        let rows = stage.map(nv, |j| {
            (0..nu)
                .filter(|&i| matches!(self.setup.probe(grid.uv(i, j), false), Probe::Blocked))
                .map(|i| (grid.point(i, j), node_area(&grid, i, j)))
                .collect::<Vec<_>>()
        })?;
        Ok(Zone::from_samples(1.5 * cell, rows.into_iter().flatten()))
    }
}

impl Candidate {
    fn has_strips(&self) -> bool {
        self.probes.iter().flatten().any(|p| matches!(p, Probe::Strip { .. }))
    }
}

/// A quarter of the cells around the node.
fn node_area(grid: &FaceGrid, i: usize, j: usize) -> f64 {
    let (nu, nv) = grid.size();
    let cells = |k: usize, n: usize| k.saturating_sub(1)..(k + 1).min(n - 1);
    cells(j, nv)
        .flat_map(|b| cells(i, nu).map(move |a| (a, b)))
        .map(|(a, b)| grid.cell_area(a, b))
        .sum::<f64>()
        * 0.25
}

/// The interval of the parameter that `field` is, if it is one.
fn parameter_range(domain: &Domain, field: Field) -> Option<Range> {
    match field {
        Field::U => Some(domain.u),
        Field::V => Some(domain.v),
        Field::Along(_) => None,
    }
}

/// Distance between probes along a line, mm: half the strip on flat ground, since strips change about as fast across
/// as along.
fn probe_spacing(cutter: &Cutter, posture: Posture, finish: &Finish) -> f64 {
    let flat = crate::geometry::Curvature::default();
    let strip = crate::contact::second_order_strip_width(cutter, posture, &flat, finish.scallop);
    (0.5 * strip).clamp(0.1, 2.0)
}

/// Spacing of the obstacle's samples, mm: small against the corner, so that nothing it can touch hides between them.
fn obstacle_cell(cutter: &Cutter) -> f64 {
    (0.25 * cutter.corner_radius).clamp(0.2, 1.0)
}
