//! Numbers of a million blocks, written and read fast.

/// 10 to the number of decimals, of which there are at most 9.
pub(super) fn power(decimals: usize) -> f64 {
    [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9][decimals.min(9)]
}

/// `x` in units of its last decimal. Numbers that are too large saturate.
pub(super) fn scaled(x: f64, decimals: usize) -> i64 {
    (x * power(decimals)).round() as i64
}

/// Appends a number that [`scaled`] gave, with all of its decimals and no exponent.
pub(super) fn push(text: &mut String, number: i64, decimals: usize) {
    let decimals = decimals.min(9);
    let mut digits = [b'0'; 24];
    let mut at = digits.len();
    let mut rest = number.unsigned_abs();
    let mut count = 0;
    while rest > 0 || count <= decimals {
        if count == decimals && decimals > 0 {
            at -= 1;
            digits[at] = b'.';
        }
        at -= 1;
        digits[at] = b'0' + (rest % 10) as u8;
        rest /= 10;
        count += 1;
    }
    if number < 0 {
        text.push('-');
    }
    text.extend(digits[at..].iter().map(|&b| char::from(b)));
}

/// Appends `x` with `decimals` decimals.
pub(super) fn push_fixed(text: &mut String, x: f64, decimals: usize) {
    push(text, scaled(x, decimals), decimals);
}

/// A plain decimal number. Up to 15 digits are read exactly without the general reader.
pub(super) fn decimal(text: &str) -> Option<f64> {
    let bytes = text.as_bytes();
    let (negative, digits) = match bytes.first()? {
        b'-' => (true, &bytes[1..]),
        b'+' => (false, &bytes[1..]),
        _ => (false, bytes),
    };
    let (mut sum, mut count, mut decimals, mut point) = (0u64, 0, 0usize, false);
    for &b in digits {
        match b {
            b'.' if !point => point = true,
            b'0'..=b'9' => {
                sum = sum.wrapping_mul(10).wrapping_add(u64::from(b - b'0'));
                count += 1;
                decimals += usize::from(point);
            }
            _ => return None,
        }
    }
    const POWERS: [f64; 16] =
        [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];
    let magnitude = match count {
        0 => return None,
        // Both are exact, so the quotient is the nearest number, as the general reader would give.
        1..=15 => sum as f64 / POWERS[decimals],
        _ => super::number::parse(std::str::from_utf8(digits).ok()?)?,
    };
    Some(if negative { -magnitude } else { magnitude })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn text(x: f64, decimals: usize) -> String {
        let mut text = String::new();
        push_fixed(&mut text, x, decimals);
        text
    }

    #[test]
    fn small_large_and_negative_numbers_have_all_their_digits() {
        assert_eq!(text(0.0, 3), "0.000");
        assert_eq!(text(-0.0004, 3), "0.000");
        assert_eq!(text(-0.0006, 3), "-0.001");
        assert_eq!(text(12.5, 0), "13");
        assert_eq!(text(1e-9, 9), "0.000000001");
        assert_eq!(text(-59_731.25, 4), "-59731.2500");
    }

    proptest! {
        #[test]
        fn text_is_that_of_the_standard_library(n in -10_000_000_000i64..10_000_000_000, decimals in 0..8usize) {
            let x = n as f64 / power(decimals);
            let standard = crate::post::number::fixed(x, decimals);
            prop_assert_eq!(text(x, decimals), standard);
        }
    }
}
