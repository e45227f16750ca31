//! The specification of a job: everything that affects its output.

use super::error::JobError;
use super::fields::GROUPS;
#[cfg(feature = "flow")]
use super::start::StartSpec;
use super::{kinds, schema};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

/// The version of [`Spec`] that this code writes, and the latest that it reads.
pub const VERSION: u32 = 1;

/// Everything that affects a job's output. Lengths in millimetres and angles in degrees, as the names say.
///
/// In JSON every choice is an object that names its `kind`.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(into = "Value")]
pub struct Spec {
    /// [`VERSION`].
    pub version: u32,
    /// The part's name, for the program's header.
    pub name: String,
    /// The shape.
    pub source: SourceSpec,
    /// The tool.
    pub cutter: CutterSpec,
    /// What holds it.
    pub holder: HolderSpec,
    /// How passes are laid.
    pub strategy: StrategySpec,
    /// What the finish must keep.
    pub tolerance: ToleranceSpec,
    /// How passes are joined.
    pub links: LinkSpec,
    /// How fast it goes.
    pub feeds: FeedSpec,
    /// How the proof is made.
    pub verify: VerifySpec,
}

/// Where the shape comes from, and which side of it is cut.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum SourceSpec {
    /// A file that comes beside the specification.
    File {
        /// Its name or path.
        path: String,
        /// Which of the shapes in it, from 0.
        #[serde(default)]
        face: usize,
        /// Unit of its numbers, where the file does not say or says wrong.
        #[serde(default)]
        unit: Option<String>,
        /// Factors along x, y and z on top of the unit, each above 0: for grids that do not state their spacing, and for
        /// models made to another scale.
        #[serde(default = "no_scale")]
        scale: [f64; 3],
        /// Which side is cut.
        #[serde(default)]
        side: SideSpec,
    },
    /// A flat rectangle in z = 0, centred.
    Plane {
        /// Sizes along x and y.
        size_mm: [f64; 2],
        /// Which side is cut.
        #[serde(default)]
        side: SideSpec,
    },
    /// A piece of a cylinder along x, its middle pointing to +z.
    Cylinder {
        /// Radius.
        radius_mm: f64,
        /// Angle that the piece covers; 360 for all of it.
        angle_deg: f64,
        /// Length along x.
        length_mm: f64,
        /// `front` is the outside.
        #[serde(default)]
        side: SideSpec,
    },
    /// A piece of a cone along x, its middle pointing to +z.
    Cone {
        /// Radius at the lower end of x.
        radius_start_mm: f64,
        /// Radius at the upper end of x.
        radius_end_mm: f64,
        /// Angle that the piece covers.
        angle_deg: f64,
        /// Length along x.
        length_mm: f64,
        /// `front` is the outside.
        #[serde(default)]
        side: SideSpec,
    },
    /// A piece of a sphere around the +z axis's equator turned up: angles to both sides of +z.
    Sphere {
        /// Radius.
        radius_mm: f64,
        /// Angle that the piece covers along x and along y, at most 178 along y.
        angle_deg: [f64; 2],
        /// `front` is the outside.
        #[serde(default)]
        side: SideSpec,
    },
    /// A piece of a torus about y, its outer equator pointing to +z.
    Torus {
        /// Radius of the centre circle.
        major_mm: f64,
        /// Radius of the tube.
        minor_mm: f64,
        /// Angle about the axis and angle around the tube; 360 for all of it.
        angle_deg: [f64; 2],
        /// `front` is the outside.
        #[serde(default)]
        side: SideSpec,
    },
    /// A rational B-spline surface.
    Nurbs {
        /// Degrees in u and v.
        degrees: [usize; 2],
        /// Knots in u.
        knots_u: Vec<f64>,
        /// Knots in v.
        knots_v: Vec<f64>,
        /// Control points, v running fastest.
        points_mm: Vec<[f64; 3]>,
        /// Weights in the same order; all 1 without.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        weights: Option<Vec<f64>>,
        /// `front` is where `du × dv` points.
        #[serde(default)]
        side: SideSpec,
    },
}

fn no_scale() -> [f64; 3] {
    [1.0; 3]
}

/// Which side is cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SideSpec {
    /// Where `du × dv` points, or the outside of triangles.
    #[default]
    Front,
    /// The other side.
    Back,
}

/// The tool.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "names and units are the table's in fields.rs")]
pub enum CutterSpec {
    BullNose { diameter_mm: f64, corner_radius_mm: f64, height_mm: f64 },
    Ball { diameter_mm: f64, height_mm: f64 },
    Flat { diameter_mm: f64, height_mm: f64 },
    Tapered { diameter_mm: f64, corner_radius_mm: f64, taper_deg: f64, height_mm: f64 },
    Conical { diameter_mm: f64, corner_radius_mm: f64, bottom_deg: f64, height_mm: f64 },
}

/// What holds the tool: nothing that is known, or a cylinder. Only links keep clear of it; cuts that it does not clear are told.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(missing_docs, reason = "names and units are the table's in fields.rs")]
pub enum HolderSpec {
    None,
    Cylinder { stickout_mm: f64, diameter_mm: f64, height_mm: f64 },
}

impl HolderSpec {
    /// From settings whose values the schema has checked: only names can be wrong.
    fn read(value: &Value) -> Result<Self, JobError> {
        let names = ["shape", "stickout_mm", "diameter_mm", "height_mm"];
        let mut keys = value.as_object().into_iter().flat_map(Map::keys);
        if let Some(unknown) = keys.find(|key| !names.contains(&key.as_str())) {
            return Err(JobError::field("holder", format!("unknown field `{unknown}`")));
        }
        let number = |k: usize| value[names[k]].as_f64().unwrap_or_default();
        Ok(if value["shape"] == "cylinder" {
            Self::Cylinder { stickout_mm: number(1), diameter_mm: number(2), height_mm: number(3) }
        } else {
            Self::None
        })
    }

    fn to_value(self) -> Value {
        match self {
            Self::None => json!({ "shape": "none" }),
            Self::Cylinder { stickout_mm, diameter_mm, height_mm } => json!({
                "shape": "cylinder", "stickout_mm": stickout_mm, "diameter_mm": diameter_mm, "height_mm": height_mm,
            }),
        }
    }
}

/// Writes [`StrategySpec`]: strategies for surfaces, each with settings of its own before those by which the cutter leans.
///
/// serde could take the latter from a type of their own, but only through a copy of its machinery that the page would have to load.
macro_rules! strategies {
    ($($(#[$only:meta])? $name:ident { $($own:ident: $type:ty),* })*) => {
        /// How passes are laid.
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
        #[serde(rename_all = "snake_case", deny_unknown_fields)]
        #[expect(missing_docs, reason = "names and units are the table's in fields.rs")]
        pub enum StrategySpec {
            $($(#[$only])? $name {
                $($own: $type,)*
                rule: RuleSpec,
                lead_deg: f64,
                yaw_deg: f64,
                least_lead_deg: f64,
                most_lead_deg: f64,
                most_yaw_deg: f64,
                turn_along_deg_per_mm: f64,
                turn_across_deg_per_mm: f64,
                order: OrderSpec,
            },)*
            Raster {
                angle_deg: f64,
                order: OrderSpec,
            },
        }
    };
}

strategies! {
    IsoParametric { along: AlongSpec }
    IsoPlanar { angle_deg: f64 }
    #[cfg(feature = "flow")]
    ConstantScallop { start: StartSpec, start_percent: f64, start_points_mm: Vec<[f64; 3]>, angle_deg: f64 }
    #[cfg(feature = "flow")]
    Flow { families: FamiliesSpec }
    #[cfg(feature = "flow")]
    PotentialField { least_efficiency_percent: f64 }
    #[cfg(feature = "flow")]
    Auto { objective: ObjectiveSpec }
}

/// What the best of all strategies is the least of: the time of the whole program at its feeds, or the length of its cuts.
#[cfg(feature = "flow")]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the names say it")]
pub enum ObjectiveSpec {
    Time,
    Length,
}

/// Whether passes along the widest strips are of one family, or of as many as make the cuts shortest.
#[cfg(feature = "flow")]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the names say it")]
pub enum FamiliesSpec {
    One,
    Several,
}

/// The parameter that passes follow.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the names say it")]
pub enum AlongSpec {
    U,
    V,
}

/// How the cutter's lead and yaw are found: stated, by curvature matching, for the widest strips, or by curvature matching with the
/// cutter on both sides of hollows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the names say it")]
pub enum RuleSpec {
    Fixed,
    Matched,
    Widest,
    TwoContacts,
}

/// Whether passes go one way or to and fro; one way also with what is uncut always on the right of the feed (climb, for a spindle that
/// turns clockwise) or always on its left (conventional).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the names say it")]
pub enum OrderSpec {
    Zig,
    Zigzag,
    Climb,
    Conventional,
}

/// What the finish must keep.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ToleranceSpec {
    /// Highest cusp.
    pub scallop_mm: f64,
    /// Share of it that passes are planned for: what is above 0 and below 1 keeps the rest in reserve, for a machine that is
    /// less exact than the plan. Proof and report judge by the whole.
    pub safety: f64,
    /// Deviation of straight moves from the surface.
    pub chord_mm: f64,
}

/// How passes are joined.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LinkSpec {
    /// Lift between neighbouring passes.
    pub lift_mm: f64,
    /// Distance from everything on rapid ways.
    pub clearance_mm: f64,
    /// What the part stands on.
    pub fixture: FixtureSpec,
    /// Height of the plane that it is.
    pub fixture_z_mm: f64,
}

/// What the part stands on, which links keep above of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the names say it")]
pub enum FixtureSpec {
    None,
    Plane,
}

/// How fast it goes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FeedSpec {
    /// Feed along passes.
    pub cut_mm_per_min: f64,
    /// Feed down to a pass.
    pub plunge_mm_per_min: f64,
    /// What the machine does in rapid; for the time in the report only.
    pub rapid_mm_per_min: f64,
    /// Spindle speed.
    pub spindle_rpm: f64,
}

/// How the proof is made.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct VerifySpec {
    /// Whether the path is cut in simulation.
    pub enabled: bool,
    /// Distance of the samples; around the extremes the simulation takes finer ones by itself.
    pub spacing_mm: f64,
}

impl Spec {
    /// Reads a specification from JSON text, filling in defaults for what it leaves out.
    ///
    /// Errors name line and column for broken JSON, and otherwise the setting: one that is unknown, missing, of the
    /// wrong type, or out of its range.
    pub fn from_json(text: &str) -> Result<Self, JobError> {
        let value: Value =
            serde_json::from_slice(text.as_bytes()).map_err(|e| JobError::Syntax(e.to_string()))?;
        let Value::Object(mut object) = value else {
            return Err(JobError::Syntax("must be a JSON object".into()));
        };
        match object.get("version").map(Value::as_u64) {
            None => object.insert("version".into(), VERSION.into()),
            Some(Some(v)) if v == u64::from(VERSION) => None,
            Some(_) => {
                return Err(JobError::field(
                    "version",
                    format!("must be {VERSION}, the version of this program"),
                ));
            }
        };
        schema::complete(&mut object, GROUPS)?;
        kinds::nest(&mut object, &kinds::CHOICES)?;
        let spec = Self {
            version: VERSION,
            name: object.remove("name").map_or(Ok(String::new()), |name| read("name", &name))?,
            source: source(&take(&mut object, "source")?)?,
            cutter: read("cutter", &take(&mut object, "cutter")?)?,
            holder: HolderSpec::read(&take(&mut object, "holder")?)?,
            strategy: read("strategy", &take(&mut object, "strategy")?)?,
            tolerance: read("tolerance", &take(&mut object, "tolerance")?)?,
            links: read("links", &take(&mut object, "links")?)?,
            feeds: read("feeds", &take(&mut object, "feeds")?)?,
            verify: read("verify", &take(&mut object, "verify")?)?,
        };
        object.remove("version");
        match object.keys().next() {
            Some(unknown) => Err(JobError::field(unknown, format!("unknown field `{unknown}`"))),
            None => Ok(spec),
        }
    }

    /// The specification as JSON text with every setting spelled out, so that it stays the same when defaults change.
    pub fn to_json(&self) -> String {
        // A struct of numbers, strings and lists always has a JSON form.
        serde_json::to_string_pretty(self).unwrap_or_default()
    }
}

pub(super) fn take(object: &mut Map<String, Value>, name: &str) -> Result<Value, JobError> {
    object.remove(name).ok_or_else(|| JobError::field(name, format!("missing field `{name}`")))
}

/// One group of settings, whose values the schema has checked: only names can be wrong, and those the message tells.
pub(super) fn read<'a, T: Deserialize<'a>>(name: &str, value: &'a Value) -> Result<T, JobError> {
    T::deserialize(value).map_err(|e| JobError::field(name, e.to_string()))
}

/// The shape, which no schema has checked. What is wrong is the setting without which something else is.
fn source(value: &Value) -> Result<SourceSpec, JobError> {
    SourceSpec::deserialize(value).map_err(|e| {
        let message = e.to_string();
        let is_wrong = |name: &&String| {
            let mut less = value.clone();
            let inside = less.as_object_mut().and_then(|less| less.values_mut().next()?.as_object_mut());
            inside.and_then(|inside| inside.remove(*name));
            SourceSpec::deserialize(&less).map_or_else(|e| e.to_string() != message, |_| true)
        };
        let inside = value.as_object().and_then(|value| value.values().next()?.as_object());
        let wrong = inside.and_then(|inside| inside.keys().find(is_wrong));
        JobError::field(&wrong.map_or("source".into(), |name| format!("source.{name}")), message)
    })
}

impl From<Spec> for Value {
    fn from(spec: Spec) -> Self {
        json!({
            "version": spec.version,
            "name": spec.name,
            "source": kinds::flat(&spec.source),
            "cutter": kinds::flat(&spec.cutter),
            "holder": spec.holder.to_value(),
            "strategy": kinds::flat(&spec.strategy),
            "tolerance": spec.tolerance,
            "links": spec.links,
            "feeds": spec.feeds,
            "verify": spec.verify,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LEAST: &str = r#"{"source": {"kind": "plane", "size_mm": [50, 30]}}"#;

    fn error(text: &str) -> (String, String) {
        match Spec::from_json(text).unwrap_err() {
            JobError::Field { field, message } => (field, message),
            other => (String::new(), other.to_string()),
        }
    }

    #[test]
    fn defaults_fill_in_and_survive_the_way_through_json() {
        let spec = Spec::from_json(LEAST).unwrap();
        assert_eq!(spec.tolerance.scallop_mm, 0.01);
        assert!(matches!(spec.strategy, StrategySpec::IsoParametric { along: AlongSpec::U, .. }));
        assert_eq!(Spec::from_json(&spec.to_json()).unwrap(), spec);
    }

    #[test]
    fn what_is_wrong_is_named() {
        let with = |extra: &str| LEAST.replacen('{', &format!("{{{extra}, "), 1);
        let (field, message) = error(&with(r#""tolerance": {"scallop_mm": 0}"#));
        assert_eq!(field, "tolerance.scallop_mm");
        assert!(message.contains("0.0001 to 5 mm"), "{message}");
        let (field, message) = error(&with(r#""cutter": {"kind": "spoon"}"#));
        assert_eq!(field, "cutter.kind");
        assert!(message.contains("bull_nose"), "{message}");
        let (field, message) = error(&with(r#""tolerance": {"scalop_mm": 0.01}"#));
        assert!(field.starts_with("tolerance") && message.contains("scalop_mm"), "{field} {message}");
        let (_, message) = error(&with(r#""tolerence": {}"#));
        assert!(message.contains("tolerence"), "{message}");
        let (field, _) = error(&with(r#""version": 7"#));
        assert_eq!(field, "version");
        let (_, message) = error("{\n\"source\": }");
        assert!(message.contains("line 2"), "{message}");
        assert!(error(&with(r#""feeds": {"spindle_rpm": "fast"}"#)).1.contains("number"));
        assert!(error("{}").1.contains("source"));
        let (field, message) = error(r#"{"source": {"kind": "cylinder", "radius_mm": "wide"}}"#);
        assert_eq!(field, "source.radius_mm");
        assert!(message.contains("wide"), "{message}");
        assert_eq!(error(r#"{"source": {"radius_mm": 3}}"#).0, "source.kind");
        let (field, message) = error(r#"{"source": {"kind": "egg"}}"#);
        assert!(field.starts_with("source") && message.contains("egg"), "{field} {message}");
    }
}
