//! Whole turning jobs, from JSON to proof.

use crate::support::near;
use serde_json::{Value, json};
use stepover::job::JobError;
use stepover::job::turning::{
    TurnedReport, TurningPlan, TurningSpec, plan, read_program, schema, verify_text,
};
use stepover::monitor::Stage;

fn spec(value: &Value) -> TurningSpec {
    TurningSpec::from_json(&value.to_string()).unwrap()
}

fn planned(value: &Value) -> TurningPlan {
    plan(&spec(value), None, &Stage::silent()).unwrap()
}

fn proven(value: &Value) -> TurnedReport {
    planned(value).prove(&Stage::silent()).unwrap().unwrap().verified
}

fn refused(value: &Value) -> (String, String) {
    let found = TurningSpec::from_json(&value.to_string()).and_then(|s| plan(&s, None, &Stage::silent()));
    match found.map(|_| ()).unwrap_err() {
        JobError::Field { field, message } => (field, message),
        other => (String::new(), other.to_string()),
    }
}

#[test]
fn nothing_said_is_the_papers_lens() {
    let job = planned(&json!({}));
    let report = job.report(None);
    near(report.outermost_mm, 41.25, 1e-6);
    near(report.step_mm, 0.5, 1e-12);
    near(report.angle_deg.unwrap(), 3.0, 1e-12);
    // The default limit of 1 m/s² at the rim's nose centre.
    near(report.z.acceleration.value, 1000.0, 1e-6);
    let again = TurningSpec::from_json(&spec(&json!({})).to_json()).unwrap();
    assert_eq!(again, spec(&json!({})));
    let (nose, path) = read_program(&job.program, &again).unwrap();
    assert_eq!((nose, &path), (job.nose, &job.emitted));
}

#[test]
fn every_kind_is_planned_and_proven() {
    let small = json!({"kind": "round", "radius_mm": 8});
    let heights: Vec<f64> = (0..21 * 21)
        .map(|k| {
            let (x, y) = (f64::from(k % 21) - 10.0, f64::from(k / 21) - 10.0);
            0.004 * (x * x - y * y) + 0.0001 * x * x * y
        })
        .collect();
    let surfaces = [
        json!({"kind": "toric", "shape": "saddle_convex_base", "turn_deg": 20}),
        json!({"kind": "toric", "shape": "concave"}),
        json!({"kind": "toric", "base_radius_mm": 60, "rotation_radius_mm": -30}),
        json!({"kind": "sphere", "shape": "concave", "shift_x_mm": 3}),
        json!({"kind": "conic", "conic": -2}),
        json!({"kind": "asphere", "even": [1e-6, -1e-9]}),
        json!({"kind": "biconic"}),
        json!({"kind": "polynomial", "norm_mm": 10, "terms": [[2, 0, 0.2], [0, 2, -0.1], [3, 1, 0.05]]}),
        json!({"kind": "zernike", "shape": "convex", "norm_mm": 10, "terms": [[2, 2, 0.1], [3, -1, 0.02]]}),
        json!({"kind": "grid", "columns": 21, "heights_mm": heights}),
    ];
    for surface in surfaces {
        for tool in [json!({"kind": "ball", "radius_mm": 5}), json!({"kind": "insert"})] {
            let found = proven(&json!({
                "surface": surface, "aperture": small, "tool": tool,
                "guide": {"step": "chosen"}, "points": {"spacing": "chosen"},
                "tolerance": {"residue_mm": 0.002, "chord_mm": 0.0002},
            }));
            let (low, high) = (found.overcut.unwrap().mm, found.residue.unwrap().mm);
            assert!(low > -0.00021 && high < 0.002 && high > 0.001, "{surface} {tool}: {low} {high}");
            assert!(found.uncut == 0.0 && found.bands[0].within == 1.0);
        }
    }
}

#[test]
fn examples_keep_their_promise() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if !(name.starts_with("turning") && name.ends_with(".json")) {
            continue;
        }
        count += 1;
        let spec = TurningSpec::from_json(&std::fs::read_to_string(&path).unwrap()).unwrap();
        let bytes = spec.surface.file().map(|file| std::fs::read(path.with_file_name(file)).unwrap());
        let job = plan(&spec, bytes.as_deref(), &Stage::silent()).unwrap();
        let found = job.prove(&Stage::silent()).unwrap().unwrap().verified;
        let high = found.residue.unwrap().mm;
        let low = found.overcut.unwrap().mm;
        // Numbers are rounded to a nanometre in the text.
        assert!(low >= -spec.tolerance.chord_mm - 1e-6, "{name}: {low}");
        assert!(high <= spec.tolerance.residue_mm + spec.tolerance.chord_mm, "{name}: {high}");
        assert!(found.sagittas_pass && job.report(None).warnings.is_empty(), "{name}");
    }
    assert!(count >= 3);
}

#[test]
fn another_body_shows_what_the_compensation_is_worth() {
    let base = |body: &str| {
        json!({"guide": {"step_mm": 0.2}, "points": {"interpolation": "pvt"},
               "verify": {"body": body, "spacing_mm": 0.5}})
    };
    let (own, insert) = (proven(&base("own")), proven(&base("insert")));
    assert!(own.residue.unwrap().mm < 0.001 && insert.residue.unwrap().mm > 0.388);
    assert_eq!((own.body, insert.body), ("ball", "insert"));
}

#[test]
fn programs_from_elsewhere_are_judged() {
    let job = planned(&json!({}));
    let spec = spec(&json!({}));
    let own = job.prove(&Stage::silent()).unwrap().unwrap().verified;
    assert_eq!(verify_text(&job.program, &spec, None, &Stage::silent()).unwrap().verified, own);
    // One word that is wrong is found.
    let line = job.program.lines().filter(|l| l.starts_with("G1 X")).nth(4000).unwrap();
    let (before, after) = line.split_once(" Z").unwrap();
    let (z, rest) = after.split_once(' ').unwrap();
    let deeper = format!("{before} Z{:.6} {rest}", z.parse::<f64>().unwrap() - 0.1);
    let found = verify_text(&job.program.replacen(line, &deeper, 1), &spec, None, &Stage::silent()).unwrap();
    assert!(found.verified.overcut.unwrap().mm < -0.05);
}

#[test]
fn settings_that_are_wrong_are_named() {
    let field = |value: Value| refused(&value).0;
    assert_eq!(field(json!({"aperture": {"radius_mm": 45}})), "aperture");
    assert_eq!(field(json!({"tool": {"kind": "insert", "clearance_deg": 7}})), "tool.clearance_deg");
    assert_eq!(field(json!({"points": {"angle_deg": 10}})), "points.angle_deg");
    assert_eq!(field(json!({"points": {"kind": "arc", "arc_mm": 9}})), "points.arc_mm");
    assert_eq!(field(json!({"speed": {"rate": "given", "c_rpm": 90}})), "speed");
    assert_eq!(field(json!({"speed": {"least_rpm": 200}})), "speed.least_rpm");
    assert_eq!(field(json!({"guide": {"step": "chosen"}})), "tolerance.chord_mm");
    assert_eq!(
        field(json!({"surface": {"kind": "toric", "rotation_radius_mm": -50}})),
        "surface.rotation_radius_mm"
    );
    assert_eq!(field(json!({"surface": {"kind": "zernike", "terms": [[3, 2, 1.0]]}})), "surface.terms");
    assert_eq!(
        field(json!({"surface": {"kind": "grid", "columns": 7, "heights_mm": [1, 2]}})),
        "surface.heights_mm"
    );
    assert_eq!(field(json!({"surface": {"kind": "grid", "path": "map.csv"}})), "surface.path");
    assert_eq!(field(json!({"surface": {"kind": "asphere", "even": "A4"}})), "surface.even");
    assert_eq!(field(json!({"surface": {"kind": "egg"}})), "surface.kind");
    assert_eq!(field(json!({"tolerance": {"residue_mm": 0}})), "tolerance.residue_mm");
    assert_eq!(field(json!({"job": "milling"})), "job");
    assert_eq!(field(json!({"version": 9})), "version");
    assert!(refused(&json!({"surfaces": {}})).1.contains("surfaces"));
    assert!(refused(&json!({"tool": {"kind": "ball", "sweep_deg": 3}})).1.contains("sweep_deg"));
    let TurningSpec { .. } = spec(&json!({"name": "ok"}));
}

#[test]
fn the_schema_names_every_setting_with_its_default() {
    let schema: Value = serde_json::from_str(&schema()).unwrap();
    let whole: Value = serde_json::from_str(&spec(&json!({})).to_json()).unwrap();
    for group in schema["groups"].as_array().unwrap() {
        let settings = &whole[group["path"].as_str().unwrap()];
        let first = group["variants"].as_array().unwrap().first();
        let own = first.map(|v| v["fields"].as_array().unwrap().clone()).unwrap_or_default();
        for field in own.iter().chain(group["fields"].as_array().unwrap()) {
            assert_eq!(
                settings[field["name"].as_str().unwrap()].to_string().replace(".0", ""),
                field["default"].to_string().replace(".0", ""),
                "{field}"
            );
        }
    }
}

/// Interpolation errors are those of the words as they stand: three decimals are coarser than what was planned.
#[test]
fn errors_between_points_are_measured_on_the_text() {
    let job = |decimals: u32| {
        json!({"points": {"spacing": "chosen"}, "tolerance": {"chord_mm": 0.0001, "residue_mm": 0.01},
               "output": {"decimals_mm": decimals}, "verify": {"spacing_mm": 2}})
    };
    let (fine, coarse) = (planned(&job(6)), planned(&job(3)));
    let planned = fine.report(None).chord_dug.mm;
    let dug =
        |plan: &TurningPlan| plan.prove(&Stage::silent()).unwrap().unwrap().verified.chord_dug.unwrap().mm;
    near(dug(&fine), planned, 2e-6);
    assert!(dug(&coarse) < planned - 2e-4);
    let warnings = coarse.report(None).warnings;
    assert!(
        warnings.iter().any(|w| w.starts_with("output.decimals_mm") && w.ends_with("4 would do")),
        "{warnings:?}"
    );
}

#[test]
fn long_words_are_warned_of_where_the_control_takes_fewer() {
    let warned = |decimals: u32| {
        let output = json!({"dialect": "fanuc", "decimals_deg": decimals});
        let all = planned(&json!({"output": output})).report(None).warnings;
        all.into_iter().find(|w| w.starts_with("output.decimals_deg"))
    };
    // 86 turns are 30,960°.
    assert!(warned(6).unwrap().ends_with("4 decimals would do"));
    assert_eq!(warned(4), None);
}

#[test]
fn a_lens_off_the_axis_is_turned_from_where_it_begins() {
    let job = |x: u32| {
        planned(&json!({"aperture": {"radius_mm": 6, "center_x_mm": x}, "tool": {"radius_mm": 5},
                        "verify": {"spacing_mm": 0.5}}))
    };
    let (near_axis, away) = (job(3).report(None), job(20));
    assert_eq!(near_axis.innermost_mm, 0.0);
    let report = away.report(None);
    assert!(report.innermost_mm > 14.0 && report.turns < 35.0, "{} {}", report.innermost_mm, report.turns);
    assert_eq!(away.prove(&Stage::silent()).unwrap().unwrap().verified.uncut, 0.0);
}

#[test]
fn a_table_of_heights_becomes_part_of_the_job() {
    let text = "0 1 2 3 4\n".repeat(7);
    let held = spec(&json!({"surface": {"kind": "grid", "spacing_x_mm": 2, "turn_deg": 30}}))
        .with_table(text.as_bytes())
        .unwrap();
    let part = held.part(None).unwrap();
    let [x, y] = part.world([2.0, 1.0]);
    near(part.at(x, y).z, 3.0, 1e-12);
    // The aperture of 30 mm became what the map holds: 8 by 6 mm.
    near(held.aperture().farthest(), 3.0, 1e-6);
    assert_eq!(TurningSpec::from_json(&held.to_json()).unwrap(), held);
    let wrong = spec(&json!({})).with_table(b"1 2\n3 x\n").unwrap_err();
    assert!(wrong.to_string().contains("line 2: `x`"), "{wrong}");
}

/// Whatever a row of turns says, a point says no more.
#[test]
fn turns_and_motion_tell_all_axes() {
    let job = planned(&json!({"points": {"kind": "arc"}, "speed": {"pace": "surface_speed"}}));
    let turns = job.turns();
    let motion = job.motion(20.0);
    assert!(turns.len().is_multiple_of(14) && motion.len().is_multiple_of(13) && motion.len() / 13 > 60);
    let row = turns.chunks(14).find(|t| (t[0] - 20.0).abs() < 0.5).unwrap();
    for axis in 0..3 {
        for kind in 1..4 {
            let most = motion.chunks(13).map(|p| p[1 + 4 * axis + kind].abs()).fold(0.0, f64::max);
            assert!(most <= 1.2 * row[2 + 4 * axis + kind] + 1e-9, "{axis} {kind}: {most} {row:?}");
        }
    }
    let table = job.turns_csv();
    assert!(table.starts_with("radius_mm,spindle_rpm,x_stroke_mm,x_mm_per_s,"));
    assert_eq!(table.lines().count(), turns.len() / 14 + 1);
}
