//! The vocabulary that planner, simulation and post-processors share; no algorithm lives here.

mod path;
mod station;
mod turning;

pub use path::{Move, Rate, Role, Toolpath};
pub use station::{Bound, CcPoint, ClPoint, Pass, Posture, Station, Touch, Work};
pub use turning::{AxisPoint, Interpolation, Nose, TurningPath};
