//! `stepover stepover`: the stepover at a tilt, by the circle model and exactly, and what either leaves.

use super::cutter::RoundCutter;
use super::{Failure, print};
use crate::contact::{
    Lean, circle_stepover, effective_radius, straight_strip, two_contact, widest_two_contact,
};
use crate::cutter::Cutter;
use crate::job::{JobError, cut_two_passes};
use clap::Args;

#[derive(Debug, Args)]
pub(super) struct Stepover {
    #[command(flatten)]
    cutter: RoundCutter,
    /// Scallop height, mm.
    #[arg(long)]
    scallop: f64,
    /// Tilt: angle between axis and normal, degrees, from 0 to below 90.
    #[arg(long)]
    tilt: f64,
    /// Tilt across the feed, not along it.
    #[arg(long)]
    lateral: bool,
    /// Radius of the surface across the feed, mm, above 0 where it is concave and below 0 where it is convex; a plane
    /// without it.
    #[arg(long, allow_negative_numbers = true)]
    radius: Option<f64>,
    /// Cut two passes at each stepover in simulation and print the scallop that they leave.
    #[arg(long)]
    simulate: bool,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

impl Stepover {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let (cutter, lean, curvature) = self.checked()?;
        let h = self.scallop;
        let circle = circle_stepover(&cutter, lean, curvature, h);
        let exact = straight_strip(&cutter, lean, curvature, h);
        let mut lines = Lines::default();
        if let Lean::Lead(lead) = lean {
            let radius = effective_radius(cutter.center_radius, cutter.corner_radius, lead);
            lines.add("effective_radius_mm", Some(radius).filter(|r| r.is_finite()));
        }
        lines.add("circle_mm", circle);
        lines.add("exact_mm", exact.map(|strip| strip.stepover));
        let cut = |stepover: f64, lift: f64| -> Result<Option<f64>, JobError> {
            cut_two_passes(&cutter, lean, curvature, stepover, lift, h).map(|found| Some(found.scallop))
        };
        // A cutter that digs in beside its contact has no scallop to speak of.
        if let (true, Some(strip)) = (self.simulate, exact) {
            lines.add("circle_scallop_mm", circle.map_or(Ok(None), |s| cut(s, 0.0))?);
            lines.add("exact_scallop_mm", cut(strip.stepover, 0.0)?);
        }
        if let (Lean::Lead(lead), true) = (lean, curvature > 0.0) {
            let here = two_contact(&cutter, lead, curvature, h);
            lines.add("two_contact_mm", here.map(|two| two.strip.stepover));
            lines.add("two_contact_lift_mm", here.map(|two| two.strip.lift));
            if let (true, Some(two)) = (self.simulate, here) {
                lines.add("two_contact_scallop_mm", cut(two.strip.stepover, two.strip.lift)?);
            }
            let widest = widest_two_contact(&cutter, curvature, h);
            lines.add("widest_two_contact_mm", widest.map(|two| two.strip.stepover));
            lines.add("widest_two_contact_lead_deg", widest.map(|two| two.lead.to_degrees()));
            lines.add("widest_two_contact_lift_mm", widest.map(|two| two.strip.lift));
        }
        print(&if self.json { lines.json() } else { lines.text() })
    }

    fn checked(&self) -> Result<(Cutter, Lean, f64), Failure> {
        let call = |why: &str| Err(Failure::Call(why.into()));
        let cutter = self.cutter.cutter()?;
        if !(self.scallop > 0.0 && self.scallop.is_finite()) {
            return call("--scallop: must be above 0 mm");
        }
        if !(0.0..90.0).contains(&self.tilt) {
            return call("--tilt: must be at least 0° and below 90°");
        }
        if self.radius.is_some_and(|radius| radius == 0.0 || !radius.is_finite()) {
            return call("--radius: must not be 0 mm; a plane goes without");
        }
        let tilt = self.tilt.to_radians();
        let lean = if self.lateral { Lean::Lateral(tilt) } else { Lean::Lead(tilt) };
        Ok((cutter, lean, self.radius.map_or(0.0, f64::recip)))
    }
}

/// Named numbers, each of which may have no value.
#[derive(Default)]
struct Lines(Vec<(&'static str, Option<f64>)>);

impl Lines {
    fn add(&mut self, name: &'static str, value: Option<f64>) {
        self.0.push((name, value));
    }

    fn text(&self) -> String {
        let line = |(name, value): &(&str, Option<f64>)| match value {
            Some(value) => format!("{name} {value:.6}"),
            None => format!("{name} none"),
        };
        self.0.iter().map(line).collect::<Vec<_>>().join("\n")
    }

    fn json(&self) -> String {
        let pair = |(name, value): &(&str, Option<f64>)| {
            let value = value.map_or("null".into(), |value| value.to_string());
            format!(r#""{name}": {value}"#)
        };
        format!("{{{}}}", self.0.iter().map(pair).collect::<Vec<_>>().join(", "))
    }
}
