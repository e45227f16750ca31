//! From polygons in space to the cubes that they pass through.

use super::zone::{Zone, key, settle};
use glam::DVec3;

/// Collects the cubes of a [`Zone`]. Never many more than asked for: when there are too many, cubes double their edge.
#[derive(Debug, Clone)]
pub struct Cubes {
    zone: Zone,
    most: usize,
}

/// So many times the most cubes may wait to be sorted.
const WAITING: usize = 4;

/// The cubes around the origin never become one, however large they are: there is one in each octant.
const FEWEST: usize = 8;

impl Cubes {
    /// None yet; of edge `cell` (mm, above 0), one of them with a corner at `origin`, at most `most`, or 8 if that is less.
    ///
    /// Adding takes time with the area over the square of `cell`: who knows an area beforehand should choose it so that
    /// `most` will do.
    pub fn new(origin: DVec3, cell: f64, most: usize) -> Self {
        Self { zone: Zone { origin, cell, cells: Vec::new(), area: 0.0 }, most: most.max(FEWEST) }
    }

    /// Those of `zone`, at most `most`, or 8 if that is less.
    pub(super) fn of(zone: Zone, most: usize) -> Self {
        Self { zone, most: most.max(FEWEST) }
    }

    /// Edge of the cubes by now, mm.
    pub fn cell(&self) -> f64 {
        self.zone.cell
    }

    /// Adds the cubes within `margin` (mm, along the axes) of the flat convex polygon with these corners, 3 or 4 of
    /// them, that stands for `area` mm².
    pub fn add(&mut self, corners: &[DVec3], margin: f64, area: f64) {
        let Zone { origin, cell, .. } = self.zone;
        each_cube(corners.iter().map(|&p| (p - origin) / cell), margin / cell, |cube| {
            self.zone.cells.push(cube);
            true
        });
        self.zone.area += area;
        self.settle(WAITING);
    }

    /// Adds a box of cubes, given by its first and last.
    pub(super) fn fill(&mut self, low: [i32; 3], high: [i32; 3]) {
        for i in low[0]..=high[0] {
            for j in low[1]..=high[1] {
                self.zone.cells.extend((low[2]..=high[2]).map(|k| [i, j, k]));
            }
        }
    }

    /// Adds what `other`, begun with the same origin and cell, has collected.
    pub fn absorb(&mut self, mut other: Self) {
        while self.zone.cell < other.zone.cell {
            self.double();
        }
        while other.zone.cell < self.zone.cell {
            other.double();
        }
        self.zone.cells.append(&mut other.zone.cells);
        self.zone.area += other.zone.area;
        self.settle(WAITING);
    }

    /// The zone of all that was added.
    pub fn zone(mut self) -> Zone {
        self.settle(0);
        self.zone
    }

    /// Makes room if more than `waiting` times the most are there.
    fn settle(&mut self, waiting: usize) {
        if self.zone.cells.len() <= self.most.saturating_mul(waiting) {
            return;
        }
        settle(&mut self.zone.cells);
        while self.zone.cells.len() > self.most && self.zone.cell.is_finite() {
            self.double();
            settle(&mut self.zone.cells);
        }
    }

    fn double(&mut self) {
        self.zone.cell *= 2.0;
        for cube in &mut self.zone.cells {
            *cube = cube.map(|c| c >> 1);
        }
    }
}

/// Calls `visit` with the cubes of edge 1 within `margin` of the flat convex polygon with these corners, in order, as long
/// as it returns true; whether it always did.
pub(super) fn each_cube(
    corners: impl Iterator<Item = DVec3>,
    margin: f64,
    mut visit: impl FnMut([i32; 3]) -> bool,
) -> bool {
    let mut polygon = Polygon::default();
    corners.for_each(|p| polygon.push(p));
    polygon.span(0, margin).all(|i| {
        let strip = polygon.between(0, f64::from(i), margin);
        strip.span(1, margin).all(|j| {
            let rod = strip.between(1, f64::from(j), margin);
            rod.span(2, margin).all(|k| visit([i, j, k]))
        })
    })
}

/// A flat convex polygon of at most a dozen corners: four, and one more for each of the four cuts.
#[derive(Default, Clone, Copy)]
struct Polygon {
    corners: [DVec3; 12],
    count: usize,
}

impl Polygon {
    fn push(&mut self, p: DVec3) {
        if let Some(corner) = self.corners.get_mut(self.count) {
            *corner = p;
            self.count += 1;
        }
    }

    fn corners(&self) -> &[DVec3] {
        &self.corners[..self.count]
    }

    /// The cubes along an axis that the polygon meets.
    fn span(&self, axis: usize, margin: f64) -> std::ops::Range<i32> {
        let along = || self.corners().iter().map(|p| p[axis]);
        let (lo, hi) = (along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max));
        if lo > hi {
            return 0..0;
        }
        let [lo, hi, _] = key(DVec3::new(lo - margin, hi + margin, 0.0));
        lo..hi.saturating_add(1)
    }

    /// The part between `from` and `from + 1` along an axis, and the margin to either side.
    fn between(&self, axis: usize, from: f64, margin: f64) -> Self {
        self.cut(|p| p[axis] - (from - margin)).cut(|p| from + 1.0 + margin - p[axis])
    }

    /// The part where `inside`, which is affine, is not negative.
    fn cut(&self, inside: impl Fn(DVec3) -> f64) -> Self {
        let mut part = Self::default();
        for (i, &a) in self.corners().iter().enumerate() {
            let b = self.corners[(i + 1) % self.count];
            let (at_a, at_b) = (inside(a), inside(b));
            if at_a >= 0.0 {
                part.push(a);
            }
            if at_a * at_b < 0.0 {
                part.push(a + (b - a) * (at_a / (at_a - at_b)));
            }
        }
        part
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = DVec3> {
        let c = || -5.0..5.0f64;
        (c(), c(), c()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    }

    proptest! {
        #[test]
        fn every_point_of_a_triangle_is_in_its_cubes(a in point(), b in point(), c in point(), most in 1usize..2000) {
            let mut cubes = Cubes::new(DVec3::new(0.1, 0.2, 0.3), 0.25, most);
            cubes.add(&[a, b, c], 1e-9, 2.0);
            let zone = cubes.zone();
            prop_assert!(zone.centers().count() <= most.max(FEWEST) && zone.area() == 2.0);
            prop_assert!(zone.holds(&[a, b, c]) && !zone.holds(&[a, b, c + DVec3::splat(20.0)]));
            for i in 0..=40 {
                for j in 0..=40 - i {
                    let p = a + (b - a) * (f64::from(i) / 40.0) + (c - a) * (f64::from(j) / 40.0);
                    prop_assert!(zone.contains(p));
                }
            }
            // No cube is far from the triangle's plane.
            if let Some(n) = (b - a).cross(c - a).try_normalize() {
                let diagonal = 0.5 * 3f64.sqrt() * zone.cell() + 1e-6;
                prop_assert!(zone.centers().all(|p| (p - a).dot(n).abs() <= diagonal));
            }
        }
    }

    #[test]
    fn around_the_origin_cubes_stop_growing_at_one_in_each_octant() {
        let (a, b, c) = (DVec3::new(-0.6, 0.0, 0.0), DVec3::new(0.0, 2.6, 0.0), DVec3::new(0.7, 0.0, 4.0));
        let mut cubes = Cubes::new(DVec3::new(0.1, 0.2, 0.3), 0.25, 5);
        cubes.add(&[a, b, c], 1e-9, 1.0);
        let zone = cubes.zone();
        assert!(zone.centers().count() <= FEWEST && zone.cell() <= 4.0 && zone.holds(&[a, b, c]));
    }

    #[test]
    fn absorbed_cubes_are_the_same_as_added_ones() {
        let square =
            |x: f64| [DVec3::new(x, 0.0, 0.0), DVec3::new(x + 3.0, 0.1, 0.2), DVec3::new(x, 3.0, 1.0)];
        let new = |most| Cubes::new(DVec3::ZERO, 0.1, most);
        let (mut all, mut first, mut second) = (new(300), new(300), new(300));
        for x in [0.0, 2.0, 40.0] {
            all.add(&square(x), 0.0, 1.0);
            let part = if x < 1.0 { &mut first } else { &mut second };
            part.add(&square(x), 0.0, 1.0);
        }
        first.absorb(second);
        assert_eq!(all.zone(), first.zone());
    }
}
