//! The ridge of a cusp, climbed to from beside it: where an edge is rolled over tightly it stands a few hundredths of a millimetre
//! wide, and no places between which nothing is looked at are close enough together.

use super::left::{Moves, Near};
use super::places::Patch;
use super::probe::Setup;
use crate::geometry::Uv;
use crate::math::bvh::Aabb;
use glam::DVec2;

/// Up to how much heights are told, in limits.
const MOST: f64 = 1.05;
/// How finely on a climb, in what it looks for.
const FINE: f64 = 1e-3;
/// How far from the middle of a patch its slopes are taken, in sides of it.
const BESIDE: f64 = 0.125;
/// How far from a ridge, and from there, those of its flanks.
const CLEAR: f64 = 0.06;
/// Where they differ by less than this share of the first slope, the part's border was met before the ridge.
const BENT: f64 = 0.25;
/// Flanks that would come to less than this share of what is looked for, were they as straight as roots of heights nearly are, are
/// not climbed.
const SURELY: f64 = 0.95;
/// Roots of heights that differ by less than this are the same.
const CLOSE: f64 = 3e-3;
/// Places on a climb; each keeps the golden share of the way.
const PLACES: usize = 16;
const GOLDEN: f64 = 0.618_033_988_749_894_8;

/// What moves leave in a patch of a face.
pub(super) struct Cusps<'m> {
    near: Near<'m>,
    /// What may be left, mm.
    limit: f64,
}

impl<'m> Cusps<'m> {
    /// What `moves` leave in `patch`, asked in `limit`s (mm); `None` where the face has no normal.
    pub(super) fn new(setup: &Setup, patch: &Patch, moves: &'m Moves, limit: f64) -> Option<Self> {
        let asked = patch.corners().into_iter().chain([patch.middle()]);
        let ends =
            asked.filter_map(|uv| setup.face.at(uv)).flat_map(|(jet, n)| [jet.p, jet.p + n * MOST * limit]);
        let (middle, reach) = Aabb::around(ends).ball();
        // What bulges between the corners of so small a patch stays within a half more.
        reach.is_finite().then(|| Self { near: moves.around((middle, 1.5 * reach)), limit })
    }

    /// How much is left at a place in the patch, in limits, to a `fine`ness in the same and rather more.
    pub(super) fn share(&self, uv: Uv, fine: f64) -> f64 {
        self.near.height(uv, MOST * self.limit, fine * self.limit) / self.limit
    }

    /// The highest place in `part` of the patch that is met straight up the slope from its middle and then along the ridge there, if more
    /// than the limit is left at it, as far as that is told.
    pub(super) fn ridge(&self, part: &Patch) -> Option<Uv> {
        // Up a flank these are nearly straight.
        let root = |at: DVec2| self.share(part.at(at.x, at.y), FINE).sqrt();
        // How they rise at a place, told by what is so much of a side beside it.
        let rise = |at: DVec2, here: f64, beside: DVec2| {
            DVec2::new(
                (root(at + DVec2::new(beside.x, 0.0)) - here) / beside.x,
                (root(at + DVec2::new(0.0, beside.y)) - here) / beside.y,
            )
        };
        let middle = DVec2::splat(0.5);
        let here = root(middle);
        let slope = rise(middle, here, DVec2::splat(BESIDE));
        let way = slope.try_normalize()?;
        let steep = slope.dot(way);
        let (top, height) = highest(&root, (middle, here), steep, way)?;
        if height > 1.0 {
            return Some(part.at(top.x, top.y));
        }
        // The flanks to either side, away from the ridge; near the middle there may have been another. Along the ridge neither rises faster
        // than the other.
        let [flank, other] = [-CLEAR, CLEAR].map(|off| {
            let (at, beside) =
                (top + way * off, off * DVec2::new(1f64.copysign(way.x), 1f64.copysign(way.y)));
            rise(at, root(at), beside)
        });
        if (flank - other).dot(way) < BENT * steep {
            return None;
        }
        let along = (flank - other).perp().try_normalize()?;
        let along = along * flank.dot(along).signum();
        let (top, height) = highest(&root, (top, height), flank.dot(along), along)?;
        (height > 1.0).then(|| part.at(top.x, top.y))
    }
}

/// The place in a part, and the root of what is left there, where most is left on the `way` from another to the border; `None` where
/// it surely is not enough, if it rises as `steep`ly as at first.
fn highest(
    root: &dyn Fn(DVec2) -> f64,
    (from, here): (DVec2, f64),
    steep: f64,
    way: DVec2,
) -> Option<(DVec2, f64)> {
    // As far as the part reaches.
    let reach = |from: f64, way: f64| if way > 0.0 { (1.0 - from) / way } else { from / -way };
    let end = [(from.x, way.x), (from.y, way.y)].into_iter().filter(|(_, way)| *way != 0.0);
    let end = end.map(|(from, way)| reach(from, way)).fold(f64::INFINITY, f64::min);
    if !end.is_finite() || here + steep * end < SURELY.sqrt() {
        return None;
    }
    let inner = |low: f64, high: f64| [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let told = |t: f64| (t, root(from + way * t));
    let (mut low, mut high) = (0.0, end);
    let [mut one, mut two] = inner(low, high).map(told);
    for _ in 0..PLACES {
        if steep * (high - low) < CLOSE {
            break;
        }
        if one.1 > two.1 {
            (high, two) = (two.0, one);
            one = told(inner(low, high)[0]);
        } else {
            (low, one) = (one.0, two);
            two = told(inner(low, high)[1]);
        }
    }
    let (at, height) = if one.1 > two.1 { one } else { two };
    Some((from + way * at, height))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::cl_of;
    use crate::geometry::Field;
    use crate::math::angle::direction;
    use crate::math::frame::Frame;
    use crate::strategy::trial::{FINISH, family, flat, leaning};
    use crate::toolpath::{CcPoint, Posture, Station, Work};
    use glam::DVec3;
    use std::f64::consts::FRAC_PI_3;

    /// Three strips that lie round a place aslant leave most right there: it is met from the middle of whatever part it lies in in 97 of
    /// 100 cases, though in two of three not straight up a slope.
    #[test]
    fn points_between_three_strips_are_climbed_to() {
        let family = family(flat([-10.0, 10.0], [-10.0, 10.0]), &leaning(0.2, 0.0), (Field::V, Field::U));
        let (setup, limit) = (&family.setup, FINISH.scallop);
        // Straight moves past a place in so many radians, so far from it.
        let around = |place: DVec3, turned: f64, away: f64| {
            let moves = (0..3).map(|k| {
                let f = direction(turned + 2.0 * FRAC_PI_3 * f64::from(k)).extend(0.0);
                let frame = Frame { f, b: DVec3::Z.cross(f), n: DVec3::Z };
                let at = |along: f64| {
                    let point = place + frame.b * away + f * along;
                    let cc = CcPoint { point, frame, posture: Posture { lead: 0.2, yaw: 0.0 } };
                    Station { cc, cl: cl_of(setup.cutter, &cc), work: Work::default() }
                };
                [at(-4.0), at(4.0)]
            });
            Moves::of(setup, moves.collect())
        };
        let (mut near, mut far) = (0.0, 2.0);
        while far - near > 1e-6 {
            let away = 0.5 * (near + far);
            let left = around(DVec3::ZERO, 0.0, away).height(Uv::new(0.0, 0.0), 2.0 * limit, 1e-4 * limit);
            *(if left.is_none_or(|left| left > 1.02 * limit) { &mut far } else { &mut near }) = away;
        }
        let [plain, _] = family.patches();
        let patch = plain[plain.len() / 2];
        let part = patch.parts(4).nth(5).unwrap();
        let mut missed = 0;
        for k in 0..400 {
            let share = |times: f64| 0.1 + 0.8 * (f64::from(k) * times).fract();
            let Uv { u, v } = part.at(share(0.7549), share(0.5698));
            let moves = around(DVec3::new(u, v, 0.0), 0.07 * f64::from(k), far);
            let cusps = Cusps::new(setup, &patch, &moves, limit).unwrap();
            match cusps.ridge(&part) {
                Some(found) => assert!(cusps.share(found, 1e-4) > 1.0 - 2.0 * FINE, "{k}"),
                None => missed += 1,
            }
        }
        assert!(missed <= 12, "{missed}");
    }
}
