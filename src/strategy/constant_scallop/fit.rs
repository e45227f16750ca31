//! Mending a spacing of passes by the strips on them.

use super::offset::Offset;
use crate::geometry::Table;
use crate::monitor::{Cancelled, Stage};
use crate::strategy::Order;
use crate::strategy::probe::{Probe, Reach, Setup};
use glam::DVec3;

/// How much a level line that strays from the smooth direction counts against a strip's width that is off.
const BEND: f64 = 0.3;
/// How often directions are evened out with their neighbours: over about a strip on flat ground; and where postures are
/// chosen, over about what the widest strips are.
const EVEN: [usize; 2] = [8, 40];
/// Steps of the conjugate gradients, and the share of the first residual at which they stop.
const STEPS: usize = 600;
const ENOUGH: f64 = 1e-4;
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

/// The symmetric equations of a least-squares fit: for every node its weights on itself and the eight around.
struct Equations {
    weights: Vec<[f64; 9]>,
    right: Vec<f64>,
}

impl<'a> Fit<'a> {
    /// For the field of `setup`, which must be given on the grid of `offset`.
    pub(super) fn new(setup: &'a Setup<'a>, offset: &'a Offset, order: Order) -> Self {
        Self { setup, offset, order }
    }

    fn size(&self) -> (usize, usize) {
        self.offset.grid.size()
    }

    /// The node that stands for the node `(i, j)`, whose numbers may lie a step beyond a seam.
    fn node(&self, i: i64, j: i64) -> Option<usize> {
        let (nu, nv) = self.size();
        let place = |k: i64, count: usize, periodic: bool| {
            let count = count as i64;
            if periodic { Some(k.rem_euclid(count - 1)) } else { (0..count).contains(&k).then_some(k) }
        };
        let (i, j) =
            (place(i, nu, self.offset.domain.u.periodic)?, place(j, nv, self.offset.domain.v.periodic)?);
        Some(j as usize * nu + i as usize)
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
        let (nu, nv) = self.size();
        let count = nu * nv;
        let field = &self.setup.field;
        let values: Vec<f64> =
            (0..count).map(|k| field.value(self.offset.uv(k), self.offset.grid.points()[k])).collect();
        let widths = stage.quiet().map(count, |k| {
            self.width(k).unwrap_or_else(|| {
                let uv = self.offset.uv(k);
                let rise = field.surface_gradient(uv, &self.setup.face.jet(uv)).length();
                let width = rise * self.offset.width(self.setup, k, field);
                if width.is_finite() { width } else { 1.0 }
            })
        })?;
        let equations = self.equations(&values, &widths, &self.directions());
        let change = self.solved(&equations);
        let mut mended = values;
        for j in 0..nv {
            for i in 0..nu {
                let Some(node) = self.node(i as i64, j as i64) else { continue };
                mended[j * nu + i] += change[node];
            }
        }
        Ok(Table::new(self.offset.domain, &self.offset.grid, &mended))
    }

    /// The unit direction of steepest rise at the nodes, evened out.
    fn directions(&self) -> Vec<DVec3> {
        let (nu, nv) = self.size();
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
                    let around = (0..9).filter_map(|w| self.node(i + w % 3 - 1, j + w / 3 - 1));
                    around.map(|node| even[node]).sum::<DVec3>().normalize_or_zero()
                })
                .collect();
        }
        even
    }

    fn equations(&self, values: &[f64], widths: &[f64], directions: &[DVec3]) -> Equations {
        let (nu, nv) = self.size();
        let mut equations = Equations { weights: vec![[0.0; 9]; nu * nv], right: vec![0.0; nu * nv] };
        for j in 0..nv - 1 {
            for i in 0..nu - 1 {
                let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
                for skipped in 0..4 {
                    let three = [1, 2, 3].map(|k| corners[(skipped + k) % 4]);
                    self.add(&mut equations, three, (values, widths, directions));
                }
            }
        }
        equations
    }

    /// Adds what the function should do on a triangle: rise by one over a strip, in the smooth direction.
    fn add(
        &self,
        equations: &mut Equations,
        three: [(usize, usize); 3],
        (values, widths, directions): (&[f64], &[f64], &[DVec3]),
    ) {
        let nu = self.size().0;
        let at = three.map(|(i, j)| j * nu + i);
        let p = at.map(|k| self.offset.grid.points()[k]);
        let normal = (p[1] - p[0]).cross(p[2] - p[0]);
        let square = normal.length_squared();
        // Gradients of the three hats.
        let hats = [0, 1, 2].map(|k| normal.cross(p[(k + 2) % 3] - p[(k + 1) % 3]) / square);
        let rise: DVec3 = (0..3).map(|k| hats[k] * values[at[k]]).sum();
        let steep = rise.length();
        let mean: DVec3 = at.iter().map(|&k| directions[k]).sum();
        let flat = mean - normal * (normal.dot(mean) / square);
        let Some(along) = flat.try_normalize() else { return };
        if !(square > 0.0 && steep > 0.0 && steep.is_finite()) {
            return;
        }
        let width = (at.iter().map(|&k| widths[k]).sum::<f64>() / 3.0).clamp(1.0 / MOST, MOST);
        // All in strips: what is off counts alike where strips are wide and where they are narrow.
        let wanted = steep / width;
        let lack = along * (wanted - along.dot(rise));
        let aside = (rise - along * along.dot(rise)) * -BEND;
        let weight = square.sqrt() / (wanted * wanted);
        for a in 0..3 {
            let Some(node) = self.node(three[a].0 as i64, three[a].1 as i64) else { continue };
            equations.right[node] += weight * hats[a].dot(lack + aside);
            for b in 0..3 {
                let (both, forth) = (hats[a].dot(hats[b]), hats[a].dot(along) * hats[b].dot(along));
                let (di, dj) = (1 + three[b].0 - three[a].0, 1 + three[b].1 - three[a].1);
                equations.weights[node][dj * 3 + di] += weight * (forth + BEND * (both - forth));
            }
        }
    }

    /// The solution that is 0 on and beside the start curve, by conjugate gradients.
    fn solved(&self, equations: &Equations) -> Vec<f64> {
        let (nu, nv) = self.size();
        let count = nu * nv;
        let mut is_free: Vec<bool> = (0..count)
            .map(|k| equations.weights[k][4] > 0.0 && self.node((k % nu) as i64, (k / nu) as i64) == Some(k))
            .collect();
        for &(k, _) in &self.offset.near {
            is_free[k] = false;
            if let Some(k) = self.node((k % nu) as i64, (k / nu) as i64) {
                is_free[k] = false;
            }
        }
        let apply = |x: &[f64]| -> Vec<f64> {
            let mut y = vec![0.0; count];
            for k in (0..count).filter(|&k| is_free[k]) {
                let (i, j) = ((k % nu) as i64, (k / nu) as i64);
                y[k] = (0..9)
                    .filter(|&w| equations.weights[k][w] != 0.0)
                    .filter_map(|w| {
                        let node = self.node(i + (w % 3) as i64 - 1, j + (w / 3) as i64 - 1)?;
                        Some(equations.weights[k][w] * x[node])
                    })
                    .sum();
            }
            y
        };
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let scaled = |r: &[f64]| -> Vec<f64> {
            (0..count).map(|k| if is_free[k] { r[k] / equations.weights[k][4] } else { 0.0 }).collect()
        };
        let mut x = vec![0.0; count];
        let mut r: Vec<f64> = (0..count).map(|k| if is_free[k] { equations.right[k] } else { 0.0 }).collect();
        let mut z = scaled(&r);
        let mut p = z.clone();
        let mut rz = dot(&r, &z);
        let enough = rz * ENOUGH * ENOUGH;
        for _ in 0..STEPS {
            let q = apply(&p);
            let pq = dot(&p, &q);
            if !(rz > enough && pq > 0.0) {
                break;
            }
            let step = rz / pq;
            for k in 0..count {
                x[k] += step * p[k];
                r[k] -= step * q[k];
            }
            z = scaled(&r);
            let next = dot(&r, &z);
            let turn = next / rz;
            rz = next;
            for k in 0..count {
                p[k] = z[k] + turn * p[k];
            }
        }
        x
    }
}
