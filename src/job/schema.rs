//! The table of settings as JSON: for forms, for filling in defaults, and for checking ranges.

use super::error::JobError;
use super::fields::{Field, GROUPS, Group, Kind, SECOND, Variant};
use serde_json::{Map, Value, json};

/// The schema that forms are made from, as JSON text: groups in order, each with its variants and settings, with unit,
/// range, step and default of every setting.
pub fn schema() -> String {
    schema_of(GROUPS, super::VERSION)
}

/// The schema of other groups than those of a milling job.
pub(super) fn schema_of(groups: &[Group], version: u32) -> String {
    let groups: Vec<Value> = groups
        .iter()
        .map(|g| {
            json!({
                "id": g.path,
                "path": g.path,
                "variants": g.variants.iter().map(variant).collect::<Vec<_>>(),
                "fields": g.fields.iter().map(field).collect::<Vec<_>>(),
            })
        })
        .collect();
    json!({ "version": version, "groups": groups }).to_string()
}

fn variant(v: &Variant) -> Value {
    let fields: Vec<Value> = v.fields.iter().map(field).collect();
    json!({ "kind": v.kind, "for": v.shapes, "second": SECOND.contains(&v.kind), "fields": fields })
}

fn field(f: &Field) -> Value {
    let mut shown = match f.kind {
        Kind::Number { unit, min, max, step, default } => json!({
            "name": f.name, "type": "number", "unit": unit, "min": min, "max": max, "step": step, "default": default,
        }),
        Kind::Choice { options, default } => {
            json!({ "name": f.name, "type": "choice", "options": options, "default": default })
        }
        Kind::Flag(default) => json!({ "name": f.name, "type": "boolean", "default": default }),
        Kind::Points => json!({ "name": f.name, "type": "points", "default": [] }),
        #[cfg(feature = "turning")]
        Kind::Numbers => json!({ "name": f.name, "type": "numbers", "default": [] }),
        #[cfg(feature = "turning")]
        Kind::Text => json!({ "name": f.name, "type": "text", "default": "" }),
    };
    if let Some((choice, words)) = f.when {
        shown["when"] = json!({ "field": choice, "is": words });
    }
    shown
}

/// The settings that apply to `object`, by its `kind`.
///
/// Errors name the `kind` if it is not one of the group's.
fn settings(group: &'static Group, object: &Map<String, Value>) -> Result<Vec<&'static Field>, JobError> {
    let own: &[Field] = match (group.variants.first(), object.get("kind")) {
        (None, _) => &[],
        (Some(first), None) => first.fields,
        (Some(_), Some(kind)) => {
            let found = group.variants.iter().find(|v| kind == v.kind);
            let known = || group.variants.iter().map(|v| v.kind).collect::<Vec<_>>().join(", ");
            found
                .ok_or_else(|| {
                    JobError::field(&format!("{}.kind", group.path), format!("must be one of {}", known()))
                })?
                .fields
        }
    };
    Ok(own.iter().chain(group.fields).collect())
}

/// Fills in what `spec` leaves out with the defaults of the table `groups`, and checks what it says against the table's ranges.
///
/// Errors name the setting and what would be right.
pub(super) fn complete(spec: &mut Map<String, Value>, groups: &'static [Group]) -> Result<(), JobError> {
    for group in groups {
        let entry = spec.entry(group.path).or_insert_with(|| Value::Object(Map::new()));
        let Value::Object(object) = entry else {
            return Err(JobError::field(group.path, "must be an object".into()));
        };
        if let Some(first) = group.variants.first() {
            object.entry("kind").or_insert_with(|| first.kind.into());
        }
        for field in settings(group, object)? {
            let path = format!("{}.{}", group.path, field.name);
            let value = object.entry(field.name).or_insert_with(|| default(field));
            check(field, value).map_err(|message| JobError::field(&path, message))?;
        }
    }
    Ok(())
}

/// More points than a start curve needs: each of its pieces is looked at with each other one.
const MOST_POINTS: usize = 1000;

/// A height map of two thousand numbers a side.
#[cfg(feature = "turning")]
const MOST_NUMBERS: usize = 4_000_000;

fn default(field: &Field) -> Value {
    match field.kind {
        Kind::Number { default, .. } => default.into(),
        Kind::Choice { default, .. } => default.into(),
        Kind::Flag(default) => default.into(),
        Kind::Points => Value::Array(Vec::new()),
        #[cfg(feature = "turning")]
        Kind::Numbers => Value::Array(Vec::new()),
        #[cfg(feature = "turning")]
        Kind::Text => "".into(),
    }
}

fn check(field: &Field, value: &Value) -> Result<(), String> {
    match field.kind {
        Kind::Number { unit, min, max, .. } => match value.as_f64() {
            Some(x) if (min..=max).contains(&x) => Ok(()),
            _ => Err(format!("must be a number from {min} to {max} {unit}").trim_end().into()),
        },
        Kind::Choice { options, .. } => match value.as_str() {
            Some(s) if options.contains(&s) => Ok(()),
            _ => Err(format!("must be one of {}", options.join(", "))),
        },
        Kind::Flag(_) => {
            if value.is_boolean() {
                Ok(())
            } else {
                Err("must be true or false".into())
            }
        }
        #[cfg(feature = "turning")]
        Kind::Text => value.as_str().map(|_| ()).ok_or_else(|| "must be text".into()),
        #[cfg(feature = "turning")]
        Kind::Numbers => match value.as_array() {
            Some(list) if list.len() <= MOST_NUMBERS && list.iter().all(Value::is_number) => Ok(()),
            _ => Err(format!("must be a list of up to {MOST_NUMBERS} numbers")),
        },
        Kind::Points => {
            let is_number = |x: &Value| x.is_number();
            let is_point = |p: &Value| p.as_array().is_some_and(|p| p.len() == 3 && p.iter().all(is_number));
            match value.as_array() {
                Some(list) if list.len() <= MOST_POINTS => match list.iter().position(|p| !is_point(p)) {
                    Some(wrong) => Err(format!("point {} must be three numbers [x, y, z]", wrong + 1)),
                    None => Ok(()),
                },
                _ => Err(format!("must be a list of up to {MOST_POINTS} points [x, y, z]")),
            }
        }
    }
}
