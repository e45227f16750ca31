//! The browser that runs the page's tests.

use crate::shell;
use anyhow::{Result, bail};
use std::path::{Path, PathBuf};

const NAMES: [&str; 5] =
    ["chromium", "chromium-browser", "google-chrome-stable", "google-chrome", "microsoft-edge"];

const ELSEWHERE: [&str; 3] = [
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
    r"C:\Program Files\Google\Chrome\Application\chrome.exe",
];

/// A Chromium of this machine: `$CHROMIUM`, one on the path, or Debian's package where it may be installed.
pub fn chromium() -> Result<PathBuf> {
    if let Some(found) = installed() {
        return Ok(found);
    }
    if Path::new("/etc/debian_version").exists() && is_root() {
        println!("no Chromium found: installing Debian's");
        let quiet =
            |args: &[&str]| shell::call("apt-get", args).env("DEBIAN_FRONTEND", "noninteractive").run();
        quiet(&["update", "-qq"])?;
        quiet(&["install", "-y", "-qq", "--no-install-recommends", "chromium"])?;
    }
    match installed() {
        Some(found) => Ok(found),
        None => bail!(
            "the page's tests need a Chromium: install chromium or Google Chrome, or set CHROMIUM to its path"
        ),
    }
}

fn installed() -> Option<PathBuf> {
    if let Some(named) = std::env::var_os("CHROMIUM") {
        return Some(PathBuf::from(named)).filter(|path| path.is_file());
    }
    let path = std::env::var_os("PATH").unwrap_or_default();
    let on_path = std::env::split_paths(&path).flat_map(|dir| NAMES.map(|name| dir.join(name)));
    on_path.chain(ELSEWHERE.map(PathBuf::from)).find(|candidate| candidate.is_file())
}

fn is_root() -> bool {
    shell::call("id", ["-u"]).capture().is_ok_and(|id| id.trim() == "0")
}
