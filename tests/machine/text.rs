//! The texts themselves, and what their readers refuse.

use crate::examples::{example, post_program};
use glam::DVec3;
use stepover::cutter::Cutter;
use stepover::job::machines::{Dialect, Layout, PostOptions};
use stepover::machine::{Kinematics, Tolerance};
use stepover::post::{Program, ReadError, Unit, multiaxis};
use stepover::toolpath::{ClPoint, Move, Rate, Role, Toolpath};

const FINE: Tolerance = Tolerance { chord: 1e-3, axis: 1e-4 };

/// One short pass with its links.
fn program(lean: f64) -> Program {
    use Rate::{Feed, Rapid};
    use Role::{Cut, Link};
    let step = |tip: [f64; 3], lean: f64, rate, role| {
        let axis = DVec3::new(libm::sin(lean.to_radians()), 0.0, libm::cos(lean.to_radians()));
        Move { to: ClPoint { tip: tip.into(), axis }, rate, role }
    };
    let moves = vec![
        step([0.0, 0.0, 60.0], lean, Rapid, Link),
        step([0.0, 0.0, 5.0], lean, Rapid, Link),
        step([0.0, 0.0, 0.0], lean, Feed(300.0), Link),
        step([10.0, 0.0, -0.25], 1.5 * lean, Feed(1200.0), Cut),
        step([10.0, 0.0, -0.25], 2.0 * lean, Feed(1200.0), Cut),
        step([20.0, -1e-9, -0.25], 2.0 * lean, Feed(1200.0), Cut),
        step([20.0, 5.0, 60.0], 2.0 * lean, Rapid, Link),
    ];
    Program {
        part: "wave (100 x 100)".into(),
        unit: Unit::Mm,
        cutter: Cutter::bull_nose(8.0, 2.0, 30.0).unwrap(),
        tool: 4,
        spindle_rpm: Some(12_000.0),
        toolpath: Toolpath { moves },
    }
}

fn text(machine: &str, dialect: Dialect) -> String {
    let lean = if machine == "three_axis" { 0.0 } else { 10.0 };
    let options = PostOptions { chord_mm: 0.05, axis_deg: 0.5, ..PostOptions::new(dialect) };
    post_program(&program(lean), &example(machine), &options).unwrap().text
}

#[test]
fn texts_are_as_ever() {
    for dialect in Dialect::ALL {
        let machine = if dialect == Dialect::Grbl { "three_axis" } else { "head_table_bc" };
        insta::assert_snapshot!(dialect.name(), text(machine, dialect));
    }
}

fn kinematics(machine: &str) -> Kinematics {
    let machine = example(machine);
    Kinematics::new(&machine, 0.5 * machine.longest_tool).unwrap()
}

fn refused(dialect: Dialect, from: &str, to: &str) -> (usize, String) {
    let text = text("head_table_bc", dialect);
    assert!(text.contains(from), "{from} in\n{text}");
    match multiaxis::read(&text.replacen(from, to, 1), dialect, &kinematics("head_table_bc"), &FINE) {
        Err(ReadError::Statement { line, word, message }) => (line, format!("{word}: {message}")),
        other => panic!("{from} → {to}: {other:?}"),
    }
}

#[test]
fn what_a_reader_cannot_follow_is_an_error_with_its_line() {
    let cases = [
        (Dialect::LinuxCnc, "G1 ", "G2 ", "G2: is no word of linuxcnc"),
        (Dialect::LinuxCnc, "G90", "G91", "G91"),
        (Dialect::LinuxCnc, "G43.1 Z125", "G43.1 Z124", "the tool's length must be 125 mm"),
        (Dialect::LinuxCnc, "(LINK)", "(LINK", "closing bracket"),
        (Dialect::LinuxCnc, "G93", "G94 A3", "A3: is no word"),
        (Dialect::LinuxCnc, "G93", "G93 G53 Z0", "must not stand within the path"),
        (Dialect::LinuxCnc, "G93", "G93 G1 X900 F1", "X: must be between -400.000 and 400.000"),
        (Dialect::LinuxCnc, "G93", "G93 G1 X1", "every block states its own inverse time"),
        (Dialect::LinuxCnc, "G93", "G93 #1=3", "must be a word"),
        (Dialect::Fanuc, "G43 H4", "G43.4 H4", "G43.4: is no word of fanuc"),
        (Dialect::FanucTip, "G43.4 H4", "G43.5 H4", "G43.5: is no word of fanuc_tip"),
        (Dialect::Haas, "G234 H4", "G254 H4", "G254"),
        (Dialect::Siemens, "RTLION", "CYCLE800", "CYCLE800"),
        (Dialect::SiemensVector, "ORIWKS", "ORIMKS", "ORIMKS"),
        (Dialect::SiemensVector, "A3=", "A2=", "A2"),
        (Dialect::Heidenhain, "M128", "M144", "M144"),
        (Dialect::Heidenhain, "LN X+10", "CC X+10", "CC"),
    ];
    for (dialect, from, to, why) in cases {
        let (line, message) = refused(dialect, from, to);
        assert!(message.contains(why) && line > 1, "{to}: line {line}: {message}");
    }
}

#[test]
fn layout_is_kept() {
    let layout = Layout { numbered: true, carriage_return: true, linear: 3, rotary: 3, ..Layout::default() };
    let options = PostOptions { layout, ..PostOptions::new(Dialect::Fanuc) };
    let posted = post_program(&program(10.0), &example("table_table_bc"), &options).unwrap();
    assert!(posted.deviation.tip_mm < 1e-3 && posted.deviation.axis_deg < 1e-3, "{:?}", posted.deviation);
    assert!(posted.text.split_terminator('\n').all(|line| line.ends_with('\r')));
    assert!(posted.text.contains("\r\nN12 "));
    let short = PostOptions { layout: Layout { most_blocks: Some(20), ..layout }, ..options };
    let why = post_program(&program(10.0), &example("table_table_bc"), &short).unwrap_err().to_string();
    assert!(why.contains("more than the 20"), "{why}");
}

#[test]
fn dialects_refuse_machines_that_they_do_not_suit() {
    let post = |machine: &str, dialect, lean| {
        post_program(&program(lean), &example(machine), &PostOptions::new(dialect)).unwrap_err().to_string()
    };
    assert!(post("table_table_ac", Dialect::Grbl, 10.0).contains("grbl has three axes"));
    assert!(post("three_axis", Dialect::Heidenhain, 0.0).contains("this machine has none"));
    assert!(post("three_axis", Dialect::Grbl, 10.0).contains("without rotary axes"));
    let long = PostOptions { tool_length_mm: Some(500.0), ..PostOptions::new(Dialect::Fanuc) };
    let why = post_program(&program(10.0), &example("table_table_ac"), &long).unwrap_err().to_string();
    assert!(why.contains("tool length") && why.contains("200 mm"), "{why}");
}
