//! Optics on a lathe whose spindle is a servo axis (slow tool servo): from a sag and a nose to motions of X, Z and C.
//!
//! The nose centre runs along a guide curve in the plane square to the spindle axis; its height is that at which the nose
//! touches the surface. Read in this order: [`sag`] and [`Placed`] for the part, [`Aperture`] for how much of it is wanted,
//! [`Tool`], [`locate`] for the height of the nose, [`Guide`] and [`Spacing`] for where it goes, [`Pace`] for how fast, and
//! [`plan`] for all of it together.

mod aperture;
mod choose;
mod chord;
mod cusp;
mod dynamics;
mod error;
mod fit;
mod guide;
mod height_jet;
mod limits;
mod locate;
mod outer;
mod pace;
mod placed;
mod plan;
mod ramp;
mod round;
pub mod sag;
mod spacing;
mod tool;

pub use aperture::{Aperture, Outline};
pub use choose::{Asked, chosen_angle, chosen_step};
pub use chord::{Chord, chord_error};
pub use cusp::{Cusp, highest_cusp};
pub use dynamics::{Dynamics, Moment, Peak, Trend, dynamics};
pub use error::{Spot, TurningError};
pub use fit::{Fit, fit};
pub use guide::{Curve, Guide, Way, Ways};
pub use height_jet::{HeightJet, PolarJet};
pub use limits::{Limits, Strictest, strictest};
pub use locate::{Location, Offset, locate};
pub use outer::{innermost, outermost};
pub use pace::Pace;
pub use placed::Placed;
pub use plan::{Order, Planned, Speed, Step, plan};
pub use spacing::{Spacing, angles};
pub use tool::Tool;
