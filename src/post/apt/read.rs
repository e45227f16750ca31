//! APT in.

use crate::cutter::Cutter;
use crate::post::number::parse;
use crate::post::{Program, ReadError, Unit, mark};
use crate::toolpath::{ClPoint, Move, Rate, Role, Toolpath};
use glam::DVec3;

/// Longest text the reader takes, bytes: four million moves.
const MOST_BYTES: usize = 300_000_000;
/// Longest statement with all its continued lines, bytes: APT's own limit is far below.
const LONGEST_STATEMENT: usize = 10_000;

/// Words that move or place the cutter in a way this reader does not follow. Skipping them would give another path.
const REFUSED: [&str; 22] = [
    "ARCMOV", "CALL", "CIRCLE", "COPY", "CYCLE", "GOBACK", "GOCLER", "GODLTA", "GODOWN", "GOFWD", "GOLFT",
    "GORGT", "GOUP", "INDEX", "INDIRP", "INDIRV", "MACRO", "MOVARC", "ORIGIN", "ROTATE", "TRACUT", "TRANS",
];

/// What the reader passed over.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Notes {
    /// Words that say nothing to this reader, in the order they first came up, and how often each did.
    pub skipped: Vec<(String, usize)>,
    /// Whether `FINI` was there; a file without it may have been cut short.
    pub ended: bool,
}

/// The program that cutter-location text states.
///
/// Taken: blanks anywhere, lower case, `$$` comments, `$` continuation, axes left out (0, 0, 1) or not quite of unit
/// length, `CUTTER/d`, `CUTTER/d,r` or all seven values, inches, feeds a revolution, `FROM` as a first position; words
/// that neither move nor state anything are passed over. Moves before any `FEDRAT` are rapid. Moves are cuts or links
/// as the last `PPRINT/PASS n` or `PPRINT/LINK` said; before any such remark whatever is fed cuts.
///
/// Errors name the line and say what would be right; motion that cannot be followed (arcs, cycles, increments) is one.
pub fn read(text: &str) -> Result<Program, ReadError> {
    read_with_notes(text).map(|(program, _)| program)
}

/// Like [`read`], with what was passed over.
pub fn read_with_notes(text: &str) -> Result<(Program, Notes), ReadError> {
    if text.len() > MOST_BYTES {
        return Err(ReadError::TooLong { what: "bytes", limit: MOST_BYTES });
    }
    let mut reader = Reader::default();
    let mut statement = String::new();
    let mut begins = 1;
    for (line, raw) in (1..).zip(text.lines()) {
        let code = raw.find("$$").map_or(raw, |at| &raw[..at]);
        let (code, continued) = code.split_once('$').map_or((code, false), |(code, _)| (code, true));
        if statement.is_empty() {
            begins = line;
        }
        statement.push_str(code);
        if statement.len() > LONGEST_STATEMENT {
            let message = format!("a statement may have at most {LONGEST_STATEMENT} characters");
            return Err(ReadError::statement(begins, &statement, message));
        }
        if !continued {
            reader.take(begins, &statement)?;
            statement.clear();
        }
        if reader.notes.ended {
            break;
        }
    }
    reader.take(begins, &statement)?;
    reader.finish()
}

#[derive(Default)]
struct Reader {
    part: String,
    unit: Unit,
    cutter: Option<Cutter>,
    tool: Option<u32>,
    spindle_rpm: Option<f64>,
    feed: Option<f64>,
    rapid: bool,
    role: Option<Role>,
    moves: Vec<Move>,
    notes: Notes,
}

impl Reader {
    fn take(&mut self, line: usize, statement: &str) -> Result<(), ReadError> {
        let statement = statement.trim();
        if statement.is_empty() {
            return Ok(());
        }
        // `PARTNO` and `PPRINT` take free text, with or without a slash.
        let head: String = statement.chars().take(6).collect::<String>().to_ascii_uppercase();
        if head == "PARTNO" || head == "PPRINT" {
            let rest = statement[6..].trim_start().trim_start_matches('/').trim();
            if head == "PARTNO" {
                self.part = rest.to_owned();
            } else if let Some(role) = mark::announced(rest) {
                self.role = Some(role);
            }
            return Ok(());
        }
        let (word, rest) = statement.split_once('/').unwrap_or((statement, ""));
        let word: String = word.split_whitespace().collect::<String>().to_ascii_uppercase();
        let values: Vec<String> =
            rest.split(',').map(|v| v.split_whitespace().collect::<String>().to_ascii_uppercase()).collect();
        let says = Statement { line, word: &word, values: &values };
        match word.as_str() {
            "UNITS" => self.units(&says)?,
            "CUTTER" => self.cutter(&says)?,
            "LOADTL" => self.tool = says.numbers().first().map(|n| *n as u32).or(self.tool),
            "SPINDL" => self.spindle_rpm = says.numbers().first().copied().or(self.spindle_rpm),
            "RAPID" => self.rapid = true,
            "FEDRAT" => self.feed(&says)?,
            "GOTO" | "FROM" => self.goto(&says)?,
            "FINI" => self.notes.ended = true,
            "MULTAX" => {}
            refused if REFUSED.contains(&refused) => {
                return Err(says.error("cannot be followed: state the motion as GOTO/x,y,z,i,j,k"));
            }
            _ => self.skip(word),
        }
        Ok(())
    }

    fn skip(&mut self, word: String) {
        // Far more different words than APT has: a file that is no program at all must not fill the memory.
        const MOST_WORDS: usize = 200;
        let skipped = &mut self.notes.skipped;
        if let Some((_, count)) = skipped.iter_mut().find(|(known, _)| *known == word) {
            *count += 1;
        } else if skipped.len() < MOST_WORDS {
            skipped.push((word, 1));
        }
    }

    fn units(&mut self, says: &Statement) -> Result<(), ReadError> {
        let unit = match says.values[0].as_str() {
            "MM" => Unit::Mm,
            "INCH" | "INCHES" | "IN" => Unit::Inch,
            _ => return Err(says.error("must be UNITS/MM or UNITS/INCH")),
        };
        let stated = self.cutter.is_some() || !self.moves.is_empty() || self.feed.is_some();
        if stated && unit != self.unit {
            return Err(says.error("must come before the first length: move it to the top"));
        }
        self.unit = unit;
        Ok(())
    }

    fn cutter(&mut self, says: &Statement) -> Result<(), ReadError> {
        let numbers = says.all_numbers()?;
        let mm = self.unit.millimetres();
        let cutter = match numbers[..] {
            // A cutter of unstated height gets five diameters, more than any corner needs.
            [d] => Cutter::new(d * mm, 0.0, 0.0, 0.0, 5.0 * d * mm),
            [d, r] => Cutter::new(d * mm, r * mm, 0.0, 0.0, 5.0 * d * mm),
            [d, r, _, _, alpha, beta, h] => {
                let build =
                    |h: f64| Cutter::new(d * mm, r * mm, alpha.to_radians(), beta.to_radians(), h * mm);
                // A height written as the lowest possible may have been rounded below it.
                build(h).or_else(|e| if e.field == "height" { build(h + 1e-9 * h.abs()) } else { Err(e) })
            }
            _ => return Err(says.error("must have 1, 2 or 7 values: CUTTER/d,r,e,f,alpha,beta,h")),
        }
        .map_err(|source| ReadError::Cutter { line: says.line, source })?;
        if let [_, _, e, f, ..] = numbers[..] {
            // Values on paper have four decimals or more.
            let off = (cutter.center_radius - e * mm).abs().max((cutter.center_height - f * mm).abs());
            if off > 2e-3 {
                let (e, f) = (cutter.center_radius / mm, cutter.center_height / mm);
                return Err(
                    says.error(format!("with these d, r, alpha and beta, e and f must be {e:.4},{f:.4}"))
                );
            }
        }
        if self.cutter.is_some_and(|other| other != cutter) && !self.moves.is_empty() {
            return Err(says.error("a program may have one cutter: split it at the tool change"));
        }
        self.cutter = Some(cutter);
        Ok(())
    }

    fn feed(&mut self, says: &Statement) -> Result<(), ReadError> {
        let feed = *says.numbers().first().ok_or_else(|| says.error("needs a number: FEDRAT/1200,MMPM"))?;
        let has = |word: &str| says.values.iter().any(|v| v == word);
        let mm = if has("MMPM") || has("MMPR") {
            1.0
        } else if has("IPM") || has("IPR") {
            25.4
        } else {
            self.unit.millimetres()
        };
        let turns = match (has("MMPR") || has("IPR"), self.spindle_rpm) {
            (false, _) => 1.0,
            (true, Some(rpm)) => rpm,
            (true, None) => return Err(says.error("a feed a revolution needs SPINDL/rpm,CLW before it")),
        };
        let feed = feed * mm * turns;
        if !(feed > 0.0 && feed.is_finite()) {
            return Err(says.error("must be above 0"));
        }
        self.feed = Some(feed);
        Ok(())
    }

    fn goto(&mut self, says: &Statement) -> Result<(), ReadError> {
        let (tip, axis) = match says.all_numbers()?[..] {
            [x, y, z] => (DVec3::new(x, y, z), DVec3::Z),
            [x, y, z, i, j, k] => (DVec3::new(x, y, z), DVec3::new(i, j, k)),
            _ => return Err(says.error("must have 3 or 6 numbers: GOTO/x,y,z,i,j,k")),
        };
        // An axis far from unit length is a column read wrong, not a direction.
        let axis = axis
            .try_normalize()
            .filter(|_| (axis.length() - 1.0).abs() < 0.01)
            .ok_or_else(|| says.error("the axis i,j,k must have length 1"))?;
        let rate = match self.feed {
            Some(feed) if !self.rapid && says.word == "GOTO" => Rate::Feed(feed),
            _ => Rate::Rapid,
        };
        self.rapid = false;
        let to = ClPoint { tip: tip * self.unit.millimetres(), axis };
        self.moves.push(Move { to, rate, role: mark::role(self.role, rate) });
        Ok(())
    }

    fn finish(self) -> Result<(Program, Notes), ReadError> {
        let missing = |what, example| ReadError::Missing { what, example };
        let cutter = self.cutter.ok_or_else(|| missing("the cutter", "CUTTER/d,r,e,f,alpha,beta,h"))?;
        if self.moves.is_empty() {
            return Err(missing("motion", "GOTO/x,y,z,i,j,k"));
        }
        let program = Program {
            part: self.part,
            unit: self.unit,
            cutter,
            tool: self.tool.unwrap_or(1),
            spindle_rpm: self.spindle_rpm,
            toolpath: Toolpath { moves: self.moves },
        };
        Ok((program, self.notes))
    }
}

struct Statement<'a> {
    line: usize,
    word: &'a str,
    values: &'a [String],
}

impl Statement<'_> {
    fn error(&self, message: impl Into<String>) -> ReadError {
        ReadError::statement(self.line, self.word, message)
    }

    /// Those values that are numbers.
    fn numbers(&self) -> Vec<f64> {
        self.values.iter().filter_map(|v| parse(v)).collect()
    }

    fn all_numbers(&self) -> Result<Vec<f64>, ReadError> {
        let number = |v: &String| {
            let shown: String = v.chars().take(20).collect();
            parse(v).ok_or_else(|| self.error(format!("“{shown}” is not a number")))
        };
        self.values.iter().map(number).collect()
    }
}
