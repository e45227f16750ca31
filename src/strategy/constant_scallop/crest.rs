//! Where the passes' direction changes much from one place to the next: fronts meet there, or strips bend.

use super::offset::Offset;
use crate::geometry::{Fronts, Uv};
use crate::strategy::family::Family;
use glam::DVec3;

/// Parts that a side of each cell there has.
const FINER: usize = 4;
/// Where directions at neighbouring nodes have a lower cosine than this (18°), strips bend or fronts meet.
const BENT: f64 = 0.95;

/// Places in the cells where the direction of the passes of `family` changes much, closer together than its nodes.
pub(super) fn places(family: &Family, offset: &Offset) -> Vec<Uv> {
    let (nu, nv) = offset.grid.size();
    let fronts = Fronts::new(&offset.domain, &offset.grid);
    let ways: Vec<DVec3> = (0..nu * nv)
        .map(|node| {
            let uv = offset.uv(node);
            let rise = family.setup.field.surface_gradient(uv, &family.setup.face.jet(uv));
            if rise.is_finite() { rise.normalize_or_zero() } else { DVec3::ZERO }
        })
        .collect();
    let is_crest =
        |node: usize| fronts.around(node).into_iter().flatten().any(|n| ways[n].dot(ways[node]) < BENT);
    let mut crest = vec![false; nu * nv];
    for node in (0..nu * nv).filter(|&node| is_crest(node)) {
        crest[node] = true;
        fronts.around(node).into_iter().flatten().for_each(|n| crest[n] = true);
    }
    let mut places = Vec::new();
    for (i, j) in
        (0..nv - 1).flat_map(|j| (0..nu - 1).map(move |i| (i, j))).filter(|(i, j)| crest[j * nu + i])
    {
        let (low, high) = (offset.grid.uv(i, j), offset.grid.uv(i + 1, j + 1));
        let at = |a: f64, b: f64, k: usize| a + (b - a) * k as f64 / FINER as f64;
        let inside = (0..(FINER + 1) * (FINER + 1)).map(|k| (k % (FINER + 1), k / (FINER + 1)));
        places.extend(inside.map(|(p, q)| Uv::new(at(low.u, high.u, p), at(low.v, high.v, q))));
    }
    places
}
