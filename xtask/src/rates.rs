//! Our hot paths in native code and as WebAssembly, and OpenCAMLib's, side by side: counts per processor second.

use crate::shell::{self, root, target};
use crate::wasm;
use anyhow::{Context, Result};
use wasm_bindgen_cli_support::Bindgen;

/// The last OpenCAMLib that is on the Python package index.
const OPENCAMLIB: &str = "opencamlib==2023.1.11";

/// A kind of work and how often it was done in a second.
struct Rate {
    name: String,
    per_second: f64,
}

/// Measures and prints the table.
pub fn run() -> Result<()> {
    let (native, module) = (native()?, module()?);
    let peer = opencamlib().unwrap_or_else(|why| {
        println!("OpenCAMLib skipped: {why:#}");
        Vec::new()
    });
    println!(
        "\n{:<40} {:>12} {:>12} {:>6} {:>12} {:>7}",
        "per processor second", "native", "wasm", "ratio", "OpenCAMLib", "ours"
    );
    for (ours, wasm) in native.iter().zip(&module) {
        let share = wasm.per_second / ours.per_second;
        print!("{:<40} {:>12.0} {:>12.0} {share:>6.2}", ours.name, ours.per_second, wasm.per_second);
        match peer.iter().find(|rate| rate.name == ours.name) {
            Some(theirs) => {
                let ratio = ours.per_second / theirs.per_second;
                println!(" {:>12.0} {ratio:>6.1}x", theirs.per_second);
            }
            None => println!(),
        }
    }
    Ok(())
}

fn native() -> Result<Vec<Rate>> {
    shell::cargo(["build", "--release", "--quiet", "--package", "rates"]).run()?;
    let program = target().join("release").join(format!("rates{}", std::env::consts::EXE_SUFFIX));
    Ok(rates(&shell::call(&program.to_string_lossy(), [""; 0]).capture()?))
}

fn module() -> Result<Vec<Rate>> {
    wasm::add_target()?;
    let what = ["--quiet", "--lib", "--package", "rates", "--target", wasm::TARGET];
    shell::cargo(["build", "--profile", wasm::PROFILE].into_iter().chain(what)).run()?;
    let folder = target().join("rates");
    Bindgen::new()
        .input_path(wasm::built("rates"))
        .nodejs(true)?
        .generate(&folder)
        .context("making the JavaScript of the benchmarks")?;
    let script = root().join("benches/rates/rates.cjs");
    Ok(rates(&shell::call("node", [script, folder]).capture()?))
}

/// OpenCAMLib in a Python environment of its own.
fn opencamlib() -> Result<Vec<Rate>> {
    let venv = target().join("opencamlib");
    let python = venv.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    if !python.exists() {
        let make = ["-m", "venv", &venv.to_string_lossy()];
        shell::call("python3", make).capture().context("python3 with its module venv is needed")?;
    }
    let python = python.to_string_lossy();
    let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", OPENCAMLIB];
    shell::call(&python, install).capture().context("the package could not be installed")?;
    Ok(rates(&shell::call(&python, ["benches/opencamlib_peer.py"]).capture()?))
}

/// Lines of `seconds<TAB>count<TAB>name`.
fn rates(text: &str) -> Vec<Rate> {
    let rate = |line: &str| {
        let mut cells = line.split('\t');
        let (seconds, count): (f64, f64) = (cells.next()?.parse().ok()?, cells.next()?.parse().ok()?);
        Some(Rate { per_second: count / seconds, name: cells.next()?.to_string() })
    };
    text.lines().filter_map(rate).collect()
}
