//! Jobs for a lathe on X, Z and C: a specification of their own, from part to proven program.

mod fields;
mod parts;
mod report;
mod run;
mod spec;
mod table;
mod trace;
mod warnings;

pub use fields::TURNING_GROUPS;
pub use report::{Asked, Axis, Place, Sag, Share, TurnedReport, TurningReport};
pub use run::{TurningPlan, TurningProof, plan, read_program, verify_text};
pub use spec::{
    ApertureSpec, BodySpec, CWordSpec, DialectSpec, FeedWordSpec, GivenSpec, GuideSpec, InterpolationSpec,
    LimitsSpec, OutputSpec, PaceSpec, PointSpec, PointsSpec, RateSpec, ShapeSpec, SpeedSpec, StepSpec,
    SurfaceSpec, TURNING_VERSION, ToolSpec, ToricSpec, TurningSpec, TurningToleranceSpec, TurningVerifySpec,
    WaySpec, XWordSpec,
};

/// The schema that forms are made from, as JSON text, in the form of [`schema`](super::schema).
pub fn schema() -> String {
    super::schema::schema_of(TURNING_GROUPS, TURNING_VERSION)
}
