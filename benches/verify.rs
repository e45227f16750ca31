//! The claim: two metres of path over a million samples in at most ten seconds of one core.

use divan::Bencher;
use stepover::cutter::Cutter;
use stepover::monitor::Stage;
use stepover::toolpath::Role;
use stepover::verify::{Options, Samples, verify};

#[path = "rates/src/dome.rs"]
mod dome;
use dome::{dome, passes};

fn main() {
    divan::main();
}

#[divan::bench(args = [5.0, 12.0], sample_count = 1, sample_size = 1)]
fn two_metres_over_a_million_samples(bencher: Bencher, lead_degrees: f64) {
    let cutter = Cutter::bull_nose(25.0, 3.0, 50.0).expect("a cutter");
    let path = passes(&cutter, lead_degrees.to_radians());
    let samples = Samples::of_face(&dome().0, 0.09).expect("samples");
    assert!(samples.samples.len() > 900_000 && path.length(Role::Cut) > 1900.0);
    let options = Options { search: 0.2, ..Options::for_height(0.01, &cutter) };
    bencher.bench(|| verify(&cutter, &path, &samples, &options, &Stage::silent()));
}
