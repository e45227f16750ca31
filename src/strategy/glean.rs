//! Short passes for what all others leave: beside borders that lines run into aslant, and along edges that bend much tighter
//! than strips are wide.

use super::family::{Candidate, Family};
use super::left::Moves;
use super::places::{Patch, between};
use super::probe::Probe;
use super::ridge::Cusps;
use crate::geometry::{IsoLine, Uv};
use crate::math::order::{rank, sort_by_key};
use crate::monitor::{Cancelled, Stage};
use glam::DVec3;

/// Where more than this share of the limit is left, places lie closer together, so many times.
const HIGH: f64 = 0.4;
const CLOSER: [usize; 2] = [4, 8];
/// Where more than this share of it is left at one of those, places about it lie so many times closer together once more: where
/// curves that bend begin, more than the limit is left on spots smaller than an eighth of a strip.
const NEARLY: f64 = 0.9;
const CLOSEST: usize = 3;
/// How finely heights are told there, in limits.
const COARSE: f64 = 0.02;
/// Where their roots, in which flanks are nearly straight, differ by more than this, a cusp is steep; its ridge may stand higher by this
/// share of that difference.
const STEEP: f64 = 0.12;
const RISE: f64 = 0.7;
/// The share of the limit that counts as no more than it, where leads are fixed: their strips overlap by 0.3 % only, and where lines bend
/// they leave the limit itself. It is 1.00 of it as far as that is written; strips of chosen postures overlap by more.
const WITHIN: f64 = 1.004;
/// Places nearer to each other than this belong together, in strips.
const TOGETHER: f64 = 0.55;
/// How far a short pass goes beyond what it is for, in strips.
const LONGER: f64 = 0.7;
/// Levels, in strips of the family, that one short pass takes care of.
const DEEP: f64 = 0.8;
/// Levels beside that of a spot, in the same, at which a line is looked for if the one there does not pass all of it: along
/// a border that lines meet aslant each has a piece of it only, and in a corner they are points.
const ASIDE: [f64; 7] = [0.0, 0.1, -0.1, 0.2, -0.2, 0.35, -0.35];
/// How near a line passes what it is for, in strips.
const PASSED: f64 = 0.5;
/// What each round takes of those distances.
const NEARER: f64 = 0.5;

/// What is looked for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sought {
    /// Where more than this is left, mm.
    pub(super) limit: f64,
    /// Up to the very ridges of cusps everywhere, and not only beside borders and where the face bends much.
    pub(super) finely: bool,
}

impl Family<'_> {
    /// Where is looked for what `moves` leave more than is sought: places all over the face, closer together where much is left, and those
    /// of `others` and on `ridges`.
    pub(super) fn looks(
        &self,
        moves: &Moves,
        (others, ridges): (&[Uv], &[Uv]),
        sought: Sought,
        stage: &Stage,
    ) -> Result<Vec<Uv>, Cancelled> {
        let limit = sought.limit;
        let [plain, close] = self.patches();
        let mut looks: Vec<Uv> = plain.iter().chain(&close).map(|patch| patch.low).collect();
        let closely = Sought { limit, finely: true };
        looks.extend(self.high_looks(&close, moves, closely, &stage.share(0.0, 0.5))?);
        looks.extend(self.high_looks(&plain, moves, sought, &stage.share(0.5, 1.0))?);
        let border = self.border();
        let is_high = |[a, b]: [Uv; 2]| moves.leave(a, HIGH * limit) || moves.leave(b, HIGH * limit);
        let is_high = stage.quiet().map(border.len(), |k| is_high(border[k]))?;
        let high = border.iter().zip(is_high).filter(|(_, is_high)| *is_high);
        let along = |&[a, b]: &[Uv; 2]| (0..=CLOSER[1]).map(move |k| between(a, b, k, CLOSER[1]));
        looks.extend(high.flat_map(|(ends, _)| along(ends)));
        looks.extend(others.iter().chain(ridges));
        Ok(looks)
    }

    /// Places near what is high already in `patches`, between whose corners more may be left.
    fn high_looks(
        &self,
        patches: &[Patch],
        moves: &Moves,
        Sought { limit, finely }: Sought,
        stage: &Stage,
    ) -> Result<Vec<Uv>, Cancelled> {
        let leaves = |uv: Uv, share: f64| moves.leave(uv, share * limit);
        let asked = |patch: &Patch| patch.corners().into_iter().chain([patch.middle()]);
        let looks = |k: usize| {
            if !asked(&patches[k]).any(|uv| leaves(uv, HIGH)) {
                return Vec::new();
            }
            if finely {
                return self.looks_in(&patches[k], moves, limit);
            }
            let mut looks = Vec::new();
            for part in patches[k].parts(CLOSER[0]) {
                let middle = part.middle();
                if leaves(middle, 1.0) {
                    looks.push(middle);
                } else if leaves(middle, NEARLY) {
                    looks.extend(part.places(CLOSEST));
                }
            }
            looks
        };
        Ok(stage.map(patches.len(), looks)?.into_iter().flatten().collect())
    }

    /// The same in one of them, up to the ridges of cusps.
    fn looks_in(&self, patch: &Patch, moves: &Moves, limit: f64) -> Vec<Uv> {
        let Some(cusps) = Cusps::new(&self.setup, patch, moves, limit) else { return Vec::new() };
        let root = |uv: Uv| (uv, cusps.share(uv, COARSE).sqrt());
        let nodes: Vec<(Uv, f64)> = patch.nodes(CLOSER[0]).map(root).collect();
        let mut looks: Vec<Uv> = nodes.iter().filter(|(_, root)| *root > 1.0).map(|(uv, _)| *uv).collect();
        for (k, part) in patch.parts(CLOSER[0]).enumerate() {
            let (uv, middle) = root(part.middle());
            if middle > 1.0 {
                looks.push(uv);
            }
            // Corners may lie on either side of a cusp.
            let first = k + k / CLOSER[0];
            let (mut low, mut high) = (middle, middle);
            for k in [first, first + 1, first + CLOSER[0] + 1, first + CLOSER[0] + 2] {
                (low, high) = (low.min(nodes[k].1), high.max(nodes[k].1));
            }
            let may_rise_to =
                if high - low > STEEP { high + RISE * (high - low) } else { high * high / NEARLY };
            if may_rise_to > 1.0
                && let Some(uv) = cusps.ridge(&part)
            {
                looks.push(uv);
            }
        }
        looks
    }

    /// Those of `looks` where `moves` leave more than the limit: where the cutter can go, and where it cannot.
    pub(super) fn left(&self, looks: &[Uv], moves: &Moves, stage: &Stage) -> Result<[Vec<Uv>; 2], Cancelled> {
        // A posture that is chosen may need a little more lead just here, which its pass then takes.
        let is_chosen = !self.setup.postures.is_fixed();
        let limit = self.setup.finish.scallop * if is_chosen { 1.0 } else { WITHIN };
        let is_blocked = |uv: Uv| !is_chosen && self.setup.probe(uv, false) == Probe::Blocked;
        let is_left = |uv: Uv| moves.leave(uv, limit).then(|| is_blocked(uv));
        let told = stage.map(looks.len(), |k| is_left(looks[k]))?;
        let of = |blocked: bool| {
            let found = looks.iter().zip(&told).filter(|(_, told)| **told == Some(blocked));
            found.map(|(&uv, _)| uv).collect()
        };
        Ok([of(false), of(true)])
    }

    /// Short lines, with what the cutter does on them, through the places `left` after so many of them: what is still there then
    /// was passed too far off, and lines go nearer.
    pub(super) fn short_lines(
        &self,
        left: &[Uv],
        gleanings: usize,
        stage: &Stage,
    ) -> Result<Vec<Candidate>, Cancelled> {
        let near = NEARER.powi(gleanings as i32) * self.setup.strip;
        let mut found = Vec::new();
        for spot in self.spots(left, TOGETHER * near) {
            self.add_lines(&spot, PASSED * near, &mut found, stage)?;
        }
        Ok(found)
    }

    /// The places in groups, with their points: those that are so near (mm) to one another hang together.
    fn spots(&self, left: &[Uv], near: f64) -> Vec<Vec<(Uv, DVec3)>> {
        let places: Vec<(Uv, DVec3)> =
            left.iter().map(|&uv| (uv, self.setup.face.surface.point(uv))).collect();
        // Only what lies so near along an axis can, least of all along the one on which they are spread most.
        let (low, high) = places
            .iter()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), (_, p)| (low.min(*p), high.max(*p)));
        let axis = (high - low).max_position();
        let along = |k: usize| places[k].1[axis];
        let mut in_order: Vec<usize> = (0..places.len()).collect();
        sort_by_key(&mut in_order, |&k| (rank(along(k)), 0));
        let mut is_taken = vec![false; places.len()];
        let mut spots = Vec::new();
        for first in (0..places.len()).rev() {
            if is_taken[first] {
                continue;
            }
            is_taken[first] = true;
            let mut spot = vec![places[first]];
            let mut next = 0;
            while let Some(&(_, here)) = spot.get(next) {
                let from = in_order.partition_point(|&k| along(k) < here[axis] - near);
                for &k in in_order[from..].iter().take_while(|&&k| along(k) <= here[axis] + near) {
                    if !is_taken[k] && places[k].1.distance_squared(here) < near * near {
                        is_taken[k] = true;
                        spot.push(places[k]);
                    }
                }
                next += 1;
            }
            spots.push(spot);
        }
        spots
    }

    /// Appends pieces of lines through `spot`, as many as its levels need, which pass its places so near (mm).
    fn add_lines(
        &self,
        spot: &[(Uv, DVec3)],
        near: f64,
        found: &mut Vec<Candidate>,
        stage: &Stage,
    ) -> Result<(), Cancelled> {
        // Short passes all go forwards.
        let course = self.setup.course(false);
        let levels = || spot.iter().map(|&(uv, p)| course.value(uv, p));
        let low = levels().fold(f64::INFINITY, f64::min);
        let high = levels().fold(f64::NEG_INFINITY, f64::max);
        let count = ((high - low) / (DEEP * self.nominal)).floor() + 1.0;
        let depth = (high - low) / count;
        for i in 0..count as usize {
            let level = low + depth * (i as f64 + 0.5);
            let is_here =
                |&&(uv, p): &&(Uv, DVec3)| (course.value(uv, p) - level).abs() <= (0.5 + 1e-9) * depth;
            let here: Vec<(Uv, DVec3)> = spot.iter().filter(is_here).copied().collect();
            let mut best: (usize, Vec<IsoLine>) = (0, Vec::new());
            for aside in ASIDE {
                let pieces = self.pieces(level + aside * self.nominal, spot);
                let passed = self.passed(&pieces, &here, near);
                if passed > best.0 {
                    best = (passed, pieces);
                }
                if best.0 == here.len() {
                    break;
                }
            }
            if let Some(level) = best.1.first().map(|line| line.level) {
                found.push(self.probed(level, best.1, false, &stage.quiet())?);
            }
        }
        Ok(())
    }

    /// How many of the places `here` the lines pass so near (mm).
    fn passed(&self, lines: &[IsoLine], here: &[(Uv, DVec3)], near: f64) -> usize {
        let lines: Vec<Vec<DVec3>> = lines
            .iter()
            .map(|line| line.nodes.iter().map(|&uv| self.setup.face.surface.point(uv)).collect())
            .collect();
        let is_passed = |p: DVec3| {
            let mut ways = lines.iter().flat_map(|line| line.windows(2));
            ways.any(|ends| to_way(ends[0], ends[1], p) < near)
        };
        here.iter().filter(|(_, p)| is_passed(*p)).count()
    }

    /// The pieces of the lines of `level` beside some place of the `spot`.
    fn pieces(&self, level: f64, spot: &[(Uv, DVec3)]) -> Vec<IsoLine> {
        let near = LONGER * self.setup.strip;
        let is_near = |uv: &Uv| {
            let here = self.setup.face.surface.point(*uv);
            spot.iter().any(|(_, p)| p.distance_squared(here) < near * near)
        };
        let mut pieces = Vec::new();
        let (low, high) = self.course(false).range();
        if !(low..=high).contains(&level) {
            return Vec::new();
        }
        for line in self.lines_of(level, false) {
            for run in line.nodes.chunk_by(|a, b| is_near(a) && is_near(b)) {
                if run.len() > 1 {
                    pieces.push(IsoLine { level: line.level, nodes: run.to_vec(), closed: false });
                }
            }
        }
        pieces
    }
}

/// The distance of `p` from the straight way between two points.
fn to_way(a: DVec3, b: DVec3, p: DVec3) -> f64 {
    let way = b - a;
    let along = (p - a).dot(way) / way.length_squared();
    p.distance(a + way * if along > 0.0 { along.min(1.0) } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Face, Field, NurbsSurface, Side};
    use crate::strategy::trial::{family, leaning};
    use crate::strategy::walk;

    /// A flat face, so many mm long and wide, and the radius of the round edge, a quarter, that it ends in.
    const FLAT: f64 = 12.0;
    const WIDE: f64 = 2.0;
    const ROUND: f64 = 0.8;

    fn rolled() -> Face {
        let arc = std::f64::consts::FRAC_PI_2 * ROUND;
        let across = [0.0, 0.0, 0.0, FLAT, FLAT, FLAT + arc, FLAT + arc, FLAT + arc];
        let knots = [across.to_vec(), vec![0.0, 0.0, 1.0, 1.0]];
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let profile = [
            (-FLAT, 0.0, 1.0),
            (-0.5 * FLAT, 0.0, 1.0),
            (0.0, 0.0, 1.0),
            (ROUND, 0.0, half),
            (ROUND, -ROUND, 1.0),
        ];
        let points: Vec<DVec3> =
            profile.iter().flat_map(|&(x, z, _)| [0.0, WIDE].map(|y| DVec3::new(x, y, z))).collect();
        let weights: Vec<f64> = profile.iter().flat_map(|&(.., weight)| [weight; 2]).collect();
        let surface = NurbsSurface::new([2, 1], knots, &points, Some(&weights)).unwrap();
        Face::new(surface, Side::Front)
    }

    /// Two passes along a round edge leave a ridge between them that is a fiftieth of a strip wide where it is too high: it is looked at
    /// wherever between the nodes of a grid it lies.
    #[test]
    fn the_ridge_on_a_round_edge_is_looked_at() {
        let stage = Stage::silent();
        let family = family(rolled(), &leaning(0.3, 0.0), (Field::U, Field::V));
        let between = |middle: f64, apart: f64| {
            let lines = [-0.5, 0.5].map(|k| family.lines_of(middle + k * apart, false));
            let passes: Vec<_> =
                lines.iter().flatten().flat_map(|line| walk::passes(&family.setup, line, false)).collect();
            Moves::new(&family.setup, passes.iter())
        };
        // The most that is left between two passes, in scallops, nearly.
        let most = |moves: &Moves, middle: f64| {
            let leaves = |share: f64| {
                (-60..=60).any(|k| moves.leave(Uv::new(middle + 5e-4 * f64::from(k), 0.5), share * 0.01))
            };
            let (mut low, mut high) = (0.5, 2.0);
            while high - low > 4e-3 {
                let share = 0.5 * (low + high);
                *(if leaves(share) { &mut low } else { &mut high }) = share;
            }
            low
        };
        for k in 0..4 {
            let middle = FLAT + 0.5 + 0.041 * f64::from(k);
            let (mut near, mut far) = (0.1, 0.4);
            while far - near > 1e-3 {
                let apart = 0.5 * (near + far);
                *(if most(&between(middle, apart), middle) > 1.1 { &mut far } else { &mut near }) = apart;
            }
            let moves = between(middle, near);
            assert!((most(&moves, middle) - 1.1).abs() < 0.02, "{middle}");
            let looks =
                family.looks(&moves, (&[], &[]), Sought { limit: 0.01, finely: false }, &stage).unwrap();
            let [open, _] = family.left(&looks, &moves, &stage).unwrap();
            let is_ridge = |uv: &&Uv| (uv.u - middle).abs() < 0.02 && uv.v > 0.2 && uv.v < 0.8;
            assert!(open.iter().any(|uv| is_ridge(&uv)), "{middle}");
        }
    }
}
