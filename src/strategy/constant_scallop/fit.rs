//! Mending a spacing of passes by the strips on them.

use super::offset::Offset;
use crate::geometry::{GradientFit, Table, Wish, triangles};
use crate::monitor::{Cancelled, Stage};
use crate::strategy::Order;
use crate::strategy::probe::{Probe, Reach, Setup};
use glam::DVec3;

/// How much a level line that strays from the smooth direction counts against a strip's width that is off.
const BEND: f64 = 0.3;
/// How often directions are evened out with their neighbours: over about a strip on flat ground; and where postures are
/// chosen, over about what the widest strips are.
const EVEN: [usize; 2] = [8, 40];
/// A way that rises by less than this share of what it should leads over a ridge.
const FOLDED: f64 = 0.6;
/// A spacing is mended by at most this factor at once.
const MOST: f64 = 1.5;

/// A function on a face, and the strips along its level lines.
pub(super) struct Fit<'a> {
    setup: &'a Setup<'a>,
    offset: &'a Offset,
    order: Order,
}

impl<'a> Fit<'a> {
    /// For the field of `setup`, which must be given on the grid of `offset`.
    pub(super) fn new(setup: &'a Setup<'a>, offset: &'a Offset, order: Order) -> Self {
        Self { setup, offset, order }
    }

    /// How wide the strip at a node is in units of the function.
    fn width(&self, node: usize) -> Option<f64> {
        let uv = self.offset.uv(node);
        let both = self.order == Order::ZigZag && !self.setup.postures.is_fixed();
        let ways: &[bool] = if both { &[false, true] } else { &[false] };
        let jet = self.setup.face.jet(uv);
        let here = jet.p;
        let own = self.setup.field.value(uv, here);
        let steep = self.setup.field.surface_gradient(uv, &jet).length();
        let mut sum = 0.0;
        for &reversed in ways {
            let Probe::Strip { up, down } = self.setup.probe(uv, reversed) else { return None };
            // Beyond a ridge, where fronts meet, levels fall again and tell nothing.
            let far = |reach: Reach| match reach {
                Reach::To { level, point, .. } => {
                    let away = (level - own).abs();
                    (away > FOLDED * steep * point.distance(here)).then_some(away)
                }
                Reach::Border { .. } | Reach::Aside => None,
            };
            sum += match (far(up), far(down)) {
                (Some(a), Some(b)) => a + b,
                (Some(a), None) | (None, Some(a)) => 2.0 * a,
                (None, None) => return None,
            };
        }
        Some(sum / ways.len() as f64).filter(|w| w.is_finite() && *w > 0.0)
    }

    /// The function with its level lines moved to where their strips meet.
    pub(super) fn mended(&self, stage: &Stage) -> Result<Table, Cancelled> {
        let count = self.offset.grid.points().len();
        let field = &self.setup.field;
        let values = self.offset.values(field);
        let widths = stage.quiet().map(count, |k| {
            self.width(k).unwrap_or_else(|| {
                let uv = self.offset.uv(k);
                let rise = field.surface_gradient(uv, &self.setup.face.jet(uv)).length();
                let width = rise * self.offset.width(self.setup, k, field);
                if width.is_finite() { width } else { 1.0 }
            })
        })?;
        let change = self.change(&values, &widths);
        let mended: Vec<f64> = values.iter().zip(change).map(|(value, change)| value + change).collect();
        Ok(Table::new(self.offset.domain, &self.offset.grid, &mended))
    }

    /// The unit direction of steepest rise at the nodes, evened out.
    fn directions(&self, fit: &GradientFit) -> Vec<DVec3> {
        let (nu, nv) = self.offset.grid.size();
        let (face, field) = (self.setup.face, &self.setup.field);
        let own = (0..nu * nv).map(|k| {
            let uv = self.offset.uv(k);
            let rise = field.surface_gradient(uv, &face.jet(uv));
            if rise.is_finite() { rise.normalize_or_zero() } else { DVec3::ZERO }
        });
        let mut even: Vec<DVec3> = own.collect();
        for _ in 0..EVEN[usize::from(!self.setup.postures.is_fixed())] {
            even = (0..nu * nv)
                .map(|k| {
                    let (i, j) = ((k % nu) as i64, (k / nu) as i64);
                    let around = (0..9).filter_map(|w| fit.node(i + w % 3 - 1, j + w / 3 - 1));
                    around.map(|node| even[node]).sum::<DVec3>().normalize_or_zero()
                })
                .collect();
        }
        even
    }

    /// What the function with `values` must change by at the nodes, and nothing on and beside the start curve, so that it rises
    /// by one over a strip, in the smooth direction.
    fn change(&self, values: &[f64], widths: &[f64]) -> Vec<f64> {
        let grid = &self.offset.grid;
        let mut fit = GradientFit::new(self.offset.domain, grid);
        let directions = self.directions(&fit);
        for triangle in triangles(grid) {
            let rise = triangle.gradient(values);
            let steep = rise.length();
            let mean: DVec3 = triangle.nodes.iter().map(|&k| directions[k]).sum();
            let Some(along) = triangle.flat(mean) else { continue };
            if !(steep > 0.0 && steep.is_finite()) {
                continue;
            }
            let width = triangle.nodes.iter().map(|&k| widths[k]).sum::<f64>() / 3.0;
            // All in strips: what is off counts alike where strips are wide and where they are narrow.
            let wanted = steep / width.clamp(1.0 / MOST, MOST);
            let weight = triangle.normal.length() / (wanted * wanted);
            fit.add(&triangle, &Wish { change: along * wanted - rise, along, aside: BEND, weight });
        }
        fit.solved(self.offset.near.iter().map(|&(node, _)| node))
    }
}
