//! Benchmarks: how the parts compare in detail, then the claims, beside OpenCAMLib.

use crate::{rates, shell};
use anyhow::Result;

/// Runs the benchmarks (those whose name matches, if names are given; `rates` for the claims alone), then the claims.
pub fn run(names: &[String]) -> Result<()> {
    if names.iter().all(|name| name != "rates") {
        let mut args = vec!["bench".to_string(), "--package".into(), "stepover".into()];
        if !names.is_empty() {
            args.push("--".into());
            args.extend_from_slice(names);
        }
        shell::cargo(args).run()?;
    }
    rates::run()
}
