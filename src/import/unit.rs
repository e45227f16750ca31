//! Units of length in files.

/// A unit of length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Millionth of a metre.
    Micrometre,
    /// Thousandth of a metre.
    Millimetre,
    /// Hundredth of a metre.
    Centimetre,
    /// Metre.
    Metre,
    /// Thousand metres.
    Kilometre,
    /// Millionth of an inch.
    Microinch,
    /// Thousandth of an inch.
    Mil,
    /// Inch of 25.4 mm.
    Inch,
    /// Twelve inches.
    Foot,
    /// 5280 feet.
    Mile,
}

/// Every unit with its size in millimetres and the names it goes by, the one to print first.
const UNITS: [(Unit, f64, &[&str]); 10] = [
    (Unit::Micrometre, 1e-3, &["µm", "um", "micron", "micrometre", "micrometer"]),
    (Unit::Millimetre, 1.0, &["mm", "millimetre", "millimeter"]),
    (Unit::Centimetre, 10.0, &["cm", "centimetre", "centimeter"]),
    (Unit::Metre, 1e3, &["m", "metre", "meter"]),
    (Unit::Kilometre, 1e6, &["km", "kilometre", "kilometer"]),
    (Unit::Microinch, 25.4e-6, &["µin", "uin", "microinch"]),
    (Unit::Mil, 25.4e-3, &["mil", "thou"]),
    (Unit::Inch, 25.4, &["in", "inch"]),
    (Unit::Foot, 304.8, &["ft", "foot", "feet"]),
    (Unit::Mile, 1_609_344.0, &["mi", "mile"]),
];

impl Unit {
    fn row(self) -> &'static (Unit, f64, &'static [&'static str]) {
        &UNITS[self as usize]
    }

    /// Millimetres in one of this unit.
    pub fn millimetres(self) -> f64 {
        self.row().1
    }

    /// The unit with this name or abbreviation, in any case: `mm`, `inch`, `FT`.
    pub fn named(name: &str) -> Option<Self> {
        // Micro has a sign of its own and may also be written with the Greek letter, small or capital.
        let name = name.trim().to_ascii_lowercase().replace(['μ', 'Μ'], "µ");
        UNITS.iter().find(|(_, _, names)| names.contains(&name.as_str())).map(|(unit, ..)| *unit)
    }
}

impl std::fmt::Display for Unit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.row().2[0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_unit_answers_to_its_names() {
        for (k, (unit, _, names)) in UNITS.iter().enumerate() {
            assert_eq!(*unit as usize, k, "rows stand in the order of the units");
            for name in *names {
                assert_eq!(Unit::named(&name.to_uppercase()), Some(*unit));
            }
        }
        assert_eq!(Unit::named("furlong"), None);
    }
}
