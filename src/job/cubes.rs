//! A zone as cubes to draw, in single precision.

use crate::geometry::Zone;

/// Cubes to draw.
#[derive(Debug, Clone, PartialEq)]
pub struct Cubes {
    /// x, y, z of each cube's middle, mm.
    pub centers: Vec<f32>,
    /// Edge of all of them, mm.
    pub edge: f64,
}

/// More than this only fill a screen.
const MOST: usize = 60_000;

impl Cubes {
    /// Those of `zone`, or larger ones where they would be too many to draw.
    pub fn of(zone: &Zone) -> Self {
        let zone = zone.in_cubes(MOST);
        let centers = zone.centers().flat_map(|p| p.as_vec3().to_array()).collect();
        Self { centers, edge: zone.cell() }
    }
}
