//! The cutter's motion, in parts that are short beside it.

use super::body::Body;
use crate::toolpath::{ClPoint, Toolpath};
use glam::DVec3;

/// Parts that one move is cut into at most; reached only by moves a thousand times longer than the cutter is wide.
const MOST_PARTS: f64 = 10_000.0;

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
    /// The move of the path that this is, counted from 0.
    step: u32,
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
        Self { tip: from.tip, travel, axis: from.axis, turn, rate, length: travel.length(), step: 0 }
    }

    /// The share `1/count` of this piece that begins at `index/count`: the very same motion.
    pub(super) fn part(&self, index: u32, count: u32) -> Self {
        let share = 1.0 / f64::from(count);
        let from = f64::from(index) * share;
        Self {
            tip: self.tip + self.travel * from,
            travel: self.travel * share,
            axis: self.axis + self.turn * from,
            turn: self.turn * share,
            rate: self.rate * share,
            length: self.length * share,
            step: self.step,
        }
    }

    /// Tip and unit axis at parameter `s`.
    pub(super) fn pose(&self, s: f64) -> ClPoint {
        ClPoint { tip: self.tip + self.travel * s, axis: (self.axis + self.turn * s).normalize_or(DVec3::Z) }
    }

    /// The body standing still.
    pub(super) fn still(at: &ClPoint) -> Self {
        Self::between(at, at)
    }

    /// The move of the path that this is, counted from 0; not of a pose that stands for several.
    #[cfg(feature = "study")]
    pub(super) fn step(&self) -> u32 {
        self.step
    }

    /// How far the tip travels, millimetres.
    pub(super) fn length(&self) -> f64 {
        self.length
    }

    /// How far, at most, the distance of a point with `lever` from the tip can bend below its tangent at mid time.
    ///
    /// The point moves in the body's frame with an acceleration of at most `rate²·lever + 2·rate·length` plus the turn's own
    /// acceleration, which is below `rate²·lever`; over half a unit of time that is an eighth of it in distance, and the
    /// distance to a convex body is itself convex.
    pub(super) fn sag(&self, lever: f64) -> f64 {
        self.rate * (self.rate * lever + self.length) * 0.25
    }

    /// Whether the axis turns at all.
    pub(super) fn turns(&self) -> bool {
        self.rate > 0.0
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

/// The motion of `body` along `path`, in parts during which no point of its cutting part goes much further than its
/// radius. Axes must be unit and never turn by more than 150° in a move. The first position counts as a move that stands
/// still.
pub(super) fn parts(body: &Body, path: &Toolpath) -> Vec<Piece> {
    let mut parts = Vec::with_capacity(path.moves.len());
    let mut from = path.moves.first().map(|m| m.to);
    for (number, step) in path.moves.iter().enumerate() {
        let whole = Piece { step: number as u32, ..Piece::between(&from.unwrap_or(step.to), &step.to) };
        let way = whole.length + whole.rate * body.reach();
        let count = (way / body.largest_radius()).ceil().clamp(1.0, MOST_PARTS) as u32;
        parts.extend((0..count).map(|i| whole.part(i, count)));
        from = Some(step.to);
    }
    parts
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
    fn parts_are_the_same_motion() {
        let body = Body::new(&Cutter::ball(10.0, 20.0).unwrap(), 50.0);
        let [from, to] =
            [(DVec3::ZERO, DVec3::Z), (DVec3::X * 30.0, DVec3::X)].map(|(tip, axis)| ClPoint { tip, axis });
        let moves = [from, to].map(|to| Move { to, rate: Rate::Rapid, role: Role::Link }).to_vec();
        let parts = parts(&body, &Toolpath { moves });
        assert!(parts.len() > 10);
        let whole = Piece::between(&from, &to);
        let x = DVec3::new(3.0, 4.0, 5.0);
        for (i, part) in parts[1..].iter().enumerate() {
            let s = (i as f64 + 0.3) / (parts.len() - 1) as f64;
            let there = whole.probe(&body, s, x, DVec3::Z).distance;
            assert!((part.probe(&body, 0.3, x, DVec3::Z).distance - there).abs() < 1e-12);
        }
    }
}
