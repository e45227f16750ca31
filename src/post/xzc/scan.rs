//! Letters and numbers of a line, read fast: a program has a million of them.

use crate::post::ReadError;
use crate::post::digits::decimal;

/// Longest text that the readers take, bytes.
const MOST_BYTES: usize = 2_000_000_000;
/// Longest block, bytes: controls take 256 or fewer.
const LONGEST_BLOCK: usize = 2_000;

/// Checks the length of a text.
pub(super) fn check_length(text: &str) -> Result<(), ReadError> {
    if text.len() > MOST_BYTES {
        return Err(ReadError::TooLong { what: "bytes", limit: MOST_BYTES });
    }
    Ok(())
}

/// The parts of a line.
#[derive(Debug, Default)]
pub(super) struct Line<'a> {
    /// Letters with their numbers, the first `count` of them.
    words: [(u8, f64); 12],
    count: usize,
    /// The last remark.
    pub(super) remark: Option<&'a str>,
}

impl<'a> Line<'a> {
    /// Letters and numbers; remarks stand in `( )` or after `;`; a `:` between numbers makes a second one with the letter in lower case.
    pub(super) fn parse(number: usize, raw: &'a str) -> Result<Self, ReadError> {
        let error = |at: usize, message: &str| {
            Err(ReadError::statement(number, raw.get(at..).unwrap_or(raw).trim(), message))
        };
        if raw.len() > LONGEST_BLOCK {
            return error(0, "a block may have at most 2000 characters");
        }
        let bytes = raw.as_bytes();
        let mut line = Self::default();
        let (mut at, mut letter) = (0, 0u8);
        while let Some(&b) = bytes.get(at) {
            match b {
                b' ' | b'\t' | b'\r' | b'%' => at += 1,
                b';' => {
                    line.remark = raw.get(at + 1..).map(str::trim);
                    break;
                }
                b'(' => {
                    let Some(length) = raw[at..].find(')') else {
                        return error(at, "needs a closing bracket");
                    };
                    line.remark = raw.get(at + 1..at + length).map(str::trim);
                    at += length + 1;
                }
                b':' if letter != 0 => {
                    letter = letter.to_ascii_lowercase();
                    at = line.number(number, raw, at + 1, letter)?;
                }
                _ if b.is_ascii_alphabetic() => {
                    letter = b.to_ascii_uppercase();
                    at = line.number(number, raw, at + 1, letter)?;
                }
                _ => return error(at, "must be a letter followed by a number"),
            }
        }
        Ok(line)
    }

    /// Takes the number that starts at `at`; gives the place after it.
    fn number(&mut self, number: usize, raw: &str, at: usize, letter: u8) -> Result<usize, ReadError> {
        let rest = &raw.as_bytes()[at..];
        let length =
            rest.iter().take_while(|b| b.is_ascii_digit() || matches!(b, b'.' | b'-' | b'+')).count();
        let value = raw.get(at..at + length).and_then(decimal);
        let Some(value) = value else {
            return Err(ReadError::statement(
                number,
                &raw[at - 1..],
                "must be a letter followed by a number",
            ));
        };
        let Some(word) = self.words.get_mut(self.count) else {
            return Err(ReadError::statement(number, raw, "has more than 12 words"));
        };
        *word = (letter, value);
        self.count += 1;
        Ok(at + length)
    }

    /// The words in their order.
    pub(super) fn words(&self) -> &[(u8, f64)] {
        &self.words[..self.count]
    }
}
