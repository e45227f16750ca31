//! Starting other programs from the root of the repository.

use anyhow::{Context, Result, bail};
use std::ffi::OsStr;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;

/// The root of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("xtask lies in the repository").to_path_buf()
}

/// Where cargo builds.
pub fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from)
}

/// A program with its arguments, run from the root unless told otherwise.
pub struct Call {
    command: Command,
    text: String,
}

/// What a program printed, and whether it succeeded.
pub struct Outcome {
    pub success: bool,
    pub output: String,
}

/// `program` with `args`.
pub fn call<S: AsRef<OsStr>>(program: &str, args: impl IntoIterator<Item = S>) -> Call {
    let mut command = Command::new(program);
    command.args(args).current_dir(root());
    let text = std::iter::once(program.to_string())
        .chain(command.get_args().map(|a| a.to_string_lossy().into_owned()))
        .collect::<Vec<_>>()
        .join(" ");
    Call { command, text }
}

/// The cargo that runs this task.
pub fn cargo<S: AsRef<OsStr>>(args: impl IntoIterator<Item = S>) -> Call {
    let mut call = call("cargo", args);
    // What cargo sets for this task must not leak into the builds it starts, or they rebuild needlessly.
    for (name, _) in std::env::vars() {
        if name.starts_with("CARGO_PKG_") || name == "CARGO_MANIFEST_DIR" || name == "CARGO_MANIFEST_PATH" {
            call.command.env_remove(name);
        }
    }
    call
}

impl Call {
    pub fn within(mut self, folder: impl AsRef<Path>) -> Self {
        self.command.current_dir(root().join(folder));
        self
    }

    pub fn env(mut self, name: &str, value: impl AsRef<OsStr>) -> Self {
        self.command.env(name, value);
        self
    }

    /// Runs it on this terminal; an error if it could not start or failed.
    pub fn run(mut self) -> Result<()> {
        let status = self.command.status().with_context(|| format!("could not start `{}`", self.text))?;
        if !status.success() {
            bail!("`{}` failed", self.text);
        }
        Ok(())
    }

    /// Runs it silently and returns what it printed.
    pub fn capture(mut self) -> Result<String> {
        let output = self.command.output().with_context(|| format!("could not start `{}`", self.text))?;
        if !output.status.success() {
            bail!("`{}` failed: {}", self.text, String::from_utf8_lossy(&output.stderr).trim());
        }
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    }

    /// Runs it, showing its output as it comes and keeping it.
    pub fn tee(mut self) -> Result<Outcome> {
        println!("$ {}", self.text);
        let mut child = self
            .command
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .with_context(|| format!("could not start `{}`", self.text))?;
        let out = child.stdout.take().map(echo);
        let err = child.stderr.take().map(echo);
        let output = [out, err].into_iter().flatten().filter_map(|t| t.join().ok()).collect();
        Ok(Outcome { success: child.wait()?.success(), output })
    }
}

fn echo(stream: impl Read + Send + 'static) -> thread::JoinHandle<String> {
    thread::spawn(move || {
        let mut text = String::new();
        let mut reader = BufReader::new(stream);
        let mut line = Vec::new();
        // Bytes, not `lines()`: a tool may print something that is not UTF-8.
        while matches!(reader.read_until(b'\n', &mut line), Ok(n) if n > 0) {
            let part = String::from_utf8_lossy(&line);
            print!("{part}");
            text.push_str(&part);
            line.clear();
        }
        text
    })
}
