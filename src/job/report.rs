//! A job's result in numbers, as JSON.

use crate::post::Program;
use crate::toolpath::{Rate, Role, Toolpath};
use crate::verify::{Extreme, Statistics};
use serde::{Deserialize, Serialize};

/// A job's result in numbers; units are in the names.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Version of this form, counted with the specification's.
    pub version: u32,
    /// The part's name.
    pub name: String,
    /// The strategy's kind.
    pub strategy: String,
    /// The limit asked for.
    pub scallop_mm: f64,
    /// Lengths of the tip's way.
    pub length: Lengths,
    /// Unbroken runs over the surface.
    pub passes: usize,
    /// Moves in the program.
    pub points: usize,
    /// Time at the programmed feeds and the stated rapid rate, without acceleration.
    pub time_min: f64,
    /// Area of the shape.
    pub area_mm2: f64,
    /// What the cutter cannot reach.
    pub unreachable: Unreachable,
    /// What the simulation of the emitted text found; nothing if it was not asked for.
    pub verified: Option<Verified>,
    /// What was mended, assumed, or is worth knowing.
    pub warnings: Vec<String>,
}

/// Lengths of the tip's way.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Lengths {
    /// Along passes.
    pub cut_mm: f64,
    /// Between passes at feed.
    pub link_mm: f64,
    /// In rapid.
    pub rapid_mm: f64,
}

/// What the cutter cannot reach in the posture asked for; left out of the figures of [`Verified`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Unreachable {
    /// Its area.
    pub area_mm2: f64,
    /// Edge of the cubes that it is drawn with.
    pub cell_mm: f64,
    /// Area of what an upright cutter does not even see: walls, undersides, what lies below other facets. Not counted in
    /// `area_mm2`; left out of the figures of [`Verified`] too.
    pub unseen_mm2: f64,
}

/// What the simulation of the emitted text found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Verified {
    /// The largest excess; nothing if nothing was cut.
    pub largest_excess_mm: Option<f64>,
    /// Where.
    pub largest_excess_at: Option<[f64; 3]>,
    /// The deepest gouge, 0 or negative.
    pub largest_gouge_mm: Option<f64>,
    /// Where.
    pub largest_gouge_at: Option<[f64; 3]>,
    /// How much either extreme can be missed between samples; nothing where no bound holds (a sharp cutter).
    pub sampling_error_mm: Option<f64>,
    /// The excess that half of the area does not exceed; nothing where that half is not cut.
    pub median_mm: Option<f64>,
    /// The excess that 95 % of the area does not exceed.
    pub q95_mm: Option<f64>,
    /// The excess that 99 % of the area does not exceed.
    pub q99_mm: Option<f64>,
    /// Share of the area within the limit, 0 to 1.
    pub share_within: f64,
    /// Area that no move came near.
    pub uncut_area_mm2: f64,
    /// Number of samples, those added around the extremes included.
    pub samples: usize,
    /// Area left out because the cutter cannot reach it.
    pub excluded_area_mm2: f64,
    /// The deepest gouge met there, 0 or negative.
    pub excluded_gouge_mm: f64,
}

impl Report {
    /// As JSON text.
    pub fn to_json(&self) -> String {
        // Strings and numbers always have a JSON form.
        serde_json::to_string_pretty(self).unwrap_or_default()
    }
}

impl Verified {
    /// As JSON text.
    pub fn to_json(&self) -> String {
        // Numbers always have a JSON form.
        serde_json::to_string_pretty(self).unwrap_or_default()
    }
}

impl From<&Statistics> for Verified {
    fn from(s: &Statistics) -> Self {
        let value = |e: &Option<Extreme>| e.map(|e| e.excess);
        let place = |e: &Option<Extreme>| e.map(|e| e.point.to_array());
        // JSON has no infinity; what is infinite is left out.
        let finite = |x: f64| x.is_finite().then_some(x);
        Self {
            largest_excess_mm: value(&s.max),
            largest_excess_at: place(&s.max),
            largest_gouge_mm: value(&s.min).map(|g| g.min(0.0)),
            largest_gouge_at: place(&s.min),
            sampling_error_mm: finite(s.excess_error.max(s.gouge_error)),
            median_mm: finite(s.median),
            q95_mm: finite(s.q95),
            q99_mm: finite(s.q99),
            share_within: s.share_within,
            uncut_area_mm2: s.uncut_area,
            samples: s.count + s.refined,
            excluded_area_mm2: s.excluded_area,
            excluded_gouge_mm: value(&s.excluded_gouge).unwrap_or(0.0),
        }
    }
}

impl Lengths {
    /// The lengths of `path`.
    pub fn of(path: &Toolpath) -> Self {
        let mut lengths = Self { cut_mm: 0.0, link_mm: 0.0, rapid_mm: 0.0 };
        for w in path.moves.windows(2) {
            let length = w[0].to.tip.distance(w[1].to.tip);
            match (w[1].role, w[1].rate) {
                (_, Rate::Rapid) => lengths.rapid_mm += length,
                (Role::Cut, Rate::Feed(_)) => lengths.cut_mm += length,
                (Role::Link, Rate::Feed(_)) => lengths.link_mm += length,
            }
        }
        lengths
    }
}

/// Minutes that `program` takes at its feeds, with rapid moves at `rapid` mm/min and no acceleration.
pub(super) fn minutes(program: &Program, rapid: f64) -> f64 {
    let pace = |w: &[crate::toolpath::Move]| {
        let length = w[0].to.tip.distance(w[1].to.tip);
        match w[1].rate {
            Rate::Rapid => length / rapid,
            Rate::Feed(feed) => length / feed,
        }
    };
    program.toolpath.moves.windows(2).map(pace).sum()
}
