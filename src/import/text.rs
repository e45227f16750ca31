//! Lines, cells and numbers of text files.

/// `bytes` without the mark that some editors put before UTF-8 text.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// What stands between the cells of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Delimiter {
    Char(char),
    Blank,
}

impl Delimiter {
    /// The delimiter of `line`: a tab, semicolon or comma where there is one, in this order, else blanks.
    pub(super) fn of(line: &str) -> Self {
        let char = ['\t', ';', ','].into_iter().find(|c| line.contains(*c));
        char.map_or(Delimiter::Blank, Delimiter::Char)
    }

    /// The cells of `line`, trimmed and without quotes.
    pub(super) fn split(self, line: &str) -> impl Iterator<Item = &str> {
        let (by_char, by_blank) = match self {
            Delimiter::Char(c) => (Some(line.split(c)), None),
            Delimiter::Blank => (None, Some(line.split_ascii_whitespace())),
        };
        let cells = by_char.into_iter().flatten().chain(by_blank.into_iter().flatten());
        cells.map(|cell| cell.trim().trim_matches('"').trim())
    }
}

/// Whether `line` is a row of a control net: points of three or four numbers, `x,y,z;x,y,z;…`.
pub(super) fn is_net_row(line: &str) -> bool {
    let mut points = line.split(';').filter(|point| !point.trim().is_empty());
    let is_point = |point: &str| {
        let numbers = point.split(',');
        let count = numbers.clone().count();
        (count == 3 || count == 4) && numbers.into_iter().all(|n| n.trim().parse::<f64>().is_ok())
    };
    line.contains(';') && points.next().is_some_and(is_point)
}
