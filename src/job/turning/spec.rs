//! The specification of a turning job: everything that affects its output.

use super::fields::TURNING_GROUPS;
use crate::job::error::JobError;
use crate::job::spec::{read, take};
use crate::job::{kinds, schema};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// The version of [`TurningSpec`] that this code writes, and the latest that it reads.
pub const TURNING_VERSION: u32 = 1;

/// The settings that are a choice.
const CHOICES: [&str; 5] = ["surface", "aperture", "tool", "guide", "points"];

/// Everything that affects a turning job's output. Lengths in millimetres and angles in degrees, as the names say; ranges and
/// defaults are those of [`TURNING_GROUPS`](super::TURNING_GROUPS).
///
/// In JSON every choice is an object that names its `kind`, and `"job": "turning"` tells the file from a milling job's.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(into = "Value")]
#[expect(missing_docs, reason = "names and units are the table's in fields.rs")]
pub struct TurningSpec {
    pub version: u32,
    pub name: String,
    pub surface: SurfaceSpec,
    pub aperture: ApertureSpec,
    pub tool: ToolSpec,
    pub guide: GuideSpec,
    pub points: PointsSpec,
    pub tolerance: TurningToleranceSpec,
    pub speed: SpeedSpec,
    pub limits: LimitsSpec,
    pub output: OutputSpec,
    pub verify: TurningVerifySpec,
}

/// What the part looks like, and how it is held.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "names and units are the table's in fields.rs")]
pub enum SurfaceSpec {
    Toric {
        shape: ToricSpec,
        base_radius_mm: f64,
        rotation_radius_mm: f64,
        shift_x_mm: f64,
        shift_y_mm: f64,
        turn_deg: f64,
    },
    Sphere {
        shape: ShapeSpec,
        radius_mm: f64,
        shift_x_mm: f64,
        shift_y_mm: f64,
        turn_deg: f64,
    },
    Conic {
        shape: ShapeSpec,
        radius_mm: f64,
        conic: f64,
        shift_x_mm: f64,
        shift_y_mm: f64,
        turn_deg: f64,
    },
    Asphere {
        shape: ShapeSpec,
        radius_mm: f64,
        conic: f64,
        even: Vec<f64>,
        shift_x_mm: f64,
        shift_y_mm: f64,
        turn_deg: f64,
    },
    Biconic {
        radius_x_mm: f64,
        radius_y_mm: f64,
        conic_x: f64,
        conic_y: f64,
        shift_x_mm: f64,
        shift_y_mm: f64,
        turn_deg: f64,
    },
    Polynomial {
        shape: ShapeSpec,
        radius_mm: f64,
        conic: f64,
        norm_mm: f64,
        terms: Vec<[f64; 3]>,
        shift_x_mm: f64,
        shift_y_mm: f64,
        turn_deg: f64,
    },
    Zernike {
        shape: ShapeSpec,
        radius_mm: f64,
        conic: f64,
        norm_mm: f64,
        terms: Vec<[f64; 3]>,
        shift_x_mm: f64,
        shift_y_mm: f64,
        turn_deg: f64,
    },
    Grid {
        given: GivenSpec,
        columns: f64,
        spacing_x_mm: f64,
        spacing_y_mm: f64,
        heights_mm: Vec<f64>,
        path: String,
        shift_x_mm: f64,
        shift_y_mm: f64,
        turn_deg: f64,
    },
}

/// A choice among words.
macro_rules! words {
    ($(#[$doc:meta])* $name:ident { $($word:ident),+ }) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(rename_all = "snake_case")]
        #[expect(missing_docs, reason = "the names say it")]
        pub enum $name { $($word),+ }
    };
}

words!(
    /// Which way both sections of a toric bend.
    ToricSpec { Convex, Concave, SaddleConvexBase, SaddleConcaveBase }
);
words!(
    /// Which way a surface bends.
    ShapeSpec { Flat, Convex, Concave }
);
words!(
    /// What the numbers of a grid are.
    GivenSpec { Heights, Coefficients }
);
words!(
    /// Which way the nose goes.
    WaySpec { Inward, Outward }
);
words!(
    /// Whether a setting stands as it is or is chosen from the tolerance.
    StepSpec { Given, Chosen }
);
words!(
    /// What the control makes of the points.
    InterpolationSpec { Linear, Pvt }
);
words!(
    /// What is kept even.
    PaceSpec { CSpeed, SurfaceSpeed }
);
words!(
    /// Whether the speed stands as it is or is the highest that the limits allow.
    RateSpec { Highest, Given }
);
words!(
    /// Whose G-code.
    DialectSpec { Linuxcnc, Fanuc }
);
words!(
    /// How speeds are stated.
    FeedWordSpec { InverseTime, PerMinute }
);
words!(
    /// Which point of the tool is stated.
    PointSpec { Tip, Center }
);
words!(
    /// How X is stated.
    XWordSpec { Radius, Diameter }
);
words!(
    /// What turns as C rises.
    CWordSpec { Tool, Part }
);
words!(
    /// What the program is cut with in the proof.
    BodySpec { Own, Ball, Insert }
);

/// How much of the surface is wanted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "names and units are the table's in fields.rs")]
pub enum ApertureSpec {
    Round { radius_mm: f64, center_x_mm: f64, center_y_mm: f64, turn_deg: f64 },
    Ellipse { half_x_mm: f64, half_y_mm: f64, center_x_mm: f64, center_y_mm: f64, turn_deg: f64 },
    Rectangle { half_x_mm: f64, half_y_mm: f64, center_x_mm: f64, center_y_mm: f64, turn_deg: f64 },
}

/// What cuts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "names and units are the table's in fields.rs")]
pub enum ToolSpec {
    Ball { radius_mm: f64, spindle_rpm: f64 },
    Insert { radius_mm: f64, rake_deg: f64, least_rake_deg: f64, clearance_deg: f64, sweep_deg: f64 },
}

/// The curve that the nose follows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "names and units are the table's in fields.rs")]
pub enum GuideSpec {
    Spiral {
        way: WaySpec,
        step: StepSpec,
        step_mm: f64,
        lead_in_turns: f64,
        lead_out_turns: f64,
    },
    Circles {
        across_deg: f64,
        way: WaySpec,
        step: StepSpec,
        step_mm: f64,
        lead_in_turns: f64,
        lead_out_turns: f64,
    },
}

/// How points lie along it, and what the control makes of them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "names and units are the table's in fields.rs")]
pub enum PointsSpec {
    Angle { angle_deg: f64, spacing: StepSpec, interpolation: InterpolationSpec },
    Arc { arc_mm: f64, most_angle_deg: f64, spacing: StepSpec, interpolation: InterpolationSpec },
    Hybrid { arc_mm: f64, switch_mm: f64, spacing: StepSpec, interpolation: InterpolationSpec },
}

/// A group of plain settings.
macro_rules! settings {
    ($(#[$doc:meta])* $name:ident { $($field:ident: $kind:ty),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
        #[serde(deny_unknown_fields)]
        #[expect(missing_docs, reason = "names and units are the table's in fields.rs")]
        pub struct $name { $(pub $field: $kind),+ }
    };
}

settings!(
    /// What must be kept: the residue where the step is chosen, the chord error always.
    TurningToleranceSpec { residue_mm: f64, chord_mm: f64 }
);
settings!(
    /// How fast it goes.
    SpeedSpec {
        pace: PaceSpec,
        rate: RateSpec,
        c_rpm: f64,
        surface_m_per_min: f64,
        most_rpm: f64,
        least_rpm: f64,
    }
);
settings!(
    /// What the axes can do.
    LimitsSpec {
        x_mm_per_s: f64,
        x_mm_per_s2: f64,
        x_mm_per_s3: f64,
        z_mm_per_s: f64,
        z_mm_per_s2: f64,
        z_mm_per_s3: f64,
        c_rpm: f64,
        c_deg_per_s2: f64,
        c_deg_per_s3: f64,
    }
);
settings!(
    /// How the program is written.
    OutputSpec {
        dialect: DialectSpec,
        feed: FeedWordSpec,
        point: PointSpec,
        x_word: XWordSpec,
        c_word: CWordSpec,
        decimals_mm: f64,
        decimals_deg: f64,
        tool_number: f64,
        clearance_mm: f64,
        approach_mm_per_min: f64,
    }
);
settings!(
    /// How the proof is made.
    TurningVerifySpec {
        enabled: bool,
        body: BodySpec,
        spacing_mm: f64,
        fine_mm: f64,
        wide_mm: f64,
        sagitta_chord_mm: f64,
        sagitta_mm: f64,
    }
);

impl TurningSpec {
    /// Reads a specification from JSON text, filling in defaults for what it leaves out: `{}` is the lens of paper 004.
    ///
    /// Errors name line and column for broken JSON, and otherwise the setting: one that is unknown, of the wrong type, or out of its
    /// range.
    pub fn from_json(text: &str) -> Result<Self, JobError> {
        let value: Value =
            serde_json::from_slice(text.as_bytes()).map_err(|e| JobError::Syntax(e.to_string()))?;
        let Value::Object(mut object) = value else {
            return Err(JobError::Syntax("must be a JSON object".into()));
        };
        if object.remove("job").is_some_and(|job| job != "turning") {
            return Err(JobError::field("job", "must be `turning`".into()));
        }
        if object.remove("version").is_some_and(|v| v != TURNING_VERSION) {
            let message = format!("must be {TURNING_VERSION}, the version of this program");
            return Err(JobError::field("version", message));
        }
        schema::complete(&mut object, TURNING_GROUPS)?;
        kinds::nest(&mut object, &CHOICES)?;
        let spec = Self {
            version: TURNING_VERSION,
            name: object.remove("name").map_or(Ok("lens".into()), |name| read("name", &name))?,
            surface: read("surface", &take(&mut object, "surface")?)?,
            aperture: read("aperture", &take(&mut object, "aperture")?)?,
            tool: read("tool", &take(&mut object, "tool")?)?,
            guide: read("guide", &take(&mut object, "guide")?)?,
            points: read("points", &take(&mut object, "points")?)?,
            tolerance: read("tolerance", &take(&mut object, "tolerance")?)?,
            speed: read("speed", &take(&mut object, "speed")?)?,
            limits: read("limits", &take(&mut object, "limits")?)?,
            output: read("output", &take(&mut object, "output")?)?,
            verify: read("verify", &take(&mut object, "verify")?)?,
        };
        match object.keys().next() {
            Some(unknown) => Err(JobError::field(unknown, format!("unknown field `{unknown}`"))),
            None => Ok(spec),
        }
    }

    /// The specification as JSON text with every setting spelled out.
    pub fn to_json(&self) -> String {
        // A struct of numbers, strings and lists always has a JSON form.
        serde_json::to_string_pretty(self).unwrap_or_default()
    }
}

impl From<TurningSpec> for Value {
    fn from(spec: TurningSpec) -> Self {
        json!({
            "job": "turning",
            "version": spec.version,
            "name": spec.name,
            "surface": kinds::flat(&spec.surface),
            "aperture": kinds::flat(&spec.aperture),
            "tool": kinds::flat(&spec.tool),
            "guide": kinds::flat(&spec.guide),
            "points": kinds::flat(&spec.points),
            "tolerance": spec.tolerance,
            "speed": spec.speed,
            "limits": spec.limits,
            "output": spec.output,
            "verify": spec.verify,
        })
    }
}
