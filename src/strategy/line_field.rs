//! Where on a face feed should run: the directions of the widest strips, evened out.

use super::potential::Potential;
use crate::geometry::{Face, FaceGrid, Fronts, Triangle};
use glam::{DMat3, DVec2, DVec3};

/// How often directions are evened out with their neighbours'.
const ROUNDS: usize = 8;

/// Directions without a sign at the nodes of a grid, each with how much it matters.
///
/// A direction `d` that makes strips wider by the share `s` than the worst is the tensor `s d dᵀ`. Tensors can be averaged
/// though directions have no sign: where neighbours disagree little is left of them, and where no direction is better than another,
/// at umbilics, the neighbours' have their way.
pub(super) struct LineField(Vec<DMat3>);

impl LineField {
    /// Of what `potential` has at the nodes of `grid`.
    pub(super) fn new(face: &Face, grid: &FaceGrid, potential: &Potential) -> Self {
        let domain = face.domain();
        let fronts = Fronts::new(&domain, grid);
        let own = |k| {
            let (d, [most, least]) = potential.best(k).unwrap_or((DVec3::ZERO, [1.0; 2]));
            DMat3::from_cols(d * d.x, d * d.y, d * d.z) * (most / least - 1.0)
        };
        let mut tensors: Vec<DMat3> = (0..grid.points().len()).map(own).collect();
        for _ in 0..ROUNDS {
            tensors = (0..tensors.len())
                .map(|k| {
                    let (mut sum, mut count) = (tensors[k], 1.0);
                    for node in fronts.around(k).into_iter().flatten() {
                        sum += tensors[node];
                        count += 1.0;
                    }
                    sum * (1.0 / count)
                })
                .collect();
        }
        Self(tensors)
    }

    /// The unit direction in `triangle` square to where feed should run, on the side of `rise` (a unit vector in the triangle's plane),
    /// and how much it matters: the share by which strips are wider along the feed than across it.
    pub(super) fn rise(&self, triangle: &Triangle, rise: DVec3) -> (DVec3, f64) {
        let side = triangle.normal.normalize_or_zero().cross(rise);
        let (along, matters) = self.along(&triangle.nodes.map(|k| (k, 1.0 / 3.0)), side, rise);
        (rise * along.x - side * along.y, matters)
    }

    /// Where feed should run, as the shares of the unit vectors `side` and `aside` (square to it) whose sum it is, the first not below
    /// 0; and how much it matters. Of the weighted mean of what is at the nodes.
    pub(super) fn along(&self, nodes: &[(usize, f64)], side: DVec3, aside: DVec3) -> (DVec2, f64) {
        let tensor = nodes.iter().fold(DMat3::ZERO, |sum, &(k, weight)| sum + self.0[k] * weight);
        let (along, across) = (tensor * side, tensor * aside);
        let (difference, mixed) = (along.dot(side) - across.dot(aside), 2.0 * along.dot(aside));
        // Half the angle by which the principal direction is turned off the side.
        let (s, c) = libm::sincos(0.5 * libm::atan2(mixed, difference));
        (DVec2::new(c, s), libm::hypot(difference, mixed))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cutter::Cutter;
    use crate::geometry::{Cylinder, Side, triangles};
    use crate::math::frame::Frame;
    use crate::monitor::Stage;
    use crate::posture::{Limits, Rule};
    use crate::strategy::Finish;

    #[test]
    fn on_a_rod_feed_should_run_round_or_along_it_whatever_side_one_asks_from() {
        let world = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
        let rod = Cylinder::new(DVec3::ZERO, world, 20.0, [0.0, 2.0], [0.0, 30.0]).unwrap();
        let face = Face::new(rod, Side::Front);
        let grid = FaceGrid::new(&face, 2.0, 4, 20);
        let cutter = Cutter::bull_nose(10.0, 2.0, 40.0).unwrap();
        let finish = Finish { scallop: 0.01, chord: 0.0002 };
        let rule = Rule::Matched(Limits::default());
        let potential = Potential::new((&face, &grid), &cutter, &rule, &finish, &Stage::silent()).unwrap();
        let lines = LineField::new(&face, &grid, &potential);
        for triangle in triangles(&grid) {
            let (best, _) = potential.best(triangle.nodes[0]).unwrap();
            for asked in [DVec3::Z, DVec3::new(0.4, 0.2, 0.7), DVec3::new(-0.5, 0.9, 0.8)] {
                let rise = triangle.flat(asked).unwrap();
                let (wanted, matters) = lines.rise(&triangle, rise);
                assert!(wanted.dot(best).abs() < 0.15 && wanted.dot(rise) > 0.0, "{wanted} {best}");
                assert!((wanted.length() - 1.0).abs() < 1e-9 && matters > 0.1, "{matters}");
            }
        }
    }
}
