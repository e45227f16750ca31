//! G-code with X, Z and C, out and in.

use super::XzcProgram;
use super::header::Meaning;
use super::scan::{Line, check_length};
use super::words::Rounding;
use crate::post::digits::{push, push_fixed};
use crate::post::number::{fixed, trimmed};
use crate::post::{ReadError, WriteError};
use crate::toolpath::{AxisPoint, Interpolation, Nose, TurningPath};

/// Whose G-code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dialect {
    /// LinuxCNC. A feed a minute counts along X and Z only.
    LinuxCnc,
    /// Fanuc lathes with G-code system B and C as a rotary axis without roll-over. A feed a minute counts X and Z in mm and C in
    /// degrees together.
    Fanuc,
}

/// How the speed of a block is stated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Feed {
    /// As the inverse of its time in minutes (G93).
    InverseTime,
    /// As millimetres, or degrees, a minute (G94).
    PerMinute,
}

/// Decimals of feeds.
const FEED_DECIMALS: usize = 4;
/// Smallest feed that the text can state.
const LEAST_FEED: f64 = 1e-4;

/// `program` as G-code. Its path must be of linear moves.
///
/// Errors: no moves; a path that is cubic in time; a number that is not finite, or time that does not rise.
pub fn write_gcode(
    program: &XzcProgram,
    dialect: Dialect,
    feed: Feed,
    rounding: &Rounding,
) -> Result<String, WriteError> {
    let points = &program.path.points;
    if program.path.interpolation != Interpolation::Linear {
        return Err(WriteError::Cubic);
    }
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return Err(WriteError::Empty) };
    check(points)?;
    let meaning = Meaning::of(program);
    let words = |p: &AxisPoint| rounding.rounded(meaning.words([p.x, p.z, p.c], false));
    let highest = points.iter().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max);
    let above = |p: &AxisPoint| AxisPoint { z: highest + program.clearance, ..*p };

    let mut text = String::with_capacity(points.len() * 48 + 1000);
    let mut line = |parts: &[&str]| {
        for part in parts {
            text.push_str(part);
        }
        text.push('\n');
    };
    line(&["%"]);
    let name = crate::post::program::plain_line(&program.part);
    match dialect {
        Dialect::LinuxCnc => {
            line(&["(", &name, ")"]);
            line(&["(", &meaning.remark(), ")"]);
            let x = if meaning.x_word == super::XWord::Diameter { "G7" } else { "G8" };
            line(&["G21 G90 G18 G94 G40 G49 G80 ", x]);
            line(&["G64 P", &trimmed(program.blend, 9)]);
            line(&[&format!("T{} M6", program.tool)]);
            line(&["G43"]);
        }
        Dialect::Fanuc => {
            line(&["O0001 (", &name, ")"]);
            line(&["(", &meaning.remark(), ")"]);
            line(&["(FANUC G-CODE SYSTEM B, C WITHOUT ROLL-OVER)"]);
            line(&["G21 G90 G18 G94 G40 G80"]);
            line(&[&format!("T{0:02}{0:02}", program.tool)]);
        }
    }
    if let (Nose::Ball(_), Some(rpm)) = (program.nose, program.spindle_rpm) {
        line(&[&format!("S{} M3", trimmed(rpm, 3))]);
    }
    let block = |motion: &str, [x, z, c]: [i64; 3], which: &str| {
        let mut block = String::from(motion);
        for (letter, value, decimals) in
            [('X', x, rounding.length), ('Z', z, rounding.length), ('C', c, rounding.angle)]
        {
            if which.contains(letter) {
                block.push(' ');
                block.push(letter);
                push(&mut block, value, decimals);
            }
        }
        block
    };
    line(&[&block("G0", words(&above(first)), "Z")]);
    line(&[&block("G0", words(first), "XC")]);
    line(&[&block("G1", words(first), "Z"), " F", &fixed(program.approach, FEED_DECIMALS)]);
    line(&["(PATH)"]);
    line(&[match feed {
        Feed::InverseTime => "G93",
        Feed::PerMinute => "G94",
    }]);
    let mut at = words(first);
    for pair in points.windows(2) {
        let to = words(&pair[1]);
        let seconds = pair[1].time - pair[0].time;
        let stated = match feed {
            Feed::InverseTime => 60.0 / seconds,
            Feed::PerMinute => 60.0 * way(dialect, rounding, at, to) / seconds,
        };
        text.push_str("G1 X");
        push(&mut text, to[0], rounding.length);
        text.push_str(" Z");
        push(&mut text, to[1], rounding.length);
        text.push_str(" C");
        push(&mut text, to[2], rounding.angle);
        text.push_str(" F");
        push_fixed(&mut text, stated.max(LEAST_FEED), FEED_DECIMALS);
        text.push('\n');
        at = to;
    }
    let mut line = |part: &str| {
        text.push_str(part);
        text.push('\n');
    };
    line("(END)");
    line("G94");
    line(&block("G0", words(&above(last)), "Z"));
    if program.spindle_rpm.is_some() && matches!(program.nose, Nose::Ball(_)) {
        line("M5");
    }
    line("M30");
    line("%");
    Ok(text)
}

/// Checks that a machine could run the points.
pub(super) fn check(points: &[AxisPoint]) -> Result<(), WriteError> {
    for (index, p) in points.iter().enumerate() {
        let finite = [p.x, p.z, p.c, p.time].iter().chain(&p.rates).all(|x| x.is_finite());
        let rises = index == 0 || p.time > points[index - 1].time;
        if !(finite && rises) {
            return Err(WriteError::NotFinite { index });
        }
    }
    Ok(())
}

/// What a feed a minute counts, in mm and degrees.
fn way(dialect: Dialect, rounding: &Rounding, from: [i64; 3], to: [i64; 3]) -> f64 {
    let [x, z, c] = rounding.value([0, 1, 2].map(|k| to[k] - from[k]));
    let flat = (x * x + z * z).sqrt();
    match dialect {
        // Degrees count where nothing else moves.
        Dialect::LinuxCnc if flat > 0.0 => flat,
        Dialect::LinuxCnc => c.abs(),
        Dialect::Fanuc => (x * x + z * z + c * c).sqrt(),
    }
}

/// The path that [`write_gcode`] wrote, with the nose that its remark states: what lies between the remarks `(PATH)` and
/// `(END)`, in absolute millimetres. Its times are those that the feeds of `dialect` mean.
///
/// Errors name the line: anything that is not a straight move within the path, words that do not belong to a lathe on X, Z and C, and
/// modes that would mean another path.
pub fn read_gcode(text: &str, dialect: Dialect) -> Result<(Nose, TurningPath), ReadError> {
    check_length(text)?;
    let mut state = State { dialect, ..State::default() };
    for (number, raw) in (1..).zip(text.lines()) {
        if raw.starts_with('O') && state.meaning.is_none() {
            continue;
        }
        let line = Line::parse(number, raw)?;
        match line.remark {
            Some("PATH") => state.begin(number, state.meaning.ok_or_else(missing)?)?,
            Some("END") => state.inside = false,
            Some(remark) => state.meaning = Meaning::announced(remark).or(state.meaning),
            None => {}
        }
        if state.run(number, &line)? {
            break;
        }
    }
    let Some(meaning) = state.meaning else { return Err(missing()) };
    if state.points.len() < 2 {
        return Err(ReadError::Missing { what: "the path", example: "(PATH), then G1 X.. Z.. C.. F.." });
    }
    Ok((meaning.nose, TurningPath { points: state.points, interpolation: Interpolation::Linear }))
}

pub(super) fn missing() -> ReadError {
    ReadError::Missing { what: "what the words mean", example: "(XZC BALL R15 TIP RADIUS TOOL)" }
}

struct State {
    dialect: Dialect,
    meaning: Option<Meaning>,
    at: [Option<f64>; 3],
    feed: Option<f64>,
    inverse: bool,
    straight: bool,
    inside: bool,
    time: f64,
    points: Vec<AxisPoint>,
}

impl Default for State {
    fn default() -> Self {
        Self {
            dialect: Dialect::LinuxCnc,
            meaning: None,
            at: [None; 3],
            feed: None,
            inverse: false,
            straight: false,
            inside: false,
            time: 0.0,
            points: Vec::new(),
        }
    }
}

impl State {
    /// The point where the path begins.
    fn begin(&mut self, number: usize, meaning: Meaning) -> Result<(), ReadError> {
        let [Some(x), Some(z), Some(c)] = self.at else {
            return Err(ReadError::statement(number, "(PATH)", "X, Z and C must be stated before"));
        };
        self.inside = true;
        let [x, z, c] = meaning.meant([x, z, c], false);
        self.points.push(AxisPoint { x, z, c, time: 0.0, rates: [0.0; 3] });
        Ok(())
    }

    /// Follows a block; true once the program has ended.
    fn run(&mut self, number: usize, line: &Line) -> Result<bool, ReadError> {
        let mut to = self.at;
        let mut moves = false;
        for &(letter, value) in line.words() {
            let error = |message: &str| {
                Err(ReadError::statement(number, &format!("{}{value}", char::from(letter)), message))
            };
            match letter {
                b'X' | b'Z' | b'C' => {
                    to[usize::from(letter == b'Z') + 2 * usize::from(letter == b'C')] = Some(value);
                    moves = true;
                }
                b'F' if value > 0.0 => self.feed = Some(value),
                b'F' => return error("a feed must be above 0"),
                b'G' => match (value * 10.0).round() as i64 {
                    0 => self.straight = false,
                    10 => self.straight = true,
                    930 => (self.inverse, self.feed) = (true, None),
                    940 => (self.inverse, self.feed) = (false, None),
                    70 | 80 | 180 | 210 | 400 | 430 | 490 | 640 | 800 | 900 => {}
                    _ => return error("is not among the G words of a path on X, Z and C"),
                },
                b'M' if value == 2.0 || value == 30.0 => return Ok(true),
                b'M' | b'N' | b'S' | b'T' | b'P' => {}
                _ => return error("is no word of a path on X, Z and C"),
            }
        }
        if moves && self.inside {
            self.go(number, to)?;
        }
        self.at = to;
        Ok(false)
    }

    fn go(&mut self, number: usize, to: [Option<f64>; 3]) -> Result<(), ReadError> {
        let error = |word: &str, message: &str| Err(ReadError::statement(number, word, message));
        let (Some(meaning), [Some(x), Some(z), Some(c)]) = (self.meaning, to) else {
            return error("X, Z, C", "must all be known");
        };
        if !self.straight {
            return error("G0", "a rapid move within the path");
        }
        let Some(feed) = self.feed else { return error("F", "is missing") };
        let [x0, z0, c0] = self.at.map(Option::unwrap_or_default);
        let flat = libm::hypot(x - x0, z - z0);
        let minutes = match (self.inverse, self.dialect) {
            (true, _) => 1.0 / feed,
            (false, Dialect::LinuxCnc) if flat > 0.0 => flat / feed,
            (false, Dialect::LinuxCnc) => (c - c0).abs() / feed,
            (false, Dialect::Fanuc) => libm::hypot(flat, c - c0) / feed,
        };
        if self.inverse {
            // Every block states its own time.
            self.feed = None;
        }
        self.time += 60.0 * minutes;
        let [x, z, c] = meaning.meant([x, z, c], false);
        self.points.push(AxisPoint { x, z, c, time: self.time, rates: [0.0; 3] });
        Ok(())
    }
}
