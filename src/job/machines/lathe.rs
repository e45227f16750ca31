//! Lathes whose spindle is a servo axis, from the same file as mills: X, Z and C.

use super::spec::{described, stated};
use crate::job::error::JobError;
use crate::job::turning::{LimitsSpec, TurningSpec};
use crate::machine::{Axis, Carries, Joint, Machine, MachineError};
use crate::toolpath::TurningPath;
use glam::DVec3;

/// A lathe: what its axes can do, and where the tool and the part are while they stand at 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Lathe {
    machine: Machine,
    /// X, Z and C.
    axes: [Axis; 3],
}

/// How far the part's axis may be from that of C, mm: what is more is a slip of the pen.
const CENTRED: f64 = 1e-3;

/// The lathe of a JSON text: linear axes X and Z and a rotary axis C about Z that carries the part, and no others.
///
/// Errors name the line and column where the text is no JSON, and else the field, that of an axis as `axes.C.speed_deg_per_s`.
pub fn lathe(json: &str) -> Result<Lathe, JobError> {
    let machine = described(json)?;
    let axes = check(&machine).map_err(|error| stated(&machine, error))?;
    Ok(Lathe { machine, axes })
}

fn check(machine: &Machine) -> Result<[Axis; 3], MachineError> {
    machine.check_parts()?;
    let wrong = |field: &str, message: String| Err(MachineError::new(field, message));
    for axis in &machine.axes {
        if !['X', 'Z', 'C'].contains(&axis.letter) {
            let message = "is no axis of a lathe here: X, Z and C are driven, and no others".into();
            return wrong(&format!("axes.{}.letter", axis.letter), message);
        }
    }
    let mut axes = [machine.axes[0]; 3];
    for (place, (letter, along)) in axes.iter_mut().zip([('X', DVec3::X), ('Z', DVec3::Z), ('C', DVec3::Z)]) {
        let Some(&axis) = machine.axes.iter().find(|axis| axis.letter == letter) else {
            let message = format!(
                "is missing: a lathe with a servo spindle needs X and Z and the rotary axis C, and none called {letter} is there"
            );
            return wrong(&format!("axes.{letter}"), message);
        };
        let (Joint::Linear { direction } | Joint::Rotary { direction, .. }) = axis.joint;
        if direction.cross(along).length() > 1e-3 {
            let message = format!("must be along {} of the machine", if letter == 'X' { "x" } else { "z" });
            return wrong(&format!("axes.{letter}.direction"), message);
        }
        *place = axis;
    }
    let Joint::Rotary { point, .. } = axes[2].joint else { return Ok(axes) };
    if axes[2].carries != Carries::Workpiece {
        return wrong("axes.C.carries", "must be workpiece: C turns the part".into());
    }
    let off = point - machine.workpiece_zero;
    if libm::hypot(off.x, off.y) > CENTRED {
        let message = "must be on the part's axis, at x and y of workpiece_zero_mm: the part turns about it";
        return wrong("axes.C.point", message.into());
    }
    Ok(axes)
}

impl Lathe {
    /// What it is called.
    pub fn name(&self) -> &str {
        &self.machine.name
    }

    /// The job with this lathe's speeds, accelerations and jerks as its limits.
    pub fn limiting(&self, spec: TurningSpec) -> TurningSpec {
        let [x, z, c] = &self.axes;
        // As they were written: the way by radians leaves a trace in the last digit.
        let degrees = |x: f64| (x.to_degrees() * 1e6).round() / 1e6;
        let limits = LimitsSpec {
            x_mm_per_s: x.speed,
            x_mm_per_s2: x.acceleration,
            x_mm_per_s3: x.jerk,
            z_mm_per_s: z.speed,
            z_mm_per_s2: z.acceleration,
            z_mm_per_s3: z.jerk,
            c_rpm: degrees(c.speed) / 6.0,
            c_deg_per_s2: degrees(c.acceleration),
            c_deg_per_s3: degrees(c.jerk),
        };
        TurningSpec { limits, ..spec }
    }

    /// Whether all of `path` is within the limits of the axes, for a tool whose nose is centred where the machine's gauge is while they
    /// stand at 0. An error names the axis, and from where to where it would go.
    pub fn holds(&self, path: &TurningPath) -> Result<(), JobError> {
        let from = self.machine.gauge - self.machine.workpiece_zero;
        let points = || path.points.iter();
        let spans = [
            span(points().map(|p| self.position(0, p.x, from.x))),
            span(points().map(|p| self.position(1, p.z, from.z))),
            span(points().map(|p| p.c)),
        ];
        for (axis, [least, greatest]) in self.axes.iter().zip(spans) {
            let Some([low, high]) = axis.limits else { continue };
            if least < low || greatest > high {
                let [least, greatest, low, high] = [least, greatest, low, high].map(|x| axis.shown(x));
                let unit = axis.unit();
                let message = format!(
                    "are {low:.3} to {high:.3}{unit}, and the path goes from {least:.3} to {greatest:.3}{unit} in machine coordinates"
                );
                let error = MachineError::new(format!("axes.{}.limits", axis.letter), message);
                return Err(stated(&self.machine, error));
            }
        }
        Ok(())
    }

    /// Where a linear axis stands with the nose at a place of the part.
    fn position(&self, index: usize, place: f64, gauge: f64) -> f64 {
        let axis = &self.axes[index];
        let (Joint::Linear { direction } | Joint::Rotary { direction, .. }) = axis.joint;
        let way = if axis.carries == Carries::Tool { place - gauge } else { gauge - place };
        way * (direction.x + direction.z).signum()
    }
}

fn span(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}
