//! Free-format fields between delimiters.

/// What ends a field and what ends a record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Delimiters {
    field: u8,
    record: u8,
}

/// One field: its text without blanks around it, and for a string without its count.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Field(Vec<u8>);

impl Field {
    /// Whether nothing stands there.
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The number in the field; exponents may be written with D. `None` where the field holds none or none that is finite.
    pub(super) fn number(&self) -> Option<f64> {
        let text = std::str::from_utf8(&self.0).ok()?;
        let number: f64 =
            if text.contains(['D', 'd']) { text.replace(['D', 'd'], "E").parse() } else { text.parse() }
                .ok()?;
        number.is_finite().then_some(number)
    }

    /// The field as text.
    pub(super) fn text(&self) -> String {
        String::from_utf8_lossy(&self.0).into_owned()
    }
}

/// The delimiters and all fields of the global section, the delimiters' own two among them.
pub(super) fn global(data: &[u8]) -> Result<(Delimiters, Vec<Field>), &'static str> {
    const MESSAGE: &str = "must begin with the two delimiters: `,,` or as in `1H,,1H;,`";
    // A delimiter is a string of one character, or nothing where it is the usual one.
    let (field, rest) = match data {
        [b'1', b'H', field, next, rest @ ..] if field == next => (*field, rest),
        [b',', rest @ ..] => (b',', rest),
        _ => return Err(MESSAGE),
    };
    let (record, rest) = match rest {
        [b'1', b'H', record, next, rest @ ..] if *next == field => (*record, rest),
        [next, rest @ ..] if *next == field => (b';', rest),
        _ => return Err(MESSAGE),
    };
    let delimiters = Delimiters { field, record };
    let own = [field, record].map(|c| Field(vec![c]));
    let others = fields(rest, delimiters)?;
    Ok((delimiters, own.into_iter().chain(others).collect()))
}

/// The fields of the record that `data` begins with.
pub(super) fn fields(data: &[u8], delimiters: Delimiters) -> Result<Vec<Field>, &'static str> {
    let mut fields = Vec::new();
    let mut rest = data;
    loop {
        let trimmed = rest.trim_ascii_start();
        let (field, after) = match string(trimmed) {
            Some((text, after)) => (Field(text.to_vec()), after.trim_ascii_start()),
            None => {
                let ends = |b: &u8| *b == delimiters.field || *b == delimiters.record;
                let end = rest.iter().position(ends).ok_or("the file ends before the record does")?;
                (Field(rest[..end].trim_ascii().to_vec()), &rest[end..])
            }
        };
        fields.push(field);
        match after.split_first() {
            Some((b, after)) if *b == delimiters.field => rest = after,
            Some((b, _)) if *b == delimiters.record => return Ok(fields),
            Some(_) => return Err("a string is longer than the count before its H says"),
            None => return Err("the file ends before the record does"),
        }
    }
}

/// The string that `data` begins with, as in `5Hwhole`, and what follows it.
fn string(data: &[u8]) -> Option<(&[u8], &[u8])> {
    let digits = data.iter().take(9).take_while(|b| b.is_ascii_digit()).count();
    if digits == 0 || data.get(digits) != Some(&b'H') {
        return None;
    }
    let length: usize = std::str::from_utf8(&data[..digits]).ok()?.parse().ok()?;
    data[digits + 1..].split_at_checked(length)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(fields: Vec<Field>) -> Vec<String> {
        fields.iter().map(Field::text).collect()
    }

    #[test]
    fn strings_hold_delimiters_and_empty_fields_stay() {
        let (delimiters, fields) = global(b",,4Ha,;b,,1.5D1 , 2 ;rest").unwrap();
        assert_eq!(delimiters, Delimiters { field: b',', record: b';' });
        assert_eq!(fields[4].number(), Some(15.0));
        assert_eq!(texts(fields), [",", ";", "a,;b", "", "1.5D1", "2"]);
    }

    #[test]
    fn other_delimiters_are_taken() {
        let (delimiters, fields) = global(b"1H//1H#/3Ha,b/7#").unwrap();
        assert_eq!(delimiters, Delimiters { field: b'/', record: b'#' });
        assert_eq!(texts(fields), ["/", "#", "a,b", "7"]);
    }

    #[test]
    fn a_record_without_an_end_is_refused() {
        let comma = Delimiters { field: b',', record: b';' };
        assert!(fields(b"128,1,2", comma).is_err());
        assert!(fields(b"128,99Hshort,1;", comma).is_ok(), "a count beyond the file is no string");
    }
}
