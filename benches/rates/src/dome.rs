//! Two metres of path over a dome, for the proof.

use glam::DVec3;
use stepover::cutter::Cutter;
use stepover::geometry::{Face, Side, Torus, Uv};
use stepover::math::frame::Frame;
use stepover::toolpath::{ClPoint, Move, Rate, Role, Toolpath};

/// A gently doubly curved dome (radii 400 and 300 mm) of about 90 × 90 mm.
pub(crate) fn dome() -> (Face, [f64; 2]) {
    let frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
    let sides = [0.225, 0.3];
    let torus = Torus::new(DVec3::ZERO, frame, 100.0, 300.0, [0.0, sides[0]], [0.0, sides[1]]);
    (Face::new(torus.expect("a piece of a torus"), Side::Front), sides)
}

/// Passes 4.3 mm apart in steps of 0.5 mm; leaning by `lead` along the feed, or upright on the dome's middle.
pub(crate) fn passes(cutter: &Cutter, lead: f64) -> Toolpath {
    let (face, [du, dv]) = dome();
    let mut toolpath = Toolpath::default();
    for j in 0..22 {
        for i in 0..=180 {
            let along = if j % 2 == 0 { i } else { 180 - i };
            let uv = Uv::new(du * f64::from(along) / 180.0, dv * (f64::from(j) + 0.5) / 22.0);
            let Some((jet, n)) = face.at(uv) else { continue };
            let (s, c) = libm::sincos(lead);
            let axis = n * c + jet.du.normalize() * s;
            let u = (n.dot(axis) * axis - n).normalize();
            let centre = jet.p + n * cutter.corner_radius - u * cutter.center_radius;
            let to = ClPoint { tip: centre - axis * cutter.corner_radius, axis };
            toolpath.moves.push(Move { to, rate: Rate::Feed(1000.0), role: Role::Cut });
        }
    }
    toolpath
}
