//! The WebAssembly module and its JavaScript.

use crate::shell::{self, root};
use anyhow::{Context, Result, bail};
use std::io::Write;
use std::path::PathBuf;
use wasm_bindgen_cli_support::Bindgen;

/// The target that browsers run.
pub const TARGET: &str = "wasm32-unknown-unknown";

/// What the module may weigh on the wire, bytes after gzip: a visitor on a slow line waits for all of it.
const LIMIT: usize = 350 * 1024;

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

/// The module's size and its size after gzip, bytes.
pub fn size() -> Result<(usize, usize)> {
    let path = folder().join("stepover_bg.wasm");
    let bytes = std::fs::read(&path).with_context(|| format!("reading {}", path.display()))?;
    let mut packer = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    packer.write_all(&bytes)?;
    Ok((bytes.len(), packer.finish()?.len()))
}

/// A line that states the module's size; an error if it is above the limit.
pub fn check_size() -> Result<String> {
    let (raw, packed) = size()?;
    let line = format!(
        "WebAssembly module: {} KB, {} KB after gzip (limit {} KB)",
        raw / 1024,
        packed / 1024,
        LIMIT / 1024
    );
    if packed > LIMIT {
        bail!("{line}");
    }
    Ok(line)
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
