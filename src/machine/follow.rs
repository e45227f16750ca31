//! Between the ends of a move: points that keep the tip on its line and the axis near its own while the machine's axes go straight.

use super::ends::wrapped;
use super::{Control, Kinematics, Position, Tolerance};
use crate::toolpath::ClPoint;
use glam::DVec3;

/// The largest turn of an axis in one piece, radians. Within a turn of θ the tip's bow is that of a parabola to about its θ-th part, so
/// that it is enough to look at its middle, with that part in hand.
pub(super) const LARGEST_TURN: f64 = 0.1;
/// How often a piece may be halved: what a thousandth of a millimetre in a kilometre would ask for.
const MOST_HALVINGS: u32 = 40;

/// A place between the ends of a move.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// Share of the move.
    pub(super) share: f64,
    /// Where the axes stand there; the tip is on the move's straight line.
    pub(super) at: Position,
}

/// What following needs room for, kept from move to move.
#[derive(Debug, Default)]
pub(super) struct Room {
    /// What was found: the places of the move in their order.
    pub(super) places: Vec<Place>,
    /// Ends of pieces that are still to be looked at, the nearest last, with how often each was halved.
    left: Vec<(Place, u32)>,
}

/// Follows straight moves of tip and axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Follower<'a> {
    pub(super) kinematics: &'a Kinematics,
    pub(super) control: Control,
    pub(super) tolerance: Tolerance,
    /// The tolerance of the axis within this angle of the pole, radians, if it is the larger one.
    pub(super) pole: f64,
    /// The largest turn of an axis in one piece, radians, if it is the smaller one.
    pub(super) largest_turn: f64,
    /// The step of rotary angles, radians.
    pub(super) step: f64,
    /// Whether the axis matters; it does not where the tool is turned over in the clear.
    pub(super) keeps_axis: bool,
}

impl Follower<'_> {
    /// Finds the places between `from` and `to`, without these, in the order of the move. The axes stand at `start` and `end` there.
    /// False if the tolerance cannot be kept.
    ///
    /// A piece whose axis would stray is halved where the move's own axis is reached, one whose tip would bow is halved where the
    /// rotary axes are half-way. So the tool passes the pole: once a piece is so small that the axis stays within its tolerance
    /// whatever the free axis does, that axis swings round at one speed and the linear axes hold the tip.
    pub(super) fn follow(
        &self,
        [from, to]: [&ClPoint; 2],
        [start, end]: [Position; 2],
        Room { places, left }: &mut Room,
    ) -> bool {
        places.clear();
        left.clear();
        if self.control == Control::Vector {
            return true;
        }
        left.push((Place { share: 1.0, at: end }, 0));
        let mut begin = Place { share: 0.0, at: start };
        while let Some(&(piece_end, halvings)) = left.last() {
            let middle = match self.halve([from, to], [&begin, &piece_end]) {
                Halved::Keeps => None,
                Halved::At(middle) => Some(middle),
                Halved::Never => return false,
            };
            match middle {
                Some(_) if halvings == MOST_HALVINGS => return false,
                Some(middle) => {
                    if let Some(last) = left.last_mut() {
                        last.1 += 1;
                    }
                    left.push((middle, halvings + 1));
                }
                None => {
                    left.pop();
                    if !left.is_empty() {
                        places.push(piece_end);
                    }
                    begin = piece_end;
                }
            }
        }
        true
    }

    fn halve(&self, [from, to]: [&ClPoint; 2], [begin, end]: [&Place; 2]) -> Halved {
        let share = 0.5 * (begin.share + end.share);
        let half = begin.at.lerp(&end.at, 0.5);
        let pose = self.kinematics.pose(&half);
        let turn = (0..2).map(|k| (end.at.rotary[k] - begin.at.rotary[k]).abs()).fold(0.0, f64::max);
        let strays = |t: f64| {
            let at = begin.at.lerp(&end.at, t).rotary;
            let asked = between(from, to, begin.share + t * (end.share - begin.share)).axis;
            self.kinematics.pointing(at).distance(asked) > self.allowed(asked)
        };
        let middle = between(from, to, share);
        if self.keeps_axis
            && (pose.axis.distance(middle.axis) > self.allowed(middle.axis)
                || turn > LARGEST_TURN && (strays(0.25) || strays(0.75)))
        {
            return match self.nearest_way(&middle, half.rotary) {
                Some(rotary) => self.place(share, &middle, rotary),
                None => Halved::Never,
            };
        }
        let largest = LARGEST_TURN.min(self.largest_turn.max(self.step));
        if self.control == Control::Tip && turn <= largest {
            return Halved::Keeps;
        }
        let [a, b] = [begin, end].map(|place| from.tip.lerp(to.tip, place.share));
        if turn > largest || bow(pose.tip, [a, b]) > (1.0 - turn) * self.tolerance.chord {
            return self.place(share, &middle, half.rotary);
        }
        Halved::Keeps
    }

    /// How far the axis may be from `asked`.
    fn allowed(&self, asked: DVec3) -> f64 {
        let is_at_pole = || self.kinematics.pole().is_some_and(|pole| pole.cross(asked).length() < self.pole);
        if self.pole > self.tolerance.axis && is_at_pole() { self.pole } else { self.tolerance.axis }
    }

    fn place(&self, share: f64, pose: &ClPoint, rotary: [f64; 2]) -> Halved {
        let rotary = rotary.map(|angle| (angle / self.step).round() * self.step);
        Halved::At(Place { share, at: self.kinematics.at(pose.tip, rotary) })
    }

    /// The solution for `pose` that is nearest to `rotary`.
    fn nearest_way(&self, pose: &ClPoint, rotary: [f64; 2]) -> Option<[f64; 2]> {
        let ways = self.kinematics.ways(pose.axis)?;
        let near = ways.pairs.map(|way| [0, 1].map(|k| rotary[k] + wrapped(way[k] - rotary[k])));
        let off = |way: &[f64; 2]| (way[0] - rotary[0]).abs() + (way[1] - rotary[1]).abs();
        near.into_iter().min_by(|a, b| off(a).total_cmp(&off(b)))
    }
}

enum Halved {
    /// The piece keeps the tolerance as it is.
    Keeps,
    At(Place),
    /// The machine cannot point the tool as asked for.
    Never,
}

/// How far the tip strays from a straight piece, mm, if it is at `middle` half-way.
///
/// A bow `d` carries it to `a + t (b − a) + 4 t (1 − t) d`. What of `d` lies along the piece does no harm while it is no more than a quarter of
/// the piece; beyond that the tip overshoots the ends, and all of `d` counts.
fn bow(middle: DVec3, [a, b]: [DVec3; 2]) -> f64 {
    let (way, d) = (b - a, middle - 0.5 * (a + b));
    let along = d.dot(way);
    if along.abs() <= 0.25 * way.length_squared() {
        (d - way * (along / way.length_squared().max(f64::MIN_POSITIVE))).length()
    } else {
        d.length()
    }
}

/// Where the tool is at a share of a straight move.
pub(super) fn between(from: &ClPoint, to: &ClPoint, share: f64) -> ClPoint {
    let axis = from.axis.lerp(to.axis, share).try_normalize().unwrap_or(from.axis);
    ClPoint { tip: from.tip.lerp(to.tip, share), axis }
}
