//! From cutter locations to a machine's program that was read back.

use super::read_back::{Deviation, deviation};
use crate::job::error::JobError;
use crate::machine::{AxisPath, Following, Kinematics, Machine, Times, Tolerance, drive, estimate};
use crate::post::multiaxis::{self, Dialect, Layout, MachineProgram};
use crate::post::{Program, apt};

/// What a program shall keep and look like.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PostOptions {
    /// Whose language.
    pub dialect: Dialect,
    /// From the spindle's nose to the tip, mm. `None` takes half of the longest tool that the machine takes, or the cutter's height
    /// where that is more.
    pub tool_length_mm: Option<f64>,
    /// How far the tip may be from its line at feed, mm, above 0.
    pub chord_mm: f64,
    /// How far the axis may be from its own at feed, degrees, above 0.
    pub axis_deg: f64,
    /// Whether coolant is switched on.
    pub coolant: bool,
    /// Numbers and lines.
    pub layout: Layout,
}

impl PostOptions {
    /// A micrometre, 0.005°, coolant, and the layout that controls are usually given.
    pub fn new(dialect: Dialect) -> Self {
        Self {
            dialect,
            tool_length_mm: None,
            chord_mm: 1e-3,
            axis_deg: 0.005,
            coolant: true,
            layout: Layout::default(),
        }
    }

    fn following(&self) -> Result<Following, JobError> {
        let positive = |field, x: f64, most: f64, unit: &str| {
            let message = || format!("must be above 0 and at most {most}{unit}");
            if x > 0.0 && x <= most { Ok(()) } else { Err(JobError::field(field, message())) }
        };
        positive("chord_mm", self.chord_mm, 1.0, " mm")?;
        positive("axis_deg", self.axis_deg, 5.0, "°")?;
        let feed = Tolerance { chord: self.chord_mm, axis: self.axis_deg.to_radians() };
        let defaults = Following::new(self.dialect.control());
        Ok(Following { feed, rotary_step: self.layout.rotary_step(), ..defaults })
    }
}

/// A program for a machine, and what is known of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Posted {
    /// The program's text.
    pub text: String,
    /// What the text states, as it was read back.
    pub read: Program,
    /// How far that is from the cutter locations.
    pub deviation: Deviation,
    /// The estimated time, s.
    pub times: Times,
    /// The motion of the axes.
    pub path: AxisPath,
    /// The machine with its tool.
    pub kinematics: Kinematics,
}

impl Posted {
    /// What the text states, as cutter locations (APT).
    pub fn read_back(&self) -> String {
        apt::write(&self.read)
    }
}

/// Largest difference between a path and what is read back of it: a tip in mm, and an axis in degrees. More is an error of this
/// program, and not of the path.
const FAITHFUL: Deviation = Deviation { tip_mm: 2e-3, axis_deg: 2e-3 };

/// The program that makes `machine` cut along the cutter locations of `text` (APT), read back from its own text.
///
/// Errors name the line of the cutter locations, the move, the axis, or the field.
pub fn post(text: &str, machine: &Machine, options: &PostOptions) -> Result<Posted, JobError> {
    let program = apt::read(text).map_err(|e| JobError::Post(e.to_string()))?;
    post_program(&program, machine, options)
}

/// Likewise, for a program that was read already.
pub fn post_program(program: &Program, machine: &Machine, options: &PostOptions) -> Result<Posted, JobError> {
    let following = options.following()?;
    let usual = (0.5 * machine.longest_tool).max(program.cutter.height);
    let length = options.tool_length_mm.unwrap_or(usual);
    let kinematics = Kinematics::new(machine, length).map_err(|e| JobError::Post(e.to_string()))?;
    let path =
        drive(&kinematics, &program.toolpath, &[], &following).map_err(|e| JobError::Post(e.to_string()))?;
    let stated = MachineProgram {
        part: &program.part,
        machine: &machine.name,
        kinematics: &kinematics,
        cutter: program.cutter,
        tool: program.tool,
        spindle_rpm: program.spindle_rpm,
        coolant: options.coolant,
        path: &path,
    };
    let text = multiaxis::write(&stated, options.dialect, &options.layout)
        .map_err(|e| JobError::Post(e.to_string()))?;
    // Closer than the program keeps its own path.
    let tolerance = Tolerance { chord: 0.2 * options.chord_mm, axis: 0.2 * options.axis_deg.to_radians() };
    let read = multiaxis::read(&text, options.dialect, &kinematics, &tolerance)
        .map_err(|e| JobError::Post(format!("the program does not read back: {e}")))?;
    let deviation = deviation(&program.toolpath, &read).ok_or_else(|| {
        JobError::Post("the program reads back as another path: give it more decimals".into())
    })?;
    let Deviation { tip_mm, axis_deg } = deviation;
    if tip_mm > FAITHFUL.tip_mm || axis_deg > FAITHFUL.axis_deg {
        return Err(JobError::Post(format!(
            "the program reads back {tip_mm:.4} mm and {axis_deg:.4}° off its path: give it more decimals"
        )));
    }
    let times = estimate(kinematics.axes(), &path);
    let Program { unit, cutter, tool, spindle_rpm, .. } = *program;
    let read = Program { part: program.part.clone(), unit, cutter, tool, spindle_rpm, toolpath: read };
    Ok(Posted { text, read, deviation, times, path, kinematics })
}
