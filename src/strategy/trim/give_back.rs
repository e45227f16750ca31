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
        let is_high = |uv| {
            let place = |share| self.place(uv, share);
            place(AT_MOST).is_some_and(|place| was_cut(&place))
                && place(MUCH).is_some_and(|place| !self.cut(&place))
        };
        let lost_in = |k: usize| -> Vec<Place> {
            let places = self.family.places_about(cells[k], PARTS, CLOSER, is_high);
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
