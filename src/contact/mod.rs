//! The cutter against a surface at one contact point: where it stands, how it bends away, what it finishes.

mod approach;
mod body;
mod circle;
mod clearance;
mod drop;
mod envelope;
mod half_strip;
mod lifted_strip;
mod matching;
mod place;
mod relative;
mod straight;
mod strip_model;
mod strip_surface;
mod two_contact;

pub use body::Body;
pub use circle::{
    circle_stepover, curved_circle_stepover, effective_radius, lateral_circle_stepover, plane_circle_stepover,
};
pub use clearance::FaceObstacle;
pub use drop::{DropMesh, Feature, Touch, Underside, drop_cutter, drop_cutter_above, is_in_mesh};
pub use envelope::Sweep;
pub use half_strip::HalfStrip;
pub use matching::matching_lead;
pub use place::{axis, center, cl_of, contact_of};
pub use relative::{cutter_curvature, second_order_strip_width};
pub use straight::{Lean, StraightStrip, straight_strip};
pub use strip_model::{ModelStrip, model_section, model_strip};
pub use strip_surface::{Edge, FaceStrip, StripLimits, face_strip};
pub use two_contact::{TwoContact, two_contact, widest_two_contact};
