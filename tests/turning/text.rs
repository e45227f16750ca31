//! Programs out and in again.

use crate::support::{near, order, planned};
use stepover::post::xzc::{
    CWord, Dialect, Feed, Reference, Rounding, XWord, XzcProgram, apt_program, read_gcode, read_pvt,
    read_table, write_gcode, write_pvt, write_table,
};
use stepover::post::{ReadError, WriteError, apt};
use stepover::toolpath::{AxisPoint, Interpolation, Nose, TurningPath};
use stepover::turning::{Asked, Curve, Order, Spacing, Step, Way, Ways};

fn short(interpolation: Interpolation) -> XzcProgram {
    let point = |i: f64| AxisPoint {
        x: 2.0 - 0.5 * i,
        z: 14.0 + 0.125 * i,
        c: 3.0 * i,
        time: 0.25 * i,
        rates: [-2.0, 0.5, 12.0],
    };
    XzcProgram {
        part: "lens (left); 2%".into(),
        nose: Nose::Ball(15.0),
        reference: Reference::Tip,
        x_word: XWord::Radius,
        c_word: CWord::Tool,
        tool: 3,
        spindle_rpm: Some(8000.0),
        clearance: 5.0,
        approach: 200.0,
        blend: 1e-5,
        path: TurningPath { points: [0.0, 1.0, 2.0].map(point).into(), interpolation },
    }
}

#[test]
fn linuxcnc_text_is_as_ever() {
    let program = short(Interpolation::Linear);
    let text = write_gcode(&program, Dialect::LinuxCnc, Feed::InverseTime, &Rounding::default());
    insta::assert_snapshot!(text.unwrap());
}

#[test]
fn fanuc_text_is_as_ever() {
    let program = XzcProgram {
        x_word: XWord::Diameter,
        c_word: CWord::Part,
        nose: Nose::Insert(1.5),
        ..short(Interpolation::Linear)
    };
    let text = write_gcode(&program, Dialect::Fanuc, Feed::PerMinute, &Rounding { length: 4, angle: 3 });
    insta::assert_snapshot!(text.unwrap());
}

#[test]
fn pvt_text_is_as_ever() {
    insta::assert_snapshot!(write_pvt(&short(Interpolation::Pvt), &Rounding::default()).unwrap());
}

fn assert_same(a: &TurningPath, b: &TurningPath, length: f64, rates: bool) {
    assert_eq!((a.points.len(), a.interpolation), (b.points.len(), b.interpolation));
    for (p, q) in a.points.iter().zip(&b.points) {
        near(q.x, p.x, length);
        near(q.z, p.z, length);
        near(q.c, p.c, 1e-7);
        near(q.time, p.time, 1e-4 * (1.0 + p.time));
        if rates {
            near(q.rates[1], p.rates[1], 1e-6);
        }
    }
}

/// A path with holds of X, where nothing but C moves.
fn circles(interpolation: Interpolation) -> XzcProgram {
    let ways = Ways { curve: Curve::Circles(0.3), way: Way::Inward, lead_in: 0.0, lead_out: 0.0 };
    let spacing = Step::Given(Spacing::Arc { length: 2.0, most: 0.5 });
    let asked = Asked { residue: 1.0, chord: 1.0 };
    let path = planned(&Order { ways, spacing, interpolation, asked, ..order(2.0, 3.0) }).path;
    XzcProgram { path, ..short(interpolation) }
}

#[test]
fn what_is_written_is_read_and_written_alike() {
    let rounding = Rounding::default();
    for (reference, x_word, c_word) in
        [(Reference::Tip, XWord::Radius, CWord::Tool), (Reference::Center, XWord::Diameter, CWord::Part)]
    {
        let program = XzcProgram { reference, x_word, c_word, ..circles(Interpolation::Linear) };
        for dialect in [Dialect::LinuxCnc, Dialect::Fanuc] {
            for feed in [Feed::InverseTime, Feed::PerMinute] {
                let text = write_gcode(&program, dialect, feed, &rounding).unwrap();
                let (nose, path) = read_gcode(&text, dialect).unwrap();
                assert_eq!(nose, program.nose);
                if feed == Feed::InverseTime {
                    assert_same(&program.path, &path, 6e-7, false);
                }
                let again = XzcProgram { path, ..program.clone() };
                assert!(
                    write_gcode(&again, dialect, feed, &rounding).unwrap() == text,
                    "{dialect:?} {feed:?}"
                );
            }
        }
        let program = XzcProgram { reference, x_word, c_word, ..circles(Interpolation::Pvt) };
        let text = write_pvt(&program, &rounding).unwrap();
        let (nose, path) = read_pvt(&text).unwrap();
        assert_eq!(nose, program.nose);
        assert_same(&program.path, &path, 6e-7, true);
        assert!(write_pvt(&XzcProgram { path, ..program.clone() }, &rounding).unwrap() == text);
        let table = write_table(&program.path, &rounding);
        let path = read_table(&table, Interpolation::Pvt).unwrap();
        assert_same(&program.path, &path, 6e-7, true);
        assert!(write_table(&path, &rounding) == table);
    }
}

/// C never jumps, and every number is plain: digits, a point, all decimals.
#[test]
fn numbers_are_plain_and_c_runs_on() {
    let program = circles(Interpolation::Linear);
    let text = write_gcode(&program, Dialect::LinuxCnc, Feed::InverseTime, &Rounding { length: 5, angle: 4 })
        .unwrap();
    let mut before = 0.0;
    for line in text.lines().filter(|line| line.starts_with("G1 X")) {
        for word in line.split(' ').skip(1) {
            let (letter, number) = word.split_at(1);
            let (whole, decimals) = number.split_once('.').unwrap();
            assert!(
                whole.trim_start_matches('-').bytes().chain(decimals.bytes()).all(|b| b.is_ascii_digit()),
                "{line}"
            );
            assert_eq!(decimals.len(), if letter == "X" || letter == "Z" { 5 } else { 4 }, "{line}");
            if letter == "C" {
                let c: f64 = number.parse().unwrap();
                assert!(c > before && c - before < 30.0, "{line}");
                before = c;
            }
        }
    }
    assert!(before > 20.0 * 360.0);
}

#[test]
fn apt_states_where_the_tool_is_over_the_part() {
    let program = circles(Interpolation::Linear);
    let stated = apt_program(&program).unwrap();
    let read = apt::read(&apt::write(&stated)).unwrap();
    assert_eq!(read.toolpath.moves.len(), program.path.points.len() + 2);
    let (at, p) = (read.toolpath.moves[8].to.tip, program.path.points[7]);
    near(at.x, p.x * libm::cos(p.c), 1e-5);
    near(at.y, p.x * libm::sin(p.c), 1e-5);
    near(at.z, p.z - 15.0, 1e-5);
}

#[test]
fn what_cannot_be_written_or_read_is_named() {
    let rounding = Rounding::default();
    let write = |program: &XzcProgram| write_gcode(program, Dialect::LinuxCnc, Feed::InverseTime, &rounding);
    assert_eq!(write(&short(Interpolation::Pvt)), Err(WriteError::Cubic));
    let mut program = short(Interpolation::Linear);
    program.path.points[2].time = 0.1;
    assert_eq!(write(&program), Err(WriteError::NotFinite { index: 2 }));
    program.path.points.clear();
    assert_eq!(write(&program), Err(WriteError::Empty));

    let text = write(&short(Interpolation::Linear)).unwrap();
    let line = |text: &str| match read_gcode(text, Dialect::LinuxCnc).unwrap_err() {
        ReadError::Statement { line, word, .. } => (line, word),
        other => (0, other.to_string()),
    };
    let first = text.lines().position(|l| l == "(PATH)").unwrap() + 3;
    let with = |old: &str, new: &str| line(&text.replacen(old, new, 1));
    assert_eq!(with("G1 X1.5", "G2 X1.5"), (first, "G2".into()));
    assert_eq!(with("G1 X1.5", "G0 X1.5").0, first);
    assert_eq!(with("G1 X1.5", "G1 Y1.5").0, first);
    assert_eq!(with("F240.0000", "").0, first);
    assert_eq!(with("X1.500000", "X1.5e0").0, first);
    assert!(with("(XZC BALL", "(XYZ BALL").1.contains("what the words mean"));
    assert!(with("(PATH)", "").1.contains("the path"));
    assert!(line("").1.contains("mean"));
    for end in (0..text.len()).step_by(7) {
        // Whatever is cut off, it is read or refused.
        let _ = read_gcode(&text[..end], Dialect::Fanuc);
        let _ = read_pvt(&text[..end]);
        let _ = read_table(&text[..end], Interpolation::Linear);
    }
}
