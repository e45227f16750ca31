//! The settings of a machine's program in one table, and as JSON.

use super::cutting::{Choice, MATERIALS};
use super::placement::Placement;
use super::post::{Pole, PostOptions};
use super::{Dialect, Layout};
use crate::job::error::JobError;
use crate::job::fields::{Field, Group, Kind, choice, number};
use crate::job::schema::{complete, schema_of};
use crate::job::spec::{read, take};
use serde::Deserialize;
use serde_json::Value;

/// The version of these settings that this code reads.
pub const POST_VERSION: u32 = 1;

const DIALECTS: &[&str] =
    &["linuxcnc", "fanuc", "fanuc_tip", "haas", "siemens", "siemens_vector", "heidenhain", "grbl"];
const NAMES: &[&str] = &[
    MATERIALS[0].name,
    MATERIALS[1].name,
    MATERIALS[2].name,
    MATERIALS[3].name,
    MATERIALS[4].name,
    MATERIALS[5].name,
    MATERIALS[6].name,
    MATERIALS[7].name,
    MATERIALS[8].name,
];

const fn flag(name: &'static str, default: bool) -> Field {
    Field { name, kind: Kind::Flag(default), when: None }
}

const fn shift(name: &'static str) -> Field {
    number(name, "mm", [-2000.0, 2000.0], 1.0, 0.0)
}

const fn turn(name: &'static str) -> Field {
    number(name, "°", [-180.0, 180.0], 5.0, 0.0)
}

/// The objects of these settings in the order in which a form shows them.
pub const POST_GROUPS: &[Group] = &[
    Group {
        path: "program",
        variants: &[],
        fields: &[
            choice("dialect", DIALECTS, "linuxcnc"),
            number("decimals", "", [3.0, 6.0], 1.0, 4.0),
            flag("numbered", false),
            flag("carriage_return", false),
            flag("coolant", true),
        ],
    },
    Group {
        path: "holding",
        variants: &[],
        fields: &[
            choice("tool", &["usual", "given"], "usual"),
            number("tool_length_mm", "mm", [1.0, 1000.0], 1.0, 100.0).when("tool", &["given"]),
            shift("shift_x_mm"),
            shift("shift_y_mm"),
            shift("shift_z_mm"),
            turn("turn_x_deg"),
            turn("turn_y_deg"),
            turn("turn_z_deg"),
        ],
    },
    Group {
        path: "following",
        variants: &[],
        fields: &[
            number("chord_mm", "mm", [1e-5, 1.0], 0.00005, 0.00005),
            number("axis_deg", "°", [1e-4, 5.0], 0.001, 0.002),
            number("turn_deg", "°", [0.1, 5.7], 0.5, 5.7),
            choice("pole", &["insert", "deviate", "aside"], "insert"),
            number("pole_deg", "°", [0.01, 5.0], 0.05, 0.2).when("pole", &["deviate", "aside"]),
        ],
    },
    Group {
        path: "cutting",
        variants: &[],
        fields: &[
            choice("speeds", &["planned", "material"], "planned"),
            choice("material", NAMES, "steel").when("speeds", &["material"]),
            number("teeth", "", [1.0, 20.0], 1.0, 2.0).when("speeds", &["material"]),
            number("most_rpm", "1/min", [100.0, 200_000.0], 1000.0, 18_000.0).when("speeds", &["material"]),
            number("allowance_mm", "mm", [0.001, 10.0], 0.05, 0.1),
        ],
    },
];

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ProgramSpec {
    dialect: String,
    decimals: f64,
    numbered: bool,
    carriage_return: bool,
    coolant: bool,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct HoldingSpec {
    tool: String,
    tool_length_mm: f64,
    shift_x_mm: f64,
    shift_y_mm: f64,
    shift_z_mm: f64,
    turn_x_deg: f64,
    turn_y_deg: f64,
    turn_z_deg: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct FollowingSpec {
    chord_mm: f64,
    axis_deg: f64,
    turn_deg: f64,
    pole: String,
    pole_deg: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct CuttingSpec {
    speeds: String,
    material: String,
    teeth: f64,
    most_rpm: f64,
    allowance_mm: f64,
}

/// The table as JSON, for forms.
pub fn schema() -> String {
    schema_of(POST_GROUPS, POST_VERSION)
}

impl PostOptions {
    /// Reads settings from JSON text, filling in defaults for what it leaves out.
    ///
    /// Errors name line and column for broken JSON, and otherwise the setting and its range.
    pub fn from_json(text: &str) -> Result<Self, JobError> {
        let value: Value = serde_json::from_str(text).map_err(|e| JobError::Syntax(e.to_string()))?;
        let Value::Object(mut object) = value else {
            return Err(JobError::Syntax("must be a JSON object".into()));
        };
        complete(&mut object, POST_GROUPS)?;
        let program: ProgramSpec = read("program", &take(&mut object, "program")?)?;
        let holding: HoldingSpec = read("holding", &take(&mut object, "holding")?)?;
        let following: FollowingSpec = read("following", &take(&mut object, "following")?)?;
        let cutting: CuttingSpec = read("cutting", &take(&mut object, "cutting")?)?;
        if let Some(unknown) = object.keys().next() {
            return Err(JobError::field(unknown, format!("unknown field `{unknown}`")));
        }
        let dialect = Dialect::named(&program.dialect).ok_or_else(|| {
            JobError::field("program.dialect", format!("must be one of {}", DIALECTS.join(", ")))
        })?;
        let decimals = program.decimals as usize;
        Ok(Self {
            tool_length_mm: (holding.tool == "given").then_some(holding.tool_length_mm),
            chord_mm: following.chord_mm,
            axis_deg: following.axis_deg,
            turn_deg: following.turn_deg,
            coolant: program.coolant,
            layout: Layout {
                linear: decimals,
                rotary: decimals,
                numbered: program.numbered,
                carriage_return: program.carriage_return,
                ..Layout::default()
            },
            placement: Placement {
                turn_deg: [holding.turn_x_deg, holding.turn_y_deg, holding.turn_z_deg],
                shift_mm: [holding.shift_x_mm, holding.shift_y_mm, holding.shift_z_mm],
            },
            pole: match following.pole.as_str() {
                "deviate" => Pole::Deviate { degrees: following.pole_deg },
                "aside" => Pole::Aside { degrees: following.pole_deg },
                _ => Pole::Insert,
            },
            speeds: (cutting.speeds == "material")
                .then(|| MATERIALS.iter().find(|material| material.name == cutting.material))
                .flatten()
                .map(|&material| Choice {
                    material,
                    teeth: cutting.teeth.round(),
                    most_rpm: cutting.most_rpm,
                }),
            allowance_mm: cutting.allowance_mm,
            ..Self::new(dialect)
        })
    }
}
