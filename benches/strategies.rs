//! All strategies on surfaces of every kind, beside the floor that no path of their posture can stay below; every row proven from its
//! text. R1 = 3 mm, r = 2 mm, h = 0.01 mm; the lead is 5°, or what fits into hollows that need more. The sculptured patch has the cutter
//! of the paper of 2013, R = 12.5 mm, r = 3 mm, in both readings of R, and its lead matched to the curvature. Words after `--` choose
//! surfaces; `matched` and `widest` choose the posture.

use serde_json::{Value, json};
use std::num::NonZeroUsize;
use std::time::Instant;
use stepover::job::{self, Spec};
use stepover::monitor::{Silent, Stage};

/// A bicubic patch over `size` mm with the heights `z` at a net of 7 × 7 points.
fn patch(size: f64, z: impl Fn(f64, f64) -> f64) -> Value {
    let knots = [0.0, 0.0, 0.0, 0.0, 0.25, 0.5, 0.75, 1.0, 1.0, 1.0, 1.0];
    let at = |k: i32| f64::from(k) / 6.0 - 0.5;
    let net = (0..7).flat_map(|i| (0..7).map(move |j| (at(i), at(j))));
    let points: Vec<[f64; 3]> = net.map(|(x, y)| [size * x, size * y, z(x, y)]).collect();
    json!({"kind": "nurbs", "degrees": [3, 3], "knots_u": knots, "knots_v": knots, "points_mm": points})
}

/// 100 × 100 mm that bend along their diagonals, with a hill: the paper of 2013 gives no data for its patch.
fn sculptured() -> Value {
    patch(100.0, |x, y| 70.0 * x * y + 6.0 * libm::sin(3.0 * x + 1.0) * libm::cos(3.0 * y))
}

/// A surface with the tool for it.
struct Case {
    name: &'static str,
    source: Value,
    lead_deg: i32,
    /// Diameter, corner radius and height, mm.
    cutter: [i32; 3],
    /// The posture unless another is asked for.
    rule: &'static str,
}

impl Case {
    fn new(name: &'static str, source: Value, lead_deg: i32) -> Self {
        Self { name, source, lead_deg, cutter: [10, 2, 40], rule: "fixed" }
    }

    fn with_cutter(self, cutter: [i32; 3]) -> Self {
        Self { cutter, rule: "matched", ..self }
    }
}

fn cases() -> Vec<Case> {
    let gallery: Value = serde_json::from_str(&job::gallery_json()).unwrap_or_default();
    let of_gallery = |k: usize| gallery[k]["spec"]["source"].clone();
    let net = |up: f64| {
        json!({
            "kind": "nurbs", "degrees": [2, 2], "knots_u": [0, 0, 0, 1, 1, 1], "knots_v": [0, 0, 0, 1, 1, 1],
            "points_mm": [
                [0, 0, 0], [0, 12.5, 5.0 * up], [0, 25, 0],
                [12.5, 0, 5.0 * up], [12.5, 12.5, 12.5 * up], [12.5, 25, 5.0 * up],
                [25, 0, 0], [25, 12.5, 5.0 * up], [25, 25, 0],
            ],
        })
    };
    let file = |path: &str, side: &str, scale: f64| json!({"kind": "file", "path": format!("tests/data/{path}"), "face": 0, "side": side, "scale": [scale, scale, scale]});
    let cylinder = |radius: i32, angle: i32, side: &str| json!({"kind": "cylinder", "radius_mm": radius, "angle_deg": angle, "length_mm": 40, "side": side});
    vec![
        Case::new("plane", json!({"kind": "plane", "size_mm": [40, 30]}), 5),
        Case::new("cap", json!({"kind": "sphere", "radius_mm": 60, "angle_deg": [40, 30]}), 5),
        Case::new("rod", cylinder(30, 70, "front"), 5),
        Case::new("trough", cylinder(60, 35, "back"), 5),
        Case::new("saddle", patch(40.0, |x, y| 24.0 * x * y), 5),
        Case::new("lens", of_gallery(2), 5),
        Case::new("wave", of_gallery(0), 15),
        Case::new("hump", patch(50.0, |x, y| 7.0 * libm::exp(-14.0 * (x * x + y * y))), 5),
        Case::new("blade", of_gallery(1), 5),
        Case::new(
            "ring",
            json!({"kind": "torus", "major_mm": 30, "minor_mm": 12, "angle_deg": [40, 360]}),
            15,
        ),
        Case::new("net", net(1.0), 5),
        Case::new("hollow net", net(-1.0), 30),
        // R = 12.5 mm as the radius of the circle of the corner's centres, and of the whole cutter.
        Case::new("sculptured", sculptured(), 5).with_cutter([31, 3, 60]),
        Case::new("sculptured, R in all", sculptured(), 5).with_cutter([25, 3, 60]),
        Case::new("wing 1:20", file("tigl_D150_wing.igs", "front", 0.05), 5),
        Case::new("bladex_lower", file("bladex_lower.iges", "back", 1.0), 5),
    ]
}

#[allow(clippy::print_stdout)]
fn main() {
    let asked: Vec<String> = std::env::args().skip(1).filter(|arg| !arg.starts_with('-')).collect();
    let rule = ["matched", "widest"].into_iter().find(|rule| asked.iter().any(|word| word == rule));
    let names: Vec<&String> = asked.iter().filter(|word| Some(word.as_str()) != rule).collect();
    println!(
        "| surface | area mm² | floor mm | strategy | passes | cut mm | of floor | link mm | min | excess µm | gouge µm | holds | plan s | unreached mm² |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
    for case in cases() {
        if names.is_empty() || names.iter().any(|word| case.name.contains(word.as_str())) {
            compare(&case, rule.unwrap_or(case.rule));
        }
    }
}

#[allow(clippy::print_stdout)]
fn compare(case: &Case, rule: &str) {
    let Case { name, source, lead_deg, cutter: [diameter, corner, height], .. } = case;
    let spec = json!({
        "version": 1,
        "name": name,
        "source": source,
        "cutter": {"kind": "bull_nose", "diameter_mm": diameter, "corner_radius_mm": corner, "height_mm": height},
        "strategy": {"kind": "flow", "rule": rule, "lead_deg": lead_deg},
        "tolerance": {"scallop_mm": 0.01},
    });
    let spec = Spec::from_json(&spec.to_string()).unwrap();
    let bytes = source["path"].as_str().map(|path| std::fs::read(path).unwrap());
    let bytes = bytes.as_deref();
    let stage = Stage::whole(&Silent, NonZeroUsize::new(2).unwrap());
    let floor = job::least_length(&spec, bytes, &stage).unwrap().unwrap();
    for contender in job::contenders(&spec, bytes).unwrap() {
        let begun = Instant::now();
        let plan = match job::plan(&contender.spec, bytes, &stage) {
            Ok(plan) => plan,
            Err(why) => {
                println!("| {name} | | {:.1} | {} | {why} |", floor.length, contender.name);
                continue;
            }
        };
        let seconds = begun.elapsed().as_secs_f64();
        let report = plan.report(plan.prove(&stage).unwrap().as_ref());
        let proven = report.verified.as_ref().unwrap();
        println!(
            "| {name} | {:.0} | {:.1} | {} | {} | {:.1} | {:.3} | {:.1} | {:.2} | {:.2} | {:.2} | {} | {seconds:.1} | {:.0} |",
            report.area_mm2,
            floor.length,
            contender.name,
            report.passes,
            report.length.cut_mm,
            report.length.cut_mm / floor.length,
            report.length.link_mm,
            report.time_min,
            1e3 * proven.largest_excess_mm.unwrap_or(f64::NAN),
            1e3 * proven.largest_gouge_mm.unwrap_or(f64::NAN),
            if job::holds(proven, spec.tolerance.scallop_mm) { "yes" } else { "no" },
            plan.unreached().area(),
        );
    }
}
