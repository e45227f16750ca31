//! The whole motion of the cutter, as a program states it.

use super::ClPoint;

/// How fast a move goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rate {
    /// As fast as the machine can.
    Rapid,
    /// At this feed of the tip, millimetres per minute.
    Feed(f64),
}

/// What a move is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Finishing the surface along a pass.
    Cut,
    /// Between passes: lifting, crossing and coming down again.
    Link,
}

/// One straight move: tip and axis go linearly from where the move before ended (the axis renormalised).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Move {
    /// Where the move ends.
    pub to: ClPoint,
    /// How fast.
    pub rate: Rate,
    /// What for.
    pub role: Role,
}

/// Moves in order. The first one has no start: it places the cutter.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Toolpath {
    /// The moves.
    pub moves: Vec<Move>,
}

impl Toolpath {
    /// Length of the tip's path over the moves of `role`, millimetres.
    pub fn length(&self, role: Role) -> f64 {
        self.moves.windows(2).filter(|w| w[1].role == role).map(|w| w[0].to.tip.distance(w[1].to.tip)).sum()
    }
}
