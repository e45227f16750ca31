//! `cargo xtask serve | test | build | bench | page`: everything a developer or CI runs.
//!
//! Each command does all of its own set-up on a machine that has rustup and Node.

mod bench;
mod browser;
mod canonical;
mod check;
mod page;
mod rates;
mod rs274;
mod serve;
mod shell;
mod summary;
mod wasm;

use anyhow::{Result, bail};
use std::process::ExitCode;

const USAGE: &str = "\
cargo xtask serve [--port N]   build everything and serve the page on this machine (port 8080 or the next free one)
cargo xtask test  [NAME …]     every check and test, or only the named suites; prints a table of what passed
cargo xtask build              the command line, the WebAssembly module and the page
cargo xtask bench [NAME …]     the benchmarks, then the claims beside OpenCAMLib; `rates` for these alone
cargo xtask page  [--port N]   serve the page as it is being edited, reloading on change";

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    match dispatch(&args) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn dispatch(args: &[String]) -> Result<ExitCode> {
    let (command, rest) = args.split_first().map_or(("help", args), |(c, r)| (c.as_str(), r));
    match command {
        "serve" => {
            let port = port(rest)?;
            build()?;
            serve::run(&page::dist(), port)?;
        }
        "test" => return check::run(rest),
        "build" => {
            shell::cargo(["build", "--release"]).run()?;
            build()?;
        }
        "bench" => bench::run(rest)?,
        "page" => {
            let port = port(rest)?;
            wasm::build()?;
            page::develop(port)?;
        }
        "help" | "--help" | "-h" => println!("{USAGE}"),
        other => bail!("no command `{other}`\n\n{USAGE}"),
    }
    Ok(ExitCode::SUCCESS)
}

fn build() -> Result<()> {
    wasm::build()?;
    page::build()
}

fn port(args: &[String]) -> Result<Option<u16>> {
    match args {
        [] => Ok(None),
        [flag, value] if flag == "--port" => {
            value.parse().map(Some).map_err(|_| anyhow::anyhow!("--port {value}: not a port"))
        }
        [arg] if arg.starts_with("--port=") => port(&["--port".into(), arg["--port=".len()..].into()]),
        _ => bail!("expected --port N, got `{}`", args.join(" ")),
    }
}
