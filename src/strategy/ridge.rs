//! The ridge of a cusp, climbed to from beside it: where an edge is rolled over tightly it stands a few hundredths of a millimetre
//! wide, and no places between which nothing is looked at are close enough together.

use super::left::{Moves, Near};
use super::places::Patch;
use super::probe::Setup;
use crate::geometry::Uv;
use crate::math::bvh::Aabb;

/// Up to how much heights are told, in limits.
const MOST: f64 = 1.05;
/// How finely on a climb, in what it looks for.
const FINE: f64 = 1e-3;
/// How far from the middle of a patch its slopes are taken, in sides of it.
const BESIDE: f64 = 0.125;
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

    /// The highest place in `part` of the patch straight up the slope from its middle, if more than `most` limits are left there, as far as
    /// that is told.
    pub(super) fn ridge(&self, part: &Patch, most: f64) -> Option<Uv> {
        let share = |[u, v]: [f64; 2]| self.share(part.at(u, v), FINE) / most;
        // Up a flank it is nearly straight.
        let here = share([0.5; 2]).sqrt();
        let rise = [[0.5 + BESIDE, 0.5], [0.5, 0.5 + BESIDE]].map(|at| (share(at).sqrt() - here) / BESIDE);
        let steep = libm::hypot(rise[0], rise[1]);
        let way = rise.map(|rise| rise / steep);
        // As far as the part reaches.
        let end = 0.5 / way[0].abs().max(way[1].abs());
        if !end.is_finite() || here + steep * end < SURELY.sqrt() {
            return None;
        }
        let at = |t: f64| way.map(|way| 0.5 + t * way);
        let inner = |low: f64, high: f64| [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
        let told = |t: f64| (t, share(at(t)));
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
        let (highest, share) = if one.1 > two.1 { one } else { two };
        let [u, v] = at(highest);
        (share > 1.0).then(|| part.at(u, v))
    }
}
