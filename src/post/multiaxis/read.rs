//! Programs in.

use super::Dialect;
use super::format::{Format, Meaning};
use super::scan::{Line, Word};
use crate::machine::{Control, Kinematics, Position, Tolerance, trace};
use crate::post::{ReadError, mark};
use crate::toolpath::{ClPoint, Move, Rate, Role, Toolpath};
use glam::DVec3;

/// Longest text the reader takes, bytes.
const MOST_BYTES: usize = 2_000_000_000;

/// The path of the tool on the workpiece that `text`, in `dialect`, makes the machine go.
///
/// Positions of axes become poses through the machine's kinematics. Between blocks places are added so that straight moves of tip and
/// axis stay within `tolerance` of how the control goes: all axes straight, or the tip straight and the rotary axes as well.
/// `(PASS n)` and `(LINK)` say what the moves after them are for. The path begins with the first position after the tool's
/// length was switched on, and ends when it is switched off; before and after, the machine may move in its own coordinates.
///
/// Errors name the line: a word that is not known in the dialect, a position beyond the limits of an axis, a tool of another length, and
/// whatever would mean another path.
pub fn read(
    text: &str,
    dialect: Dialect,
    kinematics: &Kinematics,
    tolerance: &Tolerance,
) -> Result<Toolpath, ReadError> {
    if text.len() > MOST_BYTES {
        return Err(ReadError::TooLong { what: "bytes", limit: MOST_BYTES });
    }
    let mut state = State::new(dialect.format(), kinematics, tolerance);
    let mut line = Line::default();
    for (number, raw) in (1..).zip(text.lines()) {
        line.fill(state.format, number, raw)?;
        if let Some(role) = line.remark.and_then(mark::announced) {
            state.role = Some(role);
        }
        if state.run(number, &line)? {
            break;
        }
    }
    if state.path.moves.is_empty() {
        return Err(ReadError::Missing {
            what: "motion",
            example: "the tool's length switched on, then G0 X0 Y0 Z50",
        });
    }
    Ok(state.path)
}

struct State<'a> {
    format: &'static Format,
    kinematics: &'a Kinematics,
    tolerance: &'a Tolerance,
    straight: Option<bool>,
    inverse: bool,
    feed: Option<f64>,
    /// X, Y, Z and the rotary axes as stated.
    at: [Option<f64>; 5],
    /// The direction of the tool as stated.
    direction: [Option<f64>; 3],
    /// Whether words state the path.
    on: bool,
    role: Option<Role>,
    last: Option<Pose>,
    path: Toolpath,
    places: Vec<ClPoint>,
}

/// Where a block ends.
#[derive(Clone, Copy)]
enum Pose {
    /// As the axes stand.
    Axes(Position),
    /// As the tool stands.
    Tool(ClPoint),
}

/// What a block asks for besides modes.
#[derive(Default)]
struct Asked {
    moves: bool,
    machine: bool,
    rapid: bool,
    ends: bool,
    fed: bool,
}

impl<'a> State<'a> {
    fn new(format: &'static Format, kinematics: &'a Kinematics, tolerance: &'a Tolerance) -> Self {
        Self {
            format,
            kinematics,
            tolerance,
            straight: None,
            inverse: false,
            feed: None,
            at: [None; 5],
            direction: [None; 3],
            on: false,
            role: None,
            last: None,
            path: Toolpath::default(),
            places: Vec::new(),
        }
    }

    /// Follows one block; true once the program has ended.
    fn run(&mut self, number: usize, line: &Line) -> Result<bool, ReadError> {
        let mut asked = Asked::default();
        // Modes act before the words that they change, wherever these stand in the block.
        let mut length = false;
        for word in &line.words {
            if let Some(meaning) = self.meaning(word) {
                length |= meaning == Meaning::PathOnWithLength;
                self.mode(meaning, &mut asked);
            }
        }
        for word in &line.words {
            match (self.axis(word), word.number) {
                (Some(2), Some(stated)) if length => self.check_length(number, stated)?,
                (Some(k), Some(value)) => {
                    let place = if k < 5 { &mut self.at[k] } else { &mut self.direction[k - 5] };
                    *place = Some(value);
                    asked.moves = true;
                }
                (None, Some(feed)) if word.name == "F" => {
                    if feed <= 0.0 {
                        return Err(error(number, word, "a feed must be above 0"));
                    }
                    (self.feed, asked.fed) = (Some(feed), true);
                }
                _ if self.meaning(word).is_some() => {}
                _ => {
                    let message = format!("is no word of {} that is followed here", self.format.name);
                    return Err(error(number, word, &message));
                }
            }
        }
        if asked.machine && self.on {
            return Err(ReadError::statement(
                number,
                "machine coordinates",
                "must not stand within the path",
            ));
        }
        if asked.machine {
            // Where that is on the workpiece nobody asks.
            self.at[..3].fill(None);
        } else if asked.moves && self.on {
            self.go(number, &asked)?;
        }
        Ok(asked.ends)
    }

    fn meaning(&self, word: &Word) -> Option<Meaning> {
        if matches!(word.name, "X" | "Y" | "Z" | "A" | "B" | "C" | "F") {
            // Most words by far, and modes in no dialect.
            return None;
        }
        let is = |known: &&(&str, Option<f64>, Meaning)| {
            known.0 == word.name && known.1.is_none_or(|number| word.number == Some(number))
        };
        self.format.words.iter().find_map(|words| words.iter().find(is)).map(|known| known.2)
    }

    /// The place of a word's number: X, Y, Z, the rotary axes, and the components of a direction.
    fn axis(&self, word: &Word) -> Option<usize> {
        if self.format.control == Control::Vector && self.on {
            let is = |name: &&str| name.trim_end_matches('=') == word.name;
            if let Some(k) = self.format.vector.iter().position(is) {
                return Some(5 + k);
            }
        }
        let mut name = word.name.chars();
        let (Some(letter), None) = (name.next(), name.next()) else { return None };
        let k = self.kinematics.axes().iter().position(|axis| axis.letter == letter)?;
        // Within a path of directions the rotary axes are the control's own.
        (k < 3 || self.format.control != Control::Vector || !self.on).then_some(k)
    }

    fn mode(&mut self, meaning: Meaning, asked: &mut Asked) {
        match meaning {
            Meaning::Rapid => self.straight = Some(false),
            Meaning::Straight => self.straight = Some(true),
            Meaning::RapidOnce => asked.rapid = true,
            Meaning::InverseTime => (self.inverse, self.feed) = (true, None),
            Meaning::PerMinute => (self.inverse, self.feed) = (false, None),
            Meaning::PathOn | Meaning::PathOnWithLength => {
                self.on = true;
                if self.format.control != Control::Axes {
                    // X, Y and Z were positions of axes up to here.
                    self.at[..3].fill(None);
                }
            }
            Meaning::PathOff => self.on = false,
            Meaning::MachineCoordinates => asked.machine = true,
            Meaning::End => asked.ends = true,
            Meaning::Nothing => {}
        }
    }

    fn check_length(&self, number: usize, stated: f64) -> Result<(), ReadError> {
        let length = self.kinematics.tool_length();
        if (stated - length).abs() > 1e-3 {
            let message = format!("the tool's length must be {length} mm, for which the machine was set up");
            return Err(ReadError::statement(number, &format!("Z{stated}"), message));
        }
        Ok(())
    }

    fn go(&mut self, number: usize, asked: &Asked) -> Result<(), ReadError> {
        let wrong = |word: &str, message: &str| Err(ReadError::statement(number, word, message));
        let rapid = match self.straight {
            Some(straight) => asked.rapid || !straight,
            None => return wrong("motion", "needs a rapid or a straight move before it"),
        };
        let Some(pose) = self.pose(number)? else { return Ok(()) };
        let feed = match (rapid, self.inverse, asked.fed, self.feed) {
            (true, ..) => None,
            (false, true, false, _) => {
                return wrong("F", "is missing: every block states its own inverse time");
            }
            (false, _, _, None) => return wrong("F", "is missing"),
            (false, _, _, feed) => feed,
        };
        self.places.clear();
        match (self.last, pose) {
            (Some(Pose::Axes(from)), Pose::Axes(to)) => {
                trace(self.kinematics, self.format.control, [&from, &to], self.tolerance, &mut self.places);
            }
            (_, Pose::Axes(at)) => self.places.push(self.kinematics.pose(&at)),
            (_, Pose::Tool(at)) => self.places.push(at),
        }
        let rate = match feed {
            None => Rate::Rapid,
            Some(feed) if self.inverse => Rate::Feed(self.speed(feed)),
            Some(feed) => Rate::Feed(feed),
        };
        let role = mark::role(self.role, rate);
        self.path.moves.extend(self.places.iter().map(|&to| Move { to, rate, role }));
        self.last = Some(pose);
        Ok(())
    }

    /// The feed of the tip that an inverse time means over the places of the block, mm/min.
    fn speed(&self, per_minute: f64) -> f64 {
        let mut length = 0.0;
        let mut last = self.path.moves.last().map(|step| step.to.tip);
        for place in &self.places {
            length += last.map_or(0.0, |last| last.distance(place.tip));
            last = Some(place.tip);
        }
        // A block that only turns the tool has no feed of the tip: the least that counts as one.
        (length * per_minute).max(1e-6)
    }

    /// Where the words put the tool, once all of them are known.
    fn pose(&self, number: usize) -> Result<Option<Pose>, ReadError> {
        let [Some(x), Some(y), Some(z), ..] = self.at else { return Ok(None) };
        let stated = DVec3::new(x, y, z);
        if self.format.control == Control::Vector {
            let [Some(i), Some(j), Some(k)] = self.direction else { return Ok(None) };
            let axis = DVec3::new(i, j, k);
            let Some(axis) = axis.try_normalize().filter(|_| (axis.length() - 1.0).abs() < 0.01) else {
                return Err(ReadError::statement(number, "direction", "must have length 1"));
            };
            return Ok(Some(Pose::Tool(ClPoint { tip: stated, axis })));
        }
        let mut rotary = [0.0; 2];
        for (angle, stated) in rotary.iter_mut().zip(&self.at[3..]).take(self.kinematics.axes().len() - 3) {
            let Some(degrees) = stated else { return Ok(None) };
            *angle = degrees.to_radians();
        }
        let at = match self.format.control {
            Control::Axes => Position { linear: stated + self.kinematics.program_zero(), rotary },
            Control::Tip | Control::Vector => self.kinematics.at(stated, rotary),
        };
        self.check_limits(number, &at)?;
        Ok(Some(Pose::Axes(at)))
    }

    /// Limits, give or take the rounding of words.
    fn check_limits(&self, number: usize, at: &Position) -> Result<(), ReadError> {
        const ROUNDING: f64 = 1e-3;
        for (axis, position) in self.kinematics.axes().iter().zip(at.all()) {
            let Some([low, high]) = axis.limits else { continue };
            if position < low - ROUNDING || position > high + ROUNDING {
                let message = format!(
                    "must be between {:.3} and {:.3} in machine coordinates, and goes to {:.3}",
                    axis.shown(low),
                    axis.shown(high),
                    axis.shown(position)
                );
                return Err(ReadError::statement(number, &axis.letter.to_string(), message));
            }
        }
        Ok(())
    }
}

fn error(line: usize, word: &Word, message: &str) -> ReadError {
    let number = word.number.map_or(String::new(), |number| number.to_string());
    ReadError::statement(line, &format!("{}{number}", word.name), message)
}
