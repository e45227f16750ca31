//! `stepover strip`: the strip at one contact point.

use super::cutter::RoundCutter;
use super::{Failure, print};
use crate::contact::{model_strip, second_order_strip_width};
use crate::geometry::Curvature;
use crate::toolpath::Posture;
use clap::Args;

#[derive(Debug, Args)]
pub(super) struct Strip {
    #[command(flatten)]
    cutter: RoundCutter,
    /// Scallop height, mm.
    #[arg(long)]
    scallop: f64,
    /// Lead: angle between axis and normal, degrees.
    #[arg(long)]
    lead: f64,
    /// Yaw: direction of the lean, from feed towards the left, degrees.
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    yaw: f64,
    /// Curvature of the surface as k_ff,k_fb,k_bb, 1/mm, positive where concave.
    #[arg(long, value_delimiter = ',', num_args = 1, allow_hyphen_values = true, default_value = "0,0,0")]
    curvature: Vec<f64>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

impl Strip {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let &[ff, fb, bb] = &self.curvature[..] else {
            return Err(Failure::Call("--curvature: three numbers k_ff,k_fb,k_bb are needed".into()));
        };
        let numbers = [self.lead, self.yaw, ff, fb, bb];
        if !numbers.iter().all(|x| x.is_finite()) {
            return Err(Failure::Call("every number must be finite".into()));
        }
        if !(self.scallop > 0.0 && self.scallop.is_finite()) {
            return Err(Failure::Call("--scallop: must be above 0 mm".into()));
        }
        let cutter = self.cutter.cutter()?;
        let posture = Posture { lead: self.lead.to_radians(), yaw: self.yaw.to_radians() };
        let curvature = Curvature { ff, fb, bb };
        let strip = model_strip(&cutter, posture, &curvature, self.scallop);
        let Some((left, right)) = strip.half_widths() else {
            let why = "the cutter gouges beside its contact: more lead, or a smaller cutter";
            return Err(Failure::Job(why.into()));
        };
        let second = second_order_strip_width(&cutter, posture, &curvature, self.scallop);
        if self.json {
            // JSON has no infinity.
            let second = if second.is_finite() { second.to_string() } else { "null".into() };
            return print(&format!(
                r#"{{"left_mm": {left}, "right_mm": {right}, "width_mm": {}, "second_order_mm": {second}}}"#,
                left + right
            ));
        }
        print(&format!("left_mm {left:.6}\nright_mm {right:.6}\nwidth_mm {:.6}", left + right))?;
        print(&format!("second_order_mm {second:.6}"))
    }
}
