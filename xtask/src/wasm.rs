//! The WebAssembly module and its JavaScript.

use crate::shell::{self, root};
use anyhow::{Context, Result};
use std::path::PathBuf;
use wasm_bindgen_cli_support::Bindgen;

/// The target that browsers run.
pub const TARGET: &str = "wasm32-unknown-unknown";

/// Where the page looks for the module.
pub fn folder() -> PathBuf {
    root().join("www/wasm")
}

/// Compiles the library for the browser and writes `www/wasm/stepover{.js,.d.ts,_bg.wasm}`.
pub fn build() -> Result<()> {
    add_target()?;
    shell::cargo(["build", "--release", "--lib", "--package", "stepover", "--target", TARGET]).run()?;

    Bindgen::new()
        .input_path(shell::target().join(TARGET).join("release/stepover.wasm"))
        .web(true)?
        // The command's default and the library's differ; with `true` an `init()` without arguments throws.
        .omit_default_module_path(false)
        .typescript(true)
        .remove_name_section(true)
        .remove_producers_section(true)
        .generate(folder())
        .context("making the module's JavaScript")
}

/// Makes sure that Rust can compile for the browser.
pub fn add_target() -> Result<()> {
    let installed = shell::call("rustup", ["target", "list", "--installed"]).capture();
    match installed {
        // A Rust from elsewhere (a distribution's package) may have the target already: let the build tell.
        Err(_) => Ok(()),
        Ok(list) if list.lines().any(|line| line.trim() == TARGET) => Ok(()),
        Ok(_) => shell::call("rustup", ["target", "add", TARGET]).run(),
    }
}
