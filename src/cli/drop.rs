//! `stepover drop`: heights at which a cutter touches a mesh from above.

use super::Failure;
use clap::Args;

#[derive(Debug, Args)]
pub(super) struct Drop {}

impl Drop {
    pub(super) fn run(&self) -> Result<(), Failure> {
        Err(Failure::Job("comes with the meshes".into()))
    }
}
