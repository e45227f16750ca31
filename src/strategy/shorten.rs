//! A quicker order of passes, by moving runs of them to where they join better.

use super::link::{Linking, Refuge};
use super::order::reversed;
use crate::toolpath::{ClPoint, Pass};
use glam::DVec3;

/// Passes that each one is tried before: its nearest.
const NEAR: usize = 8;
/// Longest run of passes that is moved, besides all that follow.
const RUN: usize = 3;
/// Sweeps over all passes: a dozen is what it takes, and more would only look for crumbs.
const SWEEPS: usize = 24;
/// What counts as quicker, min.
const LEAST: f64 = 1e-9;

/// `passes` in an order whose links take less time, some of them `turned` if they may be; nothing where none is found.
///
/// Local search from the order that is there: every pass is tried behind its nearest ones, alone, with the two after it, or with all after it,
/// and where passes may be turned also turned round, or by turning what lies between. What a link costs is its time as
/// [`link`](super::link()) would lay it with nothing in its way.
pub fn shortened(passes: &[Pass], turned: bool, how: &Linking, refuge: &Refuge) -> Option<Vec<Pass>> {
    let end = |cl: ClPoint| {
        let out = refuge.exit(cl).tip;
        End { cl, out, away: out.distance(cl.tip) }
    };
    let ends: Option<Vec<[End; 2]>> = passes
        .iter()
        .map(|pass| Some([end(pass.stations.first()?.cl), end(pass.stations.last()?.cl)]))
        .collect();
    let mut search = Search { ends: ends?, how, refuge, order: (0..passes.len()).map(|k| 2 * k).collect() };
    search.improve(turned).then(|| {
        let pass = |&way: &usize| {
            let pass = passes[way / 2].clone();
            if way % 2 == 1 { reversed(pass) } else { pass }
        };
        search.order.iter().map(pass).collect()
    })
}

/// An end of a pass.
struct End {
    cl: ClPoint,
    /// Where it enters the refuge, and how far that is.
    out: DVec3,
    away: f64,
}

struct Search<'a> {
    /// Start and end of each pass.
    ends: Vec<[End; 2]>,
    how: &'a Linking,
    refuge: &'a Refuge,
    /// Twice the number of each pass, and 1 more where it is turned.
    order: Vec<usize>,
}

impl Search<'_> {
    fn start(&self, way: usize) -> &End {
        &self.ends[way / 2][way % 2]
    }

    fn end(&self, way: usize) -> &End {
        self.start(way ^ 1)
    }

    /// Time of the link between two ways, min, without the last stretch down; from and to the refuge where there is none.
    fn join(&self, from: Option<usize>, to: Option<usize>) -> f64 {
        let rapid = |away: f64| away / self.how.rapid;
        match (from.map(|way| self.end(way)), to.map(|way| self.start(way))) {
            (Some(from), Some(to)) => {
                let around = from.away + self.refuge.around_by(from.out, to.out) + to.away - self.how.lift;
                self.how.near(&from.cl, &to.cl).unwrap_or(rapid(around))
            }
            (Some(end), None) | (None, Some(end)) => rapid(end.away),
            (None, None) => 0.0,
        }
    }

    /// The ways to go through passes whose starts are nearest to the end of each way.
    fn nearest(&self, way: usize, turned: bool) -> [usize; NEAR] {
        let from = self.end(way).cl.tip;
        let mut best = [(f64::INFINITY, usize::MAX); NEAR];
        for other in (0..2 * self.ends.len()).step_by(if turned { 1 } else { 2 }) {
            let away = self.start(other).cl.tip.distance_squared(from);
            if other / 2 != way / 2 && away < best[NEAR - 1].0 {
                let at = best.partition_point(|near| near.0 <= away);
                best[at..].rotate_right(1);
                best[at] = (away, other);
            }
        }
        best.map(|near| near.1)
    }

    fn improve(&mut self, turned: bool) -> bool {
        let count = self.order.len();
        let near: Vec<[usize; NEAR]> = (0..2 * count).map(|way| self.nearest(way, turned)).collect();
        let mut places = vec![0; count];
        let mut improved = false;
        for _ in 0..SWEEPS {
            let mut better = false;
            self.order.iter().enumerate().for_each(|(place, way)| places[way / 2] = place);
            for place in 0..count {
                let mut behind = near[self.order[place]].iter().filter(|next| **next != usize::MAX);
                if behind.any(|&next| self.follow(place, next, places[next / 2])) {
                    better = true;
                    self.order.iter().enumerate().for_each(|(place, way)| places[way / 2] = place);
                }
            }
            if !better {
                break;
            }
            improved = true;
        }
        improved
    }

    /// Tries to have the pass at `place` followed by the way `next` through the one at `at`.
    fn follow(&mut self, place: usize, next: usize, at: usize) -> bool {
        let count = self.order.len();
        let way = |place: Option<usize>| place.and_then(|place| self.order.get(place)).copied();
        let between = |place: usize| self.join(way(place.checked_sub(1)), way(Some(place)));
        let is_turned = self.order[at] != next;
        if !is_turned && at == place + 1 {
            return false;
        }
        let after = way(Some(place + 1));
        for run in (1..=RUN).chain([count]) {
            // The run from first to behind last, whose first or, turned, whose last is the next one.
            let (first, last) = if is_turned {
                (if run == count { place + 1 } else { (at + 1).saturating_sub(run) }, at + 1)
            } else {
                (at, (at + run).min(count))
            };
            if first > at || (first..last).contains(&place) {
                continue;
            }
            let tail = if is_turned { self.order[first] ^ 1 } else { self.order[last - 1] };
            // A run that follows already is turned where it is.
            let stays = first == place + 1;
            let (gone, come) = if stays {
                let behind = way(Some(last));
                (
                    between(first) + between(last),
                    self.join(way(Some(place)), Some(next)) + self.join(Some(tail), behind),
                )
            } else {
                let healed = self.join(way(first.checked_sub(1)), way(Some(last)));
                // At either end of the order the run takes its way in or out with it.
                let old = between(first) + between(last) + between(place + 1);
                (old, healed + self.join(way(Some(place)), Some(next)) + self.join(Some(tail), after))
            };
            if come < gone - LEAST {
                if is_turned {
                    self.order[first..last].reverse();
                    self.order[first..last].iter_mut().for_each(|way| *way ^= 1);
                }
                if first > place {
                    self.order[place + 1..last].rotate_left(first - place - 1);
                } else {
                    self.order[first..=place].rotate_left(last - first);
                }
                return true;
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::frame::Frame;
    use crate::strategy::nearest_next;
    use crate::toolpath::{CcPoint, Posture, Station, Work};

    fn station(x: f64, y: f64) -> Station {
        let point = DVec3::new(x, y, 0.0);
        let frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
        let cc = CcPoint { point, frame, posture: Posture::default() };
        Station { cc, cl: ClPoint { tip: point, axis: DVec3::Z }, work: Work::default() }
    }

    /// Short passes all over a square, as partial passes lie: the fractional parts of multiples of two irrational numbers.
    fn scattered(count: usize) -> Vec<Pass> {
        let place = |k: usize, by: f64| 300.0 * (k as f64 * by).fract();
        let pass = |k: usize| {
            let (x, y) = (place(k, 0.754_877_666), place(k, 0.569_840_291));
            Pass { stations: vec![station(x, y), station(x + 2.0 + 5.0 * (k as f64 * 0.31).fract(), y)] }
        };
        (0..count).map(pass).collect()
    }

    #[test]
    fn links_take_less_time_and_no_pass_is_lost() {
        let how = Linking {
            cut_feed: 1000.0,
            plunge_feed: 300.0,
            rapid: 8000.0,
            lift: 1.0,
            lever: 20.0,
            clearance: 5.0,
            fixture: None,
        };
        let refuge = Refuge::Above(10.0);
        for (count, turned) in [(1, true), (2, false), (60, false), (60, true), (1500, true)] {
            let before = nearest_next(scattered(count), turned);
            let time = |passes: &[Pass]| {
                let link =
                    super::super::link(passes, &how, &refuge, &|_| true, &crate::monitor::Stage::silent());
                super::super::link_time(&link.unwrap().toolpath, &how)
            };
            let Some(after) = shortened(&before, turned, &how, &refuge) else {
                assert!(count < 60);
                continue;
            };
            // At least a twentieth off what the nearest next gives.
            assert!(time(&after) < 0.95 * time(&before), "{count}: {} of {}", time(&after), time(&before));
            let ends = |passes: &[Pass]| {
                let end = |pass: &Pass| {
                    let mut ends =
                        [pass.stations[0].cc.point.x, pass.stations[1].cc.point.x].map(f64::to_bits);
                    ends.sort_unstable();
                    (ends, pass.stations[0].cc.point.y.to_bits())
                };
                let mut ends: Vec<_> = passes.iter().map(end).collect();
                ends.sort_unstable();
                ends
            };
            assert_eq!(ends(&after), ends(&before));
            assert!(turned || after.iter().all(|p| p.stations[0].cc.point.x < p.stations[1].cc.point.x));
        }
    }
}
