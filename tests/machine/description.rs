//! What is wrong with a description is named.

use crate::examples::{TEXTS, example};
use glam::DVec3;
use stepover::job::JobError;
use stepover::job::machines::machine;
use stepover::machine::{Joint, Kinematics, Machine};

/// The field and the message of the error that the first machine gives once `from` is written as `to`.
fn error(from: &str, to: &str) -> (String, String) {
    let text = TEXTS[0].1;
    assert!(text.contains(from), "{from}");
    match machine(&text.replacen(from, to, 1)).unwrap_err() {
        JobError::Field { field, message } => (field, message),
        other => (String::new(), other.to_string()),
    }
}

#[test]
fn every_mistake_in_a_file_names_its_axis_and_field() {
    let cases = [
        (r#""limits_deg": [-120, 30]"#, r#""limits_deg": [30, -120]"#, "axes.A.limits_deg", "least"),
        (r#""limits_deg": [-120, 30]"#, r#""limits_deg": [-120, 3000]"#, "axes.A.limits_deg", "five turns"),
        (r#""limits_mm": [-300, 300]"#, r#""limits_mm": [300, -300]"#, "axes.X.limits_mm", "least"),
        (r#", "speed_deg_per_s": 720"#, r#", "speed_deg_per_s": 0"#, "axes.C.speed_deg_per_s", "above 0"),
        (r#""direction": [0, 0, -1]"#, r#""direction": [0, 0, 0]"#, "axes.C.direction", "length 1"),
        (
            r#""direction": [-1, 0, 0]"#,
            r#""direction": [0, 0, 1]"#,
            "axes.A.direction",
            "parallel to that of C",
        ),
        (r#""letter": "A""#, r#""letter": "C""#, "axes.C.letter", "twice"),
        (r#""letter": "A""#, r#""letter": "Q""#, "axes.Q.letter", "A, B or C"),
        (r#""letter": "X""#, r#""letter": "Y""#, "axes.Y.letter", "twice"),
        (r#""direction": [0, 1, 0]"#, r#""direction": [1, 0, 0]"#, "axes", "one plane"),
        (r#""point_mm": [0, 0, -450], "#, "", "axes.C", "point_mm"),
        (r#""limits_mm": [-300, 300], "#, "", "axes.X", "limits_mm"),
        (r#""longest_mm": 200"#, r#""longest_mm": -1"#, "tool.longest_mm", "above 0"),
        (r#""version": 1"#, r#""version": 9"#, "version", "must be 1"),
        (r#""carries": "workpiece""#, r#""carries": "tool""#, "axes.A.carries", "come first"),
        (r#""point_mm": [0, 0, -450]"#, r#""point_mm": [0, 0, NaN]"#, "", "line 7"),
        (r#""point_mm": [0, 0, -450]"#, r#""point_mm": [0, 0, 1e999]"#, "", "line 7"),
    ];
    for (from, to, field, message) in cases {
        let (found, why) = error(from, to);
        assert!(found == field && why.contains(message), "{to}: {found}: {why}");
    }
}

#[test]
fn a_missing_axis_is_named() {
    let cut = |letter: &str| {
        let text = TEXTS[0].1;
        let at = text.find(&format!(r#""letter": "{letter}""#)).unwrap();
        let (from, to) = (text[..at].rfind('{').unwrap(), at + text[at..].find('}').unwrap() + 1);
        let comma = text[to..].find(|c: char| !c.is_whitespace()).unwrap();
        let to = if text[to + comma..].starts_with(',') { to + comma + 1 } else { to };
        machine(&format!("{}{}", &text[..from], &text[to..])).unwrap_err().to_string()
    };
    assert!(cut("Y").starts_with("axes.Y: is missing"), "{}", cut("Y"));
    assert!(cut("A").contains("no rotary axis or two"), "{}", cut("A"));
}

#[test]
fn numbers_that_are_none_are_named_in_a_description_without_a_file() {
    let with = |change: fn(&mut Machine)| {
        let mut machine = example("head_table_bc");
        change(&mut machine);
        machine.check().unwrap_err().field
    };
    let pivot = |machine: &mut Machine| {
        let Joint::Rotary { point, .. } = &mut machine.axes[4].joint else { panic!("B turns") };
        point.x = f64::NAN;
    };
    assert_eq!(with(pivot), "axes.B.point");
    assert_eq!(with(|m| m.axes[1].limits = Some([f64::NAN, 1.0])), "axes.Y.limits");
    assert_eq!(with(|m| m.axes[1].limits = None), "axes.Y.limits");
    assert_eq!(with(|m| m.gauge = DVec3::NAN), "tool.gauge");
    assert_eq!(with(|m| m.tool_axis = DVec3::Y), "axes.B.direction");
}

#[test]
fn a_tool_longer_than_the_machine_takes_is_refused() {
    let machine = example("head_table_bc");
    let why = Kinematics::new(&machine, 250.1).unwrap_err().to_string();
    assert!(why.contains("250 mm") && why.contains("250.1") && why.contains("Tilting head"), "{why}");
    assert!(Kinematics::new(&machine, f64::NAN).is_err());
    assert!(Kinematics::new(&machine, 250.0).is_ok());
}
