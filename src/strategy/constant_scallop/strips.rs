//! How wide the strips on a face are and to which side of their contacts they lie, and passes' spacing and courses by that.

use super::known::{Known, Spot};
use super::offset::Offset;
use crate::geometry::{FaceGrid, Field, Fronts, Table};
use crate::monitor::{Cancelled, Stage};
use crate::strategy::Order;
use crate::strategy::probe::Setup;
use std::sync::Arc;

/// The nodes at which strips are measured: their distance in strips on flat ground, and least and most cells a side.
const CELL: f64 = 0.5;
const CELLS: [usize; 2] = [24, 240];
/// Over how many mean strips it is evened out to which side strips lie: courses may bend no more than strips follow.
const MIDDLE: f64 = 0.3;
/// Where strips are narrower, passes are spaced as if they were so wide, in mean strips, and partial passes fill in: lines that hold back
/// along an edge would turn to run along it, where strips are narrower still.
const NARROWEST: f64 = 0.25;

/// The strips on a face along passes of one family.
#[derive(Clone)]
pub(super) struct Strips {
    grid: FaceGrid,
    /// Their widths, mm, in the mean of the ways of feed.
    widths: Known,
    /// How far their middles lie beside the contact, forwards and backwards, mm, above 0 towards higher levels; nothing is known where
    /// all passes go one way.
    middles: [Known; 2],
    /// Their mean width, mm; not a number where the cutter can go nowhere.
    mean: f64,
}

impl Strips {
    /// On the passes of `setup`.
    pub(super) fn of((setup, order): (&Setup, Order), stage: &Stage) -> Result<Self, Cancelled> {
        let grid = FaceGrid::new(setup.face, CELL * setup.strip, CELLS[0], CELLS[1]);
        let ways: &[bool] = if order == Order::ZigZag { &[false, true] } else { &[false] };
        let (nu, nv) = grid.size();
        // Of each way, width and middle; nothing where the cutter cannot go one of the ways.
        let strips = |node: usize| {
            let uv = grid.uv(node % nu, node / nu);
            let strip = |&reversed: &bool| {
                let station = setup.station(uv, reversed)?;
                let fits = setup.fits(&station, uv);
                let width = setup.width(uv, reversed, &station).filter(|width| *width > 0.0)?;
                fits.then(|| (width, setup.middle(uv, reversed)))
            };
            ways.iter().map(strip).collect::<Option<Vec<_>>>()
        };
        let (mut widths, mut middles) = (Vec::new(), [Vec::new(), Vec::new()]);
        for (node, strips) in stage.map(nu * nv, strips)?.into_iter().enumerate() {
            let Some(strips) = strips else { continue };
            let area = grid.cell_area((node % nu).min(nu - 2), (node / nu).min(nv - 2));
            let spot = |value: f64| Spot { node, point: grid.points()[node], value, area };
            if area > 0.0 {
                widths.push(spot(strips.iter().map(|strip| strip.0).sum::<f64>() / ways.len() as f64));
                if let [(_, Some(forwards)), (_, Some(backwards))] = strips[..] {
                    middles[0].push(spot(forwards));
                    middles[1].push(spot(backwards));
                }
            }
        }
        let (widths, middles) = (Known::new(widths), middles.map(Known::new));
        let mean = widths.mean();
        Ok(Self { grid, widths, middles, mean })
    }

    /// The function that is 0 on the start curve and rises by one over every strip, its width evened out `over` so many mean strips, and
    /// the face's area in such strips, mm: passes are hardly shorter. `None` where the cutter can go nowhere.
    ///
    /// Evening out takes half of what is about as narrow as it reaches; done once more on what it left out, it takes a quarter
    /// (twicing: Tukey 1977, Exploratory Data Analysis, section 16).
    pub(super) fn spacing(
        &self,
        offset: &Offset,
        over: f64,
        stage: &Stage,
    ) -> Result<Option<(Table, f64)>, Cancelled> {
        if !self.mean.is_finite() {
            return Ok(None);
        }
        let reach = self.reach(over);
        let even = self.at_nodes(&self.widths, reach, stage)?;
        let left_out = self.at_nodes(&self.widths.over(&even), reach, stage)?;
        let least = NARROWEST * self.mean;
        let slowness: Vec<f64> =
            even.iter().zip(left_out).map(|(even, more)| 1.0 / (even * more).max(least)).collect();
        let nu = self.grid.size().0;
        let around =
            |i, j| [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)].map(|(i, j)| slowness[j * nu + i]);
        let length = self
            .cells()
            .map(|(i, j)| 0.25 * self.grid.cell_area(i, j) * around(i, j).iter().sum::<f64>())
            .sum();
        let between = Table::new(offset.domain, &self.grid, &slowness);
        // Cubics run beyond the values that they join.
        let (least, most) = between.range();
        let at_node = |k: usize| between.at(offset.uv(k)).value.clamp(least, most);
        let at_nodes: Vec<f64> = (0..offset.grid.points().len()).map(at_node).collect();
        Ok(Some((offset.arrivals(&Fronts::new(&offset.domain, &offset.grid), &at_nodes), length)))
    }

    /// What passes of `setup` follow, forwards and backwards, so that not their contacts but the middles of their strips lie on the
    /// level lines of its field; `None` where all passes go one way, or nothing is known of those middles.
    ///
    /// Strips that lie to one side of their contacts lie to the other one on the way back. Along the level lines themselves steps would
    /// take turns in being too long and too short wherever that side changes.
    pub(super) fn courses(
        &self,
        setup: &Setup,
        offset: &Offset,
        stage: &Stage,
    ) -> Result<Option<[Field; 2]>, Cancelled> {
        let mut courses = Vec::new();
        for middles in &self.middles {
            if !middles.mean().is_finite() {
                return Ok(None);
            }
            let aside = self.at_nodes(middles, MIDDLE * self.mean, stage)?;
            let aside = Table::new(offset.domain, &self.grid, &aside);
            let value = |(k, level): (usize, f64)| {
                let uv = offset.uv(k);
                let rise = setup.field.surface_gradient(uv, &setup.face.jet(uv)).length();
                level + if rise.is_finite() { rise * aside.at(uv).value } else { 0.0 }
            };
            let values: Vec<f64> = offset.values(&setup.field).into_iter().enumerate().map(value).collect();
            courses.push(Field::Given(Arc::new(Table::new(offset.domain, &offset.grid, &values))));
        }
        Ok(courses.try_into().ok())
    }

    /// What is `known`, evened out within about `reach` (mm), at all nodes.
    fn at_nodes(&self, known: &Known, reach: f64, stage: &Stage) -> Result<Vec<f64>, Cancelled> {
        stage.quiet().map(self.grid.points().len(), |k| known.near(self.grid.points()[k], reach))
    }

    /// `over` so many mean strips, mm, but no less than about a cell: nearer than nodes lie nothing is known.
    fn reach(&self, over: f64) -> f64 {
        let area = self.cells().map(|(i, j)| self.grid.cell_area(i, j)).sum::<f64>();
        (over * self.mean).max((area / self.cells().count() as f64).sqrt())
    }

    fn cells(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let (nu, nv) = self.grid.size();
        (0..nv - 1).flat_map(move |j| (0..nu - 1).map(move |i| (i, j)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cutter::{Cutter, Tool};
    use crate::geometry::{Face, Plane, Range, Side, Uv};
    use crate::math::frame::Frame;
    use crate::posture::{Limits, Rule};
    use crate::strategy::Finish;
    use crate::strategy::family::{Detail, Family};
    use crate::strategy::spacing::Toward;
    use crate::toolpath::Posture;
    use glam::DVec3;

    const FINISH: Finish = Finish { scallop: 0.01, chord: 0.001 };

    fn plane() -> Face {
        let frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
        let (u, v) = (Range::open(0.0, 40.0), Range::open(0.0, 30.0));
        Face::new(Plane { origin: DVec3::ZERO, frame, u, v }, Side::Front)
    }

    fn tool() -> Tool {
        Tool { cutter: Cutter::bull_nose(10.0, 2.0, 40.0).unwrap(), holder: None }
    }

    /// From a line in the middle of a plane, where all strips are as wide.
    #[test]
    fn on_a_plane_levels_are_distances_in_strips() {
        let (face, tool, stage) = (plane(), tool(), Stage::silent());
        let (rule, fields) = (Rule::Matched(Limits::default()), (Field::V, Field::U));
        let setup = Setup::new(&face, &tool, &rule, FINISH, fields, Order::ZigZag, &stage).unwrap();
        let offset = Offset::new(&setup, &Field::V, 12.0);
        let strips = Strips::of((&setup, Order::ZigZag), &stage).unwrap();
        let width = strips.mean;
        let (levels, length) = strips.spacing(&offset, 1.5, &stage).unwrap().unwrap();
        assert!((length - 1200.0 / width).abs() < 1e-3 * length, "{length} {width}");
        for v in [0.0, 5.0, 12.0, 20.0, 30.0] {
            let level = levels.at(Uv::new(17.0, v)).value;
            assert!((level - (v - 12.0) / width).abs() < 0.02, "{v}: {level}");
        }
    }

    /// Yawed, a cutter's strip lies to one side of its contact: along the level lines every other step would be too long, along
    /// courses all are alike.
    #[test]
    fn courses_lie_where_strips_meet_both_ways() {
        let (face, tool, stage) = (plane(), tool(), Stage::silent());
        let rule = Rule::Fixed(Posture { lead: 0.3, yaw: 0.6 });
        let fields = (Field::V, Field::U);
        let mut setup = Setup::new(&face, &tool, &rule, FINISH, fields, Order::ZigZag, &stage).unwrap();
        let offset = Offset::new(&setup, &Field::V, 0.0);
        let strips = Strips::of((&setup, Order::ZigZag), &stage).unwrap();
        setup.field = Field::Given(Arc::new(strips.spacing(&offset, 1.5, &stage).unwrap().unwrap().0));
        let gaps = |setup: Setup| {
            let family = Family::on_grid(setup, Order::ZigZag, offset.grid.clone());
            let pass = |k: usize| family.candidate(3.0 + k as f64, k, Detail::Full, &stage).unwrap();
            let gap = |k: usize| {
                let front = family.front(&pass(k), Toward::Higher);
                front.gaps(&family.front(&pass(k + 1), Toward::Lower)).all_but(0.0).unwrap()
            };
            [gap(0), gap(1)]
        };
        let plain = gaps(setup.clone());
        assert!((plain[0] - plain[1]).abs() > 0.05, "{plain:?}");
        setup.courses = strips.courses(&setup, &offset, &stage).unwrap();
        let even = gaps(setup);
        assert!(even.iter().all(|gap| gap.abs() < 0.01), "{even:?}");
    }

    /// Strips measured on passes that all go one way have no other way to lie to the other side of.
    #[test]
    fn passes_that_all_go_one_way_follow_the_level_lines() {
        let (face, tool, stage) = (plane(), tool(), Stage::silent());
        let (rule, fields) = (Rule::Matched(Limits::default()), (Field::V, Field::U));
        let setup = Setup::new(&face, &tool, &rule, FINISH, fields, Order::Zig, &stage).unwrap();
        let offset = Offset::new(&setup, &Field::V, 0.0);
        let strips = Strips::of((&setup, Order::Zig), &stage).unwrap();
        assert!(strips.courses(&setup, &offset, &stage).unwrap().is_none());
    }
}
