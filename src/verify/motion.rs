//! The cutter's motion, in pieces short enough to search.

use super::body::Body;
use super::sweeps::{Box3, Slices, slices};
use crate::toolpath::{ClPoint, Toolpath};
use glam::DVec3;
use std::ops::Range;

/// What the search for the closest approach within a piece may miss, millimetres: the aim of 0.05 µm. A local minimum of
/// a function whose second derivative is nowhere below `−κ` is within `κ/2` of the lowest value over a unit interval,
/// and `κ/2` is four times [`Piece::sag`].
const MISS: f64 = 5e-5;
/// Pieces a move is cut into at most; reached only by moves that turn by a right angle over metres.
const MOST_PIECES: f64 = 10_000.0;

/// A move or a part of it: for `s` in [0, 1] the tip is at `tip + s·travel` and the axis along `axis + s·turn`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    tip: DVec3,
    travel: DVec3,
    axis: DVec3,
    turn: DVec3,
    /// Bound of the axis' rate, radians per unit of `s`.
    rate: f64,
    /// Length of `travel`.
    length: f64,
}

/// The signed distance of a point on a line to the moving body, and its derivatives.
#[derive(Debug, Clone, Copy)]
pub(super) struct Probe {
    pub(super) distance: f64,
    /// Derivative by the piece's parameter.
    pub(super) by_time: f64,
    /// Derivative along the line.
    pub(super) by_line: f64,
    /// Unit gradient in space, out of the body.
    pub(super) gradient: DVec3,
    /// Distance of the point from the tip.
    pub(super) lever: f64,
}

impl Piece {
    fn between(from: &ClPoint, to: &ClPoint) -> Self {
        let travel = to.tip - from.tip;
        let turn = to.axis - from.axis;
        // |d axis/ds| is largest midway, where the chord is nearest to the centre of the sphere.
        let midway = (from.axis + 0.5 * turn).length();
        let rate = if turn == DVec3::ZERO { 0.0 } else { turn.length() / midway };
        Self { tip: from.tip, travel, axis: from.axis, turn, rate, length: travel.length() }
    }

    /// The part of this piece between the parameters `range`: the very same motion.
    fn part(&self, range: Range<f64>) -> Self {
        let share = range.end - range.start;
        Self {
            tip: self.tip + self.travel * range.start,
            travel: self.travel * share,
            axis: self.axis + self.turn * range.start,
            turn: self.turn * share,
            rate: self.rate * share,
            length: self.length * share,
        }
    }

    /// Boxes around what each slice of the body sweeps.
    pub(super) fn swept(&self, body: &Body) -> Slices {
        let top = body.top();
        slices(body).map(|(low, high)| {
            let mut swept = Box3::EMPTY;
            for s in [0.0, 1.0] {
                let tip = self.tip + self.travel * s;
                let axis = (self.axis + self.turn * s).normalize_or_zero();
                // The slice's cylinder, and how far its ends bulge out between the two poses of a turning axis.
                let bulge = 0.125 * self.rate * self.rate * (top + body.largest_radius());
                let wide = (DVec3::ONE - axis * axis).max(DVec3::ZERO).to_array().map(f64::sqrt);
                let margin = DVec3::from(wide) * body.largest_radius() + bulge;
                for z in [low, high] {
                    let centre = tip + axis * z;
                    swept = swept.with(centre - margin).with(centre + margin);
                }
            }
            swept
        })
    }

    /// How far, at most, the distance of a point with `lever` from the tip can bend below its tangent at mid time.
    ///
    /// The point moves in the body's frame with an acceleration of at most `rate²·lever + 2·rate·length` plus the turn's own
    /// acceleration, which is below `rate²·lever`; over half a unit of time that is an eighth of it in distance, and the
    /// distance to a convex body is itself convex.
    pub(super) fn sag(&self, lever: f64) -> f64 {
        self.rate * (self.rate * lever + self.length) * 0.25
    }

    /// Half the turn of the axis, at most, radians.
    pub(super) fn half_turn(&self) -> f64 {
        0.5 * self.rate
    }

    /// The body at parameter `s` seen from the point `x` on a line with direction `n`.
    #[inline]
    pub(super) fn probe(&self, body: &Body, s: f64, x: DVec3, n: DVec3) -> Probe {
        let w = x - self.tip - self.travel * s;
        let (axis, axis_rate) = if self.rate == 0.0 {
            (self.axis, DVec3::ZERO)
        } else {
            let raw = self.axis + self.turn * s;
            let scale = 1.0 / raw.length();
            let axis = raw * scale;
            (axis, (self.turn - axis * axis.dot(self.turn)) * scale)
        };
        let height = w.dot(axis);
        let across = w - axis * height;
        let radius = across.length();
        // On the axis every direction is as good: the distance has a level there or a symmetric tip.
        let radial = if radius > 0.0 { across / radius } else { DVec3::ZERO };
        let d = body.probe(radius, height);
        let gradient = radial * d.by_radius + axis * d.by_height;
        let by_time = -gradient.dot(self.travel)
            + (w.dot(axis_rate) * d.by_height - height * axis_rate.dot(radial) * d.by_radius);
        let lever = (radius * radius + height * height).sqrt();
        Probe { distance: d.value, by_time, by_line: gradient.dot(n), gradient, lever }
    }
}

/// All moves of a path and the pieces each is cut into.
#[derive(Debug, Clone)]
pub(super) struct Motion {
    moves: Vec<Piece>,
    pieces: Vec<Piece>,
    first: Vec<u32>,
}

impl Motion {
    /// The motion of `body` along `path`, whose axes must be unit and never turn by more than 150° in a move.
    /// The first position counts as a move that stands still.
    pub(super) fn new(body: &Body, path: &Toolpath) -> Self {
        let mut motion = Self { moves: Vec::new(), pieces: Vec::new(), first: vec![0] };
        let mut from = path.moves.first().map(|m| m.to);
        for step in &path.moves {
            let whole = Piece::between(&from.unwrap_or(step.to), &step.to);
            // The sag falls with the square of the number of pieces.
            let count = (4.0 * whole.sag(body.reach()) / MISS).sqrt().ceil().clamp(1.0, MOST_PIECES);
            for i in 0..count as usize {
                let at = |i: usize| i as f64 / count;
                motion.pieces.push(whole.part(at(i)..at(i + 1)));
            }
            motion.moves.push(whole);
            motion.first.push(motion.pieces.len() as u32);
            from = Some(step.to);
        }
        motion
    }

    /// The moves, whole.
    pub(super) fn moves(&self) -> &[Piece] {
        &self.moves
    }

    /// The pieces of move `index`, in order.
    pub(super) fn pieces(&self, index: u32) -> &[Piece] {
        let i = index as usize;
        &self.pieces[self.first[i] as usize..self.first[i + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cutter::Cutter;
    use crate::toolpath::{Move, Rate, Role};

    #[test]
    fn derivatives_match_differences_and_the_sag_bounds_them() {
        let body = Body::new(&Cutter::new(12.0, 2.0, 0.1, 0.05, 20.0).unwrap(), 50.0);
        let to =
            |tip: [f64; 3], axis: [f64; 3]| ClPoint { tip: tip.into(), axis: DVec3::from(axis).normalize() };
        let piece =
            Piece::between(&to([0.0, 1.0, 2.0], [0.1, 0.2, 1.0]), &to([1.0, 0.5, 2.2], [0.3, -0.2, 0.9]));
        let n = DVec3::new(0.1, -0.3, 0.9).normalize();
        for i in 0..50 {
            let t = f64::from(i) * 0.7;
            let x = DVec3::new(9.0 * libm::cos(t), 9.0 * libm::sin(t), 0.4 * f64::from(i) - 8.0);
            let at = |s: f64, x: DVec3| piece.probe(&body, s, x, n);
            let here = at(0.5, x);
            let d = 1e-6;
            let by_time = (at(0.5 + d, x).distance - at(0.5 - d, x).distance) / (2.0 * d);
            let by_line = (at(0.5, x + n * d).distance - at(0.5, x - n * d).distance) / (2.0 * d);
            assert!((here.by_time - by_time).abs() < 1e-4, "{i}: {here:?} {by_time}");
            assert!((here.by_line - by_line).abs() < 1e-4, "{i}: {here:?} {by_line}");
            for s in [0.0, 0.2, 0.7, 1.0] {
                let tangent = here.distance + here.by_time * (s - 0.5);
                assert!(at(s, x).distance >= tangent - piece.sag(here.lever), "{i} {s}");
            }
        }
    }

    #[test]
    fn pieces_are_the_same_motion() {
        let body = Body::new(&Cutter::ball(10.0, 20.0).unwrap(), 50.0);
        let step =
            |tip: DVec3, axis: DVec3| Move { to: ClPoint { tip, axis }, rate: Rate::Rapid, role: Role::Link };
        let moves = vec![step(DVec3::ZERO, DVec3::Z), step(DVec3::X * 30.0, DVec3::X)];
        let motion = Motion::new(&body, &Toolpath { moves });
        let pieces = motion.pieces(1);
        assert!(pieces.len() > 100);
        let x = DVec3::new(3.0, 4.0, 5.0);
        for (i, piece) in pieces.iter().enumerate() {
            let s = (i as f64 + 0.3) / pieces.len() as f64;
            let whole = motion.moves()[1].probe(&body, s, x, DVec3::Z).distance;
            assert!((piece.probe(&body, 0.3, x, DVec3::Z).distance - whole).abs() < 1e-12);
        }
    }
}
