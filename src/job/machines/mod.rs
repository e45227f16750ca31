//! Programs for machines with rotary axes: from cutter locations and a machine's file to text that was read back.

mod aside;
mod contacts;
mod cutting;
#[cfg(feature = "turning")]
mod lathe;
mod note;
mod placement;
mod post;
mod prove;
mod read_back;
mod report;
mod settings;
mod shipped;
mod show;
mod spec;
mod timeline;

pub use contacts::{Contact, contacts};
pub use cutting::{Choice, Cutting, MATERIALS, Material, clearing_lead, least_diameter};
#[cfg(feature = "turning")]
pub use lathe::{Lathe, lathe};
pub use note::{Matter, Note, notes};
pub use placement::Placement;
pub use post::{Pole, PostOptions, Posted, post, post_program};
pub use prove::{Kept, prove};
pub use read_back::{Deviation, deviation};
pub use report::{kept_json, report_json};
pub use settings::{POST_GROUPS, POST_VERSION, schema};
pub use shipped::{SHIPPED, shipped_json};
pub use show::{Show, band, told};
pub use spec::{MACHINE_VERSION, machine};
pub use timeline::{Band, Moment, Timeline};

pub use crate::machine::Machine;
pub use crate::post::multiaxis::{Dialect, Layout};
