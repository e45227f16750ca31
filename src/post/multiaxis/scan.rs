//! Words of a line.

use super::format::Format;
use crate::post::ReadError;
use crate::post::digits::decimal;

/// Longest block, bytes: controls take 256 or fewer.
const LONGEST_BLOCK: usize = 2_000;

/// A name with its number, as `X12.5`, `A3=0.5`, `TRAORI`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Word<'a> {
    pub(super) name: &'a str,
    pub(super) number: Option<f64>,
}

/// The parts of a line.
#[derive(Debug, Default)]
pub(super) struct Line<'a> {
    pub(super) words: Vec<Word<'a>>,
    /// The last remark.
    pub(super) remark: Option<&'a str>,
}

impl<'a> Line<'a> {
    /// Takes a line apart, in place of the one before. Lines that say nothing of the path come out empty.
    pub(super) fn fill(&mut self, format: &Format, number: usize, raw: &'a str) -> Result<(), ReadError> {
        let error = |word: &str, message: &str| Err(ReadError::statement(number, word, message));
        self.words.clear();
        self.remark = None;
        if raw.len() > LONGEST_BLOCK {
            return error("block", "may have at most 2000 characters");
        }
        let mut rest = raw.trim();
        if format.counted {
            let count = rest.bytes().take_while(u8::is_ascii_digit).count();
            if count == 0 && !rest.is_empty() {
                return error(rest, "must begin with the number of the block");
            }
            rest = rest[count..].trim_start();
        }
        if format.passed.iter().any(|passed| rest.starts_with(passed)) {
            return Ok(());
        }
        let [open, close] = format.remark.map(str::trim);
        while !rest.is_empty() {
            if let Some(inside) = rest.strip_prefix(open) {
                if close.is_empty() {
                    self.remark = Some(inside.trim());
                    break;
                }
                let Some((inside, after)) = inside.split_once(close) else {
                    return error(rest, "needs a closing bracket");
                };
                self.remark = Some(inside.trim());
                rest = after.trim_start();
                continue;
            }
            rest = self.word(number, rest)?.trim_start();
        }
        Ok(())
    }

    /// Takes the word at the beginning of `rest`; gives what follows.
    fn word(&mut self, line: usize, rest: &'a str) -> Result<&'a str, ReadError> {
        let bytes = rest.as_bytes();
        let letters = bytes.iter().take_while(|b| b.is_ascii_alphabetic()).count();
        let error = |message: &str| Err(ReadError::statement(line, rest, message));
        if letters == 0 {
            return error("must be a word: a name and a number");
        }
        // Siemens counts names that belong together, and tells them from their numbers: A3=0.5.
        let counted = bytes[letters..].iter().take_while(|b| b.is_ascii_digit()).count();
        let (name, from) = match bytes.get(letters + counted) {
            Some(b'=') => (letters + counted, letters + counted + 1),
            _ => (letters, letters),
        };
        let length =
            bytes[from..].iter().take_while(|b| matches!(b, b'0'..=b'9' | b'.' | b'+' | b'-')).count();
        let number = match length {
            0 if from == name => None,
            _ => match decimal(&rest[from..from + length]) {
                Some(number) => Some(number),
                None => return error("must be a word: a name and a number"),
            },
        };
        self.words.push(Word { name: &rest[..name], number });
        Ok(&rest[from + length..])
    }
}
