//! Constant scallop from given start curves: what its programs leave, and what is told of curves that are none.

use serde_json::{Value, json};
use stepover::job::{self, JobError, Plan, Spec, Verified};
use stepover::monitor::Stage;
use stepover::toolpath::Role;

/// `source` cut from the curve through `points`.
fn job(source: Value, points: &[[f64; 3]]) -> Value {
    json!({
        "source": source,
        "cutter": {"kind": "bull_nose", "diameter_mm": 8, "corner_radius_mm": 2},
        "strategy": {"kind": "constant_scallop", "start": "curve", "start_points_mm": points, "lead_deg": 8},
        "tolerance": {"scallop_mm": 0.02},
    })
}

fn planned(job: &Value) -> Result<(Spec, Plan), JobError> {
    let spec = Spec::from_json(&job.to_string())?;
    let plan = job::plan(&spec, None, &Stage::silent())?;
    Ok((spec, plan))
}

fn length(plan: &Plan) -> f64 {
    plan.emitted.toolpath.length(Role::Cut)
}

/// Excess at most the scallop plus what sampling can miss, gouge at most a micrometre.
fn proven((spec, plan): &(Spec, Plan)) -> Verified {
    let verified = plan.prove(&Stage::silent()).unwrap().unwrap().verified;
    let limit = spec.tolerance.scallop_mm + verified.sampling_error_mm.unwrap();
    let (excess, gouge) = (verified.largest_excess_mm.unwrap(), verified.largest_gouge_mm.unwrap());
    assert!(excess <= limit, "{excess} at {:?}", verified.largest_excess_at);
    assert!(gouge >= -0.001, "{gouge} at {:?}", verified.largest_gouge_at);
    assert!(verified.uncut_area_mm2 <= 0.0, "{} mm² uncut", verified.uncut_area_mm2);
    verified
}

fn plane() -> Value {
    json!({"kind": "plane", "size_mm": [30, 20]})
}

/// Contacts of passes.
fn contacts(plan: &Plan) -> Vec<glam::DVec3> {
    let moves = plan.emitted.toolpath.moves.iter().zip(&plan.touches);
    moves.filter(|(m, t)| m.role == Role::Cut && t.contact.is_some()).map(|(_, t)| t.point).collect()
}

#[test]
fn experiment() {
    for (name, job) in [
        ("slant", job(plane(), &[[-5.0, -3.0, 0.0], [5.0, 2.0, 0.0]])),
        ("section", {
            let mut j = job(plane(), &[]);
            j["strategy"]["start"] = "section".into();
            j["strategy"]["angle_deg"] = 26.565051177.into();
            j
        }),
    ] {
        let it = planned(&job).unwrap();
        let plan = &it.1;
        let n = glam::DVec3::new(-1.0, 2.0, 0.0).normalize();
        println!("{name} {} {}", length(plan), plan.report(None).passes);
        let mut by: Vec<(f64, f64)> = contacts(plan).iter().map(|p| (p.dot(n), p.dot(glam::DVec3::new(2.0,1.0,0.0).normalize()))).collect();
        by.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (d, s) in by { println!("   {d:.4} {s:.3}"); }
        let v = proven(&it);
        println!("{name} {:?} {:?}", v.largest_excess_mm, v.sampling_error_mm);
    }
}
