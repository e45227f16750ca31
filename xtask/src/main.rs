//! `cargo xtask serve | test | build | bench`: everything a developer or CI runs.

fn main() {}
