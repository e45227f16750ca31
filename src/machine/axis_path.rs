//! The motion of the axes.

use super::Position;
use crate::toolpath::{ClPoint, Rate, Role};
use glam::DVec3;

/// One straight move of all axes at once, from where the move before ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisMove {
    /// Where the axes stand at its end.
    pub at: Position,
    /// Where that puts the tool.
    pub to: ClPoint,
    /// How fast the toolpath asked to go.
    pub rate: Rate,
    /// What for.
    pub role: Role,
    /// The shortest time in which the axes can do it at constant speed, and not faster than asked for, s; 0 for the first move.
    pub seconds: f64,
    /// The time that the feed asks for, s; 0 in rapid.
    pub asked: f64,
    /// The normal of the part's surface at its end, if it is known.
    pub normal: Option<DVec3>,
    /// Whether it draws the tool back, turns it over, or returns it, which the toolpath does not ask for.
    pub turns_over: bool,
    /// The move of the toolpath that it is part of, counted from 0.
    pub source: usize,
    /// Whether it ends where that move does.
    pub is_end: bool,
}

/// The motion of the axes in order. The first move has no start: it places the tool.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AxisPath {
    /// The moves.
    pub moves: Vec<AxisMove>,
    /// How often an axis was turned back, or the other inverse solution taken, on a link.
    pub turn_overs: usize,
}

impl AxisPath {
    /// Least and greatest position of the axis at `place` in the order of [`Position::all`]; infinite where nothing moves.
    pub fn span(&self, place: usize) -> [f64; 2] {
        let at = || self.moves.iter().map(|step| step.at.all()[place]);
        [at().fold(f64::INFINITY, f64::min), at().fold(f64::NEG_INFINITY, f64::max)]
    }
}
