//! The sculpted meshes of the drop-cutter benchmark: waves, a steep boss and a pit narrower than the cutter.

use glam::DVec3;
use stepover::geometry::TriMesh;

/// The height field over 100 × 100 mm with `n × n` cells of two triangles. Vertices are rounded to single precision,
/// as a binary STL file of it would hold them: the reference heights were computed from such a file.
pub(crate) fn sculpt(n: u32) -> TriMesh {
    let at = |i: u32| -50.0 + 100.0 * f64::from(i) / f64::from(n);
    let rounded = |x: f64| f64::from(x as f32);
    let vertex = |k: u32| {
        let (x, y) = (at(k / (n + 1)), at(k % (n + 1)));
        DVec3::new(rounded(x), rounded(y), rounded(height(x, y)))
    };
    let vertices = (0..(n + 1) * (n + 1)).map(vertex).collect();
    let cell = |k: u32| {
        let a = (k / n) * (n + 1) + k % n;
        (a, a + n + 1, a + n + 2, a + 1)
    };
    let first = (0..n * n).map(cell).map(|(a, b, c, _)| [a, b, c]);
    let second = (0..n * n).map(cell).map(|(a, _, c, d)| [a, c, d]);
    TriMesh { vertices, triangles: first.chain(second).collect() }
}

fn height(x: f64, y: f64) -> f64 {
    use std::f64::consts::TAU;
    let waves = 8.0 * libm::sin(TAU * x / 50.0) * libm::cos(TAU * y / 40.0)
        + 3.0 * libm::sin(TAU * (x + 2.0 * y) / 23.0);
    let bump =
        |cx: f64, cy: f64, spread: f64| libm::exp(-((x - cx) * (x - cx) + (y - cy) * (y - cy)) / spread);
    waves + 15.0 * bump(12.0, -8.0, 60.0) - 10.0 * bump(-20.0, 15.0, 25.0)
}
