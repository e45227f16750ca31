//! The cutter that the calculators are asked about.

use super::Failure;
use crate::cutter::Cutter;
use clap::Args;

#[derive(Debug, Args)]
pub(super) struct RoundCutter {
    /// Radius of the centre circle of the cutter's corner, mm: half the diameter less the corner radius.
    #[arg(long)]
    pub(super) center_radius: f64,
    /// Corner radius, mm.
    #[arg(long)]
    pub(super) corner_radius: f64,
}

impl RoundCutter {
    pub(super) fn cutter(&self) -> Result<Cutter, Failure> {
        let (r1, r) = (self.center_radius, self.corner_radius);
        if !(r1 >= 0.0 && r >= 0.0 && r1.is_finite() && r.is_finite()) {
            return Err(Failure::Call("--center-radius and --corner-radius: must be 0 mm or more".into()));
        }
        // Strips know nothing of the cutter's height; any that holds the corner does.
        Cutter::bull_nose(2.0 * (r1 + r), r, 10.0 * (r1 + r)).map_err(|e| Failure::Call(e.to_string()))
    }
}
