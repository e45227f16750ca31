//! Programs out and in again.

use glam::DVec3;
use proptest::prelude::*;
use stepover::cutter::Cutter;
use stepover::post::{Program, ReadError, Unit, WriteError, apt, csv, gcode};
use stepover::toolpath::{Bound, ClPoint, Move, Posture, Rate, Role, Toolpath, Touch, Work};

fn step(tip: [f64; 3], axis: [f64; 3], rate: Rate, role: Role) -> Move {
    Move { to: ClPoint { tip: tip.into(), axis: DVec3::from(axis).normalize() }, rate, role }
}

/// A link down, two passes with a link between, a link up.
fn moves(lean: f64) -> Vec<Move> {
    use Rate::{Feed, Rapid};
    use Role::{Cut, Link};
    let a = [lean, 0.0, 1.0];
    vec![
        step([0.0, -0.0, 50.0], [0.0, 0.0, 1.0], Rapid, Link),
        step([0.0, 0.0, 2.0], a, Rapid, Link),
        step([0.0, 0.0, -1.0 / 3.0], a, Feed(300.0), Link),
        step([10.0, 0.0, -0.25], a, Feed(1200.0), Cut),
        step([20.0, -1e-9, -0.25], a, Feed(1200.0), Cut),
        step([20.0, 5.0, 2.0], a, Rapid, Link),
        step([20.0, 5.0, 0.0], a, Feed(300.0), Link),
        step([0.0, 5.0, 1e-7], a, Feed(1200.0), Cut),
        step([0.0, 5.0, 50.0], [0.0, 0.0, 1.0], Rapid, Link),
    ]
}

fn program(lean: f64, unit: Unit) -> Program {
    Program {
        part: "wave 100 x 100".into(),
        unit,
        cutter: Cutter::bull_nose(25.0, 3.0, 50.0).unwrap(),
        tool: 4,
        spindle_rpm: Some(12_000.0),
        toolpath: Toolpath { moves: moves(lean) },
    }
}

#[test]
fn apt_text_is_as_ever() {
    insta::assert_snapshot!(apt::write(&program(0.2, Unit::Mm)));
}

#[test]
fn gcode_text_is_as_ever() {
    insta::assert_snapshot!(gcode::write(&program(0.0, Unit::Mm)).unwrap());
}

#[test]
fn table_is_as_ever() {
    let touch = |x: f64, strip| {
        let posture = Posture { lead: 0.2, yaw: -0.5 };
        let contact = Some((posture, Work { strip, bound: Bound::Curvature }));
        Touch { point: DVec3::new(x, 0.1, 0.0), contact }
    };
    let none = Touch { point: DVec3::ZERO, contact: None };
    let touches = [none, none, touch(0.0, None), touch(9.9, Some(1.25)), touch(20.0, Some(0.75)), none];
    insta::assert_snapshot!(csv::write(&program(0.2, Unit::Mm).toolpath, &touches));
}

fn assert_same_path(a: &Toolpath, b: &Toolpath, tip: f64, axis: f64, feed: f64) {
    assert_eq!(a.moves.len(), b.moves.len());
    for (a, b) in a.moves.iter().zip(&b.moves) {
        assert!(a.to.tip.distance(b.to.tip) <= tip, "{a:?} {b:?}");
        assert!(a.to.axis.distance(b.to.axis) <= axis, "{a:?} {b:?}");
        assert!((b.to.axis.length() - 1.0).abs() < 1e-15);
        assert_eq!(a.role, b.role);
        match (a.rate, b.rate) {
            (Rate::Feed(a), Rate::Feed(b)) => assert!((a - b).abs() <= feed),
            (a, b) => assert_eq!(a, b),
        }
    }
}

#[test]
fn cutters_survive_their_text() {
    let cutters = [
        Cutter::ball(10.0 / 3.0, 20.0).unwrap(),
        Cutter::ball(6.35, 3.175).unwrap(),
        Cutter::flat(0.1, 0.0).unwrap(),
        Cutter::tapered(4.0, 1.0, 0.1, 25.0).unwrap(),
        Cutter::conical(12.0, 1.5, 0.3, 20.0).unwrap(),
        Cutter::new(8.0, 1.0, 0.2, 0.15, 20.0).unwrap(),
        Cutter::new(8.0, 1.0, 0.0, -0.15, 20.0).unwrap(),
    ];
    for unit in [Unit::Mm, Unit::Inch] {
        for cutter in cutters {
            let text = apt::write(&Program { cutter, ..program(0.2, unit) });
            let back = apt::read(&text).unwrap();
            let off = |(a, b): (f64, f64)| (a - b).abs() > 1e-9;
            let pairs = back.cutter.apt_parameters().into_iter().zip(cutter.apt_parameters());
            assert!(!pairs.clone().any(off), "{:?}", pairs.collect::<Vec<_>>());
            assert_eq!(apt::write(&back), text);
        }
    }
}

fn any_rate() -> impl Strategy<Value = Rate> {
    prop_oneof![Just(Rate::Rapid), Just(Rate::Feed(1200.0)), (0.01..20_000.0).prop_map(Rate::Feed)]
}

fn any_path() -> impl Strategy<Value = Toolpath> {
    let unit = prop::array::uniform3(-1.0..1.0f64)
        .prop_filter("no direction", |a| DVec3::from(*a).length() > 0.1)
        .boxed();
    let role = prop_oneof![Just(Role::Cut), Just(Role::Link)];
    let step = (prop::array::uniform3(-2000.0..2000.0f64), unit, any_rate(), role)
        .prop_map(|(tip, axis, rate, role)| step(tip, axis, rate, role));
    prop::collection::vec(step, 1..40).prop_map(|moves| Toolpath { moves })
}

proptest! {
    #[test]
    fn apt_comes_back(path in any_path(), inch in any::<bool>()) {
        let unit = if inch { Unit::Inch } else { Unit::Mm };
        let written = Program { toolpath: path, ..program(0.0, unit) };
        let text = apt::write(&written);
        let (back, notes) = apt::read_with_notes(&text).unwrap();
        prop_assert!(notes.ended && notes.skipped.is_empty());
        assert_same_path(&written.toolpath, &back.toolpath, 3e-5, 2e-7, 2e-4);
        prop_assert_eq!(&apt::write(&back), &text);
        prop_assert_eq!((back.part, back.unit, back.tool, back.spindle_rpm), (written.part, unit, 4, Some(12_000.0)));
    }

    #[test]
    fn gcode_comes_back(mut path in any_path()) {
        path.moves.iter_mut().for_each(|m| m.to.axis = DVec3::Z);
        let written = Program { toolpath: path, ..program(0.0, Unit::Mm) };
        let text = gcode::write(&written).unwrap();
        let back = gcode::read(&text).unwrap();
        assert_same_path(&written.toolpath, &back, 0.9e-4, 0.0, 0.6e-3);
        prop_assert_eq!(gcode::write(&Program { toolpath: back, ..written }).unwrap(), text);
    }

    #[test]
    fn no_text_breaks_a_reader(text in "([A-Z/,.0-9$ ()\n-]|CUTTER/10\n|GOTO/1,2,3\n|G1X1|µ){0,60}") {
        let _ = apt::read(&text);
        let _ = gcode::read(&text);
    }
}

#[test]
fn apt_reader_takes_what_others_write() {
    let text = "partno wing 7 $$ a comment\nunits / inches\nMULTAX\nCUTTER/ 1.0, 0.125\n\
        from/0,0,2\nSPINDL/RPM,8000,CLW\nCOOLNT/ON\nRAPID\nGOTO/ 0., 0., .1 $\n , 0,0,1\nFEDRAT/10,IPM\n\
        goto/1,0,0,0,0,1.00001\nCOOLNT/OFF\nFINI\nthis is not read";
    let (program, notes) = apt::read_with_notes(text).unwrap();
    assert_eq!(program.part, "wing 7");
    assert_eq!(program.unit, Unit::Inch);
    assert_eq!((program.cutter.diameter, program.cutter.corner_radius), (25.4, 3.175));
    assert_eq!(program.spindle_rpm, Some(8000.0));
    assert_eq!(notes.skipped, [("COOLNT".to_owned(), 2)]);
    let moves = &program.toolpath.moves;
    assert_eq!(moves.len(), 3);
    assert_eq!(moves[0].to.tip, DVec3::new(0.0, 0.0, 50.8));
    assert_eq!((moves[1].rate, moves[1].role), (Rate::Rapid, Role::Link));
    assert_eq!((moves[2].rate, moves[2].role), (Rate::Feed(254.0), Role::Cut));
    assert_eq!(moves[2].to, ClPoint { tip: DVec3::new(25.4, 0.0, 0.0), axis: DVec3::Z });
}

#[test]
fn apt_errors_name_line_and_remedy() {
    let head = "CUTTER/10,2\n";
    for (text, line, says) in [
        ("GOTO/1,2\n", 2, "GOTO/x,y,z,i,j,k"),
        ("GOTO/1,2,x\n", 2, "“X” is not a number"),
        ("GOTO/1,2,3,0,0,0\n", 2, "length 1"),
        ("GOTO/1,2,3,0,0,NAN\n", 2, "not a number"),
        ("\n\nFEDRAT/0\n", 4, "above 0"),
        ("FEDRAT/0.1,MMPR\n", 2, "SPINDL"),
        ("UNITS/INCH\n", 2, "top"),
        ("UNITS/CM\n", 2, "UNITS/MM"),
        ("GOTO/0,0,0\nCYCLE/DRILL,1\n", 3, "GOTO/x,y,z,i,j,k"),
        ("GOTO/0,0,0\nCUTTER/12\n", 3, "one cutter"),
        ("CUTTER/10,2,9,2,0,0,50\n", 2, "3.0000,2.0000"),
        ("CUTTER/1,2,3\n", 2, "1, 2 or 7"),
        ("CUTTER/10,6\n", 2, "corner_radius: must be at most 5.0000 mm"),
    ] {
        let error = apt::read(&format!("{head}{text}")).unwrap_err().to_string();
        assert!(error.contains(&format!("line {line}:")) && error.contains(says), "{text}: {error}");
    }
    assert!(matches!(apt::read("GOTO/0,0,0"), Err(ReadError::Missing { what: "the cutter", .. })));
    assert!(matches!(apt::read(head), Err(ReadError::Missing { what: "motion", .. })));
    assert!(matches!(apt::read(&"1$\n".repeat(20_000)), Err(ReadError::Statement { line: 1, .. })));
}

#[test]
fn gcode_reader_is_modal_and_refuses_what_it_cannot_follow() {
    let path = gcode::read(
        "%\nO100\nN10 g20 g90 g17\nN20 G0 Z1. (start)\nX1Y0;go\nG4 P1 X9\nG1 Z0 F10\nX 2\nM30\nG2",
    )
    .unwrap();
    let tips: Vec<_> = path.moves.iter().map(|m| (m.to.tip / 25.4).to_array()).collect();
    assert_eq!(tips, [[1.0, 0.0, 1.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]);
    assert_eq!(path.moves[2].rate, Rate::Feed(254.0));
    assert_eq!(path.moves.iter().map(|m| m.role).collect::<Vec<_>>(), [Role::Link, Role::Cut, Role::Cut]);
    for (text, says) in [
        ("G2 X1 Y1 I1", "arcs"),
        ("G91 X1", "G90"),
        ("G0 A10", "APT"),
        ("G28 X0", "G28"),
        ("M98 P1", "subprograms"),
        ("G1 X1", "feed"),
        ("X1", "G0 or G1"),
        ("G0 X#1", "letter followed by a number"),
        ("G0 X", "letter followed by a number"),
        ("/G0 X1", "left out"),
        ("G0 X1 (open", "closing"),
        ("G1 F0", "above 0"),
        ("é", "letter"),
    ] {
        let error = gcode::read(&format!("G21\n{text}")).unwrap_err().to_string();
        assert!(error.contains("line 2:") && error.contains(says), "{text}: {error}");
    }
}

#[test]
fn gcode_is_for_upright_axes() {
    let tilted = gcode::write(&program(0.1, Unit::Mm));
    assert!(
        matches!(tilted, Err(WriteError::Tilted { index: 1, degrees }) if (degrees - 5.7106).abs() < 1e-4)
    );
    let mut upside_down = program(0.0, Unit::Mm);
    upside_down.toolpath.moves[3].to.axis = DVec3::NEG_Z;
    assert!(matches!(gcode::write(&upside_down), Err(WriteError::Tilted { index: 3, .. })));
    let mut broken = program(0.0, Unit::Mm);
    broken.toolpath.moves[2].to.tip.x = f64::NAN;
    assert_eq!(gcode::write(&broken), Err(WriteError::NotFinite { index: 2 }));
}
