//! Passes along the level lines of a field, each as far from the last as its strips allow.

use super::fill;
use super::probe::{Probe, Reach, Setup};
use super::spacing::{Front, Toward};
use super::walk;
use super::{Finish, Order, Planned, StrategyError};
use crate::contact::FaceObstacle;
use crate::cutter::Cutter;
use crate::geometry::{Domain, Face, FaceGrid, Field, FieldGrid, IsoLine, Range, Uv, Zone};
use crate::monitor::{Cancelled, Stage};
use crate::toolpath::{Pass, Posture};

/// Most passes of one plan: beyond it the limit and the part do not fit each other.
const MOST_PASSES: usize = 20_000;

/// A family of level lines and the strips on them.
pub(super) struct Family<'a> {
    pub(super) setup: Setup<'a>,
    pub(super) lines: FieldGrid,
    /// Levels run in here; periodic where the last pass meets the first again.
    levels: Range,
    /// A step that is right on flat ground.
    nominal: f64,
    pub(super) column_period: Option<f64>,
    order: Order,
}

/// The lines of one level, or pieces of them, with what the cutter does at their nodes.
pub(super) struct Candidate {
    pub(super) level: f64,
    pub(super) lines: Vec<IsoLine>,
    pub(super) probes: Vec<Vec<Probe>>,
    pub(super) reversed: bool,
}

/// The share of a strip's reach to one side that is trusted to be there on the other, towards a corner where no node
/// measures it: on a bent face planes cut the two sides at different slopes.
const CORNER: f64 = 0.85;

/// The share of a pass's columns that may be left to partial passes.
const OPEN: f64 = 0.1;
/// How much farther, as a share of the step, a pass must come for that: partial passes cost lifts and scars.
const WORTH: f64 = 0.4;

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
        let grid = FaceGrid::new(face, cell, 24, 1200);
        let (nu, nv) = grid.size();
        let lines = FieldGrid::new(face, field, grid);
        let obstacle = FaceObstacle::for_cutter(face, cutter);
        let domain = face.domain();
        let (low, high) = lines.range();
        let levels = parameter_range(&domain, field).unwrap_or(Range::open(low, high));
        // A cell of the grid is half a strip.
        let nominal = match field {
            Field::U => 2.0 * levels.length() / (nu - 1) as f64,
            Field::V => 2.0 * levels.length() / (nv - 1) as f64,
            Field::Along(_) => 2.0 * cell,
        };
        let column_period = parameter_range(&domain, column).filter(|r| r.periodic).map(|r| r.length());
        let setup = Setup { face, obstacle, cutter, posture, finish, field, column, strip: 2.0 * cell };
        Self { setup, lines, levels, nominal, column_period, order }
    }

    /// The passes, from the lowest level to the highest.
    pub(super) fn plan(&self, stage: &Stage) -> Result<Planned, StrategyError> {
        let candidates = self.place(&stage.part("Spacing passes", 0.0, 0.6))?;
        let tracks = fill::tracks(self, candidates, &stage.part("Filling gaps", 0.6, 0.7))?;
        let passes = self.walk(&tracks, &stage.part("Following the surface", 0.7, 0.95))?;
        let unreached = self.unreached(&stage.part("Mapping what is unreachable", 0.95, 1.0))?;
        if passes.is_empty() {
            let why = "it gouges at every point in this posture; try more lead, or a smaller cutter";
            return Err(StrategyError::FitsNowhere(why.into()));
        }
        Ok(Planned { passes, unreached })
    }

    /// The lines on which whole passes run, lowest first.
    fn place(&self, stage: &Stage) -> Result<Vec<Candidate>, StrategyError> {
        let first = self.first(stage)?;
        let start = self.front(&first, Toward::Lower).raised(self.levels.length());
        let mut placed = vec![first];
        let mut guess = self.nominal;
        while let Some(last) = placed.last() {
            let from = last.level;
            stage.at((from - self.levels.lo) / self.levels.length())?;
            let front = self.front(last, Toward::Higher);
            let done = if self.levels.periodic {
                front.gaps(&start).all_but(0.0).is_some_and(|gap| gap <= 0.0)
            } else {
                self.ends_family(last, Toward::Higher)
            };
            if done || from >= self.levels.hi - self.margin() {
                break;
            }
            if placed.len() >= MOST_PASSES {
                let why = "raise the scallop limit, or take a larger cutter".into();
                return Err(StrategyError::TooMany { most: MOST_PASSES, why });
            }
            let next = self.next(&front, from, guess, placed.len(), stage)?;
            // The next step is looked for near this one, but never so near that an odd spot slows down all that follow.
            guess = (next.level - from).max(0.1 * self.nominal);
            placed.push(next);
        }
        Ok(placed)
    }

    /// The first pass: as far in as its strips still run over the border everywhere.
    fn first(&self, stage: &Stage) -> Result<Candidate, Cancelled> {
        let lo = self.levels.lo;
        let edge = self.candidate(lo, 0, Detail::Full, stage)?;
        if self.levels.periodic {
            return Ok(edge);
        }
        let fits = |c: &Candidate| self.ends_family(c, Toward::Lower);
        let mut best = edge;
        let (mut inside, mut outside) = (0.0, (2.0 * self.nominal).min(self.levels.length()));
        // A thousandth of the first strip is nothing in the length of a path.
        for _ in 0..12 {
            let middle = 0.5 * (inside + outside);
            let candidate = self.candidate(lo + middle, 0, Detail::Full, stage)?;
            if fits(&candidate) {
                (inside, best) = (middle, candidate);
            } else {
                outside = middle;
            }
        }
        Ok(best)
    }

    /// The next pass after the one at `from`.
    ///
    /// The farthest whose strips meet `front` everywhere; or, where a few odd columns would hold up the whole pass, the
    /// farthest whose strips meet it nearly everywhere, and the rest is filled by partial passes.
    fn next(
        &self,
        front: &Front,
        from: f64,
        guess: f64,
        index: usize,
        stage: &Stage,
    ) -> Result<Candidate, Cancelled> {
        // Found on a few columns first; all columns then have the last word.
        let sketch = |guess, open| self.farthest(front, (from, guess), open, (index, Detail::Sketch), stage);
        let strict = sketch(guess, 0.0)?;
        let mut step = strict.level - from;
        let mut open = 0.0;
        let overlap = front.gaps(&self.front(&strict, Toward::Lower)).all_but(OPEN).unwrap_or(0.0);
        if overlap <= -WORTH * step {
            let loose = sketch(step - overlap, OPEN)?;
            if loose.level - from > (1.0 + WORTH) * step {
                (step, open) = (loose.level - from, OPEN);
            }
        }
        self.farthest(front, (from, step), open, (index, Detail::Full), stage)
    }

    /// The farthest pass whose strips meet `front` in all but the share `open` of their columns.
    fn farthest(
        &self,
        front: &Front,
        (from, guess): (f64, f64),
        open: f64,
        (index, detail): (usize, Detail),
        stage: &Stage,
    ) -> Result<Candidate, Cancelled> {
        let most = self.levels.length() - (from - self.levels.lo);
        let gap_at = |step: f64| -> Result<(Option<f64>, Candidate), Cancelled> {
            let candidate = self.candidate(from + step, index, detail, stage)?;
            Ok((front.gaps(&self.front(&candidate, Toward::Lower)).all_but(open), candidate))
        };
        let least = 0.05 * self.nominal;
        // The gap grows nearly linearly with the step; a percent of a step is less than a percent of the path.
        let tolerance = 0.01;
        let (mut low, mut low_gap) = (0.0, -guess);
        let mut best: Option<Candidate> = None;
        let mut high = None;
        let mut step = guess.min(most);
        for _ in 0..40 {
            let (gap, candidate) = gap_at(step)?;
            match gap {
                // Nothing lies abreast: this pass or the last cannot be cut anywhere, and neither bounds the step.
                None => return Ok(candidate),
                Some(gap) if gap > 0.0 => {
                    high = Some((step, gap));
                    break;
                }
                Some(gap) if gap > -tolerance * step => return Ok(candidate),
                Some(gap) => (low, low_gap, best) = (step, gap, Some(candidate)),
            }
            if step >= most {
                break;
            }
            step = (step * 1.3).min(most);
        }
        let Some((mut high, mut high_gap)) = high else {
            return match (detail, best) {
                (Detail::Sketch, Some(candidate)) => Ok(candidate),
                (_, best) => self.last(best, low, from, index, stage),
            };
        };
        for k in 0..30 {
            if (low > 0.0 && high - low < tolerance * high) || high < least {
                break;
            }
            let secant = (high_gap * low - low_gap * high) / (high_gap - low_gap);
            // Aim a little below the root, so that what comes back is mostly a step that holds.
            let aim = if k % 4 == 3 { 0.5 * (low + high) } else { secant - 0.3 * tolerance * high };
            let step = aim.clamp(low + 0.05 * (high - low), high - 0.05 * (high - low));
            let (gap, candidate) = gap_at(step)?;
            match gap {
                Some(gap) if gap > 0.0 => (high, high_gap) = (step, gap),
                Some(gap) => {
                    (low, low_gap, best) = (step, gap, Some(candidate));
                    if gap > -tolerance * step {
                        break;
                    }
                }
                None => (low, best) = (step, Some(candidate)),
            }
        }
        match best {
            Some(candidate) => Ok(candidate),
            // No step worth a whole pass closes the gap: go on by the least, and leave the rest to partial passes.
            None => self.candidate(from + least.min(most), index, detail, stage),
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
            None => self.candidate(self.levels.hi, index, Detail::Full, stage)?,
        };
        let (mut outside, mut inside) = (0.0, step);
        for _ in 0..10 {
            let middle = 0.5 * (inside + outside);
            let candidate = self.candidate(from + middle, index, Detail::Full, stage)?;
            if self.ends_family(&candidate, Toward::Higher) {
                (inside, best) = (middle, candidate);
            } else {
                outside = middle;
            }
        }
        Ok(best)
    }

    /// Whether nothing is left beyond the pass on that side: its strips run over the border everywhere, and a corner that
    /// the family of planes ends in lies no farther away than the strips reach to the other side.
    fn ends_family(&self, candidate: &Candidate, toward: Toward) -> bool {
        let (end, back) = match toward {
            Toward::Lower => (self.levels.lo, Toward::Higher),
            Toward::Higher => (self.levels.hi, Toward::Lower),
        };
        let away = (candidate.level - end).abs();
        let reaches = |p: &Probe| match p.reach(back) {
            Some(Reach::To { level, .. }) => CORNER * (level - candidate.level).abs() >= away,
            Some(Reach::Border { .. }) | None => true,
        };
        let corner = matches!(self.setup.field, Field::Along(_));
        candidate.runs_over_border(toward) && (!corner || candidate.probes.iter().flatten().all(reaches))
    }

    pub(super) fn front(&self, candidate: &Candidate, toward: Toward) -> Front {
        Front::new(&candidate.probes, toward, self.column_period)
    }

    fn reversed(&self, index: usize) -> bool {
        self.order == Order::ZigZag && index % 2 == 1
    }

    fn candidate(
        &self,
        level: f64,
        index: usize,
        detail: Detail,
        stage: &Stage,
    ) -> Result<Candidate, Cancelled> {
        // At the very ends a section may be a single point.
        let level = if self.levels.periodic {
            level
        } else {
            level.clamp(self.levels.lo + self.margin(), self.levels.hi - self.margin())
        };
        let mut lines = self.lines.lines(level);
        if detail == Detail::Sketch {
            lines.iter_mut().for_each(thin);
        }
        self.probed(level, lines, self.reversed(index), stage)
    }

    /// `lines`, all of `level`, with what the cutter does at their nodes.
    pub(super) fn probed(
        &self,
        level: f64,
        lines: Vec<IsoLine>,
        reversed: bool,
        stage: &Stage,
    ) -> Result<Candidate, Cancelled> {
        let nodes: Vec<_> = lines.iter().flat_map(|line| &line.nodes).collect();
        let mut flat = stage.quiet().map(nodes.len(), |i| self.setup.probe(*nodes[i], reversed))?.into_iter();
        let probes = lines.iter().map(|line| flat.by_ref().take(line.nodes.len()).collect()).collect();
        Ok(Candidate { level, lines, probes, reversed })
    }

    /// How far inside its ends the levels stay, since a section through the very corner of a face is a point.
    fn margin(&self) -> f64 {
        1e-9 * self.levels.length()
    }

    /// The passes on the lines of `tracks`.
    fn walk(&self, tracks: &[Candidate], stage: &Stage) -> Result<Vec<Pass>, Cancelled> {
        let per_track = stage.map(tracks.len(), |i| {
            let track = &tracks[i];
            let pass = |line| walk::passes(&self.setup, line, track.reversed);
            if track.reversed {
                track.lines.iter().rev().flat_map(pass).collect::<Vec<_>>()
            } else {
                track.lines.iter().flat_map(pass).collect()
            }
        })?;
        Ok(per_track.into_iter().flatten().collect())
    }

    /// Where the cutter cannot go on the lines of this family, and a rim beside it where its strips end.
    fn unreached(&self, stage: &Stage) -> Result<Zone, Cancelled> {
        let face = self.setup.face;
        let grid = FaceGrid::new(face, 0.5 * self.setup.strip, 24, 400);
        let (nu, nv) = grid.size();
        let blocked = |uv| matches!(self.setup.probe(uv, false), Probe::Blocked);
        let rows = stage
            .part("Mapping what is unreachable", 0.0, 0.6)
            .map(nv, |j| (0..nu).map(|i| blocked(grid.uv(i, j))).collect::<Vec<_>>())?;
        // Cells along the rim, and those that are blocked whole, are looked at more finely.
        let cells: Vec<(usize, usize)> = (0..nv - 1)
            .flat_map(|j| (0..nu - 1).map(move |i| (i, j)))
            .filter(|&(i, j)| rows[j][i] || rows[j][i + 1] || rows[j + 1][i] || rows[j + 1][i + 1])
            .collect();
        let found = stage.part("Mapping what is unreachable", 0.6, 1.0).map(cells.len(), |k| {
            let (i, j) = cells[k];
            let (low, high) = (grid.uv(i, j), grid.uv(i + 1, j + 1));
            let at = |a: f64, b: f64, s: usize| a + (b - a) * (s as f64 + 0.5) / FINE as f64;
            let weight = grid.cell_area(i, j) / (FINE * FINE) as f64;
            (0..FINE * FINE)
                .map(|s| Uv::new(at(low.u, high.u, s % FINE), at(low.v, high.v, s / FINE)))
                .filter(|&uv| blocked(uv))
                .map(|uv| (face.surface.point(uv), weight))
                .collect::<Vec<_>>()
        })?;
        // Grown by a cube, the zone takes in the half strip beside it where passes end.
        let cube = 0.5 * self.setup.strip;
        Ok(Zone::from_samples(cube, found.into_iter().flatten()).grown())
    }
}

/// Samples a side of a cell where the rim of the unreachable is mapped.
const FINE: usize = 3;

/// How many of a line's nodes are looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Detail {
    /// A few, to find a step.
    Sketch,
    /// All.
    Full,
}

/// Keeps every sixth node and the ends, but at least a dozen.
fn thin(line: &mut IsoLine) {
    let last = line.nodes.len() - 1;
    let stride = (line.nodes.len() / 12).clamp(1, 6);
    let mut i = 0;
    line.nodes.retain(|_| {
        i += 1;
        (i - 1) % stride == 0 || i - 1 == last
    });
}

impl Candidate {
    /// Whether the cutter can go everywhere on the lines and its strips run over the border everywhere.
    fn runs_over_border(&self, toward: Toward) -> bool {
        self.probes.iter().flatten().all(|p| matches!(p.reach(toward), Some(Reach::Border { .. })))
    }
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
