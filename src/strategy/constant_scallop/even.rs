//! Passes spaced by widths that are evened out over strips.
//!
//! A strip of chosen postures is as wide as it can be, and half as wide beside: near where curvatures match, its profile breaks off.
//! Passes that keep to each strip's own width bend with that, and choose other postures then, and bend more. Evened out, widths change
//! as the surface does, and passes that are as far apart as those stay smooth.

use super::offset::{Offset, period};
use super::{crest, fill, followed};
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
const OVER: [f64; 3] = [1.5, 3.0, 6.0];
/// The nodes at which strips are measured: their distance in strips on flat ground, and least and most cells a side.
const CELL: f64 = 0.5;
const CELLS: [usize; 2] = [24, 160];
/// Rounds in which postures, widths and the passes' direction come to agree.
const ROUNDS: usize = 3;
/// Where the face's area in strips is more than so many times what passes may be long, they are not laid: it counts what the cutter
/// cannot reach as well, and by the way of the contact.
const MARGIN: f64 = 1.05;
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
        let most = best.as_ref().map_or(most, |best| best.most().min(most));
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
            if length > MARGIN * most {
                continue 'over;
            }
            setup.field = Field::Given(Arc::new(spaced));
            setup.choose(rule, order, &part(super::TILT, 0.3, 1.0))?;
        }
        let family = Family::on_grid(setup, order, offset.grid.clone());
        let placed = family.place(&part(super::PLACE, 0.4, 0.6))?;
        let tracks = fill::tracks(&family, placed, &part(super::FILL, 0.6, 0.7))?;
        if family.length(&tracks) > most {
            continue;
        }
        let crests = crest::places(&family, &offset);
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
    /// The places of the grid where the cutter can go, with the widths of its strips, mm, in the mean of both ways of feed, and what
    /// they count for, mm².
    known: Vec<(DVec3, f64, f64)>,
}

impl Widths {
    fn of((setup, order): (&Setup, Order), stage: &Stage) -> Result<Self, Cancelled> {
        let grid = FaceGrid::new(setup.face, CELL * setup.strip, CELLS[0], CELLS[1]);
        let ways: &[bool] = if order == Order::ZigZag { &[false, true] } else { &[false] };
        let (nu, nv) = grid.size();
        let width = |k: usize| {
            let (i, j) = (k % nu, k / nu);
            let (here, uv) = (grid.points()[k], grid.uv(i, j));
            let mut sum = 0.0;
            for &reversed in ways {
                let station = setup.station(uv, reversed)?;
                if !setup.fits(&station, uv) {
                    return None;
                }
                sum += setup.width(uv, reversed, &station)?;
            }
            let area = grid.cell_area(i.min(nu - 2), j.min(nv - 2));
            Some((here, sum / ways.len() as f64, area)).filter(|(_, width, area)| *width > 0.0 && *area > 0.0)
        };
        let known = stage.map(nu * nv, width)?.into_iter().flatten().collect();
        Ok(Self { grid, known })
    }

    /// The function that is 0 on the start curve and rises by one over every strip, its width evened out `over` so many mean strips, and
    /// the face's area in such strips, mm: passes are hardly shorter. `None` where the cutter can go nowhere.
    fn evened(&self, offset: &Offset, over: f64, stage: &Stage) -> Result<Option<(Table, f64)>, Cancelled> {
        let sum = |of: fn(&(DVec3, f64, f64)) -> f64| self.known.iter().map(of).sum::<f64>();
        let mean = sum(|(_, width, area)| width * area) / sum(|(.., area)| *area);
        if !mean.is_finite() {
            return Ok(None);
        }
        let grid = &self.grid;
        let (nu, nv) = grid.size();
        let cells = || (0..nv - 1).flat_map(|j| (0..nu - 1).map(move |i| (i, j)));
        let area = cells().map(|(i, j)| grid.cell_area(i, j)).sum::<f64>();
        // Nearer than nodes lie nothing is known of widths.
        let reach = (over * mean).max((area / cells().count() as f64).sqrt());
        let slowness = stage.map(grid.points().len(), |k| self.slowness(grid.points()[k], reach))?;
        let around =
            |i, j| [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)].map(|(i, j)| slowness[j * nu + i]);
        let length =
            cells().map(|(i, j)| 0.25 * grid.cell_area(i, j) * around(i, j).iter().sum::<f64>()).sum();
        let between = Table::new(offset.domain, grid, &slowness);
        // Cubics run beyond the values that they join.
        let (least, most) = between.range();
        let at_node = |k: usize| between.at(offset.uv(k)).value.clamp(least, most);
        let at_nodes: Vec<f64> = (0..offset.grid.points().len()).map(at_node).collect();
        Ok(Some((offset.arrivals(&Fronts::new(&offset.domain, &offset.grid), &at_nodes), length)))
    }

    /// One over the mean width within about `reach` (mm) of `place`, per mm; far from all strips over that of the nearest.
    fn slowness(&self, place: DVec3, reach: f64) -> f64 {
        let squares = || {
            self.known
                .iter()
                .map(|(p, width, area)| (p.distance_squared(place) / (reach * reach), width, area))
        };
        let least = squares().map(|(square, ..)| square).fold(f64::INFINITY, f64::min);
        let near = squares().filter(|(square, ..)| square - least < FAR);
        let (weights, sum) = near.fold((0.0, 0.0), |(weights, sum), (square, width, area)| {
            let weight = area * libm::exp(-0.5 * (square - least));
            (weights + weight, sum + weight * width)
        });
        weights / sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cutter::Cutter;
    use crate::geometry::{Plane, Range, Side, Uv};
    use crate::math::frame::Frame;
    use crate::posture::Limits;

    fn plane() -> Face {
        let frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
        let (u, v) = (Range::open(0.0, 40.0), Range::open(0.0, 30.0));
        Face::new(Plane { origin: DVec3::ZERO, frame, u, v }, Side::Front)
    }

    fn widths(known: Vec<(DVec3, f64, f64)>) -> Widths {
        Widths { grid: FaceGrid::new(&plane(), 1.0, 24, 48), known }
    }

    #[test]
    fn far_from_all_strips_the_nearest_counts() {
        let two = widths(vec![(DVec3::ZERO, 2.0, 1.0), (DVec3::X, 4.0, 1.0)]);
        assert!((two.slowness(1000.0 * DVec3::X, 3.0) - 0.25).abs() < 1e-12);
        // Next to one of them the other hardly counts where less is evened out.
        let near = |reach| 1.0 / two.slowness(DVec3::ZERO, reach);
        assert!(near(0.2) < 2.01 && near(3.0) > 2.9, "{} {}", near(0.2), near(3.0));
    }

    #[test]
    fn one_strip_that_breaks_off_among_many_hardly_counts() {
        let place = |k: usize| DVec3::new((k % 20) as f64, (k / 20) as f64, 0.0);
        let known = (0..400).map(|k| (place(k), if k == 210 { 2.5 } else { 5.0 }, 1.0)).collect();
        let width = 1.0 / widths(known).slowness(place(210), 5.0);
        assert!((4.97..5.0).contains(&width), "{width}");
    }

    /// From a line in the middle of a plane, where all strips are as wide.
    #[test]
    fn on_a_plane_levels_are_distances_in_strips() {
        let (face, finish) = (plane(), Finish { scallop: 0.01, chord: 0.001 });
        let tool = Tool { cutter: Cutter::bull_nose(10.0, 2.0, 40.0).unwrap(), holder: None };
        let (rule, fields) = (Rule::Matched(Limits::default()), (Field::V, Field::U));
        let stage = Stage::silent();
        let setup = Setup::new(&face, &tool, &rule, finish, fields, Order::ZigZag, &stage).unwrap();
        let offset = Offset::new(&setup, &Field::V, 12.0);
        let widths = Widths::of((&setup, Order::ZigZag), &stage).unwrap();
        let width = widths.known[widths.known.len() / 2].1;
        let (levels, length) = widths.evened(&offset, 1.5, &stage).unwrap().unwrap();
        assert!((length - 1200.0 / width).abs() < 1e-3 * length, "{length} {width}");
        for v in [0.0, 5.0, 12.0, 20.0, 30.0] {
            let level = levels.at(Uv::new(17.0, v)).value;
            assert!((level - (v - 12.0) / width).abs() < 0.02, "{v}: {level}");
        }
    }
}
