//! When a program cuts what, and its path as a drawing.

use crate::job::Spec;
use crate::job::error::JobError;
use crate::monitor::Stage;
use crate::post;
use crate::verify::{Options, removal};

/// What a program cuts, move by move: lists of the same length, in the order of the moves.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Removed {
    /// The move, counted from 0.
    pub steps: Vec<u32>,
    /// The vertex of the picture that comes with the proof.
    pub vertices: Vec<u32>,
    /// What is left there from then on, mm.
    pub excess: Vec<f32>,
}

fn read(apt: &str) -> Result<post::Program, JobError> {
    post::apt::read(apt).map_err(|e| JobError::Post(e.to_string()))
}

/// When the program `apt` cuts which vertex of the picture of `spec` down to what; `bytes` is the content of its file.
pub fn removed(spec: &Spec, bytes: Option<&[u8]>, apt: &str, stage: &Stage) -> Result<Removed, JobError> {
    let program = read(apt)?;
    let (shape, _) = spec.source.shape(bytes)?;
    let samples = shape.picture_samples()?;
    let options =
        Options { most_refined: 0, ..Options::for_height(spec.tolerance.scallop_mm, &program.cutter) };
    let mut removed = Removed::default();
    for one in removal(&program.cutter, &program.toolpath, &samples, &options, stage)? {
        removed.steps.push(one.step);
        removed.vertices.push(one.sample);
        removed.excess.push(one.excess as f32);
    }
    Ok(removed)
}

/// The path of the program `apt` as an SVG picture, seen against the mean of its axes.
pub fn drawing(apt: &str) -> Result<String, JobError> {
    Ok(post::svg::write(&read(apt)?.toolpath))
}
