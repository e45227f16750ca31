//! A machine as data.

use super::{Axis, Carries, Joint, MachineError};
use glam::DVec3;

/// Most that a rotary axis with limits may turn to either side, radians: five turns. What turns farther turns without end.
const FARTHEST_TURN: f64 = 10.0 * std::f64::consts::PI;
/// How far from unit length a direction may be, and how near to parallel two axes: what is nearer is a slip of the pen.
const DISTINCT: f64 = 1e-3;

/// A machine with three linear axes, and none or two rotary ones, in any arrangement.
///
/// Machine frame: fixed to the machine's bed; while every axis stands at 0 the workpiece frame and the tool are parallel to it. Lengths in
/// mm, angles in radians.
#[derive(Debug, Clone, PartialEq)]
pub struct Machine {
    /// Its name; one line.
    pub name: String,
    /// The axes in the order in which one meets them on the way from the workpiece over the bed to the tool.
    pub axes: Vec<Axis>,
    /// Unit vector from the tip to the spindle while every axis stands at 0.
    pub tool_axis: DVec3,
    /// Where the spindle's nose is then; the tool's length counts from it.
    pub gauge: DVec3,
    /// The longest tool that the machine takes, above 0.
    pub longest_tool: f64,
    /// Where the workpiece's origin is then.
    pub workpiece_zero: DVec3,
}

impl Machine {
    /// Checks what no arithmetic would notice.
    ///
    /// Errors name the axis and the field: numbers that are not finite, directions that are not of unit length, limits the wrong way
    /// round, axes that are missing, double, in the wrong order or parallel.
    pub fn check(&self) -> Result<(), MachineError> {
        self.check_parts()?;
        self.check_linear()?;
        self.check_rotary()
    }

    /// Checks every axis and what holds part and tool, whichever axes there are. Errors are those of [`Machine::check`].
    pub fn check_parts(&self) -> Result<(), MachineError> {
        for (index, axis) in self.axes.iter().enumerate() {
            check_axis(axis)?;
            if self.axes[..index].iter().any(|other| other.letter == axis.letter) {
                return Err(wrong(axis, "letter", "is there twice: every axis needs a letter of its own"));
            }
        }
        unit("tool.axis", self.tool_axis)?;
        finite("tool.gauge", self.gauge)?;
        finite("workpiece_zero", self.workpiece_zero)?;
        if !(self.longest_tool > 0.0 && self.longest_tool.is_finite()) {
            return Err(MachineError::new("tool.longest", "must be above 0 mm"));
        }
        let carried = |carries| move |axis: &&Axis| axis.carries == carries;
        let first_of_tool = self.axes.iter().position(|axis| axis.carries == Carries::Tool);
        let after = first_of_tool.map_or(&self.axes[..0], |at| &self.axes[at..]);
        if let Some(axis) = after.iter().find(carried(Carries::Workpiece)) {
            let message =
                "axes are listed from the workpiece to the tool: those that carry the workpiece come first";
            return Err(wrong(axis, "carries", message));
        }
        if self.axes.is_empty() {
            return Err(MachineError::new("axes", "are missing"));
        }
        Ok(())
    }

    fn check_linear(&self) -> Result<(), MachineError> {
        if self.axes.iter().map(|axis| axis.letter).filter(|letter| !"XZC".contains(*letter)).count() == 0
            && self.axes.iter().filter(|axis| axis.is_rotary()).count() == 1
        {
            let message = "is missing: this is a lathe with X, Z and one rotary axis, which turns optics (stepover turn --machine) \
                           and cannot point a mill";
            return Err(MachineError::new("axes.Y", message));
        }
        for letter in ['X', 'Y', 'Z'] {
            if !self.axes.iter().any(|axis| axis.letter == letter && !axis.is_rotary()) {
                return Err(MachineError::new(
                    format!("axes.{letter}"),
                    format!(
                        "is missing: three linear axes X, Y and Z are needed, and none called {letter} is there"
                    ),
                ));
            }
        }
        let linear: Vec<DVec3> = self.axes.iter().filter(|a| !a.is_rotary()).map(direction).collect();
        let &[x, y, z] = &linear[..] else {
            return Err(MachineError::new("axes", "must hold three linear axes, X, Y and Z"));
        };
        if x.cross(y).dot(z).abs() < DISTINCT {
            return Err(MachineError::new(
                "axes",
                "X, Y and Z lie in one plane: three directions are needed",
            ));
        }
        Ok(())
    }

    fn check_rotary(&self) -> Result<(), MachineError> {
        let rotary: Vec<&Axis> = self.axes.iter().filter(|axis| axis.is_rotary()).collect();
        match rotary[..] {
            [] => Ok(()),
            [first, second] => {
                if direction(first).cross(direction(second)).length() < DISTINCT {
                    let message = format!(
                        "is parallel to that of {}: together they cannot point the tool",
                        first.letter
                    );
                    return Err(wrong(second, "direction", message));
                }
                if direction(second).cross(self.tool_axis).length() < DISTINCT {
                    let message = "is that of the tool: turning about it does not tilt the tool";
                    return Err(wrong(second, "direction", message));
                }
                Ok(())
            }
            _ => Err(MachineError::new(
                "axes",
                format!(
                    "must hold no rotary axis or two, not {}: leave out one that stays clamped",
                    rotary.len()
                ),
            )),
        }
    }
}

fn wrong(axis: &Axis, field: &str, message: impl Into<String>) -> MachineError {
    MachineError::new(format!("axes.{}.{field}", axis.letter), message)
}

/// The direction of an axis, as stated.
fn direction(axis: &Axis) -> DVec3 {
    match axis.joint {
        Joint::Linear { direction } | Joint::Rotary { direction, .. } => direction,
    }
}

fn check_axis(axis: &Axis) -> Result<(), MachineError> {
    let letters = if axis.is_rotary() { "ABC" } else { "XYZ" };
    if !letters.contains(axis.letter) {
        let [a, b, c] = [0, 1, 2].map(|k| &letters[k..=k]);
        return Err(wrong(axis, "letter", format!("must be {a}, {b} or {c}")));
    }
    unit(&format!("axes.{}.direction", axis.letter), direction(axis))?;
    if let Joint::Rotary { point, .. } = axis.joint {
        finite(&format!("axes.{}.point", axis.letter), point)?;
    }
    match axis.limits {
        Some([low, high]) if !(low.is_finite() && high.is_finite()) => {
            return Err(wrong(axis, "limits", "must be two numbers, or left out for an axis without end"));
        }
        Some([low, high]) if low >= high => {
            return Err(wrong(axis, "limits", "must be the least position and then the greatest"));
        }
        Some([low, high]) if axis.is_rotary() && low.abs().max(high.abs()) > FARTHEST_TURN => {
            let message = "must be within five turns to either side; leave them out for an axis without end";
            return Err(wrong(axis, "limits", message));
        }
        Some(_) => {}
        None if !axis.is_rotary() => {
            return Err(wrong(axis, "limits", "are missing: a linear axis has ends"));
        }
        None => {}
    }
    for (field, value) in [("speed", axis.speed), ("acceleration", axis.acceleration), ("jerk", axis.jerk)] {
        if !(value > 0.0 && value.is_finite()) {
            return Err(wrong(axis, field, "must be above 0"));
        }
    }
    Ok(())
}

fn finite(field: &str, value: DVec3) -> Result<(), MachineError> {
    if value.is_finite() { Ok(()) } else { Err(MachineError::new(field, "must be three finite numbers")) }
}

fn unit(field: &str, value: DVec3) -> Result<(), MachineError> {
    finite(field, value)?;
    if (value.length() - 1.0).abs() > DISTINCT {
        return Err(MachineError::new(field, "must be a direction of length 1"));
    }
    Ok(())
}
