//! `stepover turn`.

use super::progress::Terminal;
use super::{Failure, print, read, read_text, workers};
use crate::job::JobError;
use crate::job::machines;
use crate::job::turning::{self, TurnedReport, TurningProof, TurningReport, TurningSpec};
use crate::monitor::Stage;
use clap::Args;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(super) struct Turn {
    /// The specification, JSON; a height map that it names is looked for beside it.
    spec: PathBuf,
    /// The folder for the results; made if it is not there.
    #[arg(long, required_unless_present = "verify")]
    out: Option<PathBuf>,
    /// The lathe, JSON (examples/machines/lathe_xzc.json): its speeds, accelerations and jerks are the limits, instead of those of the
    /// specification, and the path must lie within the travel of its axes.
    #[arg(long, conflicts_with = "verify")]
    machine: Option<PathBuf>,
    /// Prove this program (path.nc or path.pvt) against the part instead of planning, and print what it leaves as JSON.
    #[arg(long, conflicts_with = "out")]
    verify: Option<PathBuf>,
    /// Threads; the result does not depend on it.
    #[arg(long)]
    workers: Option<NonZeroUsize>,
}

impl Turn {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let in_file = |path: &Path, e: JobError| Failure::Job(format!("{}: {e}", path.display()));
        let spec = TurningSpec::from_json(&read_text(&self.spec)?).map_err(|e| in_file(&self.spec, e))?;
        let lathe = match &self.machine {
            Some(path) => Some((path, machines::lathe(&read_text(path)?).map_err(|e| in_file(path, e))?)),
            None => None,
        };
        let spec = lathe.iter().fold(spec, |spec, (_, lathe)| lathe.limiting(spec));
        let beside = |file| self.spec.parent().unwrap_or(Path::new("")).join(file);
        let bytes = spec.surface.file().map(|file| read(&beside(file))).transpose()?;
        let terminal = Terminal::new();
        let stage = Stage::whole(&terminal, self.workers.unwrap_or_else(workers));
        if let Some(program) = &self.verify {
            let text = read_text(program)?;
            let proof = turning::verify_text(&text, &spec, bytes.as_deref(), &stage)?;
            terminal.clear();
            return print(&proof.verified.to_json());
        }
        let plan = turning::plan(&spec, bytes.as_deref(), &stage.part("Planning", 0.0, 0.3))?;
        if let Some((path, lathe)) = &lathe {
            lathe.holds(&plan.emitted).map_err(|e| in_file(path, e))?;
        }
        let proof = plan.prove(&stage.part("Proving", 0.3, 1.0))?;
        terminal.clear();
        let report = plan.report(proof.as_ref());
        let out = self.out.as_deref().unwrap_or(Path::new("."));
        let write = |name: &str, text: &str| {
            let path = out.join(name);
            std::fs::write(&path, text).map_err(|e| Failure::Job(format!("{}: {e}", path.display())))
        };
        std::fs::create_dir_all(out).map_err(|e| Failure::Job(format!("{}: {e}", out.display())))?;
        write(&format!("path.{}", plan.extension()), &plan.program)?;
        write("path.csv", &plan.csv())?;
        write("path.apt", &plan.apt()?)?;
        write("turns.csv", &plan.turns_csv())?;
        write("report.json", &report.to_json())?;
        if let Some(proof) = &proof {
            write("residue.csv", &map(proof))?;
        }
        if let Some((_, lathe)) = &lathe {
            print(&format!("machine      {}", lathe.name()))?;
        }
        summary(&report)
    }
}

/// Residues as a table: a row a ray, of which the first cell is its angle; the first row holds the distances from the axis.
fn map(proof: &TurningProof) -> String {
    use std::fmt::Write;
    let map = &proof.map;
    let mut text = String::from("angle_deg\\radius_mm");
    for ring in 0..map.rings {
        // Writing to a string cannot fail.
        let _ = write!(text, ",{:.4}", map.radius(ring));
    }
    for (ray, row) in map.residues.chunks(map.rings).enumerate() {
        let _ = write!(text, "\n{:.4}", map.angle(ray).to_degrees());
        for residue in row {
            text.push(',');
            if residue.is_finite() {
                let _ = write!(text, "{residue:.7}");
            }
        }
    }
    text.push('\n');
    text
}

fn summary(report: &TurningReport) -> Result<(), Failure> {
    print(&format!(
        "path         {} points, {:.1} turns {:.4} mm apart, from {:.3} out to {:.3} mm",
        report.points, report.turns, report.step_mm, report.innermost_mm, report.farthest_mm
    ))?;
    print(&format!(
        "expected     cusp {:.3} µm, between points {:+.4} to {:+.4} µm ({})",
        1e3 * report.cusp.mm,
        1e3 * report.chord_dug.mm,
        1e3 * report.chord_left.mm,
        report.interpolation
    ))?;
    print(&format!("time         {:.1} min, up to {:.2} rpm", report.time_s / 60.0, report.highest_rpm))?;
    for (name, axis, unit) in [("X", &report.x, "mm"), ("Z", &report.z, "mm"), ("C", &report.c, "°")] {
        print(&format!(
            "{name}            {:.4} {unit}/s, {:.3} {unit}/s², {:.2} {unit}/s³",
            axis.velocity.value, axis.acceleration.value, axis.jerk.value
        ))?;
    }
    if let (Some(strictest), Some(reserve)) = (&report.strictest, report.reserve) {
        print(&format!("first limit  {strictest}, reached at {reserve:.3} times this speed"))?;
    }
    if let Some(verified) = &report.verified {
        proven(verified)?;
    }
    for warning in &report.warnings {
        print(&format!("warning      {warning}"))?;
    }
    Ok(())
}

fn proven(verified: &TurnedReport) -> Result<(), Failure> {
    let micrometres =
        |p: &Option<turning::Place>| p.map_or("none".into(), |p| format!("{:+.4} µm", 1e3 * p.mm));
    print(&format!(
        "proven       {} to {} cut with a{} {}, PV {:.4} µm, RMS {:.4} µm",
        micrometres(&verified.overcut),
        micrometres(&verified.residue),
        if verified.body == "insert" { "n" } else { "" },
        verified.body,
        1e3 * verified.peak_to_valley_mm,
        1e3 * verified.rms_mm
    ))?;
    if let Some((left, dug)) = verified.chord_left.zip(verified.chord_dug) {
        print(&format!("             between points {:+.4} to {:+.4} µm", 1e3 * dug.mm, 1e3 * left.mm))?;
    }
    for band in &verified.bands {
        print(&format!("             {:.3} % within ±{} mm", 100.0 * band.within, band.limit_mm))?;
    }
    if verified.uncut > 0.0 {
        print(&format!("             {:.3} % not cut", 100.0 * verified.uncut))?;
    }
    for sag in &verified.sagittas {
        print(&format!(
            "sagitta      {:.4} mm over {} mm at {:.1}° (should be {:.4})",
            sag.cut_mm, sag.chord_mm, sag.direction_deg, sag.nominal_mm
        ))?;
    }
    Ok(())
}
