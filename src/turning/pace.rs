//! How fast the spindle turns at each distance from its axis.

/// The speed of the C axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pace {
    /// The same everywhere, rad/s.
    Even(f64),
    /// The same speed of the surface, mm/s, as far as the largest speed of the spindle, rad/s, lets it: smoothly
    /// `v/√(x² + (v/Ω)²)`, which is `v/x` far out and Ω at the axis.
    Surface {
        /// mm/s.
        speed: f64,
        /// rad/s.
        most: f64,
    },
}

impl Pace {
    /// Speed of C (rad/s) at the distance `x`, mm, and its derivative along x.
    pub fn at(&self, x: f64) -> [f64; 2] {
        match *self {
            Self::Even(omega) => [omega, 0.0],
            Self::Surface { speed, most } => {
                let near = speed / most;
                let under = x * x + near * near;
                let omega = speed / under.sqrt();
                [omega, -omega * x / under]
            }
        }
    }

    /// All speeds times `share`: velocities grow with it, accelerations with its square, jerks with its cube.
    #[must_use]
    pub fn scaled(&self, share: f64) -> Self {
        match *self {
            Self::Even(omega) => Self::Even(omega * share),
            Self::Surface { speed, most } => Self::Surface { speed: speed * share, most: most * share },
        }
    }

    /// The largest speed of the spindle, rad/s.
    pub fn largest(&self) -> f64 {
        match *self {
            Self::Even(omega) | Self::Surface { most: omega, .. } => omega,
        }
    }
}
