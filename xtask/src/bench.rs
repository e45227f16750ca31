//! Benchmarks: our own, then whatever they are set beside.

use crate::shell;
use anyhow::Result;

/// Runs the benchmarks (those whose name matches, if names are given), then the comparisons.
pub fn run(names: &[String]) -> Result<()> {
    let mut args = vec!["bench".to_string(), "--package".into(), "stepover".into()];
    if !names.is_empty() {
        args.push("--".into());
        args.extend_from_slice(names);
    }
    shell::cargo(args).run()?;
    PEERS.iter().try_for_each(|peer| peer())
}

/// Other programs on the same task. Each prints its figures and installs nothing.
const PEERS: [fn() -> Result<()>; 0] = [];
