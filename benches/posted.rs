//! What programs of machines change of the excess that was planned, and in how many blocks: every job of the gallery on every machine
//! with five axes in every dialect, at the usual settings.
//!
//! A table and not a time. Changes are those of the largest excess and the deepest gouge, and of the excess of any one sample, as the
//! program's text is cut. Words after `--` choose rows.

use std::num::NonZeroUsize;
use stepover::job::machines::{Dialect, PostOptions, SHIPPED, machine, post, prove};
use stepover::job::{gallery, plan};
use stepover::monitor::{Silent, Stage};

#[allow(clippy::print_stdout)]
fn main() {
    let asked: Vec<String> = std::env::args().skip(1).filter(|arg| !arg.starts_with('-')).collect();
    let stage = Stage::whole(&Silent, NonZeroUsize::MIN);
    println!("| job | machine | dialect | moves | blocks | min | excess µm | gouge µm | any sample µm |");
    println!("|---|---|---|---|---|---|---|---|---|");
    for example in gallery() {
        let planned = plan(&example.spec, None, &stage).expect("a path");
        for (name, text) in SHIPPED.iter().filter(|(name, _)| *name != "three_axis") {
            let machine = machine(text).expect("a machine");
            for dialect in Dialect::ALL.into_iter().filter(|dialect| *dialect != Dialect::Grbl) {
                let row = [example.id, name, dialect.name()];
                if !asked.iter().all(|word| row.contains(&word.as_str())) {
                    continue;
                }
                let options = PostOptions::new(dialect);
                let posted = post(&planned.apt, Some(&planned.csv), &machine, &options, &stage);
                let posted = posted.expect("a program");
                let kept = prove(&posted, &example.spec, None, &stage).expect("a proof");
                let (planned, cut) = (&kept.planned, &kept.posted);
                let change =
                    |a: Option<f64>, b: Option<f64>| 1e3 * (a.unwrap_or(0.0) - b.unwrap_or(0.0)).abs();
                println!(
                    "| {} | {} | {} | {:.3} | {:.3} | {:.3} | {:.3} |",
                    row.join(" | "),
                    posted.toolpath.moves.len(),
                    posted.text.lines().count(),
                    posted.times.total() / 60.0,
                    change(planned.largest_excess_mm, cut.largest_excess_mm),
                    change(planned.largest_gouge_mm, cut.largest_gouge_mm),
                    1e3 * kept.largest_change,
                );
            }
        }
    }
}
