//! The `stepover` command.

fn main() {}
