//! Proving a program that someone else may have written.

use super::error::JobError;
use super::report::Verified;
use super::spec::Spec;
use crate::monitor::Stage;
use crate::post;
use crate::verify::{self, Options};

/// What the program `apt` (APT cutter-location text, with its own cutter) leaves of the shape of `spec`; of the rest of
/// the specification only the scallop height and the sampling count. Nothing is left out as unreachable.
pub fn verify_text(
    apt: &str,
    spec: &Spec,
    bytes: Option<&[u8]>,
    stage: &Stage,
) -> Result<Verified, JobError> {
    let program = post::apt::read(apt).map_err(|e| JobError::Post(e.to_string()))?;
    let (shape, _) = spec.source.shape(bytes)?;
    let samples = shape.samples(spec.verify.spacing_mm)?;
    let options = Options::for_height(spec.tolerance.scallop_mm, &program.cutter);
    let cut = verify::verify(&program.cutter, &program.toolpath, &samples, &options, stage)?;
    Ok(Verified::from(&cut.statistics))
}
