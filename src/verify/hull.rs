//! What the excess can be between samples that known parts of the motion cut.

use super::bound::{excess_over, into_ball, longest, upward};
use super::cut::{Hit, Scene};
use super::entry::{Entry, Line, enter};
use super::motion::Piece;
use super::samples::Sample;
use glam::DVec3;

impl Scene {
    /// A bound of the excess over the triangle with the corners `samples`, which met `hits`: that of
    /// [`bound`](super::bound::bound), with what each part of the motion that cut one of the corners sweeps in the place of
    /// a ball. Dearer by up to six searches for an entry, and as sharp as the cutter is blunt there: it loses next to nothing
    /// along the feed where one part passes all three corners, and across it what a strip's profile bends. Good for sharp
    /// cutters too, where they do not turn.
    pub(super) fn excess_bound(&self, samples: [&Sample; 3], hits: [&Hit; 3]) -> f64 {
        let Some(up) = upward(samples) else { return f64::INFINITY };
        let is_first = |c: usize| (0..c).all(|k| hits[k].part != hits[c].part);
        let row = |c: usize| {
            if is_first(c) { self.entries(samples, hits, up, hits[c].part) } else { None }
        };
        excess_over(samples, up, &[0, 1, 2].map(|c| row(c).unwrap_or([f64::INFINITY; 3])))
    }

    /// The heights at which the corners' lines along `up` enter a convex body that lies within what the cutter sweeps in
    /// part `number`; `None` if one of them does not.
    ///
    /// Without a turn that is all it sweeps: a convex body and a segment added up. With a turn see [`lost`]: it is the hull
    /// of a ball in the cutter for each corner.
    fn entries(&self, samples: [&Sample; 3], hits: [&Hit; 3], up: DVec3, number: u32) -> Option<[f64; 3]> {
        let (piece, round) = (self.sweeps.part(number), self.body.inscribed());
        // What is entered so far up that the cutter would have to lean by more than 45° between the samples is no use.
        let to = self.to + longest(samples);
        let enter_at = |k: usize| {
            let Hit { ball, part, time, .. } = *hits[k];
            let point = samples[k].point;
            if part == number && round > 0.0 {
                // Along the sample's own normal the entry is known, and here it is next to there.
                return Some(Entry { t: into_ball(point, up, ball, round), ball, time });
            }
            let line = Line { point, direction: up, from: self.from, to };
            enter(&self.body, piece, &line).filter(|entry| entry.ball.is_finite())
        };
        let entries = [enter_at(0)?, enter_at(1)?, enter_at(2)?];
        if !piece.turns() {
            return Some(entries.map(|entry| entry.t));
        }
        let radius = round - lost(piece, &entries);
        (radius > 0.0).then(|| [0, 1, 2].map(|k| into_ball(samples[k].point, up, entries[k].ball, radius)))
    }
}

/// By how much balls in a turning cutter shrink so that it sweeps their hull too: in the middle between three balls, at
/// the middle between their times, it holds a ball that is smaller by no more than this.
///
/// Seen from the cutter, a point `c` at the time `s` is at `w = R(s)ᵀ (c − tip(s))`. The places of balls that it holds are
/// a convex set, so it holds the ball at `Σ qₖ wₖ`; the one at `Σ qₖ cₖ` and `Σ qₖ sₖ` is elsewhere by what `w` is bent.
/// `R` turns about a fixed axis at a rate of at most `ρ` and `|R″| ≤ ρ²` (for `θ = atan x` it is `√(1 + 4x²)/(1 + x²)²`
/// of that). So along `(ds, dc)` the second derivative of `w` is at most `ρ² |c − tip| ds² + 2ρ |ds| |dc − tip′ ds|`, and
/// over a triangle a function departs from the linear one by at most half of `Σᵢ<ⱼ qᵢqⱼ ≤ 1/3` times that between corners.
fn lost(piece: &Piece, entries: &[Entry; 3]) -> f64 {
    let rate = 2.0 * piece.half_turn();
    let (mut times, mut places, mut lever) = (0.0_f64, 0.0_f64, 0.0_f64);
    for (i, j) in [(0, 1), (1, 2), (2, 0)] {
        let apart = entries[i].time - entries[j].time;
        let seen = [i, j].map(|k| entries[k].ball - piece.pose(entries[k].time).tip);
        times = times.max(apart.abs());
        places = places.max(seen[0].distance(seen[1]));
        lever = lever.max(seen[0].length());
    }
    rate * times * (rate * times * lever + 2.0 * places) / 6.0
}
