//! What was cut back too far, given back.
//!
//! The places that were asked lie an eighth of a strip apart: between them more may be left where cusps are steep.

use super::{PARTS, Place, SAFE, Side, Trim, between, way};
use crate::math::bvh::Aabb;
use crate::monitor::{Cancelled, Stage};
use crate::strategy::left::{Moves, Part};
use crate::toolpath::Station;
use glam::DVec3;

/// About places where more than this share of the limit is left others are looked at, so many times closer together.
const MUCH: f64 = 0.4;
const CLOSER: usize = 4;
/// And once more about those of them where more than this is left: points between three strips are as fine, and a strip's end is steeper
/// than its sides.
const NEARLY: f64 = 0.88;
/// Where what was taken away cuts no lower than this share of the limit, it cuts nothing within it beside.
const AT_MOST: f64 = 2.0;

/// A way to cut a place again.
#[derive(Debug, Clone, Copy)]
struct Way {
    /// The move that cut it.
    number: usize,
    pass: usize,
    /// At which end of what is left of the pass; nothing is left of it without.
    side: Option<Side>,
    /// What has to be given back, mm.
    length: f64,
}

impl Trim<'_> {
    /// Places near what was taken away that were cut before, and by what is left are not.
    pub(super) fn lost(&self, stage: &Stage) -> Result<Vec<Place>, Cancelled> {
        let setup = &self.family.setup;
        let gone = Moves::of(setup, (0..self.left.len()).filter_map(|k| self.gone(k)).collect());
        let around = |part: &Part| {
            let Aabb { lo, hi } = Aabb::around(part.ends.iter().map(|station| station.cc.point));
            Aabb { lo: lo - self.wide, hi: hi + self.wide }
        };
        let boxes: Vec<Aabb> = gone.all().iter().map(around).collect();
        let cells = self.cells_near(&boxes);
        let was_cut = |place: &Place| gone.cut(self.asked(place), self.wide, |k| gone.all().get(k));
        let is_left = |uv, share| self.place(uv, share).is_some_and(|place| !self.cut(&place));
        let was_cut_at = |uv| self.place(uv, AT_MOST).is_some_and(|place| was_cut(&place));
        let is_high = |uv| was_cut_at(uv) && is_left(uv, MUCH);
        let is_nearly_left = |uv| was_cut_at(uv) && is_left(uv, NEARLY);
        let lost_in = |k: usize| -> Vec<Place> {
            let places = self.family.places_about(cells[k], PARTS, CLOSER, [&is_high, &is_nearly_left]);
            let places = places.into_iter().filter_map(|uv| self.place(uv, 1.0));
            places.filter(|place| was_cut(place) && !self.cut(place)).collect()
        };
        Ok(stage.map(cells.len(), lost_in)?.into_iter().flatten().collect())
    }

    /// What was taken away of a move.
    fn gone(&self, k: usize) -> Option<[Station; 2]> {
        let [a, b] = self.moves.all()[k].ends;
        match self.left[k].map(|part| part.ends) {
            None => Some([a, b]),
            Some([first, last]) if first != a => Some([a, if last == b { first } else { b }]),
            Some([_, last]) => (last != b).then_some([last, b]),
        }
    }

    /// Gives back what cuts each place again, by the shortest way.
    pub(super) fn give_back(&mut self, lost: &[Place], stage: &Stage) -> Result<(), Cancelled> {
        for place in lost {
            stage.at(0.0)?;
            if !self.cut(place) {
                let (point, top) = self.asked(place);
                let cutters = self.moves.cutters((point, top), self.wide);
                let shorter = |a: Way, b: Way| if b.length < a.length { b } else { a };
                if let Some(way) = cutters.into_iter().map(|k| self.way_to(k)).reduce(shorter) {
                    self.lengthen(&way, top);
                }
            }
        }
        Ok(())
    }

    /// How a move that was cut back would come back.
    fn way_to(&self, number: usize) -> Way {
        let pass = self.runs.partition_point(|run| run.end <= number);
        let run = self.run(pass);
        let (side, moves) = if run.is_empty() {
            (None, number..number + 1)
        } else if number + 1 >= run.end {
            (Some(Side::Last), run.end - 1..number + 1)
        } else {
            (Some(Side::First), number..run.start + 1)
        };
        let length = moves.filter_map(|k| self.gone(k)).map(|part| way(&part)).sum();
        Way { number, pass, side, length }
    }

    /// Gives back as much of a pass as cuts `top`, and a little more.
    fn lengthen(&mut self, &Way { number, pass, side, .. }: &Way, top: DVec3) {
        let (run, whole) = (self.run(pass), self.moves.all()[number]);
        let Some(side) = side else {
            self.left[number] = Some(whole);
            return;
        };
        let [a, b] = match side {
            Side::First => [whole.ends[1], whole.ends[0]],
            Side::Last => whole.ends,
        };
        let share =
            self.enough(&[a, b], top) + SAFE * self.family.setup.strip / whole.way().max(f64::MIN_POSITIVE);
        let end = if share < 1.0 { between(&a, &b, share) } else { b };
        let (inside, kept) = match side {
            Side::First => (number + 1..run.start + 1, [end, a]),
            Side::Last => (run.end - 1..number, [a, end]),
        };
        for k in inside {
            self.left[k] = Some(self.moves.all()[k]);
        }
        self.left[number] = Some(self.moves.part(kept));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Field, Uv};
    use crate::strategy::family::Detail;
    use crate::strategy::trial::{FINISH, family, flat, leaning};
    use crate::strategy::walk;
    use crate::toolpath::Pass;

    /// How far the face reaches to either side, mm.
    const HALF: f64 = 8.0;
    const WHOLE: [f64; 2] = [-HALF, HALF];

    /// The most that `passes` leave about a place, in limits.
    fn peak(trim: &Trim, passes: &[Pass], about: Uv) -> f64 {
        let moves = Moves::new(&trim.family.setup, passes.iter());
        let mut highest = (0.0, about);
        for step in [0.04, 0.006, 0.001] {
            let (_, Uv { u, v }) = highest;
            for (i, j) in (-12..=12).flat_map(|j| (-12..=12).map(move |i| (i, j))) {
                let uv = Uv::new(u + step * f64::from(i), v + step * f64::from(j));
                let height = moves.height(uv, 2.0 * FINISH.scallop, 1e-4 * FINISH.scallop);
                let share = height.map_or(2.0, |height| height / FINISH.scallop);
                if share > highest.0 {
                    highest = (share, uv);
                }
            }
        }
        highest.0
    }

    /// Beside a whole pass two others were cut back to where more than the limit is left on a spot that is a hundredth of a strip wide:
    /// it is cut again, wherever it lies between the places that are asked.
    #[test]
    fn points_between_three_strips_are_cut_again() {
        let stage = Stage::silent();
        let family = family(flat(WHOLE, [0.0, 2.3]), &leaning(0.1, 0.3), (Field::V, Field::U));
        let station = family.setup.station(Uv::new(0.0, 1.0), false).unwrap();
        let width = family.setup.width(Uv::new(0.0, 1.0), false, &station).unwrap();
        let pass = |level: f64, [from, to]: [f64; 2]| {
            let mut line = family.candidate(level * width, 0, Detail::Full, &stage).unwrap().lines.remove(0);
            line.nodes.retain(|uv| (from..=to).contains(&uv.u));
            walk::passes(&family.setup, &line, false)
        };
        // Cut back so that the second ends and the last begins at these places.
        let cut_back = |passes: &[Vec<Pass>], ends: [f64; 2]| {
            let mut trim = Trim::new(&family, passes);
            for k in trim.runs[1].start..trim.left.len() {
                let [a, b] = trim.moves.all()[k].ends;
                let (from, to) = (a.cc.point.x, b.cc.point.x);
                let ends_there = k < trim.runs[1].end;
                let share = (ends[usize::from(!ends_there)] - from) / (to - from);
                let at = between(&a, &b, share.clamp(0.0, 1.0));
                let (kept, is_left) =
                    if ends_there { ([a, at], share > 0.0) } else { ([at, b], share < 1.0) };
                trim.left[k] = is_left.then(|| trim.moves.part(kept));
            }
            trim
        };
        let share = |trim: &Trim, [end, begin]: [f64; 2]| {
            let passes: Vec<Pass> = (0..3).filter_map(|k| trim.pass(k)).collect();
            peak(trim, &passes, Uv::new(0.5 * (end + begin), width))
        };
        for k in 0..20 {
            let end = 0.3 * (0.7549 * f64::from(k)).fract();
            let shift = 0.15 * (0.5698 * f64::from(k)).fract();
            let passes = [
                pass(0.4 + shift, WHOLE),
                pass(1.39 + shift, [-HALF, 3.0]),
                pass(1.39 + shift, [-3.0, HALF]),
            ];
            let cut_back = |ends| cut_back(&passes, ends);
            let (mut near, mut far) = (0.0, 1.0);
            for _ in 0..12 {
                let ends = [end, end + 0.5 * (near + far)];
                *(if share(&cut_back(ends), ends) > 1.02 { &mut far } else { &mut near }) = ends[1] - end;
            }
            let ends = [end, end + far];
            let mut trim = cut_back(ends);
            assert!(share(&trim, ends) > 1.019);
            let lost = trim.lost(&stage).unwrap();
            trim.give_back(&lost, &stage).unwrap();
            assert!(share(&trim, ends) <= 1.0, "{end}");
        }
    }
}
