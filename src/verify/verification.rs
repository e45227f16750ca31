//! The whole judgement of one path on one surface.

use super::body::Body;
use super::bound::Sense;
use super::cut::Scene;
use super::entry::Line;
use super::refine::{Field, Search, Searched, is_judged};
use super::samples::{Sample, Samples};
use super::statistics::{Extreme, Histogram, Statistics, quantiles};
use crate::cutter::Cutter;
use crate::geometry::Zone;
use crate::monitor::{Cancelled, Stage};
use crate::toolpath::Toolpath;

/// What is asked of a verification. Lengths in millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options<'a> {
    /// The excess that is allowed: above 0.
    pub height: f64,
    /// How far above the surface the cutter is looked for, at least `height`; what it leaves higher is called uncut.
    pub search: f64,
    /// How far below the surface there is material. A gouge is found down to here; where the part is thinner, a cutter
    /// behind it would be taken for one.
    pub depth: f64,
    /// How far the shank goes up above the cutter's height.
    pub shank: f64,
    /// The sampling error to reach for the extremes, above 0.
    pub sampling_tolerance: f64,
    /// Samples that may be added to reach it, for either extreme. With 0 the errors are not looked into, only bounded in haste.
    pub most_refined: usize,
    /// A part of the surface that the path is not asked to cut: there only gouges are looked for, and kept apart.
    pub excluded: Option<&'a Zone>,
}

impl Options<'_> {
    /// For the allowed excess `height` and `cutter`: looked for up to five times the height and down to the cutter's
    /// largest radius, a 200 mm shank, a sampling error of a tenth of the height with up to 50,000 samples more for either extreme.
    pub fn for_height(height: f64, cutter: &Cutter) -> Self {
        Self {
            height,
            search: 5.0 * height,
            depth: cutter.largest_radius(),
            shank: 200.0,
            sampling_tolerance: height / 10.0,
            most_refined: 50_000,
            excluded: None,
        }
    }

    pub(super) fn check(&self) -> Result<(), VerifyError> {
        let positive = |x: f64| x > 0.0 && x.is_finite();
        let wrong = |field, message| Err(VerifyError::Option { field, message });
        if !positive(self.height) {
            wrong("height", "must be above 0 mm")
        } else if !(self.search >= self.height && self.search.is_finite()) {
            wrong("search", "must be at least the height")
        } else if !(self.depth >= 0.0 && self.depth.is_finite()) {
            wrong("depth", "must be 0 mm or more")
        } else if !(self.shank >= 0.0 && self.shank.is_finite()) {
            wrong("shank", "must be 0 mm or more")
        } else if !positive(self.sampling_tolerance) {
            wrong("sampling_tolerance", "must be above 0 mm")
        } else {
            Ok(())
        }
    }
}

/// Why a path cannot be judged.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum VerifyError {
    /// The verification was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// An option is out of range.
    #[error("{field}: {message}")]
    Option {
        /// The option.
        field: &'static str,
        /// What would be right.
        message: &'static str,
    },
    /// A move is no motion.
    #[error("move {index}: {message}")]
    Move {
        /// The move, counted from 0.
        index: usize,
        /// What would be right.
        message: &'static str,
    },
}

/// A sample added between the given ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Refined {
    /// Where.
    pub sample: Sample,
    /// Excess there, infinite where uncut.
    pub excess: f64,
}

/// What a path leaves.
#[derive(Debug, Clone, PartialEq)]
pub struct Verification {
    /// Excess of each sample, millimetres, in their order: negative for a gouge (minus the depth searched if deeper),
    /// infinite where nothing came within the search height, or, where excluded, below the surface.
    pub excess: Vec<f64>,
    /// Samples added where the extremes might have hidden.
    pub refined: Vec<Refined>,
    /// The excess in numbers.
    pub statistics: Statistics,
}

/// What `path` run by `cutter` leaves of the surface that `samples` stand for. Every move cuts, links and rapid moves
/// too; the first one stands at its end. The result is the same for any number of workers.
///
/// Errors: an option out of range; a move that is not finite, whose axis is not of unit length or turns by more than
/// 150° at once; cancelled.
pub fn verify(
    cutter: &Cutter,
    path: &Toolpath,
    samples: &Samples,
    options: &Options,
    stage: &Stage,
) -> Result<Verification, VerifyError> {
    options.check()?;
    check_path(path)?;
    let scene = Scene::new(Body::new(cutter, options.shank), path, -options.depth, options.search);
    let count = samples.samples.len();
    let judged: Vec<bool> = samples.samples.iter().map(|s| is_judged(s, options.excluded)).collect();
    // What the path is not asked to cut may still be gouged.
    let line = |i: usize| {
        let line = scene.line(&samples.samples[i]);
        Line { to: if judged[i] { line.to } else { 0.0 }, ..line }
    };
    let hits = scene.cut(count, line, &stage.part("cutting samples", 0.0, 0.7))?;
    let excess: Vec<f64> = hits.iter().map(|hit| hit.t).collect();

    let mut field = Field::new(samples, hits, judged.clone(), options.excluded);
    let search = Search { tolerance: options.sampling_tolerance, most: options.most_refined };
    let max =
        field.search(Sense::Excess, &scene, search, &stage.part("looking between the samples", 0.7, 0.9))?;
    let min =
        field.search(Sense::Gouge, &scene, search, &stage.part("looking between the samples", 0.9, 1.0))?;

    let statistics = summarise(samples, &excess, &judged, &field, [max, min], options.height);
    let refined =
        (count..field.samples.len()).map(|i| Refined { sample: field.samples[i], excess: field.hits[i].t });
    Ok(Verification { refined: refined.collect(), excess, statistics })
}

pub(super) fn check_path(path: &Toolpath) -> Result<(), VerifyError> {
    let wrong = |index, message| Err(VerifyError::Move { index, message });
    for (index, step) in path.moves.iter().enumerate() {
        let axis = step.to.axis;
        if !(step.to.tip.is_finite() && axis.is_finite()) {
            return wrong(index, "every coordinate must be finite");
        }
        if (axis.length() - 1.0).abs() > 1e-6 {
            return wrong(index, "the axis must have length 1");
        }
        // Halfway through a half turn a linear axis has no direction.
        if index > 0 && axis.dot(path.moves[index - 1].to.axis) < libm::cos(150.0_f64.to_radians()) {
            return wrong(index, "the axis must turn by less than 150° in a move: split it");
        }
    }
    Ok(())
}

fn summarise(
    samples: &Samples,
    excess: &[f64],
    judged: &[bool],
    field: &Field,
    [max, min]: [Searched; 2],
    height: f64,
) -> Statistics {
    let mut weighted: Vec<(f64, f64)> = Vec::with_capacity(excess.len());
    let mut excluded_area = 0.0;
    let mut excluded_gouge: Option<Extreme> = None;
    for (((t, weight), judged), sample) in excess.iter().zip(&samples.areas).zip(judged).zip(&samples.samples)
    {
        if *judged {
            weighted.push((*t, *weight));
            continue;
        }
        excluded_area += weight;
        if *t < excluded_gouge.map_or(0.0, |deepest| deepest.excess) {
            excluded_gouge = Some(Extreme { excess: *t, point: sample.point });
        }
    }
    let area: f64 = weighted.iter().map(|(_, w)| w).sum();
    // A sum over nothing is −0 unless it starts from 0.
    let sum_where = |test: &dyn Fn(f64) -> bool| {
        weighted.iter().filter(|(t, _)| test(*t)).fold(0.0, |sum, (_, weight)| sum + weight)
    };
    let uncut_area = sum_where(&|t| t.is_infinite());
    let within = sum_where(&|t| t <= height);
    let [median, q95, q99] = quantiles(&mut weighted, [0.5, 0.95, 0.99]);
    let extreme = |found: Searched| {
        found.best.map(|(_, i)| Extreme { excess: field.hits[i].t, point: field.samples[i].point })
    };
    Statistics {
        count: weighted.len(),
        refined: field.samples.len() - excess.len(),
        area,
        excluded_area,
        uncut_area,
        max: extreme(max),
        min: extreme(min),
        excluded_gouge,
        excess_error: max.error,
        gouge_error: min.error,
        median,
        q95,
        q99,
        share_within: if area > 0.0 { within / area } else { 0.0 },
        histogram: Histogram::new(&weighted, extreme(min), extreme(max), height),
    }
}
