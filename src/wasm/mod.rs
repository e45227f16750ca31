//! The boundary to the page: decodes, calls [`crate::job`], encodes. No arithmetic lives here.
//!
//! Specifications, reports and lists travel as JSON text, geometry as flat typed arrays. Errors are thrown as a string
//! that holds JSON `{code, message, field?}`.
//!
//! Each file is what one module of the page offers, and a feature; what a module does not offer it does not hold.

#[cfg(feature = "machines")]
pub mod machines;
#[cfg(feature = "milling")]
pub mod milling;
#[cfg(feature = "study")]
pub mod study;
#[cfg(feature = "turning")]
pub mod turning;

use crate::job::{self, JobError};
use crate::monitor::{Monitor, Stage};
use js_sys::Function;
use std::cell::RefCell;
use std::num::NonZeroUsize;
use wasm_bindgen::prelude::*;

thread_local! {
    /// Whom the running call tells its progress. A static, since a monitor must be shareable and a function is not.
    static LISTENER: RefCell<Option<Function>> = const { RefCell::new(None) };
}

/// Passes progress on to the page. Cancelling is not asked here: the page ends the whole worker.
struct Page;

impl Monitor for Page {
    fn progress(&self, phase: &str, fraction: f64) {
        LISTENER.with_borrow(|listener| {
            if let Some(listener) = listener {
                // A listener that throws loses its progress, not the plan.
                let _ = listener.call2(&JsValue::NULL, &phase.into(), &fraction.into());
            }
        });
    }

    fn is_cancelled(&self) -> bool {
        false
    }
}

fn watched<T>(listener: Function, work: impl FnOnce(&Stage) -> Result<T, JobError>) -> Result<T, JsValue> {
    LISTENER.set(Some(listener));
    let done = work(&Stage::whole(&Page, NonZeroUsize::MIN));
    LISTENER.set(None);
    done.map_err(thrown)
}

fn thrown(error: JobError) -> JsValue {
    job::error_json(&error).into()
}

/// Puts a panic's text on the console.
#[wasm_bindgen(start)]
pub fn start() {
    console_error_panic_hook::set_once();
}
