//! Figures to learn from: one contact on a surface that is bent as somebody likes it.

use crate::contact::{
    Lean, circle_stepover, cutter_curvature, effective_radius, model_section, model_strip,
    second_order_strip_width, straight_strip,
};
use crate::geometry::Curvature;
use crate::job::error::JobError;
use crate::job::{Spec, cut_two_passes};
use crate::toolpath::Posture;
use serde::Serialize;

/// A section square to the feed through a contact.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StudiedSection {
    /// Distance to the side and height of the envelope over the surface, mm, from right to left.
    pub envelope_mm: Vec<[f64; 2]>,
    /// Half widths of the strip, left and right, mm; none where the cutter digs in beside its contact.
    pub halves_mm: Option<[f64; 2]>,
    /// Width of the strip to second order, mm; none where curvatures match or the cutter digs in.
    pub second_order_mm: Option<f64>,
    /// Radius of the circle that touches the profile, mm; none for a flat bottom that lies on the surface.
    pub effective_radius_mm: Option<f64>,
}

/// The section for the cutter and scallop height of `spec`, leaning by `lead_deg` and `yaw_deg`, over a surface with this curvature
/// (1/mm, above 0 where hollow) along the feed, its torsion and that across, out to `reach` mm.
pub fn studied_section(
    spec: &Spec,
    [lead_deg, yaw_deg]: [f64; 2],
    [ff, fb, bb]: [f64; 3],
    reach: f64,
) -> Result<StudiedSection, JobError> {
    let cutter = spec.cutter.cutter()?;
    let (posture, k) = (posture(lead_deg, yaw_deg), Curvature { ff, fb, bb });
    let halves = model_strip(&cutter, posture, &k, spec.tolerance.scallop_mm).half_widths();
    Ok(StudiedSection {
        envelope_mm: model_section(&cutter, posture, &k, reach),
        halves_mm: halves.map(|(left, right)| [left, right]),
        second_order_mm: finite(second_order_strip_width(&cutter, posture, &k, spec.tolerance.scallop_mm)),
        effective_radius_mm: finite(effective_radius(
            cutter.center_radius,
            cutter.corner_radius,
            posture.lead,
        )),
    })
}

/// Widths of strips at one lead, by yaw.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StudiedWidths {
    /// Yaws.
    pub yaw_deg: Vec<f64>,
    /// The moving cutter's.
    pub exact_mm: Vec<Option<f64>>,
    /// Second order, with `det K / K_ff`.
    pub schur_mm: Vec<Option<f64>>,
    /// Second order, with the normal section `K_bb`.
    pub section_mm: Vec<Option<f64>>,
}

/// Yaws from minus to plus this, in steps of one degree.
const MOST_YAW: i32 = 45;

/// Widths at `lead_deg` over a surface with this curvature, as for [`studied_section`].
pub fn studied_widths(spec: &Spec, lead_deg: f64, [ff, fb, bb]: [f64; 3]) -> Result<StudiedWidths, JobError> {
    let (cutter, scallop) = (spec.cutter.cutter()?, spec.tolerance.scallop_mm);
    let k = Curvature { ff, fb, bb };
    let mut widths = StudiedWidths {
        yaw_deg: (-MOST_YAW..=MOST_YAW).map(f64::from).collect(),
        exact_mm: Vec::new(),
        schur_mm: Vec::new(),
        section_mm: Vec::new(),
    };
    for &yaw in &widths.yaw_deg {
        let posture = posture(lead_deg, yaw);
        let exact = model_strip(&cutter, posture, &k, scallop).half_widths();
        let across = (cutter_curvature(&cutter, posture) - k).bb;
        widths.exact_mm.push(exact.map(|(left, right)| left + right));
        widths.schur_mm.push(finite(second_order_strip_width(&cutter, posture, &k, scallop)));
        widths.section_mm.push((across > 0.0).then(|| 2.0 * (2.0 * scallop / across).sqrt()));
    }
    Ok(widths)
}

/// Two neighbouring straight passes, laid by the circle model and by the exact stepover, and cut in simulation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StudiedPasses {
    /// Stepover of the circle model, mm; none where it diverges.
    pub circle_mm: Option<f64>,
    /// What it leaves, mm.
    pub circle_scallop_mm: Option<f64>,
    /// The exact stepover, mm; none where the cutter digs in.
    pub exact_mm: Option<f64>,
    /// What it leaves, mm.
    pub exact_scallop_mm: Option<f64>,
}

/// The passes for the cutter and scallop height of `spec` at a lead of `tilt_deg` over a surface of this radius across the feed (mm,
/// above 0 where hollow, 0 for a plane).
pub fn studied_passes(spec: &Spec, tilt_deg: f64, radius: f64) -> Result<StudiedPasses, JobError> {
    let (cutter, scallop) = (spec.cutter.cutter()?, spec.tolerance.scallop_mm);
    let (lean, k) = (Lean::Lead(tilt_deg.to_radians()), if radius == 0.0 { 0.0 } else { radius.recip() });
    let circle_mm = circle_stepover(&cutter, lean, k, scallop);
    let exact_mm = straight_strip(&cutter, lean, k, scallop).map(|strip| strip.stepover);
    // What is wider than the face, or leaves more than the cutter is tall, has no scallop.
    let cut = |stepover: f64| cut_two_passes(&cutter, lean, k, stepover, 0.0, scallop).ok();
    let left = |stepover: Option<f64>| Some(cut(stepover?)?.scallop);
    Ok(StudiedPasses {
        circle_mm,
        circle_scallop_mm: exact_mm.and_then(|_| left(circle_mm)),
        exact_mm,
        exact_scallop_mm: left(exact_mm),
    })
}

fn posture(lead_deg: f64, yaw_deg: f64) -> Posture {
    Posture { lead: lead_deg.to_radians(), yaw: yaw_deg.to_radians() }
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
