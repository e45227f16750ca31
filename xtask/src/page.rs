//! The page: its packages, its bundle, its development server.

use crate::shell::{self, Call, root};
use anyhow::{Context, Result};
use std::fs;
use std::path::PathBuf;

/// The bundled page, ready for any static host.
pub fn dist() -> PathBuf {
    root().join("www/dist")
}

/// Bundles the page into `www/dist`; the module must be there.
pub fn build() -> Result<()> {
    install()?;
    tool("vite", &["build", "--logLevel", "warn"]).run()
}

/// Serves the page as it is being edited.
pub fn develop(port: Option<u16>) -> Result<()> {
    install()?;
    tool("vite", &["--host", "127.0.0.1", "--port", &port.unwrap_or(8080).to_string()]).run()
}

/// One of the page's own development tools, run in `www`.
pub fn tool(name: &str, args: &[&str]) -> Call {
    let all = ["--no-install", name].into_iter().chain(args.iter().copied());
    shell::call(npm("npx"), all).within("www")
}

/// Installs the packages of the lock file, unless they are there already.
pub fn install() -> Result<()> {
    let www = root().join("www");
    let lock = fs::read_to_string(www.join("package-lock.json")).context("reading www/package-lock.json")?;
    let stamp = www.join("node_modules/.installed-lock");
    if fs::read_to_string(&stamp).is_ok_and(|installed| installed == lock) {
        return Ok(());
    }
    // Browsers come from the system: nothing is downloaded behind npm's back.
    shell::call(npm("npm"), ["ci", "--no-audit", "--no-fund"])
        .within("www")
        .env("PLAYWRIGHT_SKIP_BROWSER_DOWNLOAD", "1")
        .run()
        .context("installing the page's packages (Node 20 or later is needed: https://nodejs.org)")?;
    fs::write(stamp, lock).context("noting what was installed")
}

fn npm(name: &'static str) -> &'static str {
    match (cfg!(windows), name) {
        (true, "npm") => "npm.cmd",
        (true, "npx") => "npx.cmd",
        _ => name,
    }
}
