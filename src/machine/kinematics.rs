//! From axis positions to where the tool stands on the workpiece, and back.

use super::two_turns::{TwoTurns, two_turns};
use super::{Axis, Carries, Joint, Machine, MachineError};
use crate::math::angle::{angle_between, turn_about};
use crate::toolpath::ClPoint;
use glam::{DMat3, DVec3};

/// Positions of all axes: X, Y and Z in mm, and the rotary ones in radians, that nearer to the workpiece first. A machine without rotary
/// axes leaves these at 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Position {
    /// X, Y and Z.
    pub linear: DVec3,
    /// The rotary axes.
    pub rotary: [f64; 2],
}

impl Position {
    /// All of them, the linear ones first.
    pub fn all(&self) -> [f64; 5] {
        let [first, second] = self.rotary;
        [self.linear.x, self.linear.y, self.linear.z, first, second]
    }

    /// Where the axes stand at the share `t` of a straight move to `to`.
    pub fn lerp(&self, to: &Self, t: f64) -> Self {
        let turned = |k: usize| self.rotary[k] + t * (to.rotary[k] - self.rotary[k]);
        Self { linear: self.linear.lerp(to.linear, t), rotary: [turned(0), turned(1)] }
    }
}

/// A machine that holds a tool and a workpiece.
///
/// The tool's pose on the workpiece is the product of the axes' motions in their order from the workpiece to the tool, applied to the
/// pose while all stand at 0; what carries the workpiece counts backwards. (The product of exponentials: R. W. Brockett, Robotic
/// manipulators and the product of exponentials formula, 1984.)
#[derive(Debug, Clone, PartialEq)]
pub struct Kinematics {
    /// X, Y, Z, then the rotary axes, that nearer to the workpiece first.
    axes: Vec<Axis>,
    /// Where the tool goes on the workpiece as X, Y and Z rise, while the rotary axes stand at 0.
    along: [DVec3; 3],
    /// How many rotary axes stand between the workpiece and each of X, Y and Z.
    turned_by: [usize; 3],
    /// About which the tool turns over the workpiece, by the right hand, as the rotary axes rise.
    about: Option<[DVec3; 2]>,
    points: [DVec3; 2],
    tool_axis: DVec3,
    tool_length: f64,
    /// The tip while all stand at 0, machine frame.
    tip: DVec3,
    workpiece_zero: DVec3,
    /// X, Y and Z where the tip is at the workpiece's origin with the rotary axes at 0.
    zero: DVec3,
}

impl Kinematics {
    /// `machine` with a tool of the given length, from the spindle's nose to the tip, mm.
    ///
    /// Errors: those of [`Machine::check`]; a tool that is not longer than 0, or longer than the machine takes.
    pub fn new(machine: &Machine, tool_length: f64) -> Result<Self, MachineError> {
        machine.check()?;
        if !(tool_length > 0.0 && tool_length <= machine.longest_tool) {
            let message = format!(
                "must be above 0 and at most {} mm, the longest that {} takes, not {tool_length} mm",
                machine.longest_tool, machine.name
            );
            return Err(MachineError::new("tool length", message));
        }
        let linear = ['X', 'Y', 'Z'].map(|letter| machine.axes.iter().position(|a| a.letter == letter));
        let rotary: Vec<usize> = (0..machine.axes.len()).filter(|&k| machine.axes[k].is_rotary()).collect();
        let order: Vec<usize> = linear.into_iter().flatten().chain(rotary.iter().copied()).collect();
        let axes: Vec<Axis> = order.iter().map(|&k| machine.axes[k]).collect();
        let turned_by = linear.map(|at| rotary.iter().filter(|&&turn| Some(turn) < at).count());
        let tool_axis = machine.tool_axis.normalize();
        let mut built = Self {
            along: [0, 1, 2].map(|k| relative(&axes[k]).0),
            turned_by,
            about: (rotary.len() == 2).then(|| [3, 4].map(|k: usize| relative(&axes[k]).0)),
            points: [3, 4].map(|k| axes.get(k).map_or(DVec3::ZERO, |axis| relative(axis).1)),
            tip: machine.gauge - tool_length * tool_axis,
            workpiece_zero: machine.workpiece_zero,
            zero: DVec3::ZERO,
            tool_axis,
            tool_length,
            axes,
        };
        built.zero = built.linear(DVec3::ZERO, [0.0; 2]);
        Ok(built)
    }

    /// X, Y, Z and then the rotary axes, that nearer to the workpiece first: in the order of [`Position::all`].
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// X, Y and Z where programs read 0: with the rotary axes at 0 the tip is at the workpiece's origin there.
    pub fn program_zero(&self) -> DVec3 {
        self.zero
    }

    /// What a control adds to words while the tool's length is off, so that they are machine coordinates: where X, Y and Z bring the
    /// spindle's nose to the workpiece's origin with the rotary axes at 0.
    pub fn work_offset(&self) -> DVec3 {
        self.linear(-self.tool_length * self.tool_axis, [0.0; 2])
    }

    /// From the spindle's nose to the tip, mm.
    pub fn tool_length(&self) -> f64 {
        self.tool_length
    }

    /// Unit vector from the tip to the spindle while the rotary axes stand at 0.
    pub(super) fn upright(&self) -> DVec3 {
        self.tool_axis
    }

    /// Unit vector on the workpiece along the line about which the first rotary axis turns: along it, and against it, the tool has a pole.
    /// Nothing without rotary axes.
    pub fn pole(&self) -> Option<DVec3> {
        self.about.map(|[first, _]| first)
    }

    /// Where the tool stands on the workpiece.
    pub fn pose(&self, at: &Position) -> ClPoint {
        let turns = self.turns(at.rotary);
        let tip = self.hanging(&turns) + self.columns(&turns) * at.linear - self.workpiece_zero;
        ClPoint { tip, axis: turns[1] * self.tool_axis }
    }

    /// Which way the tool points with the rotary axes there.
    pub(super) fn pointing(&self, rotary: [f64; 2]) -> DVec3 {
        self.turns(rotary)[1] * self.tool_axis
    }

    /// X, Y and Z that bring the tip to `tip` on the workpiece with the rotary axes where they are.
    pub fn linear(&self, tip: DVec3, rotary: [f64; 2]) -> DVec3 {
        self.standing(tip, rotary).0.linear
    }

    /// [`Kinematics::at`], and where the tool then stands.
    pub(super) fn standing(&self, tip: DVec3, rotary: [f64; 2]) -> (Position, ClPoint) {
        let turns = self.turns(rotary);
        let linear = self.columns(&turns).inverse() * (tip + self.workpiece_zero - self.hanging(&turns));
        (Position { linear, rotary }, ClPoint { tip, axis: turns[1] * self.tool_axis })
    }

    /// All axes that bring the tip to `tip` with the rotary axes where they are.
    pub fn at(&self, tip: DVec3, rotary: [f64; 2]) -> Position {
        Position { linear: self.linear(tip, rotary), rotary }
    }

    /// Both positions in which the tool stands at `pose`, with rotary axes in (−π, π] and without regard to limits; they are the
    /// same where there is but one. `None` if no position of the rotary axes gives the tool that axis.
    ///
    /// Where the tool points along the first rotary axis that axis is free, and given as 0.
    pub fn inverse(&self, pose: &ClPoint) -> Option<[Position; 2]> {
        let ways = self.ways(pose.axis)?;
        // Once more for what is left: where turns bring two linear axes near to each other, the first answer is not exact.
        let exactly = |rotary| {
            let at = self.at(pose.tip, rotary);
            let left = pose.tip - self.pose(&at).tip;
            Position { linear: at.linear + self.ways_of_linear(rotary).inverse() * left, rotary }
        };
        Some(ways.pairs.map(exactly))
    }

    /// Both ways to point the tool along `axis`.
    pub(super) fn ways(&self, axis: DVec3) -> Option<TwoTurns> {
        match self.about {
            Some([first, second]) => two_turns(first, second, self.tool_axis, axis),
            // What a three-axis machine cannot hold exactly it holds where nobody could measure it.
            None => (angle_between(axis, self.tool_axis) < UPRIGHT)
                .then_some(TwoTurns { pairs: [[0.0; 2]; 2], apart: 0.0 }),
        }
    }

    /// Where the tool goes over the workpiece as X, Y and Z rise, with the rotary axes there.
    pub fn ways_of_linear(&self, rotary: [f64; 2]) -> DMat3 {
        self.columns(&self.turns(rotary))
    }

    /// The turn of what hangs on the first rotary axis, and on both.
    fn turns(&self, rotary: [f64; 2]) -> [DMat3; 2] {
        let Some([first, second]) = self.about else { return [DMat3::IDENTITY; 2] };
        let outer = turn_about(first, rotary[0]);
        [outer, outer * turn_about(second, rotary[1])]
    }

    /// The tip in the frame of the workpiece side, as far as the linear axes do not move it.
    fn hanging(&self, [outer, both]: &[DMat3; 2]) -> DVec3 {
        let [p1, p2] = self.points;
        p1 + *outer * (p2 - p1) + *both * (self.tip - p2)
    }

    /// Where the tool goes as X, Y and Z rise.
    fn columns(&self, [outer, both]: &[DMat3; 2]) -> DMat3 {
        let column = |k: usize| match self.turned_by[k] {
            0 => self.along[k],
            1 => *outer * self.along[k],
            _ => *both * self.along[k],
        };
        DMat3::from_cols(column(0), column(1), column(2))
    }
}

/// How far a three-axis tool may be from upright, radians: the end of a 100 mm lever stays within 0.01 µm.
const UPRIGHT: f64 = 1e-7;

/// Direction and point of an axis, for the motion of the tool over the workpiece.
fn relative(axis: &Axis) -> (DVec3, DVec3) {
    let sense = match axis.carries {
        Carries::Workpiece => -1.0,
        Carries::Tool => 1.0,
    };
    match axis.joint {
        Joint::Linear { direction } => (sense * direction.normalize(), DVec3::ZERO),
        Joint::Rotary { direction, point } => (sense * direction.normalize(), point),
    }
}
