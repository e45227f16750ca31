//! Programs for machines with rotary axes: from cutter locations and a machine's file to text that was read back.

mod spec;

pub use spec::{MACHINE_VERSION, machine};
