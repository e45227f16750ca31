//! A turning job's result in numbers, as JSON.

use super::run::{TurningPlan, TurningProof, rpm};
use super::spec::TURNING_VERSION;
use crate::toolpath::{Interpolation, Nose};
use crate::turning::{Chord, Limits, Peak, Spacing, Spot};
use crate::verify::{Residue, TurnedProof};
use serde::Serialize;
use std::f64::consts::TAU;

/// A turning job's result in numbers; units are in the names.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "names and units say it")]
pub struct TurningReport {
    pub version: u32,
    pub name: String,
    pub points: usize,
    pub turns: f64,
    /// Distance between turns.
    pub step_mm: f64,
    /// Angle between points; nothing where they lie by arcs.
    pub angle_deg: Option<f64>,
    /// Arc between points; nothing where they lie by angles.
    pub arc_mm: Option<f64>,
    pub interpolation: &'static str,
    /// How far in and out the nose centre must go to finish the aperture, and how far out it goes.
    pub innermost_mm: f64,
    pub outermost_mm: f64,
    pub farthest_mm: f64,
    /// The highest cusp to be expected, on the exact path.
    pub cusp: Place,
    /// What interpolation leaves at most, and what it digs in, along the normal.
    pub chord_left: Place,
    pub chord_dug: Place,
    /// The smallest hollow that the nose meets; nothing where there is none.
    pub hollow_mm: Option<f64>,
    pub steepest_section_deg: f64,
    /// The steepest fall and rise along the cut.
    pub steepest_along_deg: [f64; 2],
    /// An insert's smallest clearance, and its smallest and largest rake, against the cut.
    pub effective_deg: Option<[f64; 3]>,
    pub time_s: f64,
    /// Speed of the spindle at the rim and its highest.
    pub rim_rpm: f64,
    pub highest_rpm: f64,
    /// What is asked of the axes on the way; not while the spindle gets going and comes to rest, of which `strictest` and `reserve` know.
    pub x: Axis,
    pub z: Axis,
    pub c: Axis,
    /// The limit that is reached first, in words, and how many times as fast the path could go.
    pub strictest: Option<String>,
    pub reserve: Option<f64>,
    pub verified: Option<TurnedReport>,
    pub warnings: Vec<String>,
}

/// A value and where it is; mm on the workpiece.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[expect(missing_docs, reason = "names and units say it")]
pub struct Place {
    pub mm: f64,
    pub x_mm: f64,
    pub y_mm: f64,
}

/// What is asked of an axis: X and Z in mm, C in degrees, and seconds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[expect(missing_docs, reason = "names and units say it")]
pub struct Axis {
    pub velocity: Asked,
    pub acceleration: Asked,
    pub jerk: Asked,
}

/// A largest value, its limit, and where on the path it is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[expect(missing_docs, reason = "names and units say it")]
pub struct Asked {
    pub value: f64,
    pub limit: f64,
    pub x_mm: f64,
    pub c_deg: f64,
}

/// What the simulation of the emitted text found.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "names and units say it")]
pub struct TurnedReport {
    /// What it was cut with: `ball` or `insert`.
    pub body: &'static str,
    /// The largest residue, and the least: below 0 where the tool digs in. Nothing if nothing was cut.
    pub residue: Option<Place>,
    pub overcut: Option<Place>,
    /// What the moves of the text leave and dig in at most between their ends, under the nose that it states; nothing where that nose
    /// does not fit the part.
    pub chord_left: Option<Place>,
    pub chord_dug: Option<Place>,
    pub peak_to_valley_mm: f64,
    pub mean_mm: f64,
    pub rms_mm: f64,
    pub bands: Vec<Share>,
    pub uncut: f64,
    pub samples: usize,
    pub sagittas: Vec<Sag>,
    /// Whether all sagittas are within their tolerance.
    pub sagittas_pass: bool,
}

/// Shares of the area against a tolerance, 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[expect(missing_docs, reason = "names and units say it")]
pub struct Share {
    pub limit_mm: f64,
    pub within: f64,
    pub over: f64,
    pub under: f64,
}

/// A sagitta over a chord.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[expect(missing_docs, reason = "names and units say it")]
pub struct Sag {
    pub direction_deg: f64,
    pub chord_mm: f64,
    pub nominal_mm: f64,
    pub cut_mm: f64,
}

impl TurnedReport {
    pub(super) fn new(proof: &TurnedProof, nose: Nose, between: Option<[Chord; 2]>, tolerance: f64) -> Self {
        let form = &proof.form;
        let place = |r: &Residue| Place { mm: r.value, x_mm: r.x, y_mm: r.y };
        let share = |b: &crate::verify::Band| Share {
            limit_mm: b.limit,
            within: b.within,
            over: b.over,
            under: b.under,
        };
        let sagittas: Vec<Sag> = proof
            .sagittas
            .iter()
            .map(|s| Sag {
                direction_deg: s.angle.to_degrees(),
                chord_mm: s.chord,
                nominal_mm: s.nominal,
                cut_mm: s.cut,
            })
            .collect();
        Self {
            body: match nose {
                Nose::Ball(_) => "ball",
                Nose::Insert(_) => "insert",
            },
            residue: form.highest.as_ref().map(place),
            overcut: form.lowest.as_ref().map(place),
            chord_left: between.map(|[left, _]| chord(&left)),
            chord_dug: between.map(|[_, dug]| chord(&dug)),
            peak_to_valley_mm: form.peak_to_valley,
            mean_mm: form.mean,
            rms_mm: form.rms,
            bands: form.bands.iter().map(share).collect(),
            uncut: form.uncut,
            samples: form.samples,
            sagittas_pass: sagittas.iter().all(|s| (s.cut_mm - s.nominal_mm).abs() <= tolerance),
            sagittas,
        }
    }

    /// As JSON text.
    pub fn to_json(&self) -> String {
        // Numbers and words always have a JSON form.
        serde_json::to_string_pretty(self).unwrap_or_default()
    }
}

impl TurningReport {
    pub(super) fn new(plan: &TurningPlan, proof: Option<&TurningProof>) -> Self {
        let planned = &plan.planned;
        let found = &planned.dynamics;
        let limits: &Limits = &plan.order.limits;
        let axis = |k: usize| {
            let scale = if k == 2 { 1.0_f64.to_degrees() } else { 1.0 };
            let asked = |kind: usize| {
                let Peak { value, x, c } = found.peaks[k][kind];
                Asked {
                    value: value * scale,
                    limit: limits.most[k][kind] * scale,
                    x_mm: x,
                    c_deg: (c % TAU).to_degrees(),
                }
            };
            Axis { velocity: asked(0), acceleration: asked(1), jerk: asked(2) }
        };
        let (angle, arc) = match planned.spacing {
            Spacing::Angle(angle) => (Some(angle.to_degrees()), None),
            Spacing::Arc { length, .. } | Spacing::Hybrid { length, .. } => (None, Some(length)),
        };
        let fit = &planned.fit;
        let farthest = planned.guide.farthest();
        let mut warnings = plan.warnings.clone();
        if let Some(proof) = proof.filter(|p| !p.verified.sagittas_pass) {
            let worst = proof.verified.sagittas.iter().map(|s| s.cut_mm - s.nominal_mm);
            let worst = worst.fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
            warnings.push(format!("verify.sagitta_mm: a sagitta is {worst:.4} mm off"));
        }
        Self {
            version: TURNING_VERSION,
            name: plan.spec.name.clone(),
            points: plan.emitted.points.len(),
            turns: planned.guide.length() / TAU,
            step_mm: planned.guide.step(),
            angle_deg: angle,
            arc_mm: arc,
            interpolation: match plan.emitted.interpolation {
                Interpolation::Linear => "linear",
                Interpolation::Pvt => "pvt",
            },
            innermost_mm: planned.reach[0],
            outermost_mm: planned.reach[1],
            farthest_mm: farthest,
            cusp: spot(planned.cusp.height, planned.cusp.at),
            chord_left: chord(&planned.chord[0]),
            chord_dug: chord(&planned.chord[1]),
            hollow_mm: fit.hollow.is_finite().then_some(fit.hollow),
            steepest_section_deg: fit.section.to_degrees(),
            steepest_along_deg: fit.along.map(f64::to_degrees),
            effective_deg: fit.effective.map(|angles| angles.map(f64::to_degrees)),
            time_s: found.time,
            rim_rpm: rpm(planned.pace.at(farthest)[0]),
            highest_rpm: rpm(planned.pace.largest()),
            x: axis(0),
            z: axis(1),
            c: axis(2),
            strictest: planned.strictest.map(|s| format!("{} of {}", s.kind_name(), s.axis_name())),
            reserve: planned.strictest.map(|s| s.share),
            verified: proof.map(|p| p.verified.clone()),
            warnings,
        }
    }

    /// As JSON text.
    pub fn to_json(&self) -> String {
        // Numbers and words always have a JSON form.
        serde_json::to_string_pretty(self).unwrap_or_default()
    }
}

fn spot(mm: f64, at: Spot) -> Place {
    Place { mm, x_mm: at.x, y_mm: at.y }
}

/// Where the nose centre is, for an error of interpolation.
fn chord(chord: &Chord) -> Place {
    let (sin, cos) = libm::sincos(chord.c);
    Place { mm: chord.error, x_mm: chord.x * cos, y_mm: chord.x * sin }
}
