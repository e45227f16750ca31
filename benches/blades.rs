//! Blades with chosen postures against a fixed lead of 5°, at constant scallop from the same start curve: what the widths of
//! the strips allow and what the emitted programs reach, both proven. R1 = 3 mm, r = 2 mm, h = 0.01 mm.

use serde_json::{Value, json};
use std::num::NonZeroUsize;
use stepover::job::{self, Plan, Shape, Spec};
use stepover::monitor::{Silent, Stage};

#[path = "../tests/support/widths.rs"]
mod widths;

use widths::Saving;

/// Name, source and start curve of each comparison.
fn cases() -> Vec<(&'static str, Value, &'static str)> {
    let file = |path: &str, side: &str, scale: f64| json!({"kind": "file", "path": format!("tests/data/{path}"), "face": 0, "side": side, "scale": [scale, scale, scale]});
    let gallery: Value = serde_json::from_str(&job::gallery_json()).unwrap_or_default();
    let blade = || gallery[1]["spec"]["source"].clone();
    let wing = || file("tigl_D150_wing.igs", "front", 0.05);
    let bladex = || file("bladex_lower.iges", "back", 1.0);
    vec![
        ("twisted blade", blade(), "u_low"),
        ("twisted blade", blade(), "v_low"),
        ("wing 1:20", wing(), "u_low"),
        ("wing 1:20", wing(), "v_low"),
        ("bladex_lower", bladex(), "u_low"),
        ("bladex_lower", bladex(), "v_low"),
    ]
}

fn planned(source: &Value, start: &str, posture: &Value) -> (Spec, Plan, f64, f64) {
    let mut strategy = json!({"kind": "constant_scallop", "start": start});
    for (key, value) in posture.as_object().into_iter().flatten() {
        strategy[key] = value.clone();
    }
    let spec = json!({
        "version": 1,
        "name": "blade",
        "source": source,
        "cutter": {"kind": "bull_nose", "diameter_mm": 10, "corner_radius_mm": 2, "height_mm": 40},
        "strategy": strategy,
        "tolerance": {"scallop_mm": 0.01},
    });
    let spec = Spec::from_json(&spec.to_string()).unwrap();
    let bytes = source["path"].as_str().map(|path| std::fs::read(path).unwrap());
    let workers = NonZeroUsize::new(2).unwrap();
    let stage = Stage::whole(&Silent, workers);
    let plan = job::plan(&spec, bytes.as_deref(), &stage).unwrap();
    let proof = plan.prove(&stage).unwrap().unwrap().verified;
    let (excess, gouge) = (proof.largest_excess_mm.unwrap(), proof.largest_gouge_mm.unwrap());
    (spec, plan, 1e3 * excess, 1e3 * gouge)
}

#[allow(clippy::print_stdout)]
fn main() {
    println!(
        "surface        start  5° mm     chosen mm saved % widths allow % reached %  excess µm      gouge µm"
    );
    let asked: Vec<String> = std::env::args().skip(1).filter(|arg| !arg.starts_with('-')).collect();
    for (name, source, start) in cases() {
        if !asked.is_empty() && !asked.iter().any(|word| name.contains(word.as_str())) {
            continue;
        }
        let (spec, fixed, fixed_excess, fixed_gouge) = planned(&source, start, &json!({"lead_deg": 5}));
        let (_, chosen, excess, gouge) = planned(&source, start, &json!({"rule": "widest"}));
        let bytes = source["path"].as_str().map(|path| std::fs::read(path).unwrap());
        let Ok((Shape::Face(face), _)) = spec.source.shape(bytes.as_deref()) else { continue };
        let saving = Saving::of([&fixed, &chosen], &face, 1.0);
        println!(
            "{name:14} {start:6} {:9.1} {:9.1} {:7.1} {:14.1} {:9.0}  {fixed_excess:5.2} / {excess:5.2}  {fixed_gouge:5.2} / {gouge:5.2}",
            saving.lengths[0],
            saving.lengths[1],
            100.0 * saving.made(),
            100.0 * saving.possible(),
            100.0 * saving.made() / saving.possible(),
        );
    }
}
