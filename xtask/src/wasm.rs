//! The WebAssembly modules and their JavaScript.

use crate::page;
use crate::shell::{self, root};
use anyhow::{Context, Result};
use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::thread;
use wasm_bindgen_cli_support::Bindgen;

/// The target that browsers run.
pub const TARGET: &str = "wasm32-unknown-unknown";

/// Where the page looks for the module.
pub fn folder() -> PathBuf {
    root().join("www/wasm")
}

/// What the page loads at once or when it is needed: the library with what the named feature offers.
struct Module {
    /// Of its files: `NAME.js`, `NAME.d.ts`, `NAME_bg.wasm`.
    name: &'static str,
    /// The only one it is compiled with.
    feature: &'static str,
}

const MODULES: [Module; 4] = [
    Module { name: "stepover", feature: "milling" },
    Module { name: "study", feature: "study" },
    Module { name: "turning", feature: "turning" },
    Module { name: "machines", feature: "machines" },
];

/// Compiles the library for the browser, once for each module, and writes them to [`folder`].
pub fn build() -> Result<()> {
    add_target()?;
    page::install()?;
    fs::create_dir_all(folder())?;
    // The compiler's last step, which takes longest, keeps one core busy: so as many at once as there are cores.
    let next = Mutex::new(MODULES.iter());
    let take = || next.lock().ok().and_then(|mut modules| modules.next());
    let work = || std::iter::from_fn(take).try_for_each(build_one);
    let cores = thread::available_parallelism().map_or(1, NonZeroUsize::get);
    thread::scope(|scope| {
        let workers: Vec<_> = (0..cores.min(MODULES.len())).map(|_| scope.spawn(work)).collect();
        workers
            .into_iter()
            .try_for_each(|worker| worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
    })
}

fn build_one(module: &Module) -> Result<()> {
    // A folder each: the compiler gives them all the same name.
    let target = shell::target().join("page").join(module.name);
    let library = ["build", "--profile", PROFILE, "--lib", "--package", "stepover", "--target", TARGET];
    let only = ["--no-default-features", "--features", module.feature];
    let folder_of_its_own = ["--target-dir".into(), target.display().to_string()];
    let args = library.into_iter().chain(only).map(String::from).chain(folder_of_its_own);
    shell::cargo(args).run()?;

    let bound = target.join("bindgen");
    let code = format!("{}_bg.wasm", module.name);
    let before = fs::read(bound.join(&code)).ok();
    Bindgen::new()
        .input_path(target.join(TARGET).join(PROFILE).join("stepover.wasm"))
        .out_name(module.name)
        .web(true)?
        // The command's default and the library's differ; with `true` an `init()` without arguments throws.
        .omit_default_module_path(false)
        .typescript(true)
        .remove_name_section(true)
        .remove_producers_section(true)
        .generate(&bound)
        .context("making the module's JavaScript")?;
    for end in [".js", ".d.ts", "_bg.wasm.d.ts"] {
        let name = format!("{}{end}", module.name);
        fs::copy(bound.join(&name), folder().join(&name)).with_context(|| format!("copying {name}"))?;
    }
    let small = folder().join(&code);
    let (told, passes) = (bound.join("passes"), PASSES.join(" "));
    let is_told = fs::read_to_string(&told).is_ok_and(|before| before == passes);
    if small.exists() && is_told && before == Some(fs::read(bound.join(&code))?) {
        return Ok(());
    }
    // Whatever interrupts this must not leave the module of another build.
    if small.exists() {
        fs::remove_file(&small)?;
    }
    shrink(&bound.join(&code), &small)?;
    fs::write(&told, passes).context("keeping what made the module small")
}

/// What the modules are compiled as; see `Cargo.toml`.
pub const PROFILE: &str = "page";

/// Where the compiler puts the module of the package `name`.
pub fn built(name: &str) -> PathBuf {
    shell::target().join(TARGET).join(PROFILE).join(name).with_extension("wasm")
}

/// What makes modules small. `-O1`: higher levels take three times as long for a thousandth of the size; the passes after it take a
/// moment for nine thousandths.
const PASSES: [&str; 9] = [
    "-O1",
    "--dae-optimizing",
    "--rse",
    "--simplify-locals",
    "--remove-unused-brs",
    "--code-folding",
    "--vacuum",
    "--duplicate-function-elimination",
    "--reorder-locals",
];

/// Writes the module `from` to `to` without what is said twice.
fn shrink(from: &Path, to: &Path) -> Result<()> {
    let features = ["simd", "bulk-memory", "nontrapping-float-to-int", "sign-ext", "mutable-globals"];
    let more = ["reference-types", "multivalue", "extended-const"];
    let mut args: Vec<String> = features.iter().chain(&more).map(|name| format!("--enable-{name}")).collect();
    args.extend(PASSES.map(String::from));
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
