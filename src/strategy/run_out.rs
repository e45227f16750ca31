//! Where passes run out over a border, and how far that is sure.

use super::probe::Setup;
use crate::contact::Edge;
use crate::geometry::{Curvature, Field, IsoLine, Range, Uv};

/// How far passes run out over a border, in strips: what strips that lie aslant leave before it is cut then.
const RUN_OUT: f64 = 1.1;
/// Leans, as parts of what lies beside, from which on strips and borders are not followed.
const MOST_LEAN: f64 = 6.0;
/// What every pass goes on, in strips, and how much farther than the strip's edges lie.
const LITTLE: f64 = 0.15;
const SAFELY: f64 = 1.2;
/// The most that the surface may turn on the way, radians: over an edge that is rolled tighter nothing is promised.
const MOST_TURN: f64 = 0.4;

impl Setup<'_> {
    /// How far passes surely go on beyond the first and the last node of `line`, mm: 0 where they end within the face. Lines
    /// that bend freely have their own rule.
    pub(super) fn run_outs(&self, line: &IsoLine, reversed: bool) -> [f64; 2] {
        let way = RUN_OUT * self.strip;
        if matches!(self.field, Field::Given(_)) {
            return [line.nodes.first(), line.nodes.last()]
                .map(|end| end.map_or(0.0, |uv| self.runs_on(*uv, reversed)));
        }
        [line.nodes.first(), line.nodes.last()]
            .map(|end| if end.is_some_and(|uv| self.runs_out(*uv)) { way } else { 0.0 })
    }

    /// How far passes along a line that bends freely go on at `uv`, an end of the line, mm: 0 within the face.
    fn runs_on(&self, uv: Uv, reversed: bool) -> f64 {
        let [before, beyond] = self.run_out_ways(uv, reversed).unwrap_or_default();
        before.max(beyond)
    }

    /// How far a pass whose line ends at `uv` begins before it and goes on beyond it, mm, so that its whole strip runs over the
    /// border there; `None` where that is no border.
    pub(super) fn run_out_ways(&self, uv: Uv, reversed: bool) -> Option<[f64; 2]> {
        let domain = self.face.domain();
        let (jet, frame) = self.frame(uv, reversed)?;
        let is_end = |range: &Range, x: f64| {
            !range.periodic && (x - range.lo).min(range.hi - x) < 1e-6 * range.length()
        };
        let border = if is_end(&domain.u, uv.u) {
            jet.dv
        } else if is_end(&domain.v, uv.v) {
            jet.du
        } else {
            return None;
        };
        let lean = border.dot(frame.f) / border.dot(frame.b);
        Some(self.ways_across(uv, reversed, if lean.abs() < MOST_LEAN { lean } else { 0.0 }))
    }

    /// How far a pass must begin before and go on beyond a line across it at `uv`, mm, so that its strip, which lies aslant,
    /// is cut up to that line. The line runs ahead by `lean` for each millimetre to the left.
    pub(super) fn ways_across(&self, uv: Uv, reversed: bool, lean: f64) -> [f64; 2] {
        let least = LITTLE * self.breadth(uv, reversed);
        let (Some(strip), Some((jet, frame))) = (self.strip(uv, reversed), self.frame(uv, reversed)) else {
            return [least; 2];
        };
        // Sides take turns in being wide and narrow: both count as wide as the wider.
        let half = 0.5 * self.breadth(uv, reversed);
        let ahead = |edge: Edge| match edge {
            Edge::Reached(foot) | Edge::Border(foot) => {
                let away = self.face.surface.point(foot) - jet.p;
                let (ahead, left) = (away.dot(frame.f), away.dot(frame.b));
                // Right at the contact it gives no direction; where either is extreme, going all the way would cost more than
                // it finishes.
                let own = if ahead.abs() < MOST_LEAN * left.abs() { ahead / left.abs() } else { 0.0 };
                half * (own - lean * left.signum())
            }
            Edge::Gouge(_) => 0.0,
        };
        let most = |sign: f64| {
            [strip.left, strip.right].map(|edge| sign * ahead(edge)).into_iter().fold(0.0, f64::max)
        };
        let ways = [1.0, -1.0].map(most);
        // On the way the lean may change: where strips are narrow it is cheap to count it for both ways.
        let ways = if self.postures.is_fixed() { [ways[0].max(ways[1]); 2] } else { ways };
        ways.map(|way| least + SAFELY * way)
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
