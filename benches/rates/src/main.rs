//! Prints a line `seconds<TAB>count<TAB>name` for each piece of work: processor time of this thread, best of several.

use rates::{KINDS, Work};
use std::time::Instant;

/// Measurements of which the best counts, and the least time of one: Linux counts in ticks of some milliseconds.
const MEASUREMENTS: usize = 5;
const LEAST_SECONDS: f64 = 0.2;

fn main() {
    let clock = Instant::now();
    for work in (0..KINDS).filter_map(Work::prepare) {
        let (mut best, mut done) = (f64::INFINITY, 1.0);
        for _ in 0..MEASUREMENTS {
            let (start, mut count, mut spent) = (seconds(clock), 0.0, 0.0);
            while spent < LEAST_SECONDS {
                count += f64::from(work.run());
                spent = seconds(clock) - start;
            }
            if spent / count < best / done {
                (best, done) = (spent, count);
            }
        }
        println!("{best}\t{done}\t{}", work.name());
    }
}

/// Processor seconds of this thread where Linux tells them, so that a busy machine measures the same; else of the clock.
fn seconds(clock: Instant) -> f64 {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| clock.elapsed().as_secs_f64(), |ns| ns * 1e-9)
}
