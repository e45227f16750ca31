//! Between the ends of a move: points that keep the tip on its line and the axis near its own while the machine's axes go straight.

use super::ends::wrapped;
use super::stray::{Stray, TIP, Touching, across, at_contact};
use super::{Control, Kinematics, Position, Tolerance};
use crate::toolpath::ClPoint;
use glam::DVec3;

/// The largest turn of an axis in one piece, radians. Within a turn of θ the tip's bow is that of a parabola to about its θ-th part, so
/// that it is enough to look at its middle, with that part in hand.
pub(super) const LARGEST_TURN: f64 = 0.1;
/// By how much of itself a bow may differ between parts of a piece before each of them is looked at.
const UNEVEN: f64 = 0.02;
/// How often a piece may be divided: what a thousandth of a millimetre in a kilometre would ask for in halves.
const MOST_DIVIDED: u32 = 40;

/// A straight move of the tool over the part.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line<'a> {
    pub(super) from: &'a ClPoint,
    pub(super) to: &'a ClPoint,
    /// Where it touches at both ends, if that is known.
    pub(super) touching: Option<[Touching; 2]>,
}

/// A place between the ends of a move.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// Share of the move.
    pub(super) share: f64,
    /// Where the axes stand there.
    pub(super) at: Position,
    /// Where the tool then is.
    pub(super) to: ClPoint,
    /// How far the tip stands off the move's straight line, to the other side of where the pieces bow to, mm.
    off: DVec3,
}

impl Place {
    /// On the move's line.
    pub(super) fn new(share: f64, at: Position, to: ClPoint) -> Self {
        Self { share, at, to, off: DVec3::ZERO }
    }
}

/// The end of a piece.
#[derive(Debug, Clone, Copy)]
struct Left {
    end: Place,
    /// How often it was divided.
    divided: u32,
    /// Whether it was divided into so many that it keeps the tolerance for sure.
    is_sure: bool,
}

/// What following needs room for, kept from move to move.
#[derive(Debug, Default)]
pub(super) struct Room {
    /// What was found: the places of the move in their order.
    pub(super) places: Vec<Place>,
    /// Ends of pieces that are still to be gone to, the nearest last.
    left: Vec<Left>,
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
    /// Finds the places between `start` and `end` on a line, without these, in the order of the move. False if the tolerance cannot be kept.
    ///
    /// A piece that strays is divided evenly into as many as keep the tolerance: where the move's own axis is reached if its axis strays,
    /// and else where the rotary axes are at their shares. Places between them stand off the line by half of what the pieces bow, to the
    /// other side, so that the tool is off by as much to either side, and pieces may be longer. So the tool passes the pole: once a
    /// piece is so small that the axis stays within its tolerance whatever the free axis does, that axis swings round at one speed and the
    /// linear axes hold the tip.
    pub(super) fn follow(
        &self,
        line: &Line,
        [start, end]: [Position; 2],
        Room { places, left }: &mut Room,
    ) -> bool {
        places.clear();
        left.clear();
        if self.control == Control::Vector {
            return true;
        }
        left.push(Left { end: Place::new(1.0, end, *line.to), divided: 0, is_sure: false });
        let mut begin = Place::new(0.0, start, *line.from);
        while let Some(&Left { end: piece_end, divided, is_sure }) = left.last() {
            let pieces = if is_sure { Pieces::ONE } else { self.look(line, [&begin, &piece_end]) };
            if pieces.count < 2 {
                left.pop();
                if !left.is_empty() {
                    places.push(piece_end);
                }
                begin = piece_end;
                continue;
            }
            if divided == MOST_DIVIDED {
                return false;
            }
            let (divided, is_sure) = (divided + 1, pieces.is_sure);
            if let Some(last) = left.last_mut() {
                *last = Left { divided, is_sure, ..*last };
            }
            for k in (1..pieces.count).rev() {
                match self.place(line, [&begin, &piece_end], &pieces, k) {
                    Some(end) => left.push(Left { end, divided, is_sure }),
                    None => return false,
                }
            }
        }
        true
    }

    /// Into how many pieces one must be divided to keep the tolerance.
    fn look(&self, line: &Line, [begin, end]: [&Place; 2]) -> Pieces {
        let half = begin.at.lerp(&end.at, 0.5);
        let (pose, share) = (self.kinematics.pose(&half), 0.5 * (begin.share + end.share));
        let middle = between(line.from, line.to, share);
        let turn = (0..2).map(|k| (end.at.rotary[k] - begin.at.rotary[k]).abs()).fold(0.0, f64::max);
        let strays = |t: f64| {
            let at = begin.at.lerp(&end.at, t).rotary;
            let asked = between(line.from, line.to, begin.share + t * (end.share - begin.share)).axis;
            self.kinematics.pointing(at).distance(asked) > self.allowed(asked)
        };
        let leaning = if self.keeps_axis { pose.axis - middle.axis } else { DVec3::ZERO };
        let way = (line.to.tip - line.from.tip) * (end.share - begin.share);
        let strayed = pose.tip - middle.tip;
        let off = match self.control {
            Control::Axes => farthest([begin.off, end.off], across(strayed, way)),
            Control::Tip | Control::Vector => 0.5 * (begin.off + end.off),
        };
        let chord = (1.0 - turn).max(0.5) * self.tolerance.chord;
        let Stray { off, over, lean } = match line.touching {
            Some(touching) => at_contact(&touching, &middle, share, way, [off, leaning], chord),
            None => Stray { off, over: off.length() / chord, lean: 0.0 },
        };
        let mut allowed = self.allowed(middle.axis);
        if leaning.length() > allowed {
            allowed += self.rounding(line, [begin, end]);
        }
        let lean = lean.max(leaning.length() / allowed);
        let strays = lean > 1.0 || self.keeps_axis && turn > LARGEST_TURN && (strays(0.25) || strays(0.75));
        let anew = if strays {
            Anew::Always
        } else if lean > ANEW {
            Anew::Near
        } else {
            Anew::Never
        };
        if turn > LARGEST_TURN.min(self.largest_turn.max(self.step)) {
            // Far from a parabola nothing is known of how often to divide.
            return Pieces { count: 2, anew, ..Pieces::ONE };
        }
        if !strays && over <= 1.0 {
            return Pieces::ONE;
        }
        // Beside the pole axes turn unevenly; and where most of what the tip strays by lies along the move, the rest may be uneven.
        let sine = || self.kinematics.pole().map_or(1.0, |pole| pole.cross(middle.axis).length());
        let apart = if self.control == Control::Axes { strayed.length() / off.length() } else { 1.0 };
        let is_sure = anew != Anew::Always && turn * apart < UNEVEN * sine();
        if begin.off == DVec3::ZERO && end.off == DVec3::ZERO {
            let count = even(((0.5 * over).sqrt() + SHORTER).max(lean.sqrt()));
            let share = 1.0 / (count as f64 - SHORTER);
            return Pieces { count, anew, is_sure, bow: off * (share * share) };
        }
        Pieces { count: even(over.max(lean).sqrt()), anew, is_sure, bow: DVec3::ZERO }
    }

    /// How far the axis may be from `asked`.
    fn allowed(&self, asked: DVec3) -> f64 {
        let is_at_pole = || self.kinematics.pole().is_some_and(|pole| pole.cross(asked).length() < self.pole);
        if self.pole > self.tolerance.axis && is_at_pole() { self.pole } else { self.tolerance.axis }
    }

    /// What rounding its angles adds to how far the axis is off on a piece where the axis asked for stands still. A longer piece was found
    /// to keep the tolerance, and finding the angles anew would take none of this away.
    fn rounding(&self, line: &Line, [begin, end]: [&Place; 2]) -> f64 {
        let asked = line.from.axis.distance(line.to.axis) * (end.share - begin.share);
        if asked <= self.step { self.step } else { 0.0 }
    }

    /// Where one of several pieces ends; nothing if the machine cannot point the tool as asked for.
    fn place(&self, line: &Line, [begin, end]: [&Place; 2], pieces: &Pieces, k: usize) -> Option<Place> {
        let bow =
            if pieces.bow.length() > 2.0 * TIP * self.tolerance.chord { DVec3::ZERO } else { pieces.bow };
        let shorter = if bow == DVec3::ZERO { 0.0 } else { SHORTER };
        let part = (k as f64 - 0.5 * shorter) / (pieces.count as f64 - shorter);
        let share = begin.share + part * (end.share - begin.share);
        let pose = between(line.from, line.to, share);
        let mut rotary = begin.at.lerp(&end.at, part).rotary;
        if pieces.anew != Anew::Never {
            let own = self.nearest_way(&pose, rotary)?;
            let [a, b] = [begin, end].map(|place| place.at.rotary);
            let is_near = |k: usize| (own[k] - rotary[k]).abs() <= 0.25 * (b[k] - a[k]).abs();
            if pieces.anew == Anew::Always || is_near(0) && is_near(1) {
                rotary = own;
            }
        }
        let rotary = rotary.map(|angle| (angle / self.step).round() * self.step);
        let off = -0.5 * bow;
        let (at, to) = self.kinematics.standing(pose.tip + off, rotary);
        Some(Place { share, at, to, off })
    }

    /// The solution for `pose` that is nearest to `rotary`.
    fn nearest_way(&self, pose: &ClPoint, rotary: [f64; 2]) -> Option<[f64; 2]> {
        let ways = self.kinematics.ways(pose.axis)?;
        let near = ways.pairs.map(|way| [0, 1].map(|k| rotary[k] + wrapped(way[k] - rotary[k])));
        let off = |way: &[f64; 2]| (way[0] - rotary[0]).abs() + (way[1] - rotary[1]).abs();
        near.into_iter().min_by(|a, b| off(a).total_cmp(&off(b)))
    }
}

/// Where a piece is farthest off its line, if its ends are off by `ends`, it is off by `half` half-way, and it bows evenly.
fn farthest([begin, end]: [DVec3; 2], half: DVec3) -> DVec3 {
    if begin == DVec3::ZERO && end == DVec3::ZERO {
        return half;
    }
    let bow = half - 0.5 * (begin + end);
    let quarters = [0.25, 0.75].map(|t| begin.lerp(end, t) + 0.75 * bow);
    quarters
        .into_iter()
        .fold(half, |most, off| if off.length_squared() > most.length_squared() { off } else { most })
}

/// How a piece is divided.
#[derive(Debug, Clone, Copy)]
struct Pieces {
    /// How many; 1 if it keeps the tolerance as it is.
    count: usize,
    /// Whether the rotary axes between them are found for the move's own axis.
    anew: Anew,
    /// Whether each of them keeps it then for sure.
    is_sure: bool,
    /// How far each piece bows, mm, if their ends shall stand to the other side by half of it.
    bow: DVec3,
}

impl Pieces {
    const ONE: Self = Self { count: 1, anew: Anew::Never, is_sure: false, bow: DVec3::ZERO };
}

/// Whether rotary axes are found for an axis, or stand at their shares between the ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Anew {
    Always,
    /// Where that is near to their shares: beside a pole it is not, and they swing round at one speed.
    Near,
    Never,
}

/// By how much of a piece both end pieces together are shorter where the pieces between them begin and end beside the line: with their ends
/// off by half a bow, 1, they are off to both sides alike; an end piece that begins on the line and is as long as x pieces is off by at
/// most half a bow where 4 x² t (1 − t) − t / 2 ≤ 1/2 for all t, that is, for x² ≤ 0.729.
const SHORTER: f64 = 0.292;
/// The share of its tolerance beyond which the axis is found anew in places that are inserted for the tip.
const ANEW: f64 = 0.1;
/// How many pieces: at least two, and no more than what a thousandth of a millimetre in a kilometre would ask for.
fn even(pieces: f64) -> usize {
    (pieces.ceil() as usize).clamp(2, 1000)
}

/// Where the tool is at a share of a straight move.
pub(super) fn between(from: &ClPoint, to: &ClPoint, share: f64) -> ClPoint {
    let axis = from.axis.lerp(to.axis, share).try_normalize().unwrap_or(from.axis);
    ClPoint { tip: from.tip.lerp(to.tip, share), axis }
}
