//! The command line: decodes arguments, calls [`crate::job`] and the calculators, prints. No planning lives here.

mod compare;
mod cutter;
mod drop;
mod plan;
mod post;
mod progress;
mod stepover;
mod strip;
mod turn;

use crate::job::{self, JobError};
use clap::{Parser, Subcommand};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Finishing paths for mills with a rounded corner, planned, proven by cutting them in simulation, and written as programs.
#[derive(Debug, Parser)]
#[command(name = "stepover", version, about)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Plan a job, prove it, and write path.apt, report.json, path.csv and, for three axes, path.nc.
    Plan(plan::Plan),
    /// Plan a job with every strategy that applies, prove each, and print them side by side; write compare.csv and, for each, its
    /// program and a picture of its path.
    Compare(compare::Compare),
    /// Prove an APT program against the shape of a specification and print what it leaves, as JSON.
    Verify(plan::Verify),
    /// Turn cutter locations into a program for a machine with up to five axes, and read it back.
    Post(post::Post),
    /// Plan optics on a lathe with a servo C axis (X, Z, C), prove it, and write path.nc or path.pvt, path.csv, path.apt,
    /// report.json and residue.csv; or prove a program that is there already.
    Turn(turn::Turn),
    /// Print what is inside a file: format, unit, shapes to choose from, warnings.
    Inspect {
        /// The file.
        file: PathBuf,
        /// Print JSON.
        #[arg(long)]
        json: bool,
    },
    /// Print the settings of a specification with units, ranges and defaults, as JSON.
    Schema {
        /// Those of a turning job.
        #[arg(long)]
        turning: bool,
        /// Those of a machine's program.
        #[arg(long, conflicts_with = "turning")]
        machine: bool,
    },
    /// Print the jobs of the gallery as JSON, each a specification to begin with.
    Gallery,
    /// Print the width of the strip that a cutter finishes at one contact point.
    Strip(strip::Strip),
    /// Print the stepover at a tilt and a scallop height: by the circle model, exactly, and, on request, as simulated.
    Stepover(stepover::Stepover),
    /// Print the heights at which a cutter touches a mesh from above.
    Drop(drop::Drop),
}

/// Why a command ends without success.
#[derive(Debug)]
enum Failure {
    /// The job failed.
    Job(String),
    /// The call was wrong.
    Call(String),
}

impl From<JobError> for Failure {
    fn from(error: JobError) -> Self {
        Self::Job(error.to_string())
    }
}

/// Runs the command line of this process. The exit code is 0, 1 if the job failed, or 2 if the call was wrong.
#[expect(clippy::print_stderr, reason = "a command says on the terminal why it failed")]
pub fn run() -> ExitCode {
    let result = match Arguments::parse().command {
        Command::Plan(plan) => plan.run(),
        Command::Compare(compare) => compare.run(),
        Command::Verify(verify) => verify.run(),
        Command::Inspect { file, json } => inspect(&file, json),
        Command::Post(post) => post.run(),
        Command::Turn(turn) => turn.run(),
        Command::Schema { machine: true, .. } => print(&job::machines::schema()),
        Command::Schema { turning: true, .. } => print(&job::turning::schema()),
        Command::Schema { .. } => print(&job::schema()),
        Command::Gallery => print(&job::gallery_json()),
        Command::Strip(strip) => strip.run(),
        Command::Stepover(stepover) => stepover.run(),
        Command::Drop(drop) => drop.run(),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failure::Job(why)) => {
            eprintln!("stepover: {why}");
            ExitCode::from(1)
        }
        Err(Failure::Call(why)) => {
            eprintln!("stepover: {why}");
            ExitCode::from(2)
        }
    }
}

/// Prints a line on standard output. A reader that has gone away is no failure.
fn print(text: &str) -> Result<(), Failure> {
    use std::io::Write;
    let _ = writeln!(std::io::stdout().lock(), "{text}");
    Ok(())
}

fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    std::fs::read(path).map_err(|e| Failure::Call(format!("{}: {e}", path.display())))
}

fn read_text(path: &Path) -> Result<String, Failure> {
    String::from_utf8(read(path)?).map_err(|_| Failure::Job(format!("{}: is not text", path.display())))
}

/// As many threads as the machine runs at once.
fn workers() -> NonZeroUsize {
    std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN)
}

fn inspect(file: &Path, json: bool) -> Result<(), Failure> {
    let name = file.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    let found = job::inspect(&name, &read(file)?)?;
    if json {
        return print(&found.to_json());
    }
    print(&format!("format    {}", found.format))?;
    print(&format!("unit      {}", found.unit.as_deref().unwrap_or("not stated; millimetres assumed")))?;
    for face in &found.faces {
        let [lo, hi] = face.bounds_mm;
        let size = [0, 1, 2].map(|k| hi[k] - lo[k]);
        print(&format!(
            "{:<9} {}: {}, {}",
            format!("face {}", face.index),
            face.name,
            face.kind,
            face.detail
        ))?;
        print(&format!("          {:.3} × {:.3} × {:.3} mm", size[0], size[1], size[2]))?;
        print(&format!(
            "          from {:.3}, {:.3}, {:.3} to {:.3}, {:.3}, {:.3} mm",
            lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]
        ))?;
    }
    for warning in &found.warnings {
        print(&format!("warning   {warning}"))?;
    }
    Ok(())
}
