//! What every strategy is asked for, and what it gives.

#[cfg(feature = "flow")]
use super::StartError;
use crate::geometry::Zone;
use crate::monitor::Cancelled;
use crate::toolpath::Pass;

/// What a finishing path has to keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Finish {
    /// Highest cusp left, mm, above 0.
    pub scallop: f64,
    /// How far the straight moves between stations may stray from the surface, to either side, mm.
    pub chord: f64,
}

/// The largest chord tolerance that is used, as a share of the scallop.
const FINE: f64 = 0.02;

impl Finish {
    /// With chords that are fine enough for wide strips: over a hollow they raise the cusps beside them by as much as they stray,
    /// and passes lie the closer for it. A tenth of the height would cost a twentieth of the width.
    pub(super) fn with_fine_chords(self) -> Self {
        Self { chord: self.chord.min(FINE * self.scallop), ..self }
    }
}

/// Which way neighbouring passes run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Order {
    /// All in one direction.
    Zig,
    /// Every other one back.
    #[default]
    ZigZag,
}

/// What a strategy gives.
#[derive(Debug, Clone, PartialEq)]
pub struct Planned {
    /// Passes in the order in which they are cut.
    pub passes: Vec<Pass>,
    /// Where the cutter cannot go in the posture asked for.
    pub unreached: Zone,
    /// What an upright cutter does not see; empty for a posture that follows the surface.
    pub unseen: Zone,
    /// Where postures are chosen and the cutter fits in none in places: how much smaller the largest cutter of its shape is
    /// that fits there, as a share of it.
    pub largest_fit: Option<f64>,
}

impl Planned {
    /// Length of the way of the cutter's tip along the passes, mm.
    pub(super) fn length(&self) -> f64 {
        let ways = self.passes.iter().flat_map(|pass| pass.stations.windows(2));
        ways.map(|w| w[0].cl.tip.distance(w[1].cl.tip)).sum()
    }
}

/// Why there is no path.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StrategyError {
    /// Told to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The cutter gouges wherever it is put.
    #[error("the cutter fits nowhere on this surface: {0}")]
    FitsNowhere(String),
    /// The planner of the potential field finds nothing to begin with.
    #[cfg(feature = "flow")]
    #[error("no line along the widest strips divides this surface: passes offset from a border may do")]
    NoInitialPath,
    /// Passes cannot be offset from the start curve that was given.
    #[cfg(feature = "flow")]
    #[error("the start curve {0}")]
    Start(#[from] StartError),
    /// More passes than any machine would run.
    #[error("more than {most} passes would be needed: {why}")]
    TooMany {
        /// The limit.
        most: usize,
        /// What to change.
        why: String,
    },
}
