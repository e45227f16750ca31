//! G-code in.

use crate::post::number::parse;
use crate::post::{ReadError, Unit, mark};
use crate::toolpath::{ClPoint, Move, Rate, Role, Toolpath};
use glam::DVec3;

/// Longest text the reader takes, bytes.
const MOST_BYTES: usize = 300_000_000;
/// Longest block, bytes: controls take 256 or fewer.
const LONGEST_BLOCK: usize = 2_000;

/// The path of a three-axis program: straight moves (`G0`, `G1`) in absolute coordinates, millimetres or inches.
///
/// Modal words hold until changed. Comments stand in `( )` or after `;`; `(PASS n)` and `(LINK)` say what the moves
/// after them are for, and before any such remark whatever is fed cuts. The path begins once X, Y and Z are all
/// known. Spindle, tool, coolant, offset and line numbers are passed over; `M2` or `M30` ends the program.
///
/// Errors name the line: arcs, cycles, increments, rotary axes, variables, subprograms, and every G word not known to
/// leave the path alone.
pub fn read(text: &str) -> Result<Toolpath, ReadError> {
    if text.len() > MOST_BYTES {
        return Err(ReadError::TooLong { what: "bytes", limit: MOST_BYTES });
    }
    let mut state = State::default();
    for (line, raw) in (1..).zip(text.lines()) {
        let block = Block::parse(line, raw)?;
        if state.run(&block)? {
            break;
        }
    }
    if state.moves.is_empty() {
        return Err(ReadError::Missing { what: "motion", example: "G0 X0 Y0 Z50" });
    }
    Ok(Toolpath { moves: state.moves })
}

/// Letters and numbers of a line, and its last remark.
struct Block {
    line: usize,
    words: Vec<(char, f64)>,
    remark: Option<Role>,
}

impl Block {
    fn parse(line: usize, raw: &str) -> Result<Self, ReadError> {
        let error = |word: &str, message: &str| ReadError::statement(line, word, message);
        if raw.len() > LONGEST_BLOCK {
            return Err(error("block", "may have at most 2000 characters"));
        }
        let mut code = String::new();
        let mut remark = None;
        let mut rest = raw.split(';').next().unwrap_or_default();
        while let Some((before, after)) = rest.split_once('(') {
            code.push_str(before);
            let (inside, after) =
                after.split_once(')').ok_or_else(|| error("(", "needs a closing bracket"))?;
            remark = mark::announced(inside).or(remark);
            rest = after;
        }
        code.push_str(rest);
        let code: String = code.chars().filter(|c| !c.is_whitespace() && *c != '%').collect();
        if code.starts_with('/') {
            return Err(error("/", "says that the block may be left out: remove the sign or the block"));
        }
        let mut words = Vec::new();
        let mut rest = code.as_str();
        while let Some(letter) = rest.chars().next() {
            if !letter.is_ascii_alphabetic() {
                return Err(error(rest, "must be a letter followed by a number"));
            }
            let value = &rest[1..];
            let end = value.find(|c: char| !c.is_ascii_digit() && !"+-.".contains(c)).unwrap_or(value.len());
            let number =
                parse(&value[..end]).ok_or_else(|| error(rest, "must be a letter followed by a number"))?;
            words.push((letter.to_ascii_uppercase(), number));
            rest = &value[end..];
        }
        Ok(Self { line, words, remark })
    }
}

#[derive(Default)]
struct State {
    unit: Unit,
    linear: Option<bool>,
    feed: Option<f64>,
    at: [Option<f64>; 3],
    role: Option<Role>,
    moves: Vec<Move>,
}

impl State {
    /// Follows one block; true once the program has ended.
    fn run(&mut self, block: &Block) -> Result<bool, ReadError> {
        self.role = block.remark.or(self.role);
        // Words act in the control's order, not in the line's: modes first, then feed, then motion.
        let mut dwells = false;
        for &(letter, number) in &block.words {
            if letter == 'G' {
                dwells |= self.mode(block.line, number)?;
            }
        }
        let mut moves = false;
        let mut ends = false;
        for &(letter, number) in &block.words {
            let error =
                |message: &str| Err(ReadError::statement(block.line, &format!("{letter}{number}"), message));
            let mm = self.unit.millimetres();
            match letter {
                'X' | 'Y' | 'Z' if !dwells => {
                    self.at["XYZ".find(letter).unwrap_or(0)] = Some(number * mm);
                    moves = true;
                }
                'F' if number <= 0.0 => return error("a feed must be above 0"),
                'F' if !dwells => self.feed = Some(number * mm),
                'A' | 'B' | 'C' | 'U' | 'V' | 'W' => {
                    return error("only X, Y and Z are followed: state other paths as APT");
                }
                'I' | 'J' | 'K' | 'R' => return error("arcs are not followed: state them as short G1 moves"),
                'M' if [2.0, 30.0].contains(&number) => ends = true,
                'M' if [97.0, 98.0, 99.0].contains(&number) => {
                    return error("subprograms are not followed: write them out");
                }
                'G' | 'M' | 'N' | 'O' | 'T' | 'S' | 'H' | 'D' | 'P' | 'F' | 'X' | 'Y' | 'Z' => {}
                _ => return error("is not known"),
            }
        }
        if moves {
            self.go(block.line)?;
        }
        Ok(ends)
    }

    /// Follows a G word; true for a dwell, whose X and P are times.
    fn mode(&mut self, line: usize, number: f64) -> Result<bool, ReadError> {
        let error = |message: &str| Err(ReadError::statement(line, &format!("G{number}"), message));
        // Tenths keep G59.1 apart from G59 without comparing fractions.
        match (number * 10.0).round() as i64 {
            0 => self.linear = Some(false),
            10 => self.linear = Some(true),
            40 => return Ok(true),
            200 => self.unit = Unit::Inch,
            210 => self.unit = Unit::Mm,
            // Planes, offsets off or on, work coordinates, path modes, cycles off, absolute, feed a minute.
            170 | 180 | 190 | 400 | 430 | 490 | 540..=593 | 610 | 611 | 640 | 800 | 900 | 940 => {}
            20 | 30 => return error("arcs are not followed: state them as short G1 moves"),
            910 => return error("increments are not followed: write absolute coordinates (G90)"),
            930 | 950 => return error("must be a feed a minute (G94)"),
            _ => {
                return error(
                    "is not among the G words that are followed: 0, 1, 4, 17–21, 40, 43, 49, 54–59, 61, 64, 80, 90, 94",
                );
            }
        }
        Ok(false)
    }

    fn go(&mut self, line: usize) -> Result<(), ReadError> {
        let error = |word: &str, message: &str| Err(ReadError::statement(line, word, message));
        let rate = match (self.linear, self.feed) {
            (Some(false), _) => Rate::Rapid,
            (Some(true), Some(feed)) => Rate::Feed(feed),
            (Some(true), None) => return error("G1", "needs a feed: F1200"),
            (None, _) => return error("X, Y, Z", "need G0 or G1 before them"),
        };
        if let [Some(x), Some(y), Some(z)] = self.at {
            let to = ClPoint { tip: DVec3::new(x, y, z), axis: DVec3::Z };
            self.moves.push(Move { to, rate, role: mark::role(self.role, rate) });
        }
        Ok(())
    }
}
