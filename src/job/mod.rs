//! A job from its specification to its result: the one way in for the page and for the command line.

mod error;
mod fields;
mod schema;
mod spec;

pub use error::JobError;
pub use fields::{Field, GROUPS, Group, Kind, Variant};
pub use schema::schema;
pub use spec::{
    AlongSpec, CutterSpec, FeedSpec, LinkSpec, OrderSpec, SideSpec, SourceSpec, Spec, StrategySpec,
    ToleranceSpec, VERSION, VerifySpec,
};
