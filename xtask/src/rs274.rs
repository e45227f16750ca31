//! LinuxCNC's own interpreter, which must accept the G-code of lathes.

use crate::shell::{self, Outcome};
use anyhow::{Context, Result};
use std::fs;
use std::path::Path;

/// The suite cannot run on this machine, for a reason that is not its own.
#[derive(Debug)]
pub struct Skipped(pub &'static str);

impl std::fmt::Display for Skipped {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "skipped: {}", self.0)
    }
}

impl std::error::Error for Skipped {}

const NAME: &str = "rs274";

/// How each job's program is written once more.
const FEEDS: [&str; 2] = ["inverse_time", "per_minute"];

/// Plans the paper's lens for a ball and for an insert, with either kind of feed, and has each program read.
///
/// Nothing is installed for it: Debian's `linuxcnc-uspace` holds the interpreter, and without it the suite is skipped.
pub fn run() -> Result<Outcome> {
    if shell::call(NAME, ["-?"]).capture().is_err_and(|e| format!("{e:#}").contains("could not start")) {
        return Err(Skipped("rs274 is not there; Debian's package linuxcnc-uspace has it").into());
    }
    let built = shell::cargo(["build", "--package", "stepover", "--bin", "stepover", "--quiet"]).tee()?;
    if !built.success {
        return Ok(built);
    }
    let folder = shell::target().join(NAME);
    fs::create_dir_all(&folder)?;
    let (mut passed, mut failed) = (0, 0);
    for tool in ["ball", "insert"] {
        for feed in FEEDS {
            let out = folder.join(format!("{tool}_{feed}"));
            if accepted(&out, tool, feed)? {
                passed += 1;
            } else {
                failed += 1;
            }
        }
    }
    let output = format!(
        "test result: {}. {passed} passed; {failed} failed",
        if failed == 0 { "ok" } else { "FAILED" }
    );
    println!("{output}");
    Ok(Outcome { success: failed == 0, output })
}

/// Whether the interpreter reads the program to its end, with a move for each of its blocks.
fn accepted(out: &Path, tool: &str, feed: &str) -> Result<bool> {
    fs::create_dir_all(out)?;
    let spec = out.join("spec.json");
    let text = format!(
        r#"{{"tool": {{"kind": "{tool}"}}, "output": {{"feed": "{feed}"}}, "verify": {{"enabled": false}}}}"#
    );
    fs::write(&spec, text)?;
    let command = shell::target().join("debug").join(format!("stepover{}", std::env::consts::EXE_SUFFIX));
    let (spec, folder) = (spec.display().to_string(), out.display().to_string());
    shell::call(&command.display().to_string(), ["turn", &spec, "--out", &folder]).run()?;
    let program = out.join("path.nc");
    let written = fs::read_to_string(&program).with_context(|| program.display().to_string())?;
    let blocks = written.lines().filter(|line| line.starts_with("G1 ")).count();
    let read = match shell::call(NAME, ["-g", &program.display().to_string()]).capture() {
        Ok(read) => read,
        Err(error) => {
            println!("{error:#}");
            return Ok(false);
        }
    };
    let moves = read.lines().filter(|line| line.contains("STRAIGHT_FEED(")).count();
    let ends = read.contains("PROGRAM_END()");
    println!(
        "{tool}, {feed}: {moves} moves of {blocks} blocks, {}",
        if ends { "to the end" } else { "broken off" }
    );
    Ok(ends && moves == blocks)
}
