//! A machine as JSON.

use crate::job::error::JobError;
use crate::machine::{Axis, Carries, Joint, Machine, MachineError};
use glam::DVec3;
use serde::Deserialize;
use serde_json::Value;

/// The version of a machine's file that this code reads.
pub const MACHINE_VERSION: u32 = 1;

/// A machine's file. Lengths in millimetres and angles in degrees, as the names say; frames and signs are those of
/// [`crate::machine`].
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct MachineSpec {
    version: u32,
    name: String,
    /// From the workpiece to the tool.
    axes: Vec<Value>,
    tool: ToolSpec,
    workpiece_zero_mm: [f64; 3],
}

/// What the machine holds a tool with.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ToolSpec {
    axis: [f64; 3],
    gauge_mm: [f64; 3],
    longest_mm: f64,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
enum CarriesSpec {
    Workpiece,
    Tool,
}

/// An axis, told apart by its `kind`.
#[derive(Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
enum AxisSpec {
    Linear {
        letter: char,
        carries: CarriesSpec,
        direction: [f64; 3],
        limits_mm: [f64; 2],
        speed_mm_per_min: f64,
        acceleration_mm_per_s2: f64,
        jerk_mm_per_s3: f64,
    },
    Rotary {
        letter: char,
        carries: CarriesSpec,
        direction: [f64; 3],
        point_mm: [f64; 3],
        /// Left out for an axis that turns without end.
        #[serde(default)]
        limits_deg: Option<[f64; 2]>,
        speed_deg_per_s: f64,
        acceleration_deg_per_s2: f64,
        jerk_deg_per_s3: f64,
    },
}

/// The machine of a JSON text.
///
/// Errors name the line and column where the text is no JSON, and else the field, that of an axis as `axes.C.point_mm`.
pub fn machine(json: &str) -> Result<Machine, JobError> {
    let machine = described(json)?;
    machine.check().map_err(|error| stated(&machine, error))?;
    Ok(machine)
}

/// What a JSON text describes, be it a machine or not.
pub(super) fn described(json: &str) -> Result<Machine, JobError> {
    let spec: MachineSpec = serde_json::from_str(json).map_err(|e| JobError::Import(e.to_string()))?;
    if spec.version != MACHINE_VERSION {
        let message =
            format!("must be {MACHINE_VERSION}, the version that is read here, not {}", spec.version);
        return Err(JobError::field("version", message));
    }
    Ok(Machine {
        name: spec.name,
        axes: spec.axes.into_iter().enumerate().map(axis).collect::<Result<_, _>>()?,
        tool_axis: spec.tool.axis.into(),
        gauge: spec.tool.gauge_mm.into(),
        longest_tool: spec.tool.longest_mm,
        workpiece_zero: spec.workpiece_zero_mm.into(),
    })
}

fn axis((index, value): (usize, Value)) -> Result<Axis, JobError> {
    let called = value.get("letter").and_then(Value::as_str).map_or(index.to_string(), str::to_owned);
    let spec: AxisSpec = serde_json::from_value(value)
        .map_err(|error| JobError::field(&format!("axes.{called}"), error.to_string()))?;
    let carried = |carries| match carries {
        CarriesSpec::Workpiece => Carries::Workpiece,
        CarriesSpec::Tool => Carries::Tool,
    };
    Ok(match spec {
        AxisSpec::Linear {
            letter,
            carries,
            direction,
            limits_mm,
            speed_mm_per_min,
            acceleration_mm_per_s2,
            jerk_mm_per_s3,
        } => Axis {
            letter,
            carries: carried(carries),
            joint: Joint::Linear { direction: direction.into() },
            limits: Some(limits_mm),
            speed: speed_mm_per_min / 60.0,
            acceleration: acceleration_mm_per_s2,
            jerk: jerk_mm_per_s3,
        },
        AxisSpec::Rotary {
            letter,
            carries,
            direction,
            point_mm,
            limits_deg,
            speed_deg_per_s,
            acceleration_deg_per_s2,
            jerk_deg_per_s3,
        } => Axis {
            letter,
            carries: carried(carries),
            joint: Joint::Rotary { direction: DVec3::from(direction), point: point_mm.into() },
            limits: limits_deg.map(|limits| limits.map(f64::to_radians)),
            speed: speed_deg_per_s.to_radians(),
            acceleration: acceleration_deg_per_s2.to_radians(),
            jerk: jerk_deg_per_s3.to_radians(),
        },
    })
}

/// The error with the field's name as the file has it, unit and all.
pub(super) fn stated(machine: &Machine, error: MachineError) -> JobError {
    let mut parts = error.field.rsplitn(2, '.');
    let (last, before) = (parts.next().unwrap_or_default(), parts.next());
    let letter = before.and_then(|before| before.strip_prefix("axes."));
    let turns = machine.axes.iter().any(|a| a.is_rotary() && Some(a.letter.to_string().as_str()) == letter);
    let unit = match (last, turns) {
        ("point" | "gauge" | "longest" | "workpiece_zero", _) | ("limits", false) => "_mm",
        ("limits", true) => "_deg",
        ("speed", false) => "_mm_per_min",
        ("speed", true) => "_deg_per_s",
        ("acceleration", false) => "_mm_per_s2",
        ("acceleration", true) => "_deg_per_s2",
        ("jerk", false) => "_mm_per_s3",
        ("jerk", true) => "_deg_per_s3",
        _ => "",
    };
    JobError::Field { field: format!("{}{unit}", error.field), message: error.message }
}
