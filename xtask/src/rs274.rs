//! LinuxCNC's own interpreter, which must accept its programs and go where they say.

use crate::canonical;
use crate::shell::{self, Outcome};
use anyhow::{Context, Result};
use std::fs;
use std::path::{Path, PathBuf};

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

/// How each lathe job's program is written once more.
const FEEDS: [&str; 2] = ["inverse_time", "per_minute"];

/// A piece of a sphere, over which the tool leans to all sides and passes the pole, and a flat part for an upright tool.
const PARTS: [(&str, &str); 2] = [
    (
        "sphere",
        r#"{"source": {"kind": "sphere", "radius_mm": 40, "angle_deg": [50, 50]},
            "cutter": {"kind": "bull_nose", "diameter_mm": 10, "corner_radius_mm": 2, "height_mm": 40},
            "strategy": {"kind": "iso_planar", "angle_deg": 20, "lead_deg": 8},
            "tolerance": {"scallop_mm": 0.03}, "verify": {"enabled": false}}"#,
    ),
    (
        "flat",
        r#"{"source": {"kind": "plane", "size_mm": [40, 30]},
            "cutter": {"kind": "bull_nose", "diameter_mm": 10, "corner_radius_mm": 2, "height_mm": 40},
            "strategy": {"kind": "iso_planar", "angle_deg": 20, "lead_deg": 0},
            "tolerance": {"scallop_mm": 0.03}, "verify": {"enabled": false}}"#,
    ),
];

/// Plans the paper's lens for a ball and for an insert, with either kind of feed, and a part for every machine that is shipped, and has
/// each program read.
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
    let machines = shell::root().join("examples/machines");
    for (part, spec) in PARTS {
        let apt = planned(&folder, part, spec)?;
        let files: Vec<_> = fs::read_dir(&machines)?.collect::<Result<_, _>>()?;
        let mut files: Vec<PathBuf> = files.iter().map(fs::DirEntry::path).collect();
        files.retain(|file| file.extension().is_some_and(|end| end == "json"));
        files.sort();
        for machine in files {
            // A mill with three axes takes what is flat, and a lathe nothing that is milled.
            let is_for_others =
                machine.ends_with("lathe_xzc.json") || part != "flat" && machine.ends_with("three_axis.json");
            if is_for_others {
                continue;
            }
            if runs(&folder, &apt, &machine)? {
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

fn stepover(args: &[&str]) -> Result<()> {
    let command = shell::target().join("debug").join(format!("stepover{}", std::env::consts::EXE_SUFFIX));
    shell::call(&command.display().to_string(), args).capture().map(drop)
}

/// The cutter locations of a part.
fn planned(folder: &Path, part: &str, spec: &str) -> Result<PathBuf> {
    let out = folder.join(part);
    fs::create_dir_all(&out)?;
    let file = out.join("spec.json");
    fs::write(&file, spec)?;
    stepover(&["plan", &file.display().to_string(), "--out", &out.display().to_string()])?;
    Ok(out.join("path.apt"))
}

/// Whether the interpreter goes where the program for `machine` says, in the time that it says.
fn runs(folder: &Path, apt: &Path, machine: &Path) -> Result<bool> {
    let name = machine.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let program = folder.join(format!("{name}.ngc"));
    let [apt, machine, out] = [apt, machine, &program].map(|path| path.display().to_string());
    stepover(&["post", &apt, "--machine", &machine, "--dialect", "linuxcnc", "--out", &out])?;
    let compared = shell::call(NAME, ["-g", &out])
        .capture()
        .and_then(|printed| canonical::compare(&fs::read_to_string(&program)?, &printed));
    match compared {
        Ok(moves) => println!("{name}: {moves} moves as stated"),
        Err(error) => {
            println!("{name}: {error:#}");
            return Ok(false);
        }
    }
    Ok(true)
}

/// Whether the interpreter reads the program to its end, with a move for each of its blocks.
fn accepted(out: &Path, tool: &str, feed: &str) -> Result<bool> {
    fs::create_dir_all(out)?;
    let spec = out.join("spec.json");
    let text = format!(
        r#"{{"tool": {{"kind": "{tool}"}}, "output": {{"feed": "{feed}"}}, "verify": {{"enabled": false}}}}"#
    );
    fs::write(&spec, text)?;
    stepover(&["turn", &spec.display().to_string(), "--out", &out.display().to_string()])?;
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
