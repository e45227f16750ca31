//! Postures that were chosen, eased: passes that were laid for the widest strips overlap a little everywhere, and where they do, the
//! cutter leans a little more, until strips just meet. What that leaves is nearer to the limit, and it costs no way.

use super::follow::Part;
use super::glean::Sought;
use super::left::Moves;
use super::probe::Setup;
use super::walk::MOST_TURN;
use super::{Planned, places};
use crate::contact::cl_of;
use crate::geometry::{FaceGrid, Uv};
use crate::math::angle::angle_between;
use crate::monitor::{Cancelled, Stage};
use crate::posture::Limits;
use crate::toolpath::{Bound, ClPoint, Pass, Station};
use std::ops::Range;

/// How much more lead is tried first, as a share of the lead.
const FIRST: f64 = 0.1;
/// What each round leaves of it beside a place where too much is left.
const LESS: f64 = 0.75;
/// What is added again in each of so many rounds where nothing is too high.
const MORE: f64 = 1.08;
const ADDED: usize = 6;
/// Rounds, after which there is none.
const ROUNDS: usize = 14;
/// How far from the ends of passes on the face nothing is eased, in strips, and places on each of two rings there.
const BESIDE: f64 = 0.4;
const AROUND: usize = 12;
/// Times at which all of the face is looked at.
const TIMES: usize = 8;
/// The share of what may be left that is asked for where less was left before.
const SHARE: f64 = 0.994;
/// Up to how much it counts what was left before, and how finely, in limits.
const MUCH_LEFT: f64 = 8.0;
const FINE: f64 = 1e-3;
/// How fast what is added may change along a pass, as a share of how fast the axis may turn.
const STEADY: f64 = 0.1;
/// What is added beyond this share of the lead is why it is not less.
const MUCH: f64 = 0.05;
/// Less is nothing, in leads.
const LEAST: f64 = 1e-4;
/// Contacts nearer than this to a place on the face lie there, mm.
const AT: f64 = 1e-4;
/// Lengths (mm) and angles that differ by less are the same.
const SAME: f64 = 1e-9;
/// How much of the time goes by before all of the face is looked at.
const BEGUN: f64 = 0.1;
/// What a person reads meanwhile.
const EASE: &str = "Easing postures";

/// `planned`, which follows the lines of `part`, with as much more lead everywhere as what is left on the face and at `others` allows;
/// as it is where no posture was chosen for the widest strips, or where too much would be left.
pub(super) fn eased(
    part: &Part,
    others: &[Uv],
    mut planned: Planned,
    stage: &Stage,
) -> Result<Planned, Cancelled> {
    let setup = &part.family.setup;
    let Some(limits) = setup.postures.limits() else { return Ok(planned) };
    let ridges = places::ridges(&places::edges(part.tracks.iter()));
    let limit = SHARE * setup.finish.scallop;
    let looks = |moves: &Moves, finely: bool, stage: &Stage| -> Result<Vec<Uv>, Cancelled> {
        let mut looks = part.family.looks(moves, (others, &ridges), Sought { limit, finely }, stage)?;
        looks.retain(|uv| !planned.unreached.contains(setup.face.surface.point(*uv)));
        Ok(looks)
    };
    let mut ease = Ease::new(part, limits, &planned.passes, &stage.quiet())?;
    ease.hold_ends(&stage.quiet())?;
    ease.clear(&stage.part(EASE, 0.0, BEGUN))?;
    for time in 0..TIMES {
        let within = |from: f64, to: f64| {
            let at = |t: f64| BEGUN + (1.0 - BEGUN) * (time as f64 + t) / TIMES as f64;
            stage.part(EASE, at(from), at(to))
        };
        let moves = ease.moves();
        // At first much is high wherever one looks.
        let finely = time > 0;
        let looks = looks(&moves, finely, &within(0.0, 0.4))?;
        let mut high = ease.too_high(&moves, &looks, &within(0.4, 0.5))?;
        if finely && high.is_empty() {
            planned.passes = ease.passes(&stage.quiet())?;
            break;
        }
        let asked = high.clone();
        for round in 0..=ROUNDS {
            within(0.5, 0.8).at(round as f64 / ROUNDS as f64)?;
            let share = if round < ROUNDS && time < TIMES / 2 { LESS } else { 0.0 };
            ease.take_back(&high, share, &stage.quiet())?;
            high = ease.still(&high, &stage.quiet())?;
            if high.is_empty() {
                break;
            }
        }
        if time == 0 {
            ease.add(&asked, &within(0.8, 1.0))?;
        }
        ease.clear(&stage.quiet())?;
    }
    Ok(planned)
}

/// A place and what must be left there at most, mm.
#[derive(Debug, Clone, Copy)]
struct High {
    uv: Uv,
    most: f64,
}

struct Ease<'a> {
    setup: &'a Setup<'a>,
    limits: Limits,
    /// The stations of all passes as they were, and which are those of each.
    stations: Vec<Station>,
    runs: Vec<Range<usize>>,
    /// Where each touches the face.
    uvs: Vec<Uv>,
    /// The first station of each move.
    firsts: Vec<usize>,
    before: Moves<'a>,
    /// How much more lead each station has, and may have, radians.
    more: Vec<f64>,
    most: Vec<f64>,
    /// With how much more, at either end, the move from each station on was found to be clear.
    cleared: Vec<[f64; 2]>,
}

impl<'a> Ease<'a> {
    fn new(part: &'a Part<'a>, limits: Limits, passes: &[Pass], stage: &Stage) -> Result<Self, Cancelled> {
        let setup = &part.family.setup;
        let mut from = 0;
        let runs: Vec<Range<usize>> = passes
            .iter()
            .map(|pass| {
                let to = from + pass.stations.len();
                std::mem::replace(&mut from, to)..to
            })
            .collect();
        let stations: Vec<Station> = passes.iter().flat_map(|pass| &pass.stations).copied().collect();
        let firsts = runs.iter().flat_map(|run| run.start..run.end - 1).collect();
        let before = Moves::new(setup, passes.iter());
        // Beyond borders the cutter leans as it does on them; where a pass was cut back it stands half way between two places.
        let is_free = |s: &Station| s.work.strip.is_some() && is_same(&cl_of(setup.cutter, &s.cc), &s.cl);
        let first = |s: &Station| {
            let lead = s.cc.posture.lead;
            if is_free(s) { (FIRST * lead).min(limits.most_lead - lead).max(0.0) } else { 0.0 }
        };
        let most: Vec<f64> = stations.iter().map(first).collect();
        let more = most.clone();
        let grid = part.family.lines.grid();
        let uvs = stage.map(runs.len(), |k| places_of(setup, grid, &stations[runs[k].clone()]))?.concat();
        let cleared = vec![[0.0; 2]; stations.len()];
        let mut ease = Self { setup, limits, stations, uvs, runs, firsts, before, more, most, cleared };
        ease.steady();
        Ok(ease)
    }

    /// A station as it leans now.
    fn station(&self, k: usize) -> Station {
        let (mut station, more) = (self.stations[k], self.more[k]);
        if more > 0.0 {
            station.cc.posture.lead += more;
            station.cl = cl_of(self.setup.cutter, &station.cc);
            if more > MUCH * self.stations[k].cc.posture.lead {
                station.work.bound = Bound::Met;
            }
        }
        station
    }

    fn moves(&self) -> Moves<'a> {
        let ends = |&k: &usize| [self.station(k), self.station(k + 1)];
        Moves::of(self.setup, self.firsts.iter().map(ends).collect())
    }

    /// Those of `looks` where `moves` leave too much: more than is asked for, or was left before.
    fn too_high(&self, moves: &Moves, looks: &[Uv], stage: &Stage) -> Result<Vec<High>, Cancelled> {
        let whole = self.setup.finish.scallop;
        let limit = SHARE * whole;
        let high = |uv: Uv| {
            let most = if !self.before.leave(uv, limit) {
                limit
            } else if !self.before.leave(uv, whole) {
                whole
            } else {
                self.before.height(uv, MUCH_LEFT * whole, FINE * whole)?
            };
            moves.leave(uv, most).then_some(High { uv, most })
        };
        Ok(stage.map(looks.len(), |k| high(looks[k]))?.into_iter().flatten().collect())
    }

    /// Those of `high` that still are.
    fn still(&self, high: &[High], stage: &Stage) -> Result<Vec<High>, Cancelled> {
        let moves = self.moves();
        let is_high = stage.map(high.len(), |k| moves.leave(high[k].uv, high[k].most))?;
        Ok(high.iter().zip(is_high).filter(|(_, is_high)| *is_high).map(|(high, _)| *high).collect())
    }

    /// Leaves this share of what was added to whatever cut one of the places `high` before.
    fn take_back(&mut self, high: &[High], share: f64, stage: &Stage) -> Result<(), Cancelled> {
        for k in self.cutters(high, stage)? {
            self.more[k] *= share;
        }
        self.steady();
        Ok(())
    }

    /// The stations of the moves that cut one of the places `high` before.
    fn cutters(&self, high: &[High], stage: &Stage) -> Result<Vec<usize>, Cancelled> {
        let moves = stage.map(high.len(), |k| self.before.cutters_at(high[k].uv, high[k].most))?;
        let mut is_cutter = vec![false; self.stations.len()];
        for k in moves.into_iter().flatten().map(|k| self.firsts[k]) {
            is_cutter[k..k + 2].fill(true);
        }
        Ok((0..is_cutter.len()).filter(|&k| is_cutter[k]).collect())
    }

    /// Takes all away from what cuts beside the ends of passes on the face: what is left there comes to points between three of them, which
    /// are finer than places that are looked at.
    fn hold_ends(&mut self, stage: &Stage) -> Result<(), Cancelled> {
        let (face, strip) = (self.setup.face, self.setup.strip);
        let ends: Vec<usize> = self.runs.iter().flat_map(|run| [run.start, run.end - 1]).collect();
        let beside = |k: usize| -> Vec<High> {
            let cc = &self.stations[ends[k]].cc;
            let uv = self.uvs[ends[k]];
            if face.surface.point(uv).distance(cc.point) > BESIDE * strip {
                return Vec::new();
            }
            let place = |(i, ring): (usize, f64)| {
                let (sine, cosine) = libm::sincos(std::f64::consts::TAU * i as f64 / AROUND as f64);
                let away = (cc.frame.f * cosine + cc.frame.b * sine) * ring;
                High { uv: face.nearest_from(uv, cc.point + away), most: self.setup.finish.scallop }
            };
            let rings = [0.5, 1.0]
                .into_iter()
                .flat_map(|share| (0..AROUND).map(move |i| (i, share * BESIDE * strip)));
            rings.map(place).collect()
        };
        let places = stage.map(ends.len(), beside)?;
        self.take_back(&places.concat(), 0.0, stage)
    }

    /// Adds a little more wherever none of the places `asked` then is high, again and again.
    fn add(&mut self, asked: &[High], stage: &Stage) -> Result<(), Cancelled> {
        let mut is_free = vec![true; self.more.len()];
        for k in 0..ADDED {
            stage.at(k as f64 / ADDED as f64)?;
            let before = self.more.clone();
            for (k, more) in self.more.iter_mut().enumerate().filter(|(k, _)| is_free[*k]) {
                *more = (MORE * *more).min(self.most[k]);
            }
            self.steady();
            let mut high = self.still(asked, &stage.quiet())?;
            while !high.is_empty() {
                for k in self.cutters(&high, &stage.quiet())? {
                    self.more[k] = self.more[k].min(before[k]);
                    is_free[k] = false;
                }
                self.steady();
                let now = self.still(&high, &stage.quiet())?;
                if now.len() == high.len() {
                    self.more = before;
                    return Ok(());
                }
                high = now;
            }
        }
        Ok(())
    }

    /// Takes away what makes the cutter lean by much more at one place of a pass than beside it, or its axis turn faster than it may.
    fn steady(&mut self) {
        let turn = |[a, b]: [&Station; 2]| angle_between(a.cl.axis, b.cl.axis);
        for run in self.runs.clone() {
            loop {
                let mut is_steady = true;
                for k in run.start..run.end - 1 {
                    self.hold(k, k + 1);
                }
                for k in (run.start..run.end - 1).rev() {
                    self.hold(k + 1, k);
                }
                for k in run.start..run.end - 1 {
                    if self.more[k] <= 0.0 && self.more[k + 1] <= 0.0 {
                        continue;
                    }
                    let before = turn([&self.stations[k], &self.stations[k + 1]]);
                    let allowed = before.max(MOST_TURN.min(self.limits.most_turn[0] * self.way(k, k + 1)));
                    if turn([&self.station(k), &self.station(k + 1)]) > allowed + SAME {
                        is_steady = false;
                        for k in [k, k + 1] {
                            let less = LESS * self.more[k];
                            self.more[k] =
                                if less > LEAST * self.stations[k].cc.posture.lead { less } else { 0.0 };
                        }
                    }
                }
                if is_steady {
                    break;
                }
            }
        }
    }

    /// No more is added at `next` than what is added at `k` may rise to on the way.
    fn hold(&mut self, k: usize, next: usize) {
        let rise = STEADY * self.limits.most_turn[0] * self.way(k, next);
        self.more[next] = self.more[next].min(self.more[k] + rise);
    }

    /// The way between the contacts of two stations, mm.
    fn way(&self, a: usize, b: usize) -> f64 {
        self.stations[a].cc.point.distance(self.stations[b].cc.point)
    }

    /// Takes all away where the cutter would dig in, or its holder come into the part.
    fn clear(&mut self, stage: &Stage) -> Result<(), Cancelled> {
        loop {
            let ends = |k: usize| [self.more[k], self.more[k + 1]];
            let is_open = |k: &usize| ends(*k) != self.cleared[*k];
            let open: Vec<usize> = self.firsts.iter().copied().filter(is_open).collect();
            let is_clear = stage.map(open.len(), |k| self.is_clear(open[k]))?;
            for &k in &open {
                self.cleared[k] = [self.more[k], self.more[k + 1]];
            }
            let blocked = open.iter().zip(is_clear).filter(|(_, is_clear)| !is_clear);
            let blocked: Vec<usize> = blocked.map(|(k, _)| *k).collect();
            if blocked.is_empty() {
                return Ok(());
            }
            for k in blocked {
                self.more[k..k + 2].fill(0.0);
                self.cleared[k] = [0.0; 2];
            }
            self.steady();
        }
    }

    /// Whether the cutter clears the face at the station `k` and the next, as far as they are eased, and on its way.
    fn is_clear(&self, k: usize) -> bool {
        let fits = |k: usize| {
            let (station, uv) = (self.station(k), self.uvs[k]);
            self.more[k] <= 0.0
                || self.setup.fits(&station, uv) && {
                    let is_back = self.is_back(k);
                    let more = station.cc.posture.lead - self.setup.postures.at(uv, is_back).lead;
                    self.setup.slides_clear(uv, is_back, more, &station)
                }
        };
        fits(k) && fits(k + 1) && self.setup.slides_off(&self.station(k), &self.station(k + 1))
    }

    /// Whether the feed at a station goes back along the line.
    fn is_back(&self, k: usize) -> bool {
        let along = self.stations[k].cc.frame.f;
        self.setup.frame(self.uvs[k], false).is_some_and(|(_, frame)| frame.f.dot(along) < 0.0)
    }

    /// The passes as they lean now, with the strips that they then cut.
    fn passes(&self, stage: &Stage) -> Result<Vec<Pass>, Cancelled> {
        let told = |k: usize| {
            let mut station = self.station(k);
            if self.more[k] > 0.0 {
                station.work.strip = self.setup.width(self.uvs[k], self.is_back(k), &station);
            }
            station
        };
        stage.map(self.runs.len(), |k| Pass { stations: self.runs[k].clone().map(told).collect() })
    }
}

/// The places on the face nearest to the contacts of a pass: those of them that lie on it.
fn places_of(setup: &Setup, grid: &FaceGrid, stations: &[Station]) -> Vec<Uv> {
    let face = setup.face;
    let mut last: Option<Uv> = None;
    let place = |station: &Station| {
        let point = station.cc.point;
        let is_there = |uv: &Uv| face.surface.point(*uv).distance(point) < AT;
        let near = last.map(|last| face.nearest_from(last, point)).filter(is_there);
        let uv = near.unwrap_or_else(|| face.nearest(grid, point));
        last = Some(uv);
        uv
    };
    stations.iter().map(place).collect()
}

/// Whether two locations are one.
fn is_same(a: &ClPoint, b: &ClPoint) -> bool {
    a.tip.distance(b.tip) < SAME && a.axis.distance(b.axis) < SAME
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Cylinder, Face, Field, Side};
    use crate::math::frame::Frame;
    use crate::posture::Rule;
    use crate::strategy::family::Detail;
    use crate::strategy::laid::Laid;
    use crate::strategy::trial::{FINISH, family};
    use glam::DVec3;

    /// What passes leave half way between two of them on the tube, in scallops.
    fn between(setup: &Setup, passes: &[Pass], [from, to]: [f64; 2]) -> f64 {
        let moves = Moves::new(setup, passes.iter());
        let share = |v: f64| {
            let height = moves.height(Uv::new(1.0, v), 1.5 * FINISH.scallop, 1e-3 * FINISH.scallop);
            height.map_or(1.5, |height| height / FINISH.scallop)
        };
        (0..=400).map(|k| share(from + (to - from) * f64::from(k) / 400.0)).fold(0.0, f64::max)
    }

    /// Passes round a tube, laid 0.96 strips apart: eased, they lean more, never less, by no more than the axis may turn, and
    /// leave between them what may be left.
    #[test]
    fn passes_that_overlap_lean_more_until_they_meet() {
        let (limits, stage) = (Limits { most_yaw: 0.0, ..Limits::default() }, Stage::silent());
        let lay = |rule: &Rule| {
            let frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
            let tube = Cylinder::new(DVec3::ZERO, frame, 20.0, [0.0, 2.0], [0.0, 20.0]).unwrap();
            let family = family(Face::new(tube, Side::Front), rule, (Field::V, Field::U));
            let middle = Uv::new(1.0, 10.0);
            let station = family.setup.station(middle, false).unwrap();
            let step = 0.96 * family.setup.width(middle, false, &station).unwrap();
            let levels = (0..).map(|k| step * (f64::from(k) + 0.4)).take_while(|level| *level < 20.0);
            let tracks: Vec<_> =
                levels.map(|level| family.candidate(level, 0, Detail::Full, &stage).unwrap()).collect();
            (step, Part::whole(family, tracks))
        };
        let (step, part) = lay(&Rule::Widest(limits));
        let setup = part.family.setup.clone();
        let laid = Laid::of(Rule::Widest(limits), part, Vec::new(), &stage).unwrap();
        assert!(laid.is_whole);
        let before = laid.planned.passes.clone();
        let after = laid.eased(&stage).unwrap().passes;
        assert_eq!(before.len(), after.len());
        let [low, high] = [&before, &after].map(|passes| between(&setup, passes, [1.4 * step, 2.4 * step]));
        assert!(low < 0.93 && (0.96..=1.004).contains(&high), "{low} {high}");
        let mut most = 0.0f64;
        for (a, b) in before.iter().flat_map(|p| &p.stations).zip(after.iter().flat_map(|p| &p.stations)) {
            let more = b.cc.posture.lead - a.cc.posture.lead;
            most = most.max(more);
            assert!(more >= 0.0 && a.cc.point == b.cc.point);
            assert!(b.work.strip <= a.work.strip);
            assert!(more <= 0.0 || is_same(&b.cl, &cl_of(setup.cutter, &b.cc)));
        }
        assert!(most > 1e-3);
        for pair in after.iter().flat_map(|pass| pass.stations.windows(2)) {
            let turn = angle_between(pair[0].cl.axis, pair[1].cl.axis);
            let way = pair[0].cc.point.distance(pair[1].cc.point);
            assert!(turn <= limits.most_turn[0] * way + 1e-9);
        }
        // What is prescribed stays as it is.
        let (_, part) = lay(&Rule::Matched(limits));
        let laid = Laid::of(Rule::Matched(limits), part, Vec::new(), &stage).unwrap();
        let before = laid.planned.passes.clone();
        assert_eq!(before, laid.eased(&stage).unwrap().passes);
    }
}
