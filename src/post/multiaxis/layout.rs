//! What a program looks like, in whichever dialect.

/// How numbers and lines are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layout {
    /// Decimals of lengths in mm, at most 9.
    pub linear: usize,
    /// Decimals of angles in degrees, at most 9.
    pub rotary: usize,
    /// Decimals of the components of a direction, at most 9.
    pub vector: usize,
    /// Whether blocks are numbered (N words); dialects that must have numbers have them anyway.
    pub numbered: bool,
    /// Whether lines end in a carriage return and a line feed, instead of a line feed alone.
    pub carriage_return: bool,
    /// The most blocks that the control takes.
    pub most_blocks: Option<usize>,
}

impl Default for Layout {
    /// 10⁻⁴ mm and degrees, which controls take that are set for them (Fanuc's IS-C); directions to 10⁻⁷.
    fn default() -> Self {
        Self { linear: 4, rotary: 4, vector: 7, numbered: false, carriage_return: false, most_blocks: None }
    }
}

impl Layout {
    /// The step of rotary words, radians.
    pub fn rotary_step(&self) -> f64 {
        (1.0 / crate::post::digits::power(self.rotary)).to_radians()
    }
}
