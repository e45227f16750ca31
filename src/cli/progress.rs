//! Progress on a terminal.

use crate::monitor::Monitor;
use std::io::{IsTerminal, Write};
use std::sync::Mutex;

/// Draws phase and percentage on one line of standard error, if that is a terminal.
#[derive(Debug)]
pub(super) struct Terminal {
    shown: Option<Mutex<(String, i32)>>,
}

impl Terminal {
    pub(super) fn new() -> Self {
        Self { shown: std::io::stderr().is_terminal().then(Mutex::default) }
    }

    /// Clears the line.
    pub(super) fn clear(&self) {
        if self.shown.is_some() {
            let _ = write!(std::io::stderr(), "\r\x1b[K");
        }
    }
}

impl Monitor for Terminal {
    fn progress(&self, phase: &str, fraction: f64) {
        let Some(shown) = &self.shown else { return };
        let percent = (100.0 * fraction) as i32;
        let Ok(mut shown) = shown.lock() else { return };
        if shown.0 != phase || shown.1 != percent {
            *shown = (phase.into(), percent);
            // A terminal that cannot be written to shows no progress; the job goes on.
            let _ = write!(std::io::stderr(), "\r\x1b[K{percent:3} %  {phase}");
            let _ = std::io::stderr().flush();
        }
    }

    fn is_cancelled(&self) -> bool {
        false
    }
}
