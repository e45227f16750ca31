//! Every check and test, each run even if one before it failed.

use crate::shell::{self, Call, Outcome};
use crate::summary::{self, Dialect, Row};
use crate::{browser, page, rs274, serve, wasm};
use anyhow::{Result, bail};
use std::process::ExitCode;
use std::time::Instant;

struct Suite {
    /// How it is asked for on the command line.
    id: &'static str,
    name: &'static str,
    dialect: Dialect,
    run: fn() -> Result<Outcome>,
}

const SUITES: [Suite; 9] = [
    Suite { id: "format", name: "Rust format", dialect: Dialect::Whole, run: format },
    Suite { id: "lint", name: "Rust lints, native", dialect: Dialect::Whole, run: lint },
    Suite { id: "lint-wasm", name: "Rust lints, WebAssembly", dialect: Dialect::Whole, run: lint_wasm },
    Suite { id: "native", name: "Native tests", dialect: Dialect::Cargo, run: native },
    Suite { id: "rs274", name: "G-code in LinuxCNC", dialect: Dialect::Cargo, run: rs274::run },
    Suite { id: "module", name: "WebAssembly module in Node", dialect: Dialect::Node, run: module },
    Suite { id: "style", name: "Page format and lints", dialect: Dialect::Whole, run: style },
    Suite { id: "types", name: "Page types", dialect: Dialect::Whole, run: types },
    Suite { id: "browser", name: "Page in Chromium", dialect: Dialect::Playwright, run: chromium },
];

/// Runs all suites, or those named, and ends with the table.
pub fn run(names: &[String]) -> Result<ExitCode> {
    if let Some(unknown) = names.iter().find(|name| SUITES.iter().all(|s| s.id != name.as_str())) {
        bail!("no suite `{unknown}`; there are {}", SUITES.map(|s| s.id).join(", "));
    }
    let chosen = SUITES.iter().filter(|s| names.is_empty() || names.iter().any(|name| name == s.id));
    let rows: Vec<Row> = chosen.map(row).collect();
    print!("{}", summary::table(&rows));
    let failed = rows.iter().any(|row| row.failed > 0);
    Ok(if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}

fn row(suite: &Suite) -> Row {
    println!("\n── {}", suite.name);
    let start = Instant::now();
    let (output, success, note) = match (suite.run)() {
        Ok(outcome) => (outcome.output, outcome.success, String::new()),
        Err(error) if error.is::<rs274::Skipped>() => {
            println!("{error}");
            let note = error.to_string();
            return Row { name: suite.name, passed: 0, failed: 0, time: start.elapsed(), note };
        }
        Err(error) => {
            println!("{error:#}");
            (String::new(), false, format!("{error:#}"))
        }
    };
    let (passed, failed) = summary::count(suite.dialect, &output, success);
    Row { name: suite.name, passed, failed, time: start.elapsed(), note }
}

fn format() -> Result<Outcome> {
    shell::cargo(["fmt", "--all", "--check"]).tee()
}

fn lint() -> Result<Outcome> {
    each_package(&["stepover", "xtask", "rates"], |package| {
        shell::cargo(["clippy", "--package", package, "--all-targets", "--quiet", "--", "-D", "warnings"])
    })
}

fn lint_wasm() -> Result<Outcome> {
    wasm::add_target()?;
    let lib = ["clippy", "--package", "stepover", "--lib", "--target", wasm::TARGET];
    shell::cargo(lib.into_iter().chain(["--quiet", "--", "-D", "warnings"])).tee()
}

fn native() -> Result<Outcome> {
    each_package(&["stepover", "xtask"], |package| {
        // The same random cases in every run, unless others are asked for: a change is what fails, not the draw.
        let seed = std::env::var("PROPTEST_RNG_SEED").unwrap_or_else(|_| "7".into());
        shell::cargo(["test", "--package", package, "--no-fail-fast"]).env("PROPTEST_RNG_SEED", seed)
    })
}

/// Runs a command for each of the packages. Not `--workspace`: that unites the features of all dependencies and so
/// builds those of this task, which are built already, once more.
fn each_package(packages: &[&'static str], command: fn(&'static str) -> Call) -> Result<Outcome> {
    let mut all = Outcome { success: true, output: String::new() };
    for package in packages {
        let one = command(package).tee()?;
        all = Outcome { success: all.success && one.success, output: all.output + &one.output };
    }
    Ok(all)
}

fn module() -> Result<Outcome> {
    wasm::build()?;
    // The command line that the module's texts are compared with.
    let built = shell::cargo(["build", "--package", "stepover", "--bin", "stepover", "--quiet"]).tee()?;
    if !built.success {
        return Ok(built);
    }
    shell::call("node", ["--test", "--test-reporter=tap", "tests/web/module.test.js"])
        .env(
            "STEPOVER",
            shell::target().join("debug").join(format!("stepover{}", std::env::consts::EXE_SUFFIX)),
        )
        .tee()
}

fn style() -> Result<Outcome> {
    tool("biome", &["check", ".", "../tests/web"])
}

fn types() -> Result<Outcome> {
    wasm::build()?;
    tool("tsc", &[])
}

fn chromium() -> Result<Outcome> {
    wasm::build()?;
    page::build()?;
    let address = serve::background(page::dist())?;
    playwright().env("BASE_URL", address).env("CHROMIUM", browser::chromium()?).tee()
}

fn playwright() -> Call {
    page::tool("playwright", &["test"])
}

fn tool(name: &str, args: &[&str]) -> Result<Outcome> {
    page::install()?;
    page::tool(name, args).tee()
}
