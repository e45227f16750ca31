//! Machines: axes described by data, and the motion of the axes that makes a toolpath.
//!
//! # Frames and signs
//!
//! - The machine frame is fixed to the bed. While every axis stands at 0 the workpiece frame is parallel to it, with its origin at
//!   [`Machine::workpiece_zero`], and the tool points along [`Machine::tool_axis`].
//! - An axis carries the workpiece or the tool. As its number rises, what it carries goes along its direction or turns about it by
//!   the right hand. Most machines count the other way where the table moves (ISO 841 counts the tool's motion over the part):
//!   there the direction is stated with the other sign.
//! - The tool's length counts from the spindle's nose ([`Machine::gauge`]) to the tip.
//! - A machine that leans its tool about two axes reaches every pose in two ways, but for where the tool points along the rotary axis
//!   nearer to the workpiece: that axis is free there. This is the *pole*.

mod axis;
mod axis_path;
mod ball;
mod beyond;
mod chain;
mod choose;
mod description;
mod drive;
mod ends;
mod error;
mod figure;
mod follow;
mod kinematics;
mod options;
mod spread;
mod stray;
mod stretch;
mod time;
mod trace;
mod turns;
mod two_turns;

pub use axis::{Axis, Carries, Joint};
pub use axis_path::{AxisMove, AxisPath};
pub use chain::{Chain, Tool};
pub use description::Machine;
pub use drive::drive;
pub use error::{MachineError, MotionError};
pub use figure::{Figure, Label, Part, Scene, Solid};
pub use kinematics::{Kinematics, Position};
pub use options::{Control, Following, Tolerance};
pub use stray::Touching;
pub use time::{Times, durations, estimate, smoothing};
pub use trace::trace;
