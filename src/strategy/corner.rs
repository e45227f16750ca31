//! The corners of a face beyond the first and the last pass of a family of planes.

use super::family::{Candidate, Family};
use super::probe::Setup;
use super::spacing::Toward;
use crate::contact::Body;
use crate::geometry::Uv;

/// Places looked at between two nodes of a pass, which are half a strip apart.
const BETWEEN: usize = 8;

impl Family<'_> {
    /// Whether the cutter on the lines of `candidate` leaves at most the scallop limit on all that lies beyond them
    /// on that side.
    pub(super) fn cuts_beyond(&self, candidate: &Candidate, toward: Toward) -> bool {
        let bodies = self.bodies(candidate);
        // Chords over a hollow run above the line.
        let limit = self.setup.finish.scallop - self.setup.finish.chord;
        self.lines.nodes_beyond(candidate.level, toward == Toward::Higher).all(|uv| {
            // Where there is no normal nothing can be measured.
            let Some((jet, n)) = self.setup.face.at(uv) else { return true };
            let top = jet.p + n * limit;
            bodies.iter().any(|body| body.distance(top) <= 0.0)
        })
    }

    /// The cutter at its places along the lines of `candidate`.
    fn bodies(&self, candidate: &Candidate) -> Vec<Body> {
        let Setup { face, field, cutter, .. } = &self.setup;
        let body = |uv: Uv| {
            let on_line = field.onto_level(face, candidate.level, uv)?;
            Some(Body::new(cutter, &self.setup.station(on_line, candidate.reversed)?.cl))
        };
        let between = |pair: &[Uv], k: usize| {
            let s = k as f64 / BETWEEN as f64;
            Uv::new(pair[0].u + (pair[1].u - pair[0].u) * s, pair[0].v + (pair[1].v - pair[0].v) * s)
        };
        let pairs = candidate.lines.iter().flat_map(|line| line.nodes.windows(2));
        pairs.flat_map(|pair| (0..=BETWEEN).filter_map(move |k| body(between(pair, k)))).collect()
    }
}
