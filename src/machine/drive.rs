//! From a toolpath to the motion of a machine's axes.

use super::ball::Ball;
use super::choose::choose;
use super::follow::{Follower, Line, Place, Room};
use super::stray::Touching;
use super::{Axis, AxisMove, AxisPath, Following, Kinematics, MotionError, Position};
use crate::toolpath::{ClPoint, Move, Rate, Role, Toolpath};
use glam::DVec3;

/// How the machine's axes go so that its tool goes along `path`.
///
/// At the end of every move the tip is where the path has it, exactly, and the axis within the rounding of the rotary axes. Between them
/// both keep to the tolerances of `how`. Rotary axes run on beyond a turn and never jump back; where one meets its limit the tool
/// draws back on a link, is turned over, and returns.
///
/// The feed is that of the contact with the part, whose places at the ends of the moves are `contacts`; where a move has none at either
/// end, and beyond the end of the slice, that of the tip. It is asked for, and lowered where an axis would go faster than it can. Where
/// contacts are known at both ends of a move the tolerance of the tip is that of its contact across the surface.
///
/// Errors name the move, its end, and the axis: a pose that the machine cannot reach, a limit that the path leaves, a turn for which the path
/// offers no link.
pub fn drive(
    kinematics: &Kinematics,
    path: &Toolpath,
    contacts: &[Option<Touching>],
    how: &Following,
) -> Result<AxisPath, MotionError> {
    let chosen = choose(kinematics, path, 0.5 * how.feed.axis.max(how.pole))?;
    let mut driver = Driver {
        kinematics,
        how,
        cuts: Ball::around(path),
        room: Room::default(),
        path: AxisPath::default(),
    };
    driver.path.moves.reserve(path.moves.len());
    for (index, (step, chosen)) in path.moves.iter().zip(&chosen).enumerate() {
        let contact = |k: usize| contacts.get(k).copied().flatten();
        let before = index.checked_sub(1);
        let touching = before.and_then(contact).zip(contact(index)).map(|(from, to)| [from, to]);
        let length = match (touching, before) {
            (Some([from, to]), _) => from.point.distance(to.point),
            (None, Some(before)) => step.to.tip.distance(path.moves[before].to.tip),
            (None, None) => 0.0,
        };
        let normal = contact(index).map(|at| at.normal);
        let leg = Leg { step, source: index, length, keeps_axis: true, touching, normal };
        driver.go(leg, driver.snapped(chosen.arrive))?;
        if let Some(leave) = chosen.leave {
            driver.turn_over(index, step, driver.snapped(leave))?;
        }
    }
    Ok(driver.path)
}

/// A straight move of the tool.
struct Leg<'a> {
    step: &'a Move,
    source: usize,
    /// The way that the feed counts, mm.
    length: f64,
    keeps_axis: bool,
    /// Where the cutter touches at both ends.
    touching: Option<[Touching; 2]>,
    /// The surface's normal at its end, if it touches there.
    normal: Option<DVec3>,
}

struct Driver<'a> {
    kinematics: &'a Kinematics,
    how: &'a Following,
    cuts: Ball,
    room: Room,
    path: AxisPath,
}

impl Driver<'_> {
    /// Rotary angles in whole steps, within the limits.
    fn snapped(&self, rotary: [f64; 2]) -> [f64; 2] {
        let step = self.how.rotary_step;
        [0, 1].map(|k| {
            let steps = (rotary[k] / step).round();
            let limits = self.kinematics.axes().get(3 + k).and_then(|axis: &Axis| axis.limits);
            match limits {
                Some([low, _]) if steps * step < low => (low / step).ceil() * step,
                Some([_, high]) if steps * step > high => (high / step).floor() * step,
                _ => steps * step,
            }
        })
    }

    fn go(&mut self, leg: Leg, rotary: [f64; 2]) -> Result<(), MotionError> {
        let &Leg { step, source, length, keeps_axis, touching, .. } = &leg;
        let end = self.kinematics.at(step.to.tip, rotary);
        let Some(last) = self.path.moves.last() else {
            return self.push(&leg, Place::new(1.0, end, step.to), 0.0);
        };
        let (tolerance, pole) = match step.rate {
            Rate::Rapid => (self.how.rapid, 0.0),
            Rate::Feed(_) => (self.how.feed, self.how.pole),
        };
        let (kinematics, control, step_angle) = (self.kinematics, self.how.control, self.how.rotary_step);
        let largest_turn = self.how.largest_turn;
        let follower =
            Follower { kinematics, control, tolerance, pole, largest_turn, step: step_angle, keeps_axis };
        let mut room = std::mem::take(&mut self.room);
        let line = Line { from: &last.to, to: &step.to, touching };
        if !follower.follow(&line, [last.at, end], &mut room) {
            return Err(MotionError::Jump { index: source, point: step.to.tip });
        }
        let mut before = 0.0;
        for &place in room.places.iter().chain([&Place::new(1.0, end, step.to)]) {
            self.push(&leg, place, (place.share - before) * length)?;
            before = place.share;
        }
        self.room = room;
        Ok(())
    }

    fn push(&mut self, leg: &Leg, place: Place, length: f64) -> Result<(), MotionError> {
        let &Leg { step, source, .. } = leg;
        // At the end the tool stands as the path says, but for the rounding of the rotary axes.
        let (is_end, to) = (place.share == 1.0, place.to);
        let mut axes = self.kinematics.axes().iter().zip(place.at.all());
        if let Some((axis, position)) = axes.find(|(axis, position)| !axis.holds(*position)) {
            return Err(MotionError::limit(source, to.tip, axis, position));
        }
        let asked = match step.rate {
            Rate::Rapid => 0.0,
            Rate::Feed(feed) => 60.0 * length / feed,
        };
        let least = |last: &AxisMove| least_time(self.kinematics.axes(), &last.at, &place.at);
        let seconds = self.path.moves.last().map_or(0.0, |last| least(last).max(asked));
        let (at, Move { rate, role, .. }) = (place.at, *step);
        let normal = match leg.touching {
            Some([from, to]) if !is_end => Some(from.normal.lerp(to.normal, place.share)),
            _ => leg.normal.filter(|_| is_end),
        };
        let turns_over = false;
        self.path.moves.push(AxisMove {
            at,
            to,
            rate,
            role,
            seconds,
            asked,
            normal,
            turns_over,
            source,
            is_end,
        });
        Ok(())
    }

    /// Draws the tool back along its axis until its tip is beyond every cut, turns the rotary axes to `leave` while the tip stays, and
    /// returns.
    fn turn_over(&mut self, index: usize, step: &Move, leave: [f64; 2]) -> Result<(), MotionError> {
        let arrived = self.path.moves.len();
        self.path.turn_overs += 1;
        let mut result = Ok(());
        // As far beyond as the limits let it.
        for share in [1.0, 0.5, 0.25, 0.0] {
            self.path.moves.truncate(arrived);
            let by = self.cuts.way_out(&step.to, share * self.how.clearance);
            result = self.turn_over_at(index, step, leave, by);
            if result.is_ok() {
                break;
            }
        }
        result
    }

    fn turn_over_at(
        &mut self,
        index: usize,
        step: &Move,
        leave: [f64; 2],
        by: f64,
    ) -> Result<(), MotionError> {
        let Some(arrived) = self.path.moves.last().map(|last| last.at.rotary) else { return Ok(()) };
        let begin = self.path.moves.len();
        let back = ClPoint { tip: step.to.tip + by * step.to.axis, axis: step.to.axis };
        for (to, rotary, keeps_axis) in [(back, arrived, true), (back, leave, false), (step.to, leave, true)]
        {
            let step = Move { to, rate: Rate::Rapid, role: Role::Link };
            self.go(
                Leg { step: &step, source: index, length: 0.0, keeps_axis, touching: None, normal: None },
                rotary,
            )?;
        }
        for added in &mut self.path.moves[begin..] {
            (added.is_end, added.turns_over) = (false, true);
        }
        Ok(())
    }
}

/// The shortest time in which the axes go from one position to another at constant speed, s.
fn least_time(axes: &[Axis], from: &Position, to: &Position) -> f64 {
    let ways = from.all().into_iter().zip(to.all()).map(|(a, b)| (b - a).abs());
    axes.iter().zip(ways).map(|(axis, way)| way / axis.speed).fold(0.0, f64::max)
}
