//! `stepover plan` and `stepover verify`.

use super::progress::Terminal;
use super::{Failure, print, read, read_text, workers};
use crate::job::{self, SourceSpec, Spec};
use crate::monitor::Stage;
use clap::Args;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(super) struct Plan {
    /// The specification, JSON; a file that it names is looked for beside it.
    spec: PathBuf,
    /// The folder for the results; made if it is not there.
    #[arg(long)]
    out: PathBuf,
    /// Threads; the result does not depend on it.
    #[arg(long)]
    workers: Option<NonZeroUsize>,
}

#[derive(Debug, Args)]
pub(super) struct Verify {
    /// The program, APT cutter-location text.
    apt: PathBuf,
    /// The specification that names the shape and the scallop height.
    #[arg(long)]
    spec: PathBuf,
    /// Threads; the result does not depend on it.
    #[arg(long)]
    workers: Option<NonZeroUsize>,
}

/// The specification at `path` and the content of the file that it names, if it names one.
pub(super) fn load(path: &Path) -> Result<(Spec, Option<Vec<u8>>), Failure> {
    let spec =
        Spec::from_json(&read_text(path)?).map_err(|e| Failure::Job(format!("{}: {e}", path.display())))?;
    let bytes = match &spec.source {
        SourceSpec::File { path: file, .. } => {
            let beside = path.parent().unwrap_or(Path::new("")).join(file);
            Some(read(&beside)?)
        }
        _ => None,
    };
    Ok((spec, bytes))
}

impl Plan {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let (spec, bytes) = load(&self.spec)?;
        let terminal = Terminal::new();
        let stage = Stage::whole(&terminal, self.workers.unwrap_or_else(workers));
        let plan = job::plan(&spec, bytes.as_deref(), &stage.part("Planning", 0.0, 0.5))?;
        let proof = plan.prove(&stage.part("Proving", 0.5, 1.0))?;
        terminal.clear();
        let report = plan.report(proof.as_ref());
        let write = |name: &str, text: &str| {
            let path = self.out.join(name);
            std::fs::write(&path, text).map_err(|e| Failure::Job(format!("{}: {e}", path.display())))
        };
        std::fs::create_dir_all(&self.out)
            .map_err(|e| Failure::Job(format!("{}: {e}", self.out.display())))?;
        write("path.apt", &plan.apt)?;
        write("path.csv", &plan.csv)?;
        write("report.json", &report.to_json())?;
        if let Some(nc) = &plan.nc {
            write("path.nc", nc)?;
        }
        summary(&report)
    }
}

fn summary(report: &job::Report) -> Result<(), Failure> {
    let length = &report.length;
    print(&format!("passes       {}", report.passes))?;
    print(&format!(
        "length       {:.1} mm cut, {:.1} mm links, {:.1} mm rapid",
        length.cut_mm, length.link_mm, length.rapid_mm
    ))?;
    print(&format!("time         {:.1} min without acceleration", report.time_min))?;
    if let Some(verified) = &report.verified {
        let micrometres = |x: Option<f64>| x.map_or("unbounded".into(), |x| format!("{:.2} µm", 1e3 * x));
        print(&format!(
            "proven       excess at most {} (limit {:.2} µm), gouge {}, sampling error {}",
            micrometres(verified.largest_excess_mm),
            1e3 * report.scallop_mm,
            micrometres(verified.largest_gouge_mm),
            micrometres(verified.sampling_error_mm)
        ))?;
        print(&format!("within limit {:.3} % of the reachable area", 100.0 * verified.share_within))?;
    }
    if report.unreachable.area_mm2 > 0.0 {
        let share = 100.0 * report.unreachable.area_mm2 / report.area_mm2;
        print(&format!("unreachable  {:.2} mm² ({share:.2} %)", report.unreachable.area_mm2))?;
    }
    for warning in &report.warnings {
        print(&format!("warning      {warning}"))?;
    }
    Ok(())
}

impl Verify {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let (spec, bytes) = load(&self.spec)?;
        let terminal = Terminal::new();
        let stage = Stage::whole(&terminal, self.workers.unwrap_or_else(workers));
        let found = job::verify_text(
            &read_text(&self.apt)?,
            &spec,
            bytes.as_deref(),
            &stage.part("Proving", 0.0, 1.0),
        )?;
        terminal.clear();
        print(&found.to_json())
    }
}
