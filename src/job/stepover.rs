//! Stepover against tilt at a constant scallop, as curves for a chart.

use super::error::JobError;
use super::spec::Spec;
use crate::contact::{
    Lean, TwoContact, circle_stepover, matching_lead, straight_strip, two_contact, widest_two_contact,
};
use crate::cutter::Cutter;
use crate::geometry::Curvature;
use crate::math::order::{rank, sort_by_key};
use serde::Serialize;

/// Curves of stepover against tilt for one cutter and scallop height, one set a surface radius.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StepoverChart {
    /// Scallop height.
    pub scallop_mm: f64,
    /// In the order of the radii that were asked for.
    pub curves: Vec<StepoverCurves>,
}

/// Stepovers (chords) over a surface that is bent across the feed alone. What is `None` has no value there: the model
/// diverges, the cutter gouges, or does not fit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StepoverCurves {
    /// Radius across the feed, above 0 where concave; none for a plane.
    pub radius_mm: Option<f64>,
    /// Tilts at which the values stand, rising.
    pub tilt_deg: Vec<f64>,
    /// The circle model by lead.
    pub circle_mm: Vec<Option<f64>>,
    /// By lead, exact.
    pub lead_mm: Vec<Option<f64>>,
    /// By lateral tilt, exact.
    pub lateral_mm: Vec<Option<f64>>,
    /// By lead with two contacts, exact.
    pub two_contact_mm: Vec<Option<f64>>,
    /// The lead at which curvatures match: none where the cutter does not fit into the hollow.
    pub matching_deg: Option<f64>,
    /// The widest placement with two contacts.
    pub widest: Option<Placement>,
}

/// A placement with two contacts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Placement {
    /// Lead.
    pub lead_deg: f64,
    /// How far the middle of the cutter stands off the surface.
    pub lift_mm: f64,
    /// Stepover.
    pub stepover_mm: f64,
}

impl From<TwoContact> for Placement {
    fn from(found: TwoContact) -> Self {
        Self {
            lead_deg: found.lead.to_degrees(),
            lift_mm: found.strip.lift,
            stepover_mm: found.strip.stepover,
        }
    }
}

/// Tilts from 0 in steps of this, degrees: a line through them looks smooth.
const STEP: f64 = 0.5;
/// Steps: up to 60°, beyond which nobody mills.
const STEPS: u32 = 120;

/// The curves for the cutter and scallop height of `spec`, over surfaces of these radii across the feed (mm, above 0 where
/// concave, 0 for a plane).
///
/// Errors: a cutter that cannot be, a radius that is not a number.
pub fn stepover_chart(spec: &Spec, radii: &[f64]) -> Result<StepoverChart, JobError> {
    let cutter = spec.cutter.cutter()?;
    if !radii.iter().all(|radius| radius.is_finite()) {
        return Err(JobError::field("radius_mm", "must be a number".into()));
    }
    let scallop_mm = spec.tolerance.scallop_mm;
    let curves = radii.iter().map(|&radius| curves(&cutter, scallop_mm, radius)).collect();
    Ok(StepoverChart { scallop_mm, curves })
}

impl StepoverChart {
    /// As JSON text.
    pub fn to_json(&self) -> String {
        // Finite numbers always have a JSON form.
        serde_json::to_string(self).unwrap_or_default()
    }
}

/// An angle in both units, so that neither is rounded on the way to the other.
#[derive(Clone, Copy, PartialEq)]
struct Tilt {
    degrees: f64,
    radians: f64,
}

impl Tilt {
    fn of_degrees(degrees: f64) -> Self {
        Self { degrees, radians: degrees.to_radians() }
    }

    fn of_radians(radians: f64) -> Self {
        Self { degrees: radians.to_degrees(), radians }
    }
}

fn curves(cutter: &Cutter, scallop: f64, radius: f64) -> StepoverCurves {
    let k = if radius == 0.0 { 0.0 } else { 1.0 / radius };
    let matching = matching_lead(cutter, &Curvature::across(k), 0.0);
    let widest = widest_two_contact(cutter, k, scallop);
    let mut tilts: Vec<Tilt> = (0..=STEPS).map(|i| Tilt::of_degrees(STEP * f64::from(i))).collect();
    // Where lines begin and end.
    tilts.extend(matching.map(Tilt::of_radians));
    tilts.extend(widest.map(|w| Tilt::of_radians(w.lead)));
    sort_by_key(&mut tilts, |tilt| (rank(tilt.radians), 0));
    tilts.dedup();
    let at = |value: &dyn Fn(f64) -> Option<f64>| tilts.iter().map(|tilt| value(tilt.radians)).collect();
    let exact = |lean| straight_strip(cutter, lean, k, scallop).map(|strip| strip.stepover);
    StepoverCurves {
        radius_mm: (radius != 0.0).then_some(radius),
        tilt_deg: tilts.iter().map(|tilt| tilt.degrees).collect(),
        circle_mm: at(&|tilt| circle_stepover(cutter, Lean::Lead(tilt), k, scallop)),
        lead_mm: at(&|tilt| exact(Lean::Lead(tilt))),
        lateral_mm: at(&|tilt| exact(Lean::Lateral(tilt))),
        two_contact_mm: at(&|tilt| two_contact(cutter, tilt, k, scallop).map(|two| two.strip.stepover)),
        matching_deg: matching.map(f64::to_degrees),
        widest: widest.map(Placement::from),
    }
}
