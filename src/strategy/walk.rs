//! Stations along a level line, as far apart as the chord tolerance allows.

use super::probe::{GOUGE, Setup};
use crate::contact::contact_of;
use crate::geometry::{IsoLine, Uv};
use crate::toolpath::{ClPoint, Pass, Station};

/// A station on the line, and whether the cutter can stand there.
#[derive(Debug, Clone, Copy)]
struct At {
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
        let station = self.station(t)?;
        Some(At { station, clear: self.setup.is_clear(&station) })
    }

    fn station(&self, t: f64) -> Option<Station> {
        let i = (t.floor() as usize).min(self.nodes.len() - 2);
        let (a, b, s) = (self.nodes[i], self.nodes[i + 1], t - i as f64);
        let uv = Uv::new(a.u + (b.u - a.u) * s, a.v + (b.v - a.v) * s);
        let uv = self.setup.field.onto_level(self.setup.face, self.level, uv)?;
        self.setup.station(uv, self.reversed)
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
        if depth == 0 || self.is_straight(a, (ta, tb), b) {
            out.push(b);
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
        let low = -(self.setup.finish.chord.min(GOUGE));
        let high = self.setup.finish.chord;
        [0.5, 0.25, 0.75].iter().all(|&s| {
            let Some(m) = self.station(ta + (tb - ta) * s) else { return false };
            (low..=high).contains(&lift(self, &a.station.cl, &b.station.cl, s, &m))
        })
    }

    /// The clear runs of at least two stations.
    fn split(&self, ats: &[Option<At>]) -> Vec<Pass> {
        let clear = |at: &Option<At>| at.filter(|at| at.clear);
        ats.chunk_by(|a, b| clear(a).is_some() == clear(b).is_some())
            .filter(|run| run.len() > 1 && clear(&run[0]).is_some())
            .map(|run| Pass { stations: run.iter().flatten().map(|at| at.station).collect() })
            .collect()
    }
}

/// How far above the face the cutter passes over the station `m` when it goes straight from `a` to `b` and has done
/// the share `s` of the move, mm; negative for a gouge.
fn lift(walker: &Walker, a: &ClPoint, b: &ClPoint, s: f64, m: &Station) -> f64 {
    let Some(axis) = a.axis.lerp(b.axis, s).try_normalize() else { return f64::INFINITY };
    let cl = ClPoint { tip: a.tip.lerp(b.tip, s), axis };
    let n = m.cc.frame.n;
    match contact_of(walker.setup.cutter, &cl, n) {
        Some(lowest) => (lowest - m.cc.point).dot(n),
        None => (cl.tip - m.cc.point).dot(n),
    }
}
