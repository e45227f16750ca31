//! How far apart whole passes lie: each as far from the last as its strips allow.

use super::StrategyError;
use super::family::{Candidate, Detail, Family};
use super::spacing::{Front, Toward};
use crate::geometry::Field;
use crate::monitor::{Cancelled, Stage};

/// Most passes of one plan: beyond it the limit and the part do not fit each other.
pub(super) const MOST_PASSES: usize = 20_000;

/// Shares of a pass's columns that may be left to partial passes, each with how much farther, as a share of the step, a
/// pass must come for that: partial passes cost lifts and scars.
const OPEN: [(f64, f64); 2] = [(0.1, 0.4), (0.5, 1.5)];

/// How often a pass is laid nearer to a border so that it cuts a corner, by how much each time, in steps, and the halvings of the last
/// of them.
const NEARER: u32 = 6;
const NEARER_BY: f64 = 0.02;
const NEARER_HALVINGS: usize = 4;
/// Levels that are looked at where none of those has a line.
const SOME: u32 = 16;

/// What is said of more passes than that.
pub(super) fn too_many() -> StrategyError {
    let why = "raise the scallop limit, or take a larger cutter".into();
    StrategyError::TooMany { most: MOST_PASSES, why }
}

impl Family<'_> {
    /// The lines on which whole passes run, lowest first.
    pub(super) fn place(&self, stage: &Stage) -> Result<Vec<Candidate>, StrategyError> {
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
                self.is_last(last)
            };
            if done || from >= self.levels.hi - self.margin() {
                break;
            }
            if placed.len() >= MOST_PASSES {
                return Err(too_many());
            }
            let next = self.next(&front, from, guess, placed.len(), stage)?;
            // The next step is looked for near this one, but never so near that an odd spot slows down all that follow.
            guess = (next.level - from).max(0.1 * self.nominal);
            placed.push(next);
        }
        Ok(placed)
    }

    /// The first pass: as far in as its strips still run over the border everywhere.
    pub(super) fn first(&self, stage: &Stage) -> Result<Candidate, Cancelled> {
        let lo = self.levels.lo;
        let farthest = (2.0 * self.nominal).min(self.levels.length());
        if self.has_courses() {
            return self.beside_border((lo, lo + farthest), Toward::Lower, 0, stage);
        }
        let edge = self.candidate(lo, 0, Detail::Full, stage)?;
        if self.levels.periodic {
            return Ok(edge);
        }
        // A thousandth of the first strip is nothing in the length of a path.
        let at = |inside: f64| self.candidate(lo + inside, 0, Detail::Full, stage);
        let fits = |c: &Candidate| self.ends_family(c, Toward::Lower);
        Ok(last_that((0.0, farthest), 12, at, fits)?.unwrap_or(edge))
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
        let mut held = strict;
        for (share, worth) in OPEN {
            let overlap = front.gaps(&self.front(&held, Toward::Lower)).all_but(share).unwrap_or(0.0);
            if overlap.is_finite() && overlap <= -worth * step {
                let loose = sketch(step - overlap, share)?;
                if loose.level - from > (1.0 + worth) * step {
                    (step, open) = (loose.level - from, share);
                    held = loose;
                }
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
                // Or its course has left over the border already.
                None if detail == Detail::Full && candidate.lines.is_empty() && self.has_courses() => {
                    return self.last(None, step, from, index, stage);
                }
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
            // Aim a little below the root, so that what comes back is mostly a step that holds. Over a border strips
            // overlap without end, and there is no secant.
            let aim = if k % 4 == 3 || !secant.is_finite() {
                0.5 * (low + high)
            } else {
                secant - 0.3 * tolerance * high
            };
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

    /// The pass farthest from a border, between the level at it and one inside, whose strips run over it everywhere, where
    /// passes follow courses of their own; or a little nearer, if then what it leaves in a corner is cut. Right beside the border
    /// courses leave over it themselves.
    fn beside_border(
        &self,
        (border, inner): (f64, f64),
        toward: Toward,
        index: usize,
        stage: &Stage,
    ) -> Result<Candidate, Cancelled> {
        let at = |level: f64| self.candidate(level, index, Detail::Full, stage);
        let runs_over = |c: &Candidate| c.runs_over_border(toward);
        let farthest = match last_that((border, inner), 10, at, runs_over)? {
            Some(farthest) => farthest,
            None => at(border)?,
        };
        if farthest.lines.is_empty() {
            return self
                .some_line((border, inner), toward, index, stage)
                .map(|some| some.unwrap_or(farthest));
        }
        let out = if toward == Toward::Lower { -1.0 } else { 1.0 };
        let inside = farthest.level;
        let nearer = |steps: f64| at(inside + out * steps * NEARER_BY * self.nominal);
        let ends = |c: &Candidate| c.lines.len() == farthest.lines.len() && self.ends_family(c, toward);
        for k in 0..NEARER {
            let last = nearer(f64::from(k))?;
            if !ends(&last) {
                continue;
            }
            let halvings = if k > 0 { NEARER_HALVINGS } else { 0 };
            let between = (f64::from(k), f64::from(k) - 1.0);
            return Ok(last_that(between, halvings, nearer, ends)?.unwrap_or(last));
        }
        Ok(farthest)
    }

    /// The pass farthest from a border whose strips run over it, of a few between the level at it and one inside; or the nearest one
    /// where none do; `None` where there are no lines at all.
    fn some_line(
        &self,
        (border, inner): (f64, f64),
        toward: Toward,
        index: usize,
        stage: &Stage,
    ) -> Result<Option<Candidate>, Cancelled> {
        let mut some: Option<Candidate> = None;
        for k in 0..=SOME {
            let level = border + (inner - border) * f64::from(k) / f64::from(SOME);
            let candidate = self.candidate(level, index, Detail::Full, stage)?;
            if !candidate.lines.is_empty() && (some.is_none() || candidate.runs_over_border(toward)) {
                some = Some(candidate);
            }
        }
        Ok(some)
    }

    /// Whether no whole pass goes between this one and the border: where passes follow courses of their own, what they leave in a
    /// corner has none that ends them.
    fn is_last(&self, candidate: &Candidate) -> bool {
        self.ends_family(candidate, Toward::Higher)
            || self.has_courses() && !candidate.lines.is_empty() && candidate.runs_over_border(Toward::Higher)
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
        if self.has_courses() {
            return self.beside_border((from + step, from), Toward::Higher, index, stage);
        }
        let at = |step: f64| self.candidate(from + step, index, Detail::Full, stage);
        let ends = |c: &Candidate| self.ends_family(c, Toward::Higher);
        Ok(match (last_that((step, 0.0), 10, at, ends)?, at_border) {
            (Some(last), _) | (None, Some(last)) => last,
            (None, None) => self.candidate(self.levels.hi, index, Detail::Full, stage)?,
        })
    }

    /// The last pass after `last` towards one side, the end of the levels less than a step away; `None` where no pass runs
    /// over the border everywhere.
    #[cfg(feature = "flow")]
    pub(super) fn last_toward(
        &self,
        last: &Candidate,
        toward: Toward,
        index: usize,
        stage: &Stage,
    ) -> Result<Option<Candidate>, Cancelled> {
        let end = if toward == Toward::Higher { self.levels.hi } else { self.levels.lo };
        let at = |share: f64| {
            let level = last.level + share * (end - last.level);
            self.candidate(level, index, Detail::Full, stage)
        };
        let ends = |c: &Candidate| !c.lines.is_empty() && self.ends_family(c, toward);
        last_that((1.0, 0.0), 10, at, ends)
    }

    /// Whether nothing is left beyond the pass on that side: its strips run over the border everywhere, and what a family
    /// of planes still has in a corner beyond it is cut as well.
    pub(super) fn ends_family(&self, candidate: &Candidate, toward: Toward) -> bool {
        let ends_in_corner = matches!(self.setup.field, Field::Along(_) | Field::Given(_));
        candidate.runs_over_border(toward) && (!ends_in_corner || self.cuts_beyond(candidate, toward))
    }
}

/// The candidate last found to hold by so many halvings between where one surely does and where none may; `None` where none did.
fn last_that(
    (mut holding, mut failing): (f64, f64),
    halvings: usize,
    at: impl Fn(f64) -> Result<Candidate, Cancelled>,
    holds: impl Fn(&Candidate) -> bool,
) -> Result<Option<Candidate>, Cancelled> {
    let mut last = None;
    for _ in 0..halvings {
        let middle = 0.5 * (holding + failing);
        let candidate = at(middle)?;
        if holds(&candidate) { (holding, last) = (middle, Some(candidate)) } else { failing = middle }
    }
    Ok(last)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Face, NurbsSurface, Side};
    use crate::strategy::trial::{family, leaning};
    use glam::DVec3;

    /// Along the handle of a paddle one strip runs over both borders: that tells nothing of the step across its blade.
    #[test]
    fn strips_over_borders_hurry_no_step() {
        let knots = [vec![0.0, 0.0, 0.75, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]];
        let (handle, blade) = (0.6, 30.0);
        let points: Vec<DVec3> = [(0.0, handle), (60.0, handle), (80.0, blade)]
            .into_iter()
            .flat_map(|(x, width)| [DVec3::new(x, 0.0, 0.0), DVec3::new(x, width, 0.0)])
            .collect();
        let paddle = NurbsSurface::new([1, 1], knots, &points, None).unwrap();
        let face = Face::new(paddle, Side::Front);
        let family = family(face, &leaning(0.3, 0.0), (Field::V, Field::U));
        let placed = family.place(&Stage::silent()).unwrap();
        let steps: Vec<f64> = placed.windows(2).map(|w| w[1].level - w[0].level).collect();
        let strip = family.setup.strip / blade;
        assert!(steps.iter().all(|step| *step < 4.5 * strip), "{steps:?} {strip}");
    }
}
