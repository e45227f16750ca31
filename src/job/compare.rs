//! Every strategy that applies to a job, side by side.

use super::error::JobError;
use super::report::Verified;
use super::shape::Shape;
use super::spec::Spec;
use crate::monitor::Stage;
use crate::posture::Rule;
pub use crate::verify::Floor;
use crate::verify::{Class, floor};
use serde_json::{Value, json};

/// The deepest gouge that a path may have, mm.
const MOST_GOUGE: f64 = 0.001;

/// The job of a comparison with one of its strategies.
#[derive(Debug, Clone)]
pub struct Contender {
    /// What tells it from the others: words and numbers, fit for a file's name.
    pub name: String,
    /// The whole job.
    pub spec: Spec,
}

/// The jobs that differ from `spec` in their strategy alone, postures and order being as there: for a mesh parallel sections in four
/// directions; else both parameters, parallel sections in six, constant scallop from each border, the potential field with
/// neighbours that are as efficient as they are by default and less, and flow in one family
/// and, at fixed postures, in several.
pub fn contenders(spec: &Spec, bytes: Option<&[u8]>) -> Result<Vec<Contender>, JobError> {
    let (shape, _) = spec.source.shape(bytes)?;
    let whole: Value = serde_json::from_str(&spec.to_json()).unwrap_or_default();
    // What only one of the strategies knows is left out, and comes back as its default.
    let own = whole["strategy"].as_object().into_iter().flatten();
    let shared = own.filter(|(key, _)| SHARED.contains(&key.as_str()));
    let shared: Value = shared.map(|(key, value)| (key.clone(), value.clone())).collect();
    let with = |name: &str, settings: Value| -> Result<Contender, JobError> {
        let mut job = whole.clone();
        job["strategy"] = shared.clone();
        for (key, value) in settings.as_object().into_iter().flatten() {
            job["strategy"][key] = value.clone();
        }
        Ok(Contender { name: name.into(), spec: Spec::from_json(&job.to_string())? })
    };
    let mut all = Vec::new();
    if let Shape::Mesh(_) = shape {
        for angle in [0, 45, 90, 135] {
            all.push(with(&format!("raster-{angle}"), json!({"kind": "raster", "angle_deg": angle}))?);
        }
        return Ok(all);
    }
    for along in ["u", "v"] {
        let settings = json!({"kind": "iso_parametric", "along": along});
        all.push(with(&format!("iso-parametric-{along}"), settings)?);
    }
    for angle in [0, 30, 60, 90, 120, 150] {
        all.push(with(&format!("iso-planar-{angle}"), json!({"kind": "iso_planar", "angle_deg": angle}))?);
    }
    for start in ["u_low", "u_high", "v_low", "v_high"] {
        let settings = json!({"kind": "constant_scallop", "start": start});
        all.push(with(&format!("constant-scallop-{}", start.replace('_', "-")), settings)?);
    }
    for (name, least) in [("potential-field", 90), ("potential-field-80", 80)] {
        all.push(with(name, json!({"kind": "potential_field", "least_efficiency_percent": least}))?);
    }
    all.push(with("flow", json!({"kind": "flow"}))?);
    if matches!(spec.strategy.rule()?, Some(Rule::Fixed(_))) {
        all.push(with("flow-divided", json!({"kind": "flow", "families": "several"}))?);
    }
    Ok(all)
}

/// Settings that strategies have in common.
const SHARED: [&str; 9] = [
    "rule",
    "lead_deg",
    "yaw_deg",
    "least_lead_deg",
    "most_lead_deg",
    "most_yaw_deg",
    "turn_along_deg_per_mm",
    "turn_across_deg_per_mm",
    "order",
];

/// The length that no path of the postures of `spec` stays below, one contact at a time; `None` for a mesh.
pub fn least_length(spec: &Spec, bytes: Option<&[u8]>, stage: &Stage) -> Result<Option<Floor>, JobError> {
    let (Shape::Face(face), _) = spec.source.shape(bytes)? else { return Ok(None) };
    let class = match spec.strategy.rule()? {
        None => return Ok(None),
        Some(Rule::Fixed(posture)) => Class::Fixed { lead: posture.lead, yaw: posture.yaw },
        Some(Rule::Matched(limits) | Rule::TwoContacts(limits)) => {
            Class::Free { least_lead: limits.least_lead, most_lead: limits.most_lead, most_yaw: 0.0 }
        }
        Some(Rule::Widest(limits)) => Class::Free {
            least_lead: limits.least_lead,
            most_lead: limits.most_lead,
            most_yaw: limits.most_yaw,
        },
    };
    Ok(Some(floor(&face, &spec.cutter.cutter()?, class, spec.finish()?.scallop, stage)?))
}

/// Whether what was proven keeps the limit, as far as samples tell, digs in by no more than a micrometre, and leaves nothing uncut.
pub fn holds(verified: &Verified, scallop_mm: f64) -> bool {
    let limit = scallop_mm + verified.sampling_error_mm.unwrap_or(0.0);
    verified.largest_excess_mm.is_some_and(|excess| excess <= limit)
        && verified.largest_gouge_mm.is_some_and(|gouge| gouge >= -MOST_GOUGE)
        && verified.uncut_area_mm2 <= 0.0
}
