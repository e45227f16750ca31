//! Cards of 80 columns into global section, directory and parameters.

use super::record::{self, Delimiters, Field};
use super::{Format, ImportError, Place, fault};

/// Columns of data on a card, before the section's letter.
const DATA: usize = 72;
/// Columns of data on a card of the parameter section, before the pointer back to the directory.
const PARAMETER_DATA: usize = 64;

/// An IGES file, taken apart.
pub(super) struct File {
    /// Fields of the global section, the two delimiters first.
    pub(super) global: Vec<Field>,
    pub(super) directory: Vec<Entry>,
    delimiters: Delimiters,
    /// Data of all parameter cards, 64 columns each.
    parameters: Vec<u8>,
}

/// One entity in the directory.
pub(super) struct Entry {
    /// Sequence number of its first card: what pointers name.
    pub(super) number: usize,
    pub(super) kind: i64,
    /// Number of its first parameter card, from 1.
    parameter: usize,
    /// Number of the transformation's entry, 0 for none.
    pub(super) matrix: usize,
    pub(super) label: String,
}

impl File {
    pub(super) fn of(bytes: &[u8]) -> Result<Self, ImportError> {
        let mut global = Vec::new();
        let mut directory = Vec::new();
        let mut parameters = Vec::new();
        for (number, card) in cards(bytes) {
            let Some(section) = card.get(DATA) else {
                let message = format!(
                    "a card has 80 columns, with the section's letter in column 73; found {}",
                    card.len()
                );
                return Err(ImportError::at(Format::Iges, Place::Line(number), message));
            };
            match section {
                b'G' => global.extend_from_slice(&card[..DATA]),
                b'D' => directory.push((number, &card[..DATA])),
                b'P' => parameters.extend_from_slice(&card[..PARAMETER_DATA]),
                b'S' | b'T' => {}
                other => {
                    let message =
                        format!("column 73 must hold S, G, D, P or T, found `{}`", other.escape_ascii());
                    return Err(ImportError::at(Format::Iges, Place::Line(number), message));
                }
            }
        }
        let in_global =
            |message: &str| ImportError::at(Format::Iges, Place::Field("global section".into()), message);
        let (delimiters, global) = record::global(&global).map_err(in_global)?;
        let directory = entries(&directory)?;
        Ok(Self { global, directory, delimiters, parameters })
    }

    /// The entry that the pointer `number` names; `None` where there is none.
    pub(super) fn entry(&self, number: usize) -> Option<&Entry> {
        self.directory.get(number.checked_sub(1)? / 2).filter(|entry| entry.number == number)
    }

    /// The parameters of `entry`; number 0 is the entity's type.
    pub(super) fn record<'a>(&self, entry: &'a Entry) -> Result<Record<'a>, ImportError> {
        let start = entry.parameter.checked_sub(1).and_then(|cards| cards.checked_mul(PARAMETER_DATA));
        let Some(data) = start.and_then(|start| self.parameters.get(start..)).filter(|data| !data.is_empty())
        else {
            let have = self.parameters.len() / PARAMETER_DATA;
            let message =
                format!("its parameters should start at card P{}, there are {have}", entry.parameter);
            return Err(fault(entry, message));
        };
        let fields = record::fields(data, self.delimiters).map_err(|message| fault(entry, message))?;
        let record = Record { entry, fields };
        if record.whole(0)? != entry.kind {
            return Err(fault(
                entry,
                format!("card P{} belongs to an entity of another type", entry.parameter),
            ));
        }
        Ok(record)
    }
}

/// The lines that say something with their numbers from 1; a file without line ends is cut every 80 columns.
fn cards(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let split: Box<dyn Iterator<Item = &[u8]>> =
        if bytes.len() > 80 && !bytes.iter().take(200).any(|&b| b == b'\n') {
            Box::new(bytes.chunks(80))
        } else {
            Box::new(bytes.split(|&b| b == b'\n'))
        };
    (1..).zip(split).filter(|(_, card)| !card.trim_ascii().is_empty())
}

/// The directory's entries from its cards with their line numbers; each takes two cards of nine fields of eight columns.
fn entries(cards: &[(usize, &[u8])]) -> Result<Vec<Entry>, ImportError> {
    let mut entries = Vec::with_capacity(cards.len() / 2);
    for (k, pair) in cards.chunks(2).enumerate() {
        let &[(line, first), (_, second)] = pair else {
            let message = "the directory ends within an entry, which takes two cards";
            return Err(ImportError::at(Format::Iges, Place::Line(pair[0].0), message));
        };
        let field = |card: &[u8], number: usize| {
            String::from_utf8_lossy(&card[8 * number - 8..8 * number]).trim().to_owned()
        };
        let whole = |number: usize| match field(first, number).as_str() {
            "" => Ok(0),
            text => text.parse::<i64>().map_err(|_| {
                let message =
                    format!("field {number} of the directory must be a whole number, found `{text}`");
                ImportError::at(Format::Iges, Place::Line(line), message)
            }),
        };
        let pointer = |number: usize| whole(number).map(|n| usize::try_from(n).unwrap_or(0));
        let subscript = field(second, 9);
        let label = field(second, 8);
        let label =
            if label.is_empty() || subscript.is_empty() { label } else { format!("{label} {subscript}") };
        entries.push(Entry {
            number: 2 * k + 1,
            kind: whole(1)?,
            parameter: pointer(2)?,
            matrix: pointer(7)?,
            label,
        });
    }
    Ok(entries)
}

/// The parameters of an entity.
pub(super) struct Record<'a> {
    pub(super) entry: &'a Entry,
    fields: Vec<Field>,
}

impl Record<'_> {
    /// Number of parameters, the entity's type among them.
    pub(super) fn len(&self) -> usize {
        self.fields.len()
    }

    /// The number at `index`, 0 where the field is empty.
    pub(super) fn number(&self, index: usize) -> Result<f64, ImportError> {
        let wrong =
            |found: &str| fault(self.entry, format!("parameter {index} must be a number, found {found}"));
        match self.fields.get(index) {
            None => Err(wrong("the end of the entity")),
            Some(field) if field.is_empty() => Ok(0.0),
            Some(field) => field.number().ok_or_else(|| wrong(&format!("`{}`", field.text()))),
        }
    }

    /// The whole number at `index`, 0 where the field is empty.
    pub(super) fn whole(&self, index: usize) -> Result<i64, ImportError> {
        let number = self.number(index)?;
        if number.fract() == 0.0 && number.abs() < 1e15 {
            return Ok(number as i64);
        }
        Err(fault(self.entry, format!("parameter {index} must be a whole number, found {number}")))
    }

    /// The count or pointer at `index`.
    pub(super) fn count(&self, index: usize) -> Result<usize, ImportError> {
        let whole = self.whole(index)?;
        usize::try_from(whole)
            .map_err(|_| fault(self.entry, format!("parameter {index} must not be below 0, found {whole}")))
    }

    /// The numbers from `start`, `count` of them.
    pub(super) fn numbers(&self, start: usize, count: usize) -> Result<Vec<f64>, ImportError> {
        let end = start.checked_add(count).filter(|&end| end <= self.len());
        let Some(end) = end else {
            let have = self.len().saturating_sub(start);
            return Err(fault(
                self.entry,
                format!("{count} numbers should follow parameter {start}, there are {have}"),
            ));
        };
        (start..end).map(|index| self.number(index)).collect()
    }
}
