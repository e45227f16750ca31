//! Lowering cutters on the sculpted meshes: drops a second must not depend on the number of triangles.

use divan::counter::ItemsCount;
use stepover::contact::{DropMesh, Underside, drop_cutter};
use stepover::cutter::Cutter;

#[path = "rates/src/places.rs"]
mod places;
#[path = "../tests/support/sculpt.rs"]
mod sculpt;
use places::scattered;

/// Cells a side of meshes of 5,000, 50,000 and 500,000 triangles.
const CELLS: [u32; 3] = [50, 158, 500];

/// Places per measurement.
const DROPS: usize = 5000;

fn main() {
    divan::main();
}

#[divan::bench(args = CELLS)]
fn bull_nose_scattered(bencher: divan::Bencher<'_, '_>, cells: u32) {
    measure(bencher, cells, &Cutter::bull_nose(10.0, 2.0, 50.0).unwrap(), scattered);
}

#[divan::bench(args = CELLS)]
fn bull_nose_raster(bencher: divan::Bencher<'_, '_>, cells: u32) {
    measure(bencher, cells, &Cutter::bull_nose(10.0, 2.0, 50.0).unwrap(), raster);
}

#[divan::bench(args = CELLS)]
fn ball_scattered(bencher: divan::Bencher<'_, '_>, cells: u32) {
    measure(bencher, cells, &Cutter::ball(10.0, 50.0).unwrap(), scattered);
}

#[divan::bench(args = CELLS)]
fn flat_scattered(bencher: divan::Bencher<'_, '_>, cells: u32) {
    measure(bencher, cells, &Cutter::flat(10.0, 50.0).unwrap(), scattered);
}

#[divan::bench(args = CELLS, sample_count = 10)]
fn build(bencher: divan::Bencher<'_, '_>, cells: u32) {
    let mesh = sculpt::sculpt(cells);
    bencher.counter(ItemsCount::new(mesh.triangles.len())).bench(|| DropMesh::new(&mesh));
}

fn measure(bencher: divan::Bencher<'_, '_>, cells: u32, cutter: &Cutter, place: fn(usize) -> (f64, f64)) {
    let mesh = DropMesh::new(&sculpt::sculpt(cells));
    let under = Underside::new(cutter);
    bencher.counter(ItemsCount::new(DROPS)).bench(|| {
        let height = |i| {
            let (x, y) = place(i);
            drop_cutter(&mesh, &under, x, y).map_or(0.0, |touch| touch.tip_z)
        };
        (0..DROPS).map(height).sum::<f64>()
    });
}

/// Along lines 1.9 mm apart, at 0.95 mm.
fn raster(i: usize) -> (f64, f64) {
    (-47.5 + 0.95 * (i % 100) as f64, -47.5 + 1.9 * (i / 100) as f64)
}
