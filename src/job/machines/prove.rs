//! What a program cuts beside what its cutter locations cut.

use super::post::Posted;
use crate::job::error::JobError;
use crate::job::report::Verified;
use crate::job::spec::Spec;
use crate::monitor::Stage;
use crate::toolpath::Toolpath;
use crate::verify::{self, Options, Samples, Verification};

/// The shape of a job cut twice: as the cutter locations say, and as the program's text says.
#[derive(Debug, Clone, PartialEq)]
pub struct Kept {
    /// What the cutter locations leave.
    pub planned: Verified,
    /// What the program leaves.
    pub posted: Verified,
    /// The largest difference between both at any sample, mm.
    pub largest_change: f64,
    /// How much the tolerances of the program allow, mm.
    pub allowed: f64,
    /// Samples.
    pub samples: usize,
}

/// What rounding does to excess besides the tolerances, mm: a tip of four decimals, and samples that see it.
const ROUNDING: f64 = 1e-4;

/// Cuts the shape of `spec` with what the program's text states, and with the cutter locations that it was made of, at the same samples.
///
/// Extremes between samples are not looked for: both would find their own. Nothing is left out as unreachable.
pub fn prove(posted: &Posted, spec: &Spec, bytes: Option<&[u8]>, stage: &Stage) -> Result<Kept, JobError> {
    stage.part("Reading the shape", 0.0, 0.05).at(0.0)?;
    let (shape, _) = spec.source.shape(bytes)?;
    let samples = shape.samples(spec.verify.spacing_mm)?;
    let cutter = &posted.read.cutter;
    let options = Options { most_refined: 0, ..Options::for_height(spec.tolerance.scallop_mm, cutter) };
    let cut = |path: &Toolpath, samples: &Samples, stage: &Stage| -> Result<Verification, JobError> {
        Ok(verify::verify(cutter, path, samples, &options, stage)?)
    };
    let planned = cut(&posted.planned.toolpath, &samples, &stage.part("Cutting as planned", 0.05, 0.5))?;
    let read = cut(&posted.read.toolpath, &samples, &stage.part("Cutting as posted", 0.5, 1.0))?;
    // What is uncut in both is infinite in both.
    let change = |(a, b): (&f64, &f64)| if a == b { 0.0 } else { (a - b).abs() };
    Ok(Kept {
        largest_change: planned.excess.iter().zip(&read.excess).map(change).fold(0.0, f64::max),
        // The axis swings about the tip, and the contact is no farther from there than the corner's outer end.
        allowed: posted.tolerance.chord
            + posted.tolerance.axis * (cutter.largest_radius() + cutter.corner_radius)
            + ROUNDING,
        samples: planned.excess.len(),
        planned: Verified::from(&planned.statistics),
        posted: Verified::from(&read.statistics),
    })
}
