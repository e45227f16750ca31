//! Stations along a level line, as far apart as the chord tolerance allows.

use super::probe::{GOUGE, Setup};
use crate::contact::contact_of;
use crate::geometry::{Curvature, IsoLine, Uv};
use crate::math::angle::angle_between;
use crate::math::frame::Frame;
use crate::toolpath::{CcPoint, ClPoint, Pass, Station, Work};
use glam::DVec3;

/// A station on the line, and whether the cutter can stand there.
#[derive(Debug, Clone, Copy)]
struct At {
    uv: Uv,
    station: Station,
    clear: bool,
}

/// Nodes that a move may span before it is looked at: moves longer than some strips help nobody.
const SPAN: usize = 8;
/// Halvings of a move: the shortest is a four-thousandth of a node's distance.
const DEPTH: usize = 12;

/// The passes along `line`: more than one where the cutter cannot go in between.
pub(super) fn passes(setup: &Setup, line: &IsoLine, reversed: bool) -> Vec<Pass> {
    let nodes = setup.in_feed_order(line, reversed);
    let walker = Walker { setup, nodes: &nodes, level: line.level, reversed };
    let last = nodes.len() - 1;
    let mut ats: Vec<Option<At>> = vec![walker.at(0.0)];
    let mut from = 0;
    while from < last {
        let to = (from + SPAN).min(last);
        let (a, b) = (walker.at(from as f64), walker.at(to as f64));
        walker.refine(a, (from as f64, to as f64), b, DEPTH, &mut ats);
        from = to;
    }
    walker.split(&ats)
}

/// The moves of a pass along `line` before its first node and beyond its last.
pub(super) fn ends(setup: &Setup, line: &IsoLine, reversed: bool) -> Vec<[ClPoint; 2]> {
    let nodes = setup.in_feed_order(line, reversed);
    let walker = Walker { setup, nodes: &nodes, level: line.level, reversed };
    let end = |node: usize, toward: f64| {
        let from = walker.at(node as f64).filter(|at| at.clear)?.station;
        let all = [vec![from], walker.run_out(nodes[node], &from, toward)].concat();
        Some(all.windows(2).map(|pair| [pair[0].cl, pair[1].cl]).collect::<Vec<_>>())
    };
    let ends = [end(0, -1.0), end(nodes.len() - 1, 1.0)];
    ends.into_iter().flatten().flatten().collect()
}

/// The most that the axis may turn in a move, radians (3°): parts of the cutter that nobody looks at here stray by the
/// square of it.
pub(super) const MOST_TURN: f64 = 0.052;
/// The most that the cutter turns beyond a border, radians: a line that ends on a rolled-over edge of a tenth of a
/// millimetre would otherwise wind up around it, over ground that is not there.
const MOST_RUN_OUT_TURN: f64 = 0.4;

/// How many times more moves there are beyond a border than a chord asks for: the rear of the cutter reaches back over it.
const FINER: f64 = 3.0;

/// How much more lead is tried there, radians, times the squares of so many numbers.
const MORE_LEAD: f64 = 0.002;
const MORE_LEADS: u32 = 7;

/// How deep the cutter may dig in between stations, in what it may at one.
const ON_THE_WAY: f64 = 1.8;

impl Setup<'_> {
    /// Whether the cutter on its way from one station to the other digs in by no more than stations and chords may together.
    pub(super) fn slides_off(&self, a: &Station, b: &Station) -> bool {
        let allowed = -ON_THE_WAY * GOUGE;
        let is_off = |s: f64| {
            let Some(axis) = a.cl.axis.lerp(b.cl.axis, s).try_normalize() else { return false };
            let cl = ClPoint { tip: a.cl.tip.lerp(b.cl.tip, s), axis };
            !self.obstacle.digs(self.cutter, &cl, DVec3::INFINITY, allowed)
        };
        [0.5, 0.25, 0.75].into_iter().all(is_off)
    }
}

struct Walker<'a> {
    setup: &'a Setup<'a>,
    nodes: &'a [Uv],
    level: f64,
    reversed: bool,
}

impl Walker<'_> {
    /// The station at `t` (node number and fraction to the next) and whether the cutter clears the face there; `None`
    /// where the face has no frame.
    fn at(&self, t: f64) -> Option<At> {
        let (uv, station) = self.station(t)?;
        if self.setup.postures.is_fixed() {
            return Some(At { uv, station, clear: self.setup.fits(&station, uv) });
        }
        // Between the places where postures were chosen a little more lead may be needed.
        let fitting = (0..MORE_LEADS).find_map(|k| {
            let more = MORE_LEAD * f64::from(k * k);
            let station = self.setup.leaning(&station, more);
            let clear =
                self.setup.fits(&station, uv) && self.setup.slides_clear(uv, self.reversed, more, &station);
            clear.then_some(station)
        });
        Some(At { uv, station: fitting.unwrap_or(station), clear: fitting.is_some() })
    }

    fn station(&self, t: f64) -> Option<(Uv, Station)> {
        let i = (t.floor() as usize).min(self.nodes.len() - 2);
        let (a, b, s) = (self.nodes[i], self.nodes[i + 1], t - i as f64);
        let uv = a.lerp(b, s);
        let uv = self.setup.course(self.reversed).onto_level(self.setup.face, self.level, uv)?;
        Some((uv, self.setup.station(uv, self.reversed)?))
    }

    /// Appends the stations after `a` up to and including `b`.
    fn refine(
        &self,
        a: Option<At>,
        (ta, tb): (f64, f64),
        b: Option<At>,
        depth: usize,
        out: &mut Vec<Option<At>>,
    ) {
        if self.is_straight(a, (ta, tb), b) {
            out.push(b);
            return;
        }
        if depth == 0 {
            // The feed turns at once, where fronts meet or a plane touches the face: no move leads on from here.
            out.extend([None, b]);
            return;
        }
        let middle = 0.5 * (ta + tb);
        let m = self.at(middle);
        self.refine(a, (ta, middle), m, depth - 1, out);
        self.refine(m, (middle, tb), b, depth - 1, out);
    }

    /// Whether the straight move from `a` to `b` stays within the chord tolerance of the line between them.
    fn is_straight(&self, a: Option<At>, (ta, tb): (f64, f64), b: Option<At>) -> bool {
        let (Some(a), Some(b)) = (a, b) else {
            // The end of what can be cut is found to an eighth of a node's distance.
            return (a.is_none() && b.is_none()) || tb - ta < 0.125;
        };
        if a.clear != b.clear {
            return tb - ta < 0.125;
        }
        if !a.clear {
            return true;
        }
        if angle_between(a.station.cl.axis, b.station.cl.axis) > MOST_TURN {
            return false;
        }
        let low = -(self.setup.finish.chord.min(GOUGE));
        let high = self.setup.finish.chord;
        [0.5, 0.25, 0.75].iter().all(|&s| {
            let Some((uv, m)) = self.station(ta + (tb - ta) * s) else { return false };
            let Some(axis) = a.station.cl.axis.lerp(b.station.cl.axis, s).try_normalize() else {
                return false;
            };
            let cl = ClPoint { tip: a.station.cl.tip.lerp(b.station.cl.tip, s), axis };
            let half = 0.5 * self.setup.breadth(uv, self.reversed);
            self.lifts(&cl, &m, half).iter().all(|lift| (low..=high).contains(lift))
                && (self.setup.postures.is_fixed() || self.stays_off(&cl, &m))
        })
    }

    /// How far the cutter at `cl` stands above where it stands at the station `m`, mm, negative for below: towards the
    /// contact, and towards the two edges of its strip, `half` its width away, where a roll about the feed counts.
    fn lifts(&self, cl: &ClPoint, m: &Station, half: f64) -> [f64; 3] {
        let cutter = self.setup.cutter;
        let frame = m.cc.frame;
        let s = libm::sin(m.cc.posture.lead);
        // The envelope's slope against the surface at an edge.
        let across = (s / (cutter.center_radius + cutter.corner_radius * s)).min(1.0);
        let slope = half * across;
        [0.0, slope, -slope].map(|slope| {
            let n = (frame.n + frame.b * slope).normalize();
            match (contact_of(cutter, cl, n), contact_of(cutter, &m.cl, n)) {
                (Some(there), Some(here)) => (there - here).dot(n),
                _ => (cl.tip - m.cl.tip).dot(n),
            }
        })
    }

    /// Whether the cutter at `cl` on the way, near the station `m`, digs in beyond its contact by no more than stations and
    /// chords may together. A posture that is chosen leaves hardly any room under the rear.
    fn stays_off(&self, cl: &ClPoint, m: &Station) -> bool {
        let allowed = -ON_THE_WAY * GOUGE;
        !self.setup.obstacle.digs(self.setup.cutter, cl, m.cc.point, allowed)
    }

    /// The clear runs of at least two stations.
    fn split(&self, ats: &[Option<At>]) -> Vec<Pass> {
        let clear = |at: &Option<At>| at.filter(|at| at.clear);
        let mut passes = Vec::new();
        let mut start = 0;
        for run in ats.chunk_by(|a, b| clear(a).is_some() == clear(b).is_some()) {
            if run.len() > 1 && clear(&run[0]).is_some() {
                let mut stations: Vec<Station> = run.iter().flatten().map(|at| self.worked(at)).collect();
                if start == 0 {
                    let before = self.run_out(self.nodes[0], &stations[0], -1.0);
                    stations.splice(0..0, before.into_iter().rev());
                }
                if start + run.len() == ats.len() {
                    let last = stations[stations.len() - 1];
                    stations.extend(self.run_out(self.nodes[self.nodes.len() - 1], &last, 1.0));
                }
                passes.push(Pass { stations });
            }
            start += run.len();
        }
        passes
    }

    /// The station with the width of its strip.
    fn worked(&self, At { uv, station, .. }: &At) -> Station {
        let strip = self.setup.width(*uv, self.reversed, station);
        Station { work: Work { strip, ..station.work }, ..*station }
    }

    /// The stations beyond the border at an end of the line, on (`toward` +1) or back (−1): so far that the whole width of
    /// the strip has run over the border, be that met aslant or the strip cut aslant by a yawed cutter. They follow the
    /// line as it would go on with the curvature that it ends with. None where the line does not end on a border, or the
    /// cutter would dig in.
    fn run_out(&self, uv: Uv, end: &Station, toward: f64) -> Vec<Station> {
        let Some(ways) = self.setup.run_out_ways(uv, self.reversed) else { return Vec::new() };
        let way = ways[usize::from(toward > 0.0)];
        let (jet, frame) = (self.setup.face.jet(uv), end.cc.frame);
        let Some(k) = Curvature::of(&jet, &frame) else { return Vec::new() };
        let [bend, twist] = [k.ff, k.fb].map(|k| k.clamp(-MOST_RUN_OUT_TURN / way, MOST_RUN_OUT_TURN / way));
        // As many moves as the chord of that curvature and the turn of the axis ask for.
        let chord = (8.0 * self.setup.finish.chord.min(GOUGE) / bend.abs().max(1e-6)).sqrt();
        let turn = libm::hypot(bend, twist) * way / MOST_TURN;
        let count = (FINER * (way / chord).max(turn)).ceil().clamp(1.0, 64.0) as usize;
        let mut last = *end;
        let beyond = |i: usize| {
            let s = toward * way * i as f64 / count as f64;
            let (point, n, along) = arc(&end.cc, [bend, twist], s);
            let cc = CcPoint { point, frame: Frame::from_normal(n, along)?, ..end.cc };
            let on = Station { cc, cl: end.cl, work: Work { strip: None, ..end.work } };
            // What goes on beyond a border is a guess at the surface: more lead makes up for it.
            last = (0..MORE_LEADS)
                .map(|k| self.setup.leaning(&on, MORE_LEAD * f64::from(k * k)))
                .find(|station| self.setup.is_off(&station.cl) && self.setup.slides_off(&last, station))?;
            Some(last)
        };
        (1..=count).map_while(beyond).collect()
    }
}

/// Point, normal and direction `s` mm beyond a contact, where the surface bends and twists along the feed as it does there.
fn arc(cc: &CcPoint, [bend, twist]: [f64; 2], s: f64) -> (DVec3, DVec3, DVec3) {
    let Frame { f, b, n } = cc.frame;
    let (sine, cosine) = libm::sincos(bend * s);
    // Chord and sagitta of the arc, also where it is almost straight.
    let half = 0.5 * bend * s;
    let chord = if half == 0.0 { s } else { s * libm::sin(half) / half };
    let (half_sine, half_cosine) = libm::sincos(half);
    let point = cc.point + (f * half_cosine + n * half_sine) * chord;
    let along = f * cosine + n * sine;
    let (twist_sine, twist_cosine) = libm::sincos(twist * s);
    let normal = (n * cosine - f * sine) * twist_cosine - b * twist_sine;
    (point, normal, along)
}
