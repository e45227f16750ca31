//! The WebAssembly module and its JavaScript.

use crate::page;
use crate::shell::{self, root};
use anyhow::{Context, Result};
use std::fs;
use std::path::{Path, PathBuf};
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
    shell::cargo(["build", "--profile", PROFILE, "--lib", "--package", "stepover", "--target", TARGET])
        .run()?;

    let bound = shell::target().join("bindgen");
    let module = bound.join(MODULE);
    let before = fs::read(&module).ok();
    Bindgen::new()
        .input_path(built("stepover"))
        .web(true)?
        // The command's default and the library's differ; with `true` an `init()` without arguments throws.
        .omit_default_module_path(false)
        .typescript(true)
        .remove_name_section(true)
        .remove_producers_section(true)
        .generate(&bound)
        .context("making the module's JavaScript")?;
    fs::create_dir_all(folder())?;
    for name in ["stepover.js", "stepover.d.ts", "stepover_bg.wasm.d.ts"] {
        fs::copy(bound.join(name), folder().join(name)).with_context(|| format!("copying {name}"))?;
    }
    let small = folder().join(MODULE);
    if small.exists() && before == Some(fs::read(&module)?) {
        return Ok(());
    }
    // Whatever interrupts this must not leave the module of another build.
    if small.exists() {
        fs::remove_file(&small)?;
    }
    shrink(&module, &small)
}

/// What the module is compiled as; see `Cargo.toml`.
pub const PROFILE: &str = "page";

/// Where the compiler puts the module of the package `name`.
pub fn built(name: &str) -> PathBuf {
    shell::target().join(TARGET).join(PROFILE).join(name).with_extension("wasm")
}

const MODULE: &str = "stepover_bg.wasm";

/// Writes the module `from` to `to` without what is said twice. `-O1`: higher levels take three times as long for a
/// thousandth of the size; the passes after it take a moment for three thousandths.
fn shrink(from: &Path, to: &Path) -> Result<()> {
    page::install()?;
    let features = ["simd", "bulk-memory", "nontrapping-float-to-int", "sign-ext", "mutable-globals"];
    let more = ["reference-types", "multivalue", "extended-const"];
    let mut args: Vec<String> = features.iter().chain(&more).map(|name| format!("--enable-{name}")).collect();
    args.extend(["-O1", "--rse", "--simplify-locals", "--vacuum"].map(String::from));
    args.extend([from.display().to_string(), "-o".into(), to.display().to_string()]);
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    page::tool("wasm-opt", &args).run()
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
