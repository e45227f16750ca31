//! Passes spaced by widths that are evened out over strips.
//!
//! A strip of chosen postures is as wide as it can be, and half as wide beside: near where curvatures match, its profile breaks off.
//! Passes that keep to each strip's own width bend with that, and choose other postures then, and bend more. Evened out, widths change
//! as the surface does, and passes that are as far apart as those stay smooth.

use super::offset::{Offset, period};
use super::{crest, fill, followed};
use crate::contact::Edge;
use crate::cutter::Tool;
use crate::geometry::{Face, FaceGrid, Field, Fronts, Table};
use crate::monitor::{Cancelled, Stage};
use crate::posture::Rule;
use crate::strategy::family::{Family, Laid};
use crate::strategy::follow::Part;
use crate::strategy::probe::Setup;
use crate::strategy::{Finish, Order, StrategyError};
use glam::DVec3;
use std::sync::Arc;

/// Over how many mean strips widths are evened out, in each way of which no formula tells which makes passes shorter.
const OVER: [f64; 2] = [1.5, 6.0];
/// The nodes at which strips are measured: their distance in strips on flat ground, and least and most cells a side.
const CELL: f64 = 0.5;
const CELLS: [usize; 2] = [24, 48];
/// Rounds in which postures, widths and the passes' direction come to agree.
const ROUNDS: usize = 3;
/// Squares of distances, in what widths are evened out over, beyond which they count as nothing.
const FAR: f64 = 32.0;

/// The passes offset from the line of `seed` to both sides, the shorter ones of those that leave nothing; none where all come out
/// longer than `most` (mm), and where fronts run round the face and meet.
pub(in crate::strategy) fn passes(
    (face, tool): (&Face, &Tool),
    (from, level, column): &(Field, f64, Field),
    rule: &Rule,
    finish: Finish,
    order: Order,
    most: f64,
    stage: &Stage,
) -> Result<Option<Laid>, StrategyError> {
    if period(face, from).is_some() {
        return Ok(None);
    }
    let finish = finish.with_fine_chords();
    let fields = (from.clone(), column.clone());
    let first = Setup::new(face, tool, rule, finish, fields, order, &stage.part(super::TILT, 0.0, 0.08))?;
    let offset = Offset::new(&first, from, *level);
    let begun = Widths::of((&first, order), &stage.part(super::SOLVE, 0.08, 0.1))?;
    let mut best: Option<Laid> = None;
    'over: for (k, over) in OVER.into_iter().enumerate() {
        let part = |name, a: f64, b: f64| {
            let at = |t: f64| 0.1 + 0.9 * (k as f64 + t) / OVER.len() as f64;
            stage.part(name, at(a), at(b))
        };
        let most = best.as_ref().filter(|best| best.is_whole).map_or(most, |best| best.planned.length());
        let (mut setup, mut widths) = (first.clone(), begun.clone());
        for round in 0..ROUNDS {
            let part = |name, a: f64, b: f64| {
                let at = |t: f64| 0.4 * (round as f64 + t) / ROUNDS as f64;
                part(name, at(a), at(b))
            };
            if round > 0 {
                widths = Widths::of((&setup, order), &part(super::SOLVE, 0.0, 0.2))?;
            }
            let Some((spaced, length)) = widths.evened(&offset, over, &part(super::SOLVE, 0.2, 0.3))? else {
                continue 'over;
            };
            if length > most {
                continue 'over;
            }
            setup.field = Field::Given(Arc::new(spaced));
            setup.choose(rule, order, &part(super::TILT, 0.3, 1.0))?;
        }
        let family = Family::on_grid(setup, order, offset.grid.clone());
        let placed = family.place(&part(super::PLACE, 0.4, 0.6))?;
        let tracks = fill::tracks(&family, placed, &part(super::FILL, 0.6, 0.7))?;
        let crests = crest::places(&family, &offset);
        if family.length(&tracks) > most {
            continue;
        }
        let following = part("Following the surface", 0.7, 1.0);
        let (planned, is_whole) = followed(&[Part::whole(family, tracks)], &crests, &following)?;
        let laid = Laid { rule: *rule, planned, is_whole };
        if best.as_ref().is_none_or(|best| laid.is_better(best)) {
            best = Some(laid);
        }
    }
    Ok(best)
}

/// How wide strips are on a face.
#[derive(Clone)]
struct Widths {
    grid: FaceGrid,
    /// The places of the grid where strips lie wholly on the face, with their widths, mm, in the mean of both ways of feed.
    known: Vec<(DVec3, f64)>,
}

impl Widths {
    fn of((setup, order): (&Setup, Order), stage: &Stage) -> Result<Self, Cancelled> {
        let grid = FaceGrid::new(setup.face, CELL * setup.strip, CELLS[0], CELLS[1]);
        let ways: &[bool] = if order == Order::ZigZag { &[false, true] } else { &[false] };
        let (nu, nv) = grid.size();
        let width = |k: usize| {
            let (here, uv) = (grid.points()[k], grid.uv(k % nu, k / nu));
            let mut sum = 0.0;
            for &reversed in ways {
                let strip = setup.strip(uv, reversed)?;
                let (Edge::Reached(left), Edge::Reached(right)) = (strip.left, strip.right) else {
                    return None;
                };
                let (_, frame) = setup.frame(uv, reversed)?;
                let away = |edge| (setup.face.surface.point(edge) - here).dot(frame.b).abs();
                sum += away(left) + away(right);
            }
            Some((here, sum / ways.len() as f64)).filter(|(_, width)| *width > 0.0)
        };
        let known = stage.map(nu * nv, width)?.into_iter().flatten().collect();
        Ok(Self { grid, known })
    }

    /// The function that is 0 on the start curve and rises by one over every strip, its width evened out `over` so many mean strips, and
    /// the face's area in such strips, mm: passes are hardly shorter. `None` where no strip lies wholly on the face.
    fn evened(&self, offset: &Offset, over: f64, stage: &Stage) -> Result<Option<(Table, f64)>, Cancelled> {
        if self.known.is_empty() {
            return Ok(None);
        }
        let grid = &self.grid;
        let mean = self.known.iter().map(|(_, width)| width).sum::<f64>() / self.known.len() as f64;
        let slowness = stage.map(grid.points().len(), |k| self.slowness(grid.points()[k], over * mean))?;
        let (nu, nv) = grid.size();
        let cells = (0..nv - 1).flat_map(|j| (0..nu - 1).map(move |i| (i, j)));
        let around =
            |i, j| [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)].map(|(i, j)| slowness[j * nu + i]);
        let length = cells.map(|(i, j)| 0.25 * grid.cell_area(i, j) * around(i, j).iter().sum::<f64>()).sum();
        let between = Table::new(offset.domain, grid, &slowness);
        let at_nodes: Vec<f64> =
            (0..offset.grid.points().len()).map(|k| between.at(offset.uv(k)).value).collect();
        Ok(Some((offset.arrivals(&Fronts::new(&offset.domain, &offset.grid), &at_nodes), length)))
    }

    /// Strips per mm at `place`, in the mean over about `reach` (mm) around; far from all strips as at the nearest.
    fn slowness(&self, place: DVec3, reach: f64) -> f64 {
        let squares =
            || self.known.iter().map(|(p, width)| (p.distance_squared(place) / (reach * reach), width));
        let least = squares().map(|(square, _)| square).fold(f64::INFINITY, f64::min);
        let near = squares().filter(|(square, _)| square - least < FAR);
        let (weights, sum) = near.fold((0.0, 0.0), |(weights, sum), (square, width)| {
            let weight = libm::exp(-0.5 * (square - least));
            (weights + weight, sum + weight * width)
        });
        weights / sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Plane, Range, Side};
    use crate::math::frame::Frame;

    fn widths(known: Vec<(DVec3, f64)>) -> Widths {
        let frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
        let (u, v) = (Range::open(0.0, 40.0), Range::open(0.0, 30.0));
        let face = Face::new(Plane { origin: DVec3::ZERO, frame, u, v }, Side::Front);
        Widths { grid: FaceGrid::new(&face, 1.0, 24, 48), known }
    }

    #[test]
    fn between_strips_their_mean_counts_and_far_off_the_nearest() {
        let two = widths(vec![(DVec3::ZERO, 2.0), (DVec3::X, 4.0)]);
        assert!((two.slowness(0.5 * DVec3::X, 3.0) - 1.0 / 3.0).abs() < 1e-12);
        assert!((two.slowness(1000.0 * DVec3::X, 3.0) - 0.25).abs() < 1e-12);
    }

    #[test]
    fn one_strip_that_breaks_off_among_many_hardly_counts() {
        let mut known: Vec<(DVec3, f64)> =
            (0..400).map(|k| (DVec3::new(f64::from(k % 20), f64::from(k / 20), 0.0), 5.0)).collect();
        known[210].1 = 2.5;
        let here = known[210].0;
        let width = 1.0 / widths(known).slowness(here, 5.0);
        assert!((4.97..5.0).contains(&width), "{width}");
    }
}
