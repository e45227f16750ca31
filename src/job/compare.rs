//! Every strategy that applies to a job, side by side, and the best of them.

use super::error::JobError;
use super::report::Verified;
use super::run::{Plan, plan};
use super::shape::Shape;
use super::spec::{ObjectiveSpec, Spec, StrategySpec};
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
/// directions; else both parameters, parallel sections in six, constant scallop from each border, the potential field, and flow.
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
    all.push(with("potential-field", json!({"kind": "potential_field"}))?);
    all.push(with("flow", json!({"kind": "flow"}))?);
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

/// Plans the job with every strategy that applies and proves them, the quickest first, until one holds: that one. Where none does,
/// the quickest of all.
///
/// Quick is the whole program at its feeds, links and rapid ways included; or, where length is the objective, what has the shortest cuts.
/// Strategies that cannot be planned are passed over, unless none can.
pub(super) fn auto(spec: &Spec, bytes: Option<&[u8]>, stage: &Stage) -> Result<Plan, JobError> {
    let contenders = contenders(spec, bytes)?;
    let count = contenders.len() as f64;
    let by_length = matches!(spec.strategy, StrategySpec::Auto { objective: ObjectiveSpec::Length, .. });
    let mut plans = Vec::new();
    let mut why = None;
    for (k, Contender { spec, .. }) in contenders.iter().enumerate() {
        let part = stage.part("Planning", 0.8 * k as f64 / count, 0.8 * (k + 1) as f64 / count);
        match plan(spec, bytes, &part) {
            Ok(plan) => {
                let report = plan.report(None);
                plans.push((if by_length { report.length.cut_mm } else { report.time_min }, plan));
            }
            Err(JobError::Cancelled(cancelled)) => return Err(cancelled.into()),
            Err(other) => why = Some(other),
        }
    }
    // Few, and equals keep their order.
    plans.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (_, plan) in &plans {
        let proof = plan.proof(&stage.part("Cutting in simulation", 0.8, 1.0).quiet())?;
        if holds(&proof.verified, spec.tolerance.scallop_mm) {
            return Ok(plan.clone());
        }
    }
    let quickest = plans.into_iter().next().map(|(_, plan)| plan);
    quickest.ok_or_else(|| why.unwrap_or_else(|| JobError::Strategy("no strategy applies".into())))
}
