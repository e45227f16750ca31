//! From passes to one path with links that clear the part and what it stands on.

use super::error::JobError;
use crate::monitor::Stage;
use crate::strategy::{self, Linked, Linking, Outline, Refuge};
use crate::toolpath::{ClPoint, Pass};

/// What joins passes on one shape.
pub(super) struct Joining<'a> {
    pub(super) how: Linking,
    pub(super) outline: Outline,
    /// Whether the cutter, and its holder, clear the part with so much more around them, mm.
    pub(super) clears: &'a (dyn Fn(&ClPoint, f64) -> bool + Sync),
    pub(super) holder_clears: &'a (dyn Fn(&ClPoint, f64) -> bool + Sync),
    /// How much more that is on links.
    pub(super) more: f64,
}

impl Joining<'_> {
    /// The passes in one path, with `warnings` of what cuts meet: in their order, or in another one, `turned` where they may be, if they may be
    /// moved and links take less time then.
    pub(super) fn joined(
        &self,
        passes: &mut Vec<Pass>,
        (moved, turned): (bool, bool),
        refuge: &Refuge,
        warnings: &mut Vec<String>,
        stage: &Stage,
    ) -> Result<Linked, JobError> {
        let is_clear = |cl: &ClPoint| {
            (self.clears)(cl, self.more)
                && (self.holder_clears)(cl, self.more)
                && self.how.fixture.is_none_or(|height| self.outline.lowest(cl) > height)
        };
        let link =
            |passes: &[Pass], stage: &Stage| strategy::link(passes, &self.how, refuge, &is_clear, stage);
        let mut linked = link(passes, &stage.part("Joining passes", 0.0, 0.5))?;
        let other = moved.then(|| strategy::shortened(passes, turned, &self.how, refuge)).flatten();
        if let Some(other) = other {
            let again = link(&other, &stage.part("Joining passes", 0.5, 1.0))?;
            let time = |linked: &Linked| strategy::link_time(&linked.toolpath, &self.how);
            if time(&again) < time(&linked) {
                (linked, *passes) = (again, other);
            }
        }
        warnings.extend(self.met(&linked));
        Ok(linked)
    }

    /// Where the holder does not clear the part, and where the tool goes below what the part stands on: cuts do not ask for either.
    fn met(&self, linked: &Linked) -> impl Iterator<Item = String> {
        let told = |what: &str, meets: &dyn Fn(&ClPoint) -> bool| {
            let mut met = linked.toolpath.moves.iter().enumerate().filter(|(_, step)| meets(&step.to));
            let (first, step) = met.next()?;
            let count = 1 + met.count();
            let [x, y, z] = step.to.tip.to_array();
            Some(format!("{what} at {count} moves, first at move {first} to ({x:.3}, {y:.3}, {z:.3})"))
        };
        let held = told("the holder does not clear the part", &|cl| !(self.holder_clears)(cl, 0.0));
        let below = self.how.fixture.and_then(|height| {
            told("the tool goes below the fixture", &|cl| self.outline.lowest(cl) < height - FIXTURE_ROUNDING)
        });
        held.into_iter().chain(below)
    }
}

/// How far below the fixture counts as a rounding error, mm.
const FIXTURE_ROUNDING: f64 = 1e-9;
