//! The point of a face nearest to a place.

use super::{Face, FaceGrid, Uv};
use glam::DVec3;

/// Steps at most. Near a face each brings a digit or more; far from one a few digits are enough.
const STEPS: usize = 60;
/// A step that brings nothing is tried at half its length, down to this share of it.
const LEAST: f64 = 1e-3;

impl Face {
    /// Parameters of the point of the face nearest to `place` (mm), looked for around the node of `grid`, which must be of
    /// the face, that is nearest: a nearer place in a fold much smaller than a cell is missed. Beside the face it lies on its
    /// border.
    ///
    /// Steps along the tangents (Gauss and Newton) and, where a border or a pole is in the way, along either parameter.
    pub fn nearest(&self, grid: &FaceGrid, place: DVec3) -> Uv {
        let nu = grid.size().0;
        let nodes = grid.points().iter().enumerate();
        let closer = |a: (f64, usize), b: (f64, usize)| if b.0 < a.0 { b } else { a };
        let (_, node) = nodes.map(|(k, p)| (p.distance_squared(place), k)).fold((f64::INFINITY, 0), closer);
        self.nearest_from(grid.uv(node % nu, node / nu), place)
    }

    /// The same, looked for around the place `uv` of the face.
    pub fn nearest_from(&self, mut uv: Uv, place: DVec3) -> Uv {
        let domain = self.domain();
        let off = |uv: Uv| self.surface.point(uv).distance_squared(place);
        let (mut least, mut share) = (off(uv), 1.0);
        for _ in 0..STEPS {
            let jet = self.jet(uv);
            let away = place - jet.p;
            let alone = |d: DVec3| d.dot(away) / d.length_squared().max(f64::MIN_POSITIVE);
            let both = jet.pull_back(away).unwrap_or_default();
            let (base, before) = (uv, least);
            for (u, v) in [both, (alone(jet.du), 0.0), (0.0, alone(jet.dv))] {
                let next = domain.clamp(Uv::new(base.u + share * u, base.v + share * v));
                let found = off(next);
                if found < least {
                    (least, uv) = (found, next);
                }
            }
            if least >= before {
                share *= 0.5;
                if share < LEAST {
                    break;
                }
            }
        }
        domain.hold(uv)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Cylinder, Side, Sphere};
    use crate::math::frame::Frame;
    use std::f64::consts::{FRAC_PI_2, TAU};

    const WORLD: Frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };

    fn found(face: &Face, place: DVec3) -> DVec3 {
        let grid = FaceGrid::new(face, 1.0, 8, 200);
        face.surface.point(face.nearest(&grid, place))
    }

    #[test]
    fn feet_are_square_below_and_on_borders_beside() {
        let tube =
            Face::new(Cylinder::new(DVec3::ZERO, WORLD, 5.0, [0.0, TAU], [0.0, 9.0]).unwrap(), Side::Front);
        let dome = Face::new(
            Sphere::new(DVec3::ZERO, WORLD, 10.0, [0.0, TAU], [0.0, FRAC_PI_2]).unwrap(),
            Side::Front,
        );
        for k in 0..40 {
            let (s, c) = libm::sincos(0.161 * f64::from(k));
            let (out, z) = (DVec3::new(c, s, 0.0), 0.3 * f64::from(k) - 1.0);
            let foot = found(&tube, out * (4.0 + 0.1 * f64::from(k)) + DVec3::Z * z);
            assert!(foot.distance(out * 5.0 + DVec3::Z * z.clamp(0.0, 9.0)) < 1e-6, "{k}: {foot}");
            let way = (out + DVec3::Z * 0.2 * f64::from(k)).normalize();
            assert!(found(&dome, way * 12.0).distance(way * 10.0) < 1e-6, "{k}");
        }
        assert!(found(&dome, DVec3::Z * 11.0).distance(DVec3::Z * 10.0) < 1e-4);
    }
}
