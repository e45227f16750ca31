//! Programs for machines with rotary axes: from cutter locations and a machine's file to text that was read back.

mod post;
mod read_back;
mod spec;

pub use post::{PostOptions, Posted, post, post_program};
pub use read_back::{Deviation, deviation};
pub use spec::{MACHINE_VERSION, machine};

pub use crate::post::multiaxis::{Dialect, Layout};
