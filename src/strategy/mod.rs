//! From a shape and a cutter to ordered passes that leave no cusp above the limit: one file a strategy.

#[cfg(feature = "flow")]
mod coarea;
#[cfg(feature = "flow")]
mod constant_scallop;
mod corner;
#[cfg(feature = "flow")]
mod ease;
#[cfg(feature = "flow")]
mod edge_to_edge;
mod family;
mod fill;
mod finish;
#[cfg(feature = "flow")]
mod flow;
mod follow;
mod glean;
mod iso_parametric;
mod iso_planar;
mod laid;
mod left;
#[cfg(feature = "flow")]
mod line_field;
mod link;
mod order;
mod places;
mod placing;
#[cfg(feature = "flow")]
mod potential;
#[cfg(feature = "flow")]
mod potential_field;
mod probe;
#[cfg(feature = "flow")]
mod promise;
mod raster;
#[cfg(feature = "flow")]
mod region;
mod ridge;
mod run_out;
mod setup;
mod shorten;
mod spacing;
#[cfg(feature = "flow")]
mod streamlines;
#[cfg(test)]
mod trial;
mod trim;
mod unreached;
mod walk;

#[cfg(feature = "flow")]
pub use constant_scallop::{Start, StartError, constant_scallop};
pub use finish::{Finish, Order, Planned, StrategyError};
#[cfg(feature = "flow")]
pub use flow::{Families, flow};
pub use iso_parametric::iso_parametric;
pub use iso_planar::iso_planar;
pub use link::{IsClear, LOOK, Linked, Linking, Outline, Refuge, link, link_time};
pub use order::{Side, nearest_next, one_sided};
#[cfg(feature = "study")]
pub use potential::Potential;
#[cfg(feature = "flow")]
pub use potential_field::potential_field;
#[cfg(feature = "flow")]
pub use promise::Promises;
pub use raster::{Raster, RasterError, RasterOptions, raster};
pub use shorten::shortened;
#[cfg(feature = "study")]
pub use streamlines::{PathPoint, Streamlines, Swept};
