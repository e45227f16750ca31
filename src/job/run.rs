//! From a specification to a program that was proven.

use super::error::JobError;
use super::picture::Picture;
use super::report::{Lengths, Report, Unreachable, Verified, minutes};
use super::shape::Shape;
use super::spec::{AlongSpec, Spec, StrategySpec, VERSION};
use super::tool::posture;
use crate::contact::FaceObstacle;
use crate::cutter::Cutter;
use crate::geometry::{Along, Face, Zone};
use crate::monitor::Stage;
use crate::post::{self, Program};
use crate::strategy::{self, Linked, Planned, Refuge};
use crate::toolpath::Toolpath;
use crate::verify::{self, Options};
use glam::DVec3;

/// A job's result.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// In numbers.
    pub report: Report,
    /// The program as APT cutter-location text.
    pub apt: String,
    /// The program as G-code, for a three-axis path.
    pub nc: Option<String>,
    /// The path as a table.
    pub csv: String,
    /// The motion as it was emitted, with the touching points.
    pub linked: Linked,
    /// What the cutter cannot reach.
    pub unreached: Zone,
    /// The shape with its excess, to draw.
    pub picture: Picture,
}

/// Plans, writes, reads back and proves the job of `spec`; `bytes` is the content of its file, if its source is one.
///
/// The same specification and bytes give the same outcome on every target and for any number of workers.
pub fn run(spec: &Spec, bytes: Option<&[u8]>, stage: &Stage) -> Result<Outcome, JobError> {
    stage.part("Reading the shape", 0.0, 0.02).at(0.0)?;
    let cutter = spec.cutter.cutter()?;
    let (shape, mut warnings) = spec.source.shape(bytes)?;
    let planning = stage.part("Planning", 0.02, 0.7);
    let (planned, linked) = match &shape {
        Shape::Face(face) => on_face(spec, face, &cutter, &planning)?,
        Shape::Mesh(_) => return Err(JobError::Strategy("meshes come next".into())),
    };
    let program = Program {
        part: spec.name.clone(),
        unit: post::Unit::Mm,
        cutter,
        tool: 1,
        spindle_rpm: Some(spec.feeds.spindle_rpm),
        toolpath: linked.toolpath.clone(),
    };
    stage.part("Writing the program", 0.7, 0.72).at(0.0)?;
    let apt = post::apt::write(&program);
    let emitted =
        post::apt::read(&apt).map_err(|e| JobError::Post(format!("the program does not read back: {e}")))?;
    let nc = post::gcode::write(&program).ok();
    let csv = post::csv::write(&emitted.toolpath);
    let proof =
        prove(spec, &shape, &emitted, &planned.unreached, &stage.part("Cutting in simulation", 0.72, 1.0))?;
    if planned.unreached.area() > 0.0 {
        warnings.push(format!(
            "the cutter cannot reach {:.2} mm² in this posture; a smaller cutter or another lead may",
            planned.unreached.area()
        ));
    }
    let report = Report {
        version: VERSION,
        name: spec.name.clone(),
        strategy: spec.strategy.kind().into(),
        scallop_mm: spec.tolerance.scallop_mm,
        length: Lengths::of(&emitted.toolpath),
        passes: planned.passes.len(),
        points: emitted.toolpath.moves.len(),
        time_min: minutes(&emitted, spec.feeds.rapid_mm_per_min),
        area_mm2: proof.area,
        unreachable: Unreachable { area_mm2: planned.unreached.area(), cell_mm: planned.unreached.cell() },
        verified: proof.verified,
        warnings,
    };
    stage.at(1.0)?;
    Ok(Outcome { report, apt, nc, csv, linked, unreached: planned.unreached, picture: proof.picture })
}

fn on_face(spec: &Spec, face: &Face, cutter: &Cutter, stage: &Stage) -> Result<(Planned, Linked), JobError> {
    let finish = spec.finish()?;
    let planned = match spec.strategy {
        StrategySpec::IsoParametric { along, lead_deg, yaw_deg, order } => {
            let along = match along {
                AlongSpec::U => Along::U,
                AlongSpec::V => Along::V,
            };
            let posture = posture(lead_deg, yaw_deg);
            strategy::iso_parametric(face, cutter, along, posture, finish, order.into(), stage)?
        }
        StrategySpec::IsoPlanar { angle_deg, lead_deg, yaw_deg, order } => {
            let (angle, posture) = (angle_deg.to_radians(), posture(lead_deg, yaw_deg));
            strategy::iso_planar(face, cutter, angle, posture, finish, order.into(), stage)?
        }
        StrategySpec::Raster { .. } => {
            return Err(JobError::field(
                "strategy.kind",
                "raster is for meshes; this shape is a surface".into(),
            ));
        }
    };
    let how = spec.linking();
    // Links may not touch at all, so samples need only be dense against the lift.
    let obstacle = FaceObstacle::new(face, (0.5 * how.lift).clamp(0.2, 1.0));
    let bounds = obstacle.bounds();
    let refuge = Refuge::around(bounds, cutter, how.clearance);
    let is_clear = |cl: &_| obstacle.depth(cutter, cl, DVec3::INFINITY) >= 0.0;
    let linked = strategy::link(&planned.passes, &how, &refuge, &is_clear);
    Ok((planned, linked))
}

/// What the simulation gives.
struct Proof {
    area: f64,
    verified: Option<Verified>,
    picture: Picture,
}

/// Cuts the shape with the motion that was read back from the text.
fn prove(
    spec: &Spec,
    shape: &Shape,
    emitted: &Program,
    unreached: &Zone,
    stage: &Stage,
) -> Result<Proof, JobError> {
    let picture = shape.picture_samples()?;
    if !spec.verify.enabled {
        return Ok(Proof { area: picture.area(), verified: None, picture: Picture::new(&picture, &[]) });
    }
    let samples = shape.samples(spec.verify.spacing_mm)?;
    let excluded = (!unreached.is_empty()).then_some(unreached);
    let options = Options { excluded, ..Options::for_height(spec.tolerance.scallop_mm, &emitted.cutter) };
    let cut = |samples, options: &Options, stage: &Stage| {
        verify::verify(&emitted.cutter, &emitted.toolpath, samples, options, stage).map_err(|e| match e {
            verify::VerifyError::Cancelled(cancelled) => JobError::Cancelled(cancelled),
            other => JobError::Post(format!("the program cannot be proven: {other}")),
        })
    };
    let proof = cut(&samples, &options, &stage.part("Cutting in simulation", 0.0, 0.85))?;
    let drawn = Options { most_refined: 0, ..options };
    let shown = cut(&picture, &drawn, &stage.part("Drawing what is left", 0.85, 1.0))?;
    Ok(Proof {
        area: samples.area(),
        verified: Some(Verified::from(&proof.statistics)),
        picture: Picture::new(&picture, &shown.excess),
    })
}

/// The shape of `spec` to draw before anything is planned.
pub fn preview(spec: &Spec, bytes: Option<&[u8]>) -> Result<Picture, JobError> {
    let (shape, _) = spec.source.shape(bytes)?;
    Ok(Picture::new(&shape.picture_samples()?, &[]))
}

impl StrategySpec {
    /// The value of its `kind`.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::IsoParametric { .. } => "iso_parametric",
            Self::IsoPlanar { .. } => "iso_planar",
            Self::Raster { .. } => "raster",
        }
    }
}

/// The motion and cutter of an APT text.
pub fn read_program(apt: &str) -> Result<(Cutter, Toolpath), JobError> {
    let program = post::apt::read(apt).map_err(|e| JobError::Post(e.to_string()))?;
    Ok((program.cutter, program.toolpath))
}
