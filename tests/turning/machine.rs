//! A lathe from a file: its axes are the limits of the plan, and what is wrong names the axis.

use std::process::Command;
use stepover::job::JobError;
use stepover::job::machines::{self, lathe};
use stepover::job::turning::{TurningSpec, plan};
use stepover::monitor::Stage;

const TEXT: &str = include_str!("../../examples/machines/lathe_xzc.json");

/// The field and the message of the error that the lathe gives once `from` is written as `to`.
fn error(from: &str, to: &str) -> (String, String) {
    assert!(TEXT.contains(from), "{from}");
    match lathe(&TEXT.replacen(from, to, 1)).unwrap_err() {
        JobError::Field { field, message } => (field, message),
        other => (String::new(), other.to_string()),
    }
}

#[test]
fn the_limits_of_the_file_are_those_that_the_plan_keeps() {
    let spec = TurningSpec::from_json(r#"{"speed": {"rate": "highest"}}"#).unwrap();
    let reserve = |text: &str| {
        let plan = plan(&lathe(text).unwrap().limiting(spec.clone()), None, &Stage::silent()).unwrap();
        let report = plan.report(None);
        let limit = report.z.acceleration.limit;
        (limit, report.z.acceleration.value, report.time_s)
    };
    let (limit, reached, time) = reserve(TEXT);
    assert!((limit - 2000.0).abs() < 1e-9 && reached <= limit * (1.0 + 1e-9), "{reached} of {limit}");
    // A Z axis of half the acceleration is kept as well, and takes longer.
    let slow = TEXT.replacen(r#""acceleration_mm_per_s2": 2000"#, r#""acceleration_mm_per_s2": 200"#, 1);
    let (limit, reached, longer) = reserve(&slow);
    assert!((limit - 200.0).abs() < 1e-9 && reached <= limit * (1.0 + 1e-9), "{reached} of {limit}");
    assert!(longer > time, "{longer} s and {time} s");
    let limits = lathe(TEXT).unwrap().limiting(spec).limits;
    assert!((limits.c_rpm - 1000.0).abs() < 1e-9 && (limits.x_mm_per_s - 100.0).abs() < 1e-9, "{limits:?}");
}

#[test]
fn what_is_wrong_with_a_lathe_names_its_axis() {
    let cases = [
        (r#""letter": "C""#, r#""letter": "B""#, "axes.B.letter", "X, Z and C"),
        (r#""limits_mm": [-110, 110]"#, r#""limits_mm": [110, -110]"#, "axes.X.limits_mm", "least"),
        (r#""speed_deg_per_s": 6000"#, r#""speed_deg_per_s": 0"#, "axes.C.speed_deg_per_s", "above 0"),
        (r#""point_mm": [0, 0, 0]"#, r#""point_mm": [0, 1, 0]"#, "axes.C.point_mm", "part's axis"),
        (r#""direction": [-1, 0, 0]"#, r#""direction": [0, 1, 0]"#, "axes.X.direction", "along x"),
        (r#""jerk_mm_per_s3": 200000"#, r#""jerk_mm_per_s3": NaN"#, "", "line 15"),
        (
            r#""carries": "workpiece", "direction": [0, 0, -1]"#,
            r#""carries": "tool", "direction": [0, 0, -1]"#,
            "axes.X.carries",
            "come first",
        ),
    ];
    for (from, to, field, message) in cases {
        let (found, why) = error(from, to);
        assert!(found == field && why.contains(message), "{to}: {found}: {why}");
    }
    let c = TEXT.find("    {\n").unwrap();
    let without = format!("{}{}", &TEXT[..c], &TEXT[TEXT[c..].find("},\n").unwrap() + c + 3..]);
    let why = lathe(&without).unwrap_err().to_string();
    assert!(why.starts_with("axes.C: is missing"), "{why}");
    // And a mill cannot be had of it, nor a lathe of a mill.
    let why = machines::machine(TEXT).unwrap_err().to_string();
    assert!(why.starts_with("axes.Y: is missing: this is a lathe"), "{why}");
    let why = lathe(machines::SHIPPED[0].1).unwrap_err().to_string();
    assert!(why.contains("is no axis of a lathe"), "{why}");
}

#[test]
fn the_command_line_turns_on_a_lathe_and_says_where_its_travel_ends() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("turn_on_lathe");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("job.json"), r#"{"verify": {"enabled": false}}"#).unwrap();
    let turn = |text: &str| {
        std::fs::write(folder.join("lathe.json"), text).unwrap();
        let output = Command::new(env!("CARGO_BIN_EXE_stepover"))
            .current_dir(&folder)
            .args(["turn", "job.json", "--out", "out", "--machine", "lathe.json"])
            .output()
            .unwrap();
        let said = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap()).concat();
        (output.status.success(), said)
    };
    let (done, said) = turn(TEXT);
    assert!(done && said.contains("machine      Lathe with a servo spindle"), "{said}");
    std::fs::remove_dir_all(folder.join("out")).unwrap();
    let (done, said) = turn(&TEXT.replacen("[-110, 110]", "[-30, 30]", 1));
    assert!(!done && said.contains("lathe.json: axes.X.limits_mm: are -30.000 to 30.000 mm"), "{said}");
    assert!(!folder.join("out").exists());
}
