//! Strip widths a second: exact over the model surface, exact over a spline surface, second order.

use divan::Bencher;
use divan::counter::ItemsCount;
use glam::DVec3;
use stepover::contact::{StripLimits, face_strip, model_strip, second_order_strip_width};
use stepover::cutter::Cutter;

#[path = "rates/src/strips.rs"]
mod strips;
use strips::{cases, contacts};

fn main() {
    divan::main();
}

#[divan::bench]
fn exact_over_model(bencher: Bencher) {
    let cases = cases();
    bencher.counter(ItemsCount::new(cases.len())).bench(|| {
        cases
            .iter()
            .filter_map(|(c, p, k)| model_strip(c, *p, k, 0.01).half_widths())
            .map(|(l, r)| l + r)
            .sum::<f64>()
    });
}

#[divan::bench]
fn second_order(bencher: Bencher) {
    let cases = cases();
    bencher
        .counter(ItemsCount::new(cases.len()))
        .bench(|| cases.iter().map(|(c, p, k)| second_order_strip_width(c, *p, k, 0.01)).sum::<f64>());
}

#[divan::bench]
fn exact_over_spline_surface(bencher: Bencher) {
    let (Some(face), contacts) = contacts() else { return };
    let cutter = Cutter::bull_nose(8.0, 2.0, 30.0).unwrap();
    let limits = StripLimits { scallop: 0.02, gouge: 0.0005 };
    bencher.counter(ItemsCount::new(contacts.len())).bench(|| {
        contacts
            .iter()
            .filter(|(uv, cc)| face_strip(&face, &cutter, cc, *uv, DVec3::ZERO, limits).is_some())
            .count()
    });
}
