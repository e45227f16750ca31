//! From a turning specification to a program that was proven.

use super::report::{TurnedReport, TurningReport};
use super::spec::{BodySpec, DialectSpec, StepSpec, ToolSpec, TurningSpec};
use super::warnings::warnings;
use crate::job::error::JobError;
use crate::monitor::Stage;
use crate::post::xzc::{self, Dialect, XzcProgram};
use crate::post::{self, ReadError};
use crate::toolpath::{Interpolation, Nose, TurningPath};
use crate::turning::{self, Order, Placed, Planned, TurningError};
use crate::verify::{Surface, TurnedError, TurnedOptions, TurnedPart, TurnedProof, verify_turned};
use std::f64::consts::TAU;

/// A planned path and the program that states it, not yet proven.
pub struct TurningPlan {
    pub(super) spec: TurningSpec,
    pub(super) order: Order,
    pub(super) planned: Planned,
    pub(super) warnings: Vec<String>,
    /// The program as the machine runs it: G-code, or blocks of position, velocity and time.
    pub program: String,
    /// The motion as its own text states it.
    pub emitted: TurningPath,
    /// What cuts, as the text states it.
    pub nose: Nose,
}

/// What the simulation gives.
#[derive(Debug, Clone)]
pub struct TurningProof {
    /// In numbers.
    pub verified: TurnedReport,
    /// Residues on rays from the axis.
    pub map: TurnedProof,
}

/// The motion and the nose of a program: G-code or blocks of position, velocity and time, told apart by their first line.
/// `spec` says whose G-code.
pub fn read_program(text: &str, spec: &TurningSpec) -> Result<(Nose, TurningPath), JobError> {
    let read =
        if text.starts_with(';') { xzc::read_pvt(text) } else { xzc::read_gcode(text, spec.dialect()) };
    read.map_err(|e: ReadError| JobError::Post(e.to_string()))
}

/// Plans the job of `spec` and writes its program; `bytes` is the content of its surface's file, if it is in one.
///
/// The same specification and bytes give the same program on every target.
pub fn plan(spec: &TurningSpec, bytes: Option<&[u8]>, stage: &Stage) -> Result<TurningPlan, JobError> {
    let order = spec.order(bytes)?;
    let planned = turning::plan(&order, &stage.part("Planning", 0.0, 0.7)).map_err(|e| refused(spec, e))?;
    stage.part("Writing the program", 0.7, 1.0).at(0.0)?;
    let program = spec.program(order.tool.nose(), planned.path.clone());
    let (_, _, _, feed) = spec.words();
    let rounding = spec.rounding();
    let text = match order.interpolation {
        Interpolation::Linear => xzc::write_gcode(&program, spec.dialect(), feed, &rounding),
        Interpolation::Pvt => xzc::write_pvt(&program, &rounding),
    }
    .map_err(|e| JobError::Post(e.to_string()))?;
    let (nose, emitted) = read_program(&text, spec)?;
    let warnings = warnings(spec, &order, &planned, &emitted);
    stage.at(1.0)?;
    Ok(TurningPlan { spec: spec.clone(), order, planned, warnings, program: text, emitted, nose })
}

/// Names the setting that an error is about.
fn refused(spec: &TurningSpec, error: TurningError) -> JobError {
    let field = match &error {
        TurningError::Cancelled(cancelled) => return JobError::Cancelled(*cancelled),
        TurningError::Reach { .. } => "aperture",
        TurningError::Hollow { .. } | TurningError::NoTouch { .. } => "tool.radius_mm",
        TurningError::Sweep { .. } => "tool.sweep_deg",
        TurningError::Clearance { .. } => "tool.clearance_deg",
        TurningError::Rake { .. } => "tool.rake_deg",
        TurningError::Chord { .. } => spec.spacing_field(),
        TurningError::Limit { .. } => "speed",
        TurningError::TooSlow { .. } => "speed.least_rpm",
        TurningError::TooMany { .. } => "guide.step_mm",
    };
    JobError::field(field, error.to_string())
}

/// Of what interpolation may be off, the control gets this part for rounding the corners between chords.
const BLENDED: f64 = 10.0;

impl TurningSpec {
    pub(super) fn dialect(&self) -> Dialect {
        match self.output.dialect {
            DialectSpec::Linuxcnc => Dialect::LinuxCnc,
            DialectSpec::Fanuc => Dialect::Fanuc,
        }
    }

    /// The setting that says how far points are apart.
    fn spacing_field(&self) -> &'static str {
        match self.points {
            super::spec::PointsSpec::Angle { spacing: StepSpec::Given, .. } => "points.angle_deg",
            super::spec::PointsSpec::Arc { spacing: StepSpec::Given, .. }
            | super::spec::PointsSpec::Hybrid { spacing: StepSpec::Given, .. } => "points.arc_mm",
            _ => "tolerance.chord_mm",
        }
    }

    fn program(&self, nose: Nose, path: TurningPath) -> XzcProgram {
        let (reference, x_word, c_word, _) = self.words();
        let spindle_rpm = match self.tool {
            ToolSpec::Ball { spindle_rpm, .. } => Some(spindle_rpm),
            ToolSpec::Insert { .. } => None,
        };
        XzcProgram {
            part: self.name.clone(),
            nose,
            reference,
            x_word,
            c_word,
            tool: self.output.tool_number as u32,
            spindle_rpm,
            clearance: self.output.clearance_mm,
            approach: self.output.approach_mm_per_min,
            blend: self.tolerance.chord_mm / BLENDED,
            path,
        }
    }
}

impl TurningPlan {
    /// `nc` for G-code, `pvt` for blocks of position, velocity and time.
    pub fn extension(&self) -> &'static str {
        match self.emitted.interpolation {
            Interpolation::Linear => "nc",
            Interpolation::Pvt => "pvt",
        }
    }

    /// The motion as a table.
    pub fn csv(&self) -> String {
        xzc::write_table(&self.planned.path, &self.spec.rounding())
    }

    /// The motion as APT cutter-location text.
    pub fn apt(&self) -> Result<String, JobError> {
        let program = self.spec.program(self.order.tool.nose(), self.planned.path.clone());
        let program = xzc::apt_program(&program).map_err(|e| JobError::Post(e.to_string()))?;
        Ok(post::apt::write(&program))
    }

    /// Cuts the part with the motion that was read back from the text; `None` if the specification does not ask for it.
    pub fn prove(&self, stage: &Stage) -> Result<Option<TurningProof>, JobError> {
        if !self.spec.verify.enabled {
            return Ok(None);
        }
        prove(&self.spec, &self.order.part, self.nose, &self.emitted, stage).map(Some)
    }

    /// The plan in numbers, with those of `proof` if there is one.
    pub fn report(&self, proof: Option<&TurningProof>) -> TurningReport {
        TurningReport::new(self, proof)
    }
}

/// What the program `text` leaves of the part of `spec`; of the rest of the specification only the aperture and how the
/// proof is made. `bytes` is the content of its surface's file, if it is in one.
pub fn verify_text(
    text: &str,
    spec: &TurningSpec,
    bytes: Option<&[u8]>,
    stage: &Stage,
) -> Result<TurningProof, JobError> {
    let (nose, path) = read_program(text, spec)?;
    prove(spec, &spec.part(bytes)?, nose, &path, stage)
}

fn prove(
    spec: &TurningSpec,
    part: &Placed,
    nose: Nose,
    path: &TurningPath,
    stage: &Stage,
) -> Result<TurningProof, JobError> {
    let v = spec.verify;
    let aperture = spec.aperture();
    let surface = |x: f64, y: f64| {
        aperture.contains(x, y).then(|| {
            let f = part.at(x, y);
            let w = f.stretch();
            Surface { z: f.z, normal: [-f.g[0] / w, -f.g[1] / w, 1.0 / w] }
        })
    };
    let between = turning::chord_error(part, &aperture, nose, path.interpolation, &path.points).ok();
    let nose = match v.body {
        BodySpec::Own => nose,
        BodySpec::Ball => Nose::Ball(nose.radius()),
        BodySpec::Insert => Nose::Insert(nose.radius()),
    };
    let whole = TurnedPart { surface: &surface, farthest: aperture.farthest(), meridians: spec.meridians() };
    let options = TurnedOptions {
        spacing: v.spacing_mm,
        // A millimetre, and what a small nose can reach at all.
        search: nose.radius().min(1.0),
        bands: vec![v.fine_mm, v.wide_mm],
        chord: v.sagitta_chord_mm,
    };
    let map = verify_turned(&whole, nose, path, &options, stage).map_err(|e| match e {
        TurnedError::Cancelled(cancelled) => JobError::Cancelled(cancelled),
        TurnedError::TooMany { .. } => JobError::field("verify.spacing_mm", e.to_string()),
        other => JobError::Post(format!("the program cannot be proven: {other}")),
    })?;
    Ok(TurningProof { verified: TurnedReport::new(&map, nose, between, v.sagitta_mm), map })
}

/// Revolutions a minute.
pub(super) fn rpm(omega: f64) -> f64 {
    omega * 60.0 / TAU
}
