//! A part of a surface, kept as the cubes of space that it passes through.

use glam::DVec3;

/// A part of a surface given by samples: the cubes of edge [`Zone::cell`] that hold at least one of them, and the area
/// that the samples stand for.
///
/// Cubes serve surfaces and meshes alike, need no parameters, and can be drawn. A point near the zone's rim may fall
/// in a cube without belonging to the zone: by at most the cube's diagonal.
#[derive(Debug, Clone, PartialEq)]
pub struct Zone {
    cell: f64,
    cells: Vec<[i32; 3]>,
    area: f64,
}

impl Zone {
    /// The zone of `samples`, each a point (mm) and the area it stands for (mm²), in cubes of edge `cell` (mm, above 0).
    pub fn from_samples(cell: f64, samples: impl IntoIterator<Item = (DVec3, f64)>) -> Self {
        let mut area = 0.0;
        let mut cells = Vec::new();
        for (point, weight) in samples {
            cells.push(Self::key(cell, point));
            area += weight;
        }
        cells.sort_unstable();
        cells.dedup();
        Self { cell, cells, area }
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
        cells.sort_unstable();
        cells.dedup();
        Self { cells, ..*self }
    }

    /// A zone that holds nothing.
    pub fn empty() -> Self {
        Self { cell: 1.0, cells: Vec::new(), area: 0.0 }
    }

    fn key(cell: f64, point: DVec3) -> [i32; 3] {
        (point / cell).floor().to_array().map(|c| c as i32)
    }

    /// Whether `point` lies in one of the zone's cubes.
    pub fn contains(&self, point: DVec3) -> bool {
        self.cells.binary_search(&Self::key(self.cell, point)).is_ok()
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
        self.cells.iter().map(|c| (DVec3::from_array(c.map(f64::from)) + 0.5) * self.cell)
    }

    /// Whether the zone holds nothing.
    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }
}
