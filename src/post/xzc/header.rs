//! The line that says how a program's words are meant.

use super::XzcProgram;
use crate::post::number::{parse, trimmed};
use crate::toolpath::Nose;

/// Which point of the tool the words state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reference {
    /// The lowest point of the nose, straight below its centre.
    Tip,
    /// The centre of the nose.
    Center,
}

/// How X is stated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum XWord {
    /// The distance from the axis.
    Radius,
    /// Twice that.
    Diameter,
}

/// How C is stated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CWord {
    /// The angle of the tool over the part: rising C moves the tool counter-clockwise over the part, seen from the tool's side.
    Tool,
    /// The angle of the part: the negative of that.
    Part,
}

/// How the words of a text are meant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Meaning {
    pub(super) nose: Nose,
    pub(super) reference: Reference,
    pub(super) x_word: XWord,
    pub(super) c_word: CWord,
}

impl Meaning {
    pub(super) fn of(program: &XzcProgram) -> Self {
        let XzcProgram { nose, reference, x_word, c_word, .. } = *program;
        Self { nose, reference, x_word, c_word }
    }

    /// The words X (mm), Z (mm) and C (degrees) for a nose centre and an angle in radians; velocities likewise where `moving`.
    pub(super) fn words(&self, [x, z, c]: [f64; 3], moving: bool) -> [f64; 3] {
        let [kx, dz, kc] = self.factors();
        [x * kx, if moving { z } else { z - dz }, c.to_degrees() * kc]
    }

    /// The other way.
    pub(super) fn meant(&self, [x, z, c]: [f64; 3], moving: bool) -> [f64; 3] {
        let [kx, dz, kc] = self.factors();
        [x / kx, if moving { z } else { z + dz }, (c * kc).to_radians()]
    }

    fn factors(&self) -> [f64; 3] {
        let x = match self.x_word {
            XWord::Radius => 1.0,
            XWord::Diameter => 2.0,
        };
        let z = match self.reference {
            Reference::Tip => self.nose.radius(),
            Reference::Center => 0.0,
        };
        let c = match self.c_word {
            CWord::Tool => 1.0,
            CWord::Part => -1.0,
        };
        [x, z, c]
    }

    /// As a remark: `XZC BALL R15 TIP RADIUS TOOL`.
    pub(super) fn remark(&self) -> String {
        let (kind, radius) = match self.nose {
            Nose::Ball(r) => ("BALL", r),
            Nose::Insert(r) => ("INSERT", r),
        };
        let reference = match self.reference {
            Reference::Tip => "TIP",
            Reference::Center => "CENTER",
        };
        let x = match self.x_word {
            XWord::Radius => "RADIUS",
            XWord::Diameter => "DIAMETER",
        };
        let c = match self.c_word {
            CWord::Tool => "TOOL",
            CWord::Part => "PART",
        };
        format!("XZC {kind} R{} {reference} {x} {c}", trimmed(radius, 9))
    }

    /// From a remark, if it is this one.
    pub(super) fn announced(remark: &str) -> Option<Self> {
        let words: Vec<&str> = remark.split_whitespace().collect();
        let ["XZC", kind, radius, reference, x, c] = words[..] else { return None };
        let radius = parse(radius.strip_prefix('R')?).filter(|r| *r > 0.0)?;
        Some(Self {
            nose: match kind {
                "BALL" => Nose::Ball(radius),
                "INSERT" => Nose::Insert(radius),
                _ => return None,
            },
            reference: match reference {
                "TIP" => Reference::Tip,
                "CENTER" => Reference::Center,
                _ => return None,
            },
            x_word: match x {
                "RADIUS" => XWord::Radius,
                "DIAMETER" => XWord::Diameter,
                _ => return None,
            },
            c_word: match c {
                "TOOL" => CWord::Tool,
                "PART" => CWord::Part,
                _ => return None,
            },
        })
    }
}
