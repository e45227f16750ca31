//! How finely words are stated.

use crate::post::digits::{power, scaled};

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
