//! How a choice is written: people and links name it beside its settings, `{"kind": "ball", "diameter_mm": 6}`; serde
//! reads it from around them, `{"ball": {"diameter_mm": 6}}`.
//!
//! serde can read the former too, but through a copy of its whole machinery for every type that a choice contains:
//! a tenth of the module that a browser has to load.

use super::error::JobError;
use serde::Serialize;
use serde_json::{Map, Value};

/// The settings of a milling job that are a choice.
pub(super) const CHOICES: [&str; 3] = ["source", "cutter", "strategy"];

/// Puts the settings of each of `choices` into their kind.
///
/// Errors name a `kind` that is missing or no text.
pub(super) fn nest(spec: &mut Map<String, Value>, choices: &[&str]) -> Result<(), JobError> {
    for name in choices {
        let Some(Value::Object(settings)) = spec.get_mut(*name) else { continue };
        let Some(Value::String(kind)) = settings.remove("kind") else {
            return Err(JobError::field(&format!("{name}.kind"), "must be the name of a kind".into()));
        };
        let inside = Value::Object(std::mem::take(settings));
        settings.insert(kind, inside);
    }
    Ok(())
}

/// `choice` with its kind beside its settings.
pub(super) fn flat(choice: &impl Serialize) -> Value {
    // Numbers, strings and lists always have a JSON form.
    let Ok(Value::Object(outside)) = serde_json::to_value(choice) else { return Value::Null };
    let Some((kind, Value::Object(mut settings))) = outside.into_iter().next() else { return Value::Null };
    settings.insert("kind".into(), kind.into());
    Value::Object(settings)
}
