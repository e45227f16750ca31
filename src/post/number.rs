//! Numbers as program text: a point for the decimals whatever the locale, and no negative zero.

/// `x` with exactly `decimals` decimals.
pub(super) fn fixed(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    // What rounds to zero from below would read "-0.000".
    if text.starts_with('-') && text.bytes().all(|b| matches!(b, b'-' | b'0' | b'.')) {
        text[1..].to_owned()
    } else {
        text
    }
}

/// `x` with at most `decimals` decimals, none of them a trailing zero.
pub(super) fn trimmed(x: f64, decimals: usize) -> String {
    let text = fixed(x, decimals);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// A finite number as programs write it: `1`, `1.`, `.5`, `+1E-3`, `1.D-3`; `None` for anything else.
pub(super) fn parse(text: &str) -> Option<f64> {
    let text = text.trim();
    let plain = |b: u8| b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.' | b'e' | b'E' | b'd' | b'D');
    if !text.bytes().all(plain) {
        return None;
    }
    let number: f64 = text.replace(['d', 'D'], "e").parse().ok()?;
    number.is_finite().then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zero_has_no_sign_and_foreign_numbers_are_read() {
        assert_eq!(fixed(-1e-9, 5), "0.00000");
        assert_eq!(fixed(-0.000_011, 5), "-0.00001");
        assert_eq!(trimmed(-0.0, 3), "0");
        assert_eq!(trimmed(100.0, 0), "100");
        assert_eq!(trimmed(12.340, 3), "12.34");
        for (text, number) in [("1.", 1.0), (" .5 ", 0.5), ("+1E-3", 1e-3), ("-2.5D1", -25.0)] {
            assert_eq!(parse(text), Some(number), "{text}");
        }
        for text in ["", "nan", "inf", "1e999", "1,0", "0x10", "--1", "e"] {
            assert_eq!(parse(text), None, "{text}");
        }
    }
}
