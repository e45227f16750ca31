//! Numbers of a million blocks, written fast.

/// Decimals of the words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rounding {
    /// Of lengths in mm, at most 9.
    pub length: usize,
    /// Of angles in degrees, at most 9.
    pub angle: usize,
}

impl Default for Rounding {
    /// A nanometre, and 10⁻⁶ degrees, which at 50 mm is a nanometre too.
    fn default() -> Self {
        Self { length: 6, angle: 6 }
    }
}

impl Rounding {
    /// The numbers X, Z and C (degrees) as their text will state them.
    pub(super) fn rounded(&self, words: [f64; 3]) -> [i64; 3] {
        [scaled(words[0], self.length), scaled(words[1], self.length), scaled(words[2], self.angle)]
    }

    /// X, Z and C that the rounded numbers mean.
    pub(super) fn value(&self, [x, z, c]: [i64; 3]) -> [f64; 3] {
        let (l, a) = (power(self.length), power(self.angle));
        [x as f64 / l, z as f64 / l, c as f64 / a]
    }
}

fn power(decimals: usize) -> f64 {
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
