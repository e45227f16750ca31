//! Angles and turns with the same bits on every target.
//!
//! The vectors' own functions for them call the standard library's sine, cosine and arc cosine, which differ from one target to
//! the next; what the vectors do with roots alone is the same everywhere, and an instruction in WebAssembly too.

use glam::{DMat3, DVec2, DVec3};

/// The angle between two vectors of any length but 0, radians from 0 to π.
pub fn angle_between(a: DVec3, b: DVec3) -> f64 {
    let cosine = a.dot(b) / (a.length_squared() * b.length_squared()).sqrt();
    libm::acos(cosine.clamp(-1.0, 1.0))
}

/// The unit vector at an angle (radians) from x towards y.
pub fn direction(angle: f64) -> DVec2 {
    let (sin, cos) = libm::sincos(angle);
    DVec2::new(cos, sin)
}

/// The turn about a unit `axis` by an angle (radians), positive by the right hand (O. Rodrigues, 1840).
pub fn turn_about(axis: DVec3, angle: f64) -> DMat3 {
    let (sin, cos) = libm::sincos(angle);
    let rest = 1.0 - cos;
    let (s, DVec3 { x, y, z }) = (axis * sin, axis);
    let (xy, xz, yz) = (x * y * rest, x * z * rest, y * z * rest);
    DMat3::from_cols(
        DVec3::new(x * x * rest + cos, xy + s.z, xz - s.y),
        DVec3::new(xy - s.z, y * y * rest + cos, yz + s.x),
        DVec3::new(xz + s.y, yz - s.x, z * z * rest + cos),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_keeps_its_axis_and_turns_the_rest_by_its_angle() {
        let axis = DVec3::new(1.0, -2.0, 2.0) / 3.0;
        let across = axis.any_orthonormal_vector();
        for angle in [-3.0, -0.4, 0.0, 1e-9, 0.7, 3.1] {
            let turned = turn_about(axis, angle) * across;
            assert!((turn_about(axis, angle) * axis).distance(axis) < 1e-15);
            assert!((angle_between(across, 5.0 * turned) - f64::abs(angle)).abs() < 1e-7);
            assert!((across.cross(turned).dot(axis) - libm::sin(angle)).abs() < 1e-15);
            assert!((direction(angle).x - across.dot(turned)).abs() < 1e-15);
        }
    }
}
