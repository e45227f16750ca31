//! A job from its specification to its result: the one way in for the page and for the command line.

#[cfg(feature = "flow")]
mod auto;
#[cfg(feature = "flow")]
mod compare;
mod cubes;
mod error;
mod fields;
mod gallery;
mod inspect;
mod joining;
mod kinds;
#[cfg(feature = "kinematics")]
pub mod machines;
mod picture;
mod report;
mod run;
mod schema;
mod shape;
mod spec;
#[cfg(feature = "flow")]
mod start;
mod stepover;
#[cfg(feature = "study")]
pub mod study;
mod tool;
#[cfg(feature = "turning")]
pub mod turning;
mod two_passes;
mod verify_text;

#[cfg(feature = "flow")]
pub use compare::{Contender, Floor, contenders, holds, least_length};
pub use cubes::Cubes;
pub use error::{JobError, error_json};
pub use fields::{Field, GROUPS, Group, Kind, Variant};
pub use gallery::{Example, gallery, gallery_json};
pub use inspect::{Inspected, Inspection, inspect};
pub use picture::Picture;
pub use report::{Lengths, Report, Unreachable, Verified};
pub use run::{Plan, Proof, plan, preview};
pub use schema::schema;
pub use shape::Shape;
pub use spec::{
    AlongSpec, CutterSpec, FeedSpec, FixtureSpec, HolderSpec, LinkSpec, OrderSpec, RuleSpec, SideSpec,
    SourceSpec, Spec, StrategySpec, ToleranceSpec, VERSION, VerifySpec,
};
#[cfg(feature = "flow")]
pub use spec::{FamiliesSpec, ObjectiveSpec};
#[cfg(feature = "flow")]
pub use start::StartSpec;
pub use stepover::{Placement, StepoverChart, StepoverCurves, stepover_chart};
pub use tool::outline;
pub use two_passes::{TwoPasses, cut_two_passes};
pub use verify_text::verify_text;
