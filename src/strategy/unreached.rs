//! Where the cutter cannot go, mapped outwards from where the lines of a family found it so.

use super::family::Candidate;
use super::probe::{Probe, Setup};
use crate::geometry::{FaceGrid, Uv, Zone};
use crate::monitor::{Cancelled, Stage};
use std::collections::BTreeSet;

/// Samples a side of a cell where the rim of the unreachable is mapped.
const FINE: usize = 3;
/// Most cells a side of the map.
const MOST: usize = 400;

/// Where the cutter cannot go around the blocked probes of `tracks` and around `others`, as far as the family `owns` the face, and a
/// rim beside it where its strips end: elsewhere another family may go in its own direction.
///
/// A spot that is blocked but lies between the lines, met by none of them, may be finished by the strips on either side, and
/// is no part of the zone then.
pub(super) fn zone(
    setup: &Setup,
    tracks: &[Candidate],
    others: &[Uv],
    owns: &(dyn Fn(Uv) -> bool + Sync),
    stage: &Stage,
) -> Result<Zone, Cancelled> {
    let map = Map { setup, owns, grid: FaceGrid::new(setup.face, 0.5 * setup.strip, 24, MOST) };
    let domain = setup.face.domain();
    let blocked = tracks
        .iter()
        .flat_map(|track| track.lines.iter().zip(&track.probes))
        .flat_map(|(line, probes)| line.nodes.iter().zip(probes))
        .filter(|(_, probe)| **probe == Probe::Blocked)
        .map(|(&uv, _)| uv);
    let seeds_at = blocked.chain(others.iter().copied()).map(|uv| map.grid.cell_at(domain.hold(uv)));
    // Extended and not collected: that would bring a sort of its own into the page's module.
    let mut seeds = BTreeSet::new();
    seeds.extend(seeds_at);
    if seeds.is_empty() {
        return Ok(Zone::empty());
    }
    let cells = map.flood(seeds, &stage.part("Mapping what is unreachable", 0.0, 0.5))?;
    let found = stage
        .part("Mapping what is unreachable", 0.5, 1.0)
        .map(cells.len(), |k| map.blocked_within(cells[k]).collect::<Vec<_>>())?;
    // Grown by a cube, the zone takes in the half strip beside it where passes end.
    Ok(Zone::from_samples(0.5 * setup.strip, found.into_iter().flatten()).grown())
}

/// A cell or node of the map: its place along u and v.
type Place = (usize, usize);

struct Map<'a> {
    setup: &'a Setup<'a>,
    owns: &'a (dyn Fn(Uv) -> bool + Sync),
    grid: FaceGrid,
}

impl Map<'_> {
    fn is_blocked(&self, uv: Uv) -> bool {
        (self.owns)(uv) && self.setup.probe(uv, false) == Probe::Blocked
    }

    /// The `seeds` and all cells with a blocked node that hang together with them, in order.
    fn flood(&self, seeds: BTreeSet<Place>, stage: &Stage) -> Result<Vec<Place>, Cancelled> {
        let (nu, nv) = self.grid.size();
        let mut seen = BTreeSet::new();
        seen.extend(seeds.iter().flat_map(|&cell| corners(cell)));
        let mut cells = seeds;
        let mut rim: Vec<Place> = seen.iter().copied().collect();
        while !rim.is_empty() {
            // How far the water will run is not known: half of what has been looked at is a fair guess.
            stage.at(seen.len() as f64 / (2 * nu * nv) as f64)?;
            let blocked =
                stage.quiet().map(rim.len(), |k| self.is_blocked(self.grid.uv(rim[k].0, rim[k].1)))?;
            let wet: Vec<Place> =
                rim.iter().zip(blocked).filter(|(_, b)| *b).map(|(&node, _)| node).collect();
            rim.clear();
            for node in wet {
                for cell in cells_around(node, (nu, nv)) {
                    cells.insert(cell);
                    rim.extend(corners(cell).into_iter().filter(|&corner| seen.insert(corner)));
                }
            }
        }
        Ok(cells.into_iter().collect())
    }

    /// The blocked spots of a cell, each with the area it stands for.
    fn blocked_within(&self, (i, j): Place) -> impl Iterator<Item = (glam::DVec3, f64)> {
        let (low, high) = (self.grid.uv(i, j), self.grid.uv(i + 1, j + 1));
        let at = |a: f64, b: f64, s: usize| a + (b - a) * (s as f64 + 0.5) / FINE as f64;
        let weight = self.grid.cell_area(i, j) / (FINE * FINE) as f64;
        (0..FINE * FINE)
            .map(move |s| Uv::new(at(low.u, high.u, s % FINE), at(low.v, high.v, s / FINE)))
            .filter(|&uv| self.is_blocked(uv))
            .map(move |uv| (self.setup.face.surface.point(uv), weight))
    }
}

fn corners((i, j): Place) -> [Place; 4] {
    [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)]
}

fn cells_around((i, j): Place, (nu, nv): (usize, usize)) -> impl Iterator<Item = Place> {
    let beside = |k: usize, n: usize| k.saturating_sub(1)..=k.min(n - 2);
    beside(j, nv).flat_map(move |b| beside(i, nu).map(move |a| (a, b)))
}
