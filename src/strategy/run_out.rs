//! Where passes run out over a border, and how far that is sure.

use super::probe::Setup;
use crate::geometry::{Curvature, Field, IsoLine, Uv};

/// How far passes run out over a border, in strips: what strips that lie aslant leave before it is cut then.
const RUN_OUT: f64 = 1.1;
/// The most that the surface may turn on the way, radians: over an edge that is rolled tighter nothing is promised.
const MOST_TURN: f64 = 0.4;

impl Setup<'_> {
    /// How far passes surely go on beyond the first and the last node of `line`, mm: 0 where they end within the face. Lines
    /// that bend freely have their own rule.
    pub(super) fn run_outs(&self, line: &IsoLine) -> [f64; 2] {
        let way = RUN_OUT * self.strip;
        [line.nodes.first(), line.nodes.last()]
            .map(|end| if end.is_some_and(|uv| self.runs_out(*uv)) { way } else { 0.0 })
    }

    /// Whether a pass that ends at `uv` goes on over the border there.
    pub(super) fn runs_out(&self, uv: Uv) -> bool {
        let domain = self.face.domain();
        let is_border = domain.u.is_near_end(uv.u) || domain.v.is_near_end(uv.v);
        if !is_border || matches!(self.field, Field::Given(_)) {
            return false;
        }
        let bend = self.frame(uv, false).and_then(|(jet, frame)| Curvature::of(&jet, &frame));
        bend.is_some_and(|k| libm::hypot(k.ff, k.fb) * RUN_OUT * self.strip < MOST_TURN)
    }
}
