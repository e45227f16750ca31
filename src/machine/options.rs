//! How closely the axes follow a toolpath.

/// How far the tool may be from where the toolpath has it, between the ends of its moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// The contact from its way across the surface, mm, above 0; the tip from its straight line where the contact is not known.
    pub chord: f64,
    /// The axis from that of the straight move, radians, above 0. Beside a pole, where it swings round while the axis asked for stands
    /// still, a step of the rotary angles more.
    pub axis: f64,
}

/// What the control makes of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Control {
    /// All axes go straight from block to block; what that does to the tip is up to the program.
    Axes,
    /// The tip goes straight over the workpiece; the rotary axes go straight from block to block.
    Tip,
    /// Tip and axis both go straight over the workpiece, as the toolpath has them.
    Vector,
}

/// How a machine shall follow a toolpath.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Following {
    /// What the control makes of a block.
    pub control: Control,
    /// For moves at feed.
    pub feed: Tolerance,
    /// For rapid moves.
    pub rapid: Tolerance,
    /// How far the axis may be from its own at feed within this angle of the pole, radians, so that the tool passes through it; what is
    /// less than the tolerance at feed adds nothing.
    pub pole: f64,
    /// The most that a rotary axis turns from block to block, radians, above 0; more than 0.1 adds nothing.
    pub largest_turn: f64,
    /// The step that rotary angles are rounded to before the linear axes are found for them, radians: what the program's decimals
    /// can state. The tip stays where it is all the same.
    pub rotary_step: f64,
    /// How far beyond every cut of the path the tip stays while the tool is turned over on a link, mm; less where limits ask for it.
    pub clearance: f64,
}

impl Following {
    /// A twentieth of a micrometre and 0.002° at feed, a twentieth of a millimetre and half a degree in rapid, angles to 10⁻⁴ degrees, 50 mm beyond the cuts.
    pub fn new(control: Control) -> Self {
        Self {
            control,
            feed: Tolerance { chord: 5e-5, axis: 0.002f64.to_radians() },
            rapid: Tolerance { chord: 0.05, axis: 0.5f64.to_radians() },
            pole: 0.0,
            largest_turn: 5.7f64.to_radians(),
            rotary_step: 1e-4f64.to_radians(),
            clearance: 50.0,
        }
    }
}
