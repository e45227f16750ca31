//! A part of a surface, kept as the cubes of space that it passes through.

use super::cubes::{Cubes, each_cube};
use crate::math::order::sort_by_key;
use glam::DVec3;

/// A part of a surface, kept as the cubes of edge [`Zone::cell`] that it passes through, and its area.
///
/// Cubes serve surfaces and meshes alike, need no parameters, and can be drawn. A point near the zone's rim may fall
/// in a cube without belonging to the zone: by at most the cube's diagonal.
#[derive(Debug, Clone, PartialEq)]
pub struct Zone {
    pub(super) origin: DVec3,
    pub(super) cell: f64,
    /// Sorted, each once.
    pub(super) cells: Vec<[i32; 3]>,
    pub(super) area: f64,
}

impl Zone {
    /// The zone of `samples`, each a point (mm) and the area it stands for (mm²), in cubes of edge `cell` (mm, above 0)
    /// that hold at least one of them.
    pub fn from_samples(cell: f64, samples: impl IntoIterator<Item = (DVec3, f64)>) -> Self {
        let mut area = 0.0;
        let mut cells = Vec::new();
        for (point, weight) in samples {
            cells.push(key(point / cell));
            area += weight;
        }
        settle(&mut cells);
        Self { origin: DVec3::ZERO, cell, cells, area }
    }

    /// The zone with every cube next to one of its own, over faces, edges and corners; the area stays that of the samples.
    #[must_use]
    pub fn grown(&self) -> Self {
        let around = || (-1..=1).flat_map(|x| (-1..=1).flat_map(move |y| (-1..=1).map(move |z| [x, y, z])));
        let mut cells: Vec<[i32; 3]> = self
            .cells
            .iter()
            .flat_map(|c| around().map(move |d| [c[0] + d[0], c[1] + d[1], c[2] + d[2]]))
            .collect();
        settle(&mut cells);
        Self { cells, ..*self }
    }

    /// A zone that holds what either holds, in the larger one's cubes; the areas add up. Of two zones with cubes of the
    /// same grid, halved or not, nothing is added.
    #[must_use]
    pub fn joined(&self, other: &Self) -> Self {
        let (coarse, fine) = if self.cell >= other.cell { (self, other) } else { (other, self) };
        let area = self.area + other.area;
        if coarse.is_empty() {
            return Self { area, ..fine.clone() };
        }
        let mut cubes = Cubes::new(coarse.origin, coarse.cell, usize::MAX);
        let ratio = fine.cell / coarse.cell;
        let offset = (fine.origin - coarse.origin) / coarse.cell;
        for c in &fine.cells {
            let low = offset + DVec3::from_array(c.map(f64::from)) * ratio;
            // Faces that coincide up to rounding do not meet.
            let (low, high) = (key(low + NUDGE), key(low + ratio - NUDGE));
            cubes.fill(low, high);
        }
        for &c in &coarse.cells {
            cubes.fill(c, c);
        }
        Self { area, ..cubes.zone() }
    }

    /// The zone in at most `most` cubes (or 8 if that is less), their edge doubled as often as that takes: to draw it.
    #[must_use]
    pub fn in_cubes(&self, most: usize) -> Self {
        Cubes::of(self.clone(), most).zone()
    }

    /// A zone that holds nothing.
    pub fn empty() -> Self {
        Self { origin: DVec3::ZERO, cell: 1.0, cells: Vec::new(), area: 0.0 }
    }

    /// Whether `point` lies in one of the zone's cubes.
    pub fn contains(&self, point: DVec3) -> bool {
        self.cells.binary_search(&key((point - self.origin) / self.cell)).is_ok()
    }

    /// Whether all of the flat convex polygon with these corners, 3 or 4 of them, lies in the zone's cubes.
    pub fn holds(&self, corners: &[DVec3]) -> bool {
        let corners = corners.iter().map(|&p| (p - self.origin) / self.cell);
        each_cube(corners, 0.0, |cube| self.cells.binary_search(&cube).is_ok())
    }

    /// The area that the samples stood for, square millimetres.
    pub fn area(&self) -> f64 {
        self.area
    }

    /// Edge of the cubes, millimetres.
    pub fn cell(&self) -> f64 {
        self.cell
    }

    /// Centres of the cubes, in a fixed order.
    pub fn centers(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.cells.iter().map(|c| self.origin + (DVec3::from_array(c.map(f64::from)) + 0.5) * self.cell)
    }

    /// Whether the zone holds nothing.
    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }
}

/// Part of a cube that rounding may make of none.
const NUDGE: f64 = 1e-6;

/// Sorts cubes and leaves each once.
pub(super) fn settle(cells: &mut Vec<[i32; 3]>) {
    // With the sign's bit turned round, patterns are in the order of the numbers.
    sort_by_key(cells, |c| {
        let [x, y, z] = c.map(|c| c.cast_unsigned() ^ 1 << 31);
        (u64::from(x) << 32 | u64::from(y), z)
    });
    cells.dedup();
}

/// The cube of a point given in cubes.
pub(super) fn key(point: DVec3) -> [i32; 3] {
    point.floor().to_array().map(|c| c as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joined_zones_hold_what_either_holds() {
        let points = |n: u32, by: f64| (0..n).map(move |i| DVec3::new(by * f64::from(i), 0.3, -0.2 * by));
        let weigh = |p: DVec3| (p, 0.5);
        let (a, b) = (
            Zone::from_samples(0.4, points(9, 0.7).map(weigh)),
            Zone::from_samples(0.2, points(20, -0.3).map(weigh)),
        );
        for zone in [a.joined(&b), b.joined(&a)] {
            assert!(points(9, 0.7).chain(points(20, -0.3)).all(|p| zone.contains(p)));
            assert_eq!((zone.area(), zone.cell()), (14.5, 0.4));
        }
        assert_eq!(a.joined(&Zone::empty()).centers().count(), a.centers().count());
        assert_eq!(a.joined(&a).centers().count(), a.centers().count());
    }

    #[test]
    fn fewer_cubes_hold_what_more_held() {
        let points = || (0..500).map(|i| DVec3::new(0.1 * f64::from(i), 0.05 * f64::from(i % 40), -3.0));
        let zone = Zone::from_samples(0.05, points().map(|p| (p, 1.0)));
        let drawn = zone.in_cubes(90);
        assert!(drawn.centers().count() <= 90 && points().all(|p| drawn.contains(p)));
        assert_eq!(drawn.area(), zone.area());
        assert_eq!(zone.in_cubes(500), zone);
    }
}
