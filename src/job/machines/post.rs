//! From cutter locations to a machine's program that was read back.

use super::aside::tilt_aside;
use super::contacts::{Contact, contacts, touching};
use super::cutting::{self, Choice, Cutting};
use super::placement::Placement;
use super::read_back::{Deviation, deviation};
use crate::job::error::JobError;
use crate::machine::{AxisPath, Following, Kinematics, Machine, Times, Tolerance, drive, estimate};
use crate::monitor::Stage;
use crate::post::multiaxis::{self, Dialect, Layout, MachineProgram};
use crate::post::{Program, apt};
use crate::toolpath::Toolpath;

/// What happens where the tool passes a pole, and the rotary axis nearer to the workpiece would swing round.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Pole {
    /// Points are inserted, so that the axis stays within its tolerance; the feed gives way.
    #[default]
    Insert,
    /// The axis may be off by so much, degrees, within that angle of the pole, and passes through it.
    Deviate {
        /// The angle.
        degrees: f64,
    },
    /// The axis is tilted aside about its contact, and leads around the pole at that angle, degrees.
    Aside {
        /// The angle.
        degrees: f64,
    },
}

/// What a program shall keep and look like.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PostOptions {
    /// Whose language.
    pub dialect: Dialect,
    /// From the spindle's nose to the tip, mm. `None` takes half of the longest tool that the machine takes, or the cutter's height
    /// where that is more.
    pub tool_length_mm: Option<f64>,
    /// How far the contact may be from its way across the surface at feed, mm, above 0; without contacts, the tip from its line.
    pub chord_mm: f64,
    /// How far the axis may be from its own at feed, degrees, above 0.
    pub axis_deg: f64,
    /// The most that a rotary axis turns from block to block, degrees, above 0 and at most 5.7.
    pub turn_deg: f64,
    /// Whether coolant is switched on.
    pub coolant: bool,
    /// Numbers and lines.
    pub layout: Layout,
    /// How the part is clamped.
    pub placement: Placement,
    /// What happens at poles.
    pub pole: Pole,
    /// How spindle and feed are chosen; those of the path are kept without.
    pub speeds: Option<Choice>,
    /// What the cutter takes off, mm, for the least diameter on which it cuts.
    pub allowance_mm: f64,
}

impl PostOptions {
    /// A twentieth of a micrometre, so that excess and gouge stay as planned to a tenth, 0.002°, coolant, the layout that controls are usually given, the part as it is and the speeds of the path.
    pub fn new(dialect: Dialect) -> Self {
        Self {
            dialect,
            tool_length_mm: None,
            chord_mm: 5e-5,
            axis_deg: 0.002,
            turn_deg: 5.7,
            coolant: true,
            layout: Layout::default(),
            placement: Placement::default(),
            pole: Pole::Insert,
            speeds: None,
            allowance_mm: 0.1,
        }
    }

    fn following(&self) -> Result<Following, JobError> {
        let positive = |field, x: f64, most: f64, unit: &str| {
            let message = || format!("must be above 0 and at most {most}{unit}");
            if x > 0.0 && x <= most { Ok(()) } else { Err(JobError::field(field, message())) }
        };
        positive("following.chord_mm", self.chord_mm, 1.0, " mm")?;
        positive("following.axis_deg", self.axis_deg, 5.0, "°")?;
        positive("following.turn_deg", self.turn_deg, 5.7, "°")?;
        let pole = match self.pole {
            Pole::Insert => 0.0,
            Pole::Deviate { degrees } | Pole::Aside { degrees } => {
                positive("following.pole_deg", degrees, 5.0, "°")?;
                if let Pole::Deviate { .. } = self.pole { degrees.to_radians() } else { 0.0 }
            }
        };
        let feed = Tolerance { chord: self.chord_mm, axis: self.axis_deg.to_radians() };
        let defaults = Following::new(self.dialect.control());
        let (largest_turn, rotary_step) = (self.turn_deg.to_radians(), self.layout.rotary_step());
        Ok(Following { feed, pole, largest_turn, rotary_step, ..defaults })
    }
}

/// A program for a machine, and what is known of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Posted {
    /// The program's text.
    pub text: String,
    /// What the text states, as it was read back, in the part's own frame.
    pub read: Program,
    /// What it was made of, in the part's own frame.
    pub planned: Program,
    /// Likewise its path as the part is clamped and the axis tilted: what the machine follows.
    pub toolpath: Toolpath,
    /// How far what was read back is from that path.
    pub deviation: Deviation,
    /// How closely the axes follow it at feed.
    pub tolerance: Tolerance,
    /// The estimated time, s.
    pub times: Times,
    /// The motion of the axes.
    pub path: AxisPath,
    /// The machine.
    pub machine: Machine,
    /// The machine with its tool.
    pub kinematics: Kinematics,
    /// What the cutter gets at its contacts, if they are known.
    pub cutting: Option<Cutting>,
    /// The moves whose axis was tilted aside.
    pub aside: Vec<usize>,
}

impl Posted {
    /// What the text states, as cutter locations (APT) in the part's own frame.
    pub fn read_back(&self) -> String {
        apt::write(&self.read)
    }
}

/// Largest difference between a path and what is read back of it: a tip in mm, and an axis in degrees. More is an error of this
/// program, and not of the path.
const FAITHFUL: Deviation = Deviation { tip_mm: 2e-3, axis_deg: 2e-3 };

/// The program that makes `machine` cut along the cutter locations of `text` (APT), read back from its own text. `table` (CSV) is what was
/// written with it: where the cutter touches.
///
/// Errors name the line of the cutter locations or of the table, the move, the axis, or the field.
pub fn post(
    text: &str,
    table: Option<&str>,
    machine: &Machine,
    options: &PostOptions,
    stage: &Stage,
) -> Result<Posted, JobError> {
    stage.part("Reading the path", 0.0, 0.2).at(0.0)?;
    let program = apt::read(text).map_err(|e| JobError::Post(e.to_string()))?;
    let contacts = table.map_or(Ok(Vec::new()), |table| contacts(table, &program.toolpath))?;
    post_program(program, &contacts, machine, options, &stage.part("Writing the program", 0.2, 1.0))
}

/// Likewise, for a program that was read already, with the contacts of its moves; an empty list where they are not known.
pub fn post_program(
    program: Program,
    contacts: &[Option<Contact>],
    machine: &Machine,
    options: &PostOptions,
    stage: &Stage,
) -> Result<Posted, JobError> {
    let following = options.following()?;
    let usual = (0.5 * machine.longest_tool).max(program.cutter.height);
    let length = options.tool_length_mm.unwrap_or(usual);
    let kinematics = Kinematics::new(machine, length).map_err(|e| JobError::Post(e.to_string()))?;
    let planned = program.clone();
    let Program { part, unit, cutter, tool, mut spindle_rpm, mut toolpath } = program;
    let choice = options.speeds.as_ref();
    if let Some(choice) = choice {
        cutting::choose(&mut toolpath, &cutter, &mut spindle_rpm, contacts, choice)?;
    }
    let look = |rpm| cutting::look(&toolpath, &cutter, rpm, contacts, choice, options.allowance_mm);
    let cutting = spindle_rpm.and_then(look);
    if !options.placement.is_none() {
        toolpath = options.placement.path(&toolpath);
    }
    let contacts = options.placement.contacts(contacts);
    // Before axes are tilted, while leads are those of the contacts.
    let touching = touching(&toolpath, &contacts);
    let aside = match (options.pole, kinematics.pole()) {
        (Pole::Aside { degrees }, Some(pole)) => {
            tilt_aside(&mut toolpath, &cutter, &contacts, pole, degrees.to_radians())?
        }
        _ => Vec::new(),
    };
    stage.part("Moving the axes", 0.0, 0.4).at(0.0)?;
    let path =
        drive(&kinematics, &toolpath, &touching, &following).map_err(|e| JobError::Post(e.to_string()))?;
    let stated = MachineProgram {
        part: &part,
        machine: &machine.name,
        kinematics: &kinematics,
        cutter,
        tool,
        spindle_rpm,
        coolant: options.coolant,
        path: &path,
    };
    stage.part("Writing the text", 0.4, 0.55).at(0.0)?;
    let text = multiaxis::write(&stated, options.dialect, &options.layout)
        .map_err(|e| JobError::Post(e.to_string()))?;
    stage.part("Reading it back", 0.55, 0.95).at(0.0)?;
    // Closer than the program keeps its own path.
    let tolerance = Tolerance { chord: 0.1 * options.chord_mm, axis: 0.2 * options.axis_deg.to_radians() };
    let read = multiaxis::read(&text, options.dialect, &kinematics, &tolerance)
        .map_err(|e| JobError::Post(format!("the program does not read back: {e}")))?;
    let deviation = deviation(&toolpath, &read).ok_or_else(|| {
        JobError::Post("the program reads back as another path: give it more decimals".into())
    })?;
    let Deviation { tip_mm, axis_deg } = deviation;
    if tip_mm > FAITHFUL.tip_mm || axis_deg > FAITHFUL.axis_deg {
        return Err(JobError::Post(format!(
            "the program reads back {tip_mm:.4} mm and {axis_deg:.4}° off its path: give it more decimals"
        )));
    }
    let times = estimate(kinematics.axes(), &path);
    let read = if options.placement.is_none() { read } else { options.placement.path_back(&read) };
    let read = Program { part, unit, cutter, tool, spindle_rpm, toolpath: read };
    stage.at(1.0)?;
    let machine = machine.clone();
    Ok(Posted {
        text,
        read,
        planned,
        toolpath,
        deviation,
        times,
        path,
        machine,
        kinematics,
        cutting,
        aside,
        tolerance: following.feed,
    })
}
