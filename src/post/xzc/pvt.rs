//! Blocks of position, velocity and time, in the form of PMAC motion programs, out and in.

use super::XzcProgram;
use super::gcode::{check, missing};
use super::header::Meaning;
use super::scan::{Line, check_length};
use super::words::Rounding;
use crate::post::digits::{decimal, push, push_fixed, scaled};
use crate::post::{ReadError, WriteError};
use crate::toolpath::{AxisPoint, Interpolation, Nose, TurningPath};

/// Decimals of milliseconds: time is exact to a nanosecond.
const TIME_DECIMALS: usize = 6;
/// Decimals of velocities beyond those of positions: an error of velocity counts for the time of a block, hundredths of a second.
const MORE: usize = 1;

/// `program` as blocks `X position:velocity Z … C …`, each reached in the time stated by the last `PVT` (milliseconds);
/// velocities are in mm/s and degrees/s.
///
/// Before the path Z comes down to it, and after it goes up again, while X and C are at rest: the path itself is from rest to rest.
///
/// Errors: no moves; a number that is not finite, or time that does not rise.
pub fn write_pvt(program: &XzcProgram, rounding: &Rounding) -> Result<String, WriteError> {
    let points = &program.path.points;
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return Err(WriteError::Empty) };
    check(points)?;
    let meaning = Meaning::of(program);
    let clear = points.iter().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max) + program.clearance;
    let above = |p: &AxisPoint| AxisPoint { z: clear, rates: [0.0; 3], ..*p };
    // A cubic from rest to rest is half as fast again in its middle as on average. In whole milliseconds: no rounding of Z shows.
    let approach = |p: &AxisPoint| 1e-3 * (1.5 * 60e3 * (clear - p.z) / program.approach).ceil();

    let mut blocks =
        Blocks { text: String::with_capacity(points.len() * 80 + 1000), meaning, rounding, time: 0 };
    blocks.line(&format!("; {}", crate::post::program::plain_line(&program.part)));
    blocks.line(&format!("; {}", meaning.remark()));
    blocks.line("; X AND Z IN MM, C IN DEGREES, VELOCITIES A SECOND");
    blocks.line("OPEN PROG 1 CLEAR");
    blocks.line("ABS");
    blocks.rapid(&above(first), "Z");
    blocks.rapid(&above(first), "XC");
    blocks.reach(&AxisPoint { rates: [0.0; 3], ..*first }, approach(first));
    blocks.line("; PATH");
    for pair in points.windows(2) {
        blocks.reach(&pair[1], pair[1].time - pair[0].time);
    }
    blocks.line("; END");
    blocks.reach(&above(last), approach(last));
    blocks.line("CLOSE");
    Ok(blocks.text)
}

struct Blocks<'a> {
    text: String,
    meaning: Meaning,
    rounding: &'a Rounding,
    /// The time last stated, in its last decimal.
    time: i64,
}

impl Blocks<'_> {
    fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    fn decimals(&self, axis: usize) -> usize {
        if axis == 2 { self.rounding.angle } else { self.rounding.length }
    }

    fn rapid(&mut self, to: &AxisPoint, which: &str) {
        self.text.push_str("RAPID");
        let words = self.meaning.words([to.x, to.z, to.c], false);
        for (axis, letter) in "XZC".chars().enumerate().filter(|(_, letter)| which.contains(*letter)) {
            self.text.push(' ');
            self.text.push(letter);
            let decimals = self.decimals(axis);
            push_fixed(&mut self.text, words[axis], decimals);
        }
        self.text.push('\n');
    }

    fn reach(&mut self, to: &AxisPoint, seconds: f64) {
        let time = scaled(1e3 * seconds, TIME_DECIMALS).max(1);
        if time != self.time {
            self.time = time;
            self.text.push_str("PVT");
            push(&mut self.text, time, TIME_DECIMALS);
            self.text.push('\n');
        }
        let words = self.meaning.words([to.x, to.z, to.c], false);
        let rates = self.meaning.words(to.rates, true);
        for (axis, letter) in "XZC".chars().enumerate() {
            let decimals = self.decimals(axis);
            if axis > 0 {
                self.text.push(' ');
            }
            self.text.push(letter);
            push_fixed(&mut self.text, words[axis], decimals);
            self.text.push(':');
            push_fixed(&mut self.text, rates[axis], decimals + MORE);
        }
        self.text.push('\n');
    }
}

/// The path that [`write_pvt`] wrote, with the nose that its remark states: what lies between the remarks `PATH` and `END`.
///
/// Errors name the line.
pub fn read_pvt(text: &str) -> Result<(Nose, TurningPath), ReadError> {
    check_length(text)?;
    let mut meaning: Option<Meaning> = None;
    let (mut step, mut time) = (None, 0.0);
    let mut last: Option<AxisPoint> = None;
    let mut path = TurningPath { points: Vec::new(), interpolation: Interpolation::Pvt };
    let mut inside = false;
    for (number, raw) in (1..).zip(text.lines()) {
        let word = raw.split_whitespace().next().unwrap_or_default();
        if word == "CLOSE" {
            break;
        }
        if matches!(word, "OPEN" | "ABS" | "RAPID") {
            continue;
        }
        if let Some(stated) = word.strip_prefix("PVT") {
            let number = decimal(stated)
                .filter(|ms| *ms > 0.0)
                .ok_or_else(|| ReadError::statement(number, word, "needs a time in milliseconds above 0"))?;
            step = Some(1e-3 * number);
            continue;
        }
        let line = Line::parse(number, raw)?;
        match line.remark {
            Some("PATH") => {
                let Some(point) = last else {
                    return Err(ReadError::statement(number, "PATH", "X, Z and C must be stated before"));
                };
                path.points.push(AxisPoint { time: 0.0, ..point });
                (inside, time) = (true, 0.0);
            }
            Some("END") => inside = false,
            Some(remark) => meaning = Meaning::announced(remark).or(meaning),
            None => {}
        }
        if line.words().is_empty() {
            continue;
        }
        let &[(b'X', x), (b'x', vx), (b'Z', z), (b'z', vz), (b'C', c), (b'c', vc)] = line.words() else {
            return Err(ReadError::statement(number, raw, "must be X..:.. Z..:.. C..:.."));
        };
        let (Some(meaning), Some(step)) = (meaning, step) else {
            return Err(if meaning.is_none() {
                missing()
            } else {
                ReadError::statement(number, raw, "needs a time before it: PVT5.0")
            });
        };
        time += step;
        let [x, z, c] = meaning.meant([x, z, c], false);
        let point = AxisPoint { x, z, c, time, rates: meaning.meant([vx, vz, vc], true) };
        last = Some(point);
        if inside {
            path.points.push(point);
        }
    }
    let Some(meaning) = meaning else { return Err(missing()) };
    if path.points.len() < 2 {
        return Err(ReadError::Missing { what: "the path", example: "; PATH" });
    }
    Ok((meaning.nose, path))
}
