//! The motion of the axes keeps the tool on its path.

use crate::examples::{all, example, five_axis};
use glam::DVec3;
use proptest::prelude::*;
use stepover::machine::{AxisPath, Control, Following, Kinematics, Machine, MotionError, Touching, drive};
use stepover::toolpath::{ClPoint, Move, Rate, Role, Toolpath};

const CUT: (Rate, Role) = (Rate::Feed(2000.0), Role::Cut);
const RAPID: (Rate, Role) = (Rate::Rapid, Role::Link);

/// A tool at `tip` that leans by `lean` degrees towards `azimuth` degrees.
fn pose(tip: DVec3, lean: f64, azimuth: f64) -> ClPoint {
    let (s, c) = libm::sincos(lean.to_radians());
    let (sa, ca) = libm::sincos(azimuth.to_radians());
    ClPoint { tip, axis: DVec3::new(s * ca, s * sa, c) }
}

fn path(poses: impl IntoIterator<Item = (ClPoint, (Rate, Role))>) -> Toolpath {
    let moves = poses.into_iter().map(|(to, (rate, role))| Move { to, rate, role });
    Toolpath { moves: moves.collect() }
}

fn driven(machine: &Machine, path: &Toolpath) -> Result<AxisPath, MotionError> {
    let kinematics = Kinematics::new(machine, 120.0).unwrap();
    drive(&kinematics, path, &[], &Following::new(Control::Axes))
}

/// Checks every move in 16 places: limits, chord and axis tolerance, the ends, and the time that the axes need.
fn assert_follows(kinematics: &Kinematics, path: &Toolpath, axes: &AxisPath, how: &Following) {
    let ends: Vec<_> = axes.moves.iter().filter(|m| m.is_end).collect();
    assert_eq!(ends.len(), path.moves.len());
    for (step, end) in path.moves.iter().zip(&ends) {
        let pose = kinematics.pose(&end.at);
        assert!(pose.tip.distance(step.to.tip) < 1e-9, "{pose:?} {step:?}");
        assert!(pose.axis.distance(step.to.axis) < 3e-6, "{pose:?} {step:?}");
    }
    for pair in axes.moves.windows(2) {
        let [a, b] = pair else { unreachable!() };
        let tolerance = if b.rate == Rate::Rapid { how.rapid } else { how.feed };
        for k in 0..=16 {
            let at = a.at.lerp(&b.at, f64::from(k) / 16.0);
            for (axis, position) in kinematics.axes().iter().zip(at.all()) {
                let [low, high] = axis.limits.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
                assert!(position >= low - 1e-9 && position <= high + 1e-9, "{} at {position}", axis.letter);
            }
            let pose = kinematics.pose(&at);
            // Off the path's own line, and not off that between both places.
            let [from, to] = if b.turns_over || b.source == 0 {
                [a.to.tip, b.to.tip]
            } else {
                [path.moves[b.source - 1].to.tip, path.moves[b.source].to.tip]
            };
            let way = to - from;
            let share = (pose.tip - from).dot(way) / way.length_squared();
            let nearest = if share > 0.0 { from + share.min(1.0) * way } else { from };
            let off = pose.tip.distance(nearest);
            assert!(off < 1.05 * tolerance.chord + 1e-9, "the tip is off by {off} between {a:?} and {b:?}");
            if b.rate != Rate::Rapid {
                let (from, to) = (&path.moves[b.source - 1].to, &path.moves[b.source].to);
                let nearest = (0..=400)
                    .map(|k| from.axis.lerp(to.axis, f64::from(k) / 400.0).normalize().distance(pose.axis))
                    .fold(f64::INFINITY, f64::min);
                let grain = from.axis.distance(to.axis) / 400.0;
                let allowed = 1.01 * tolerance.axis + how.rotary_step + grain;
                assert!(nearest < allowed, "the axis is off by {nearest} at {b:?}");
            }
        }
        for (axis, (from, to)) in kinematics.axes().iter().zip(a.at.all().into_iter().zip(b.at.all())) {
            assert!(
                (to - from).abs() <= axis.speed * b.seconds * (1.0 + 1e-9),
                "{} is too fast",
                axis.letter
            );
        }
    }
}

#[test]
fn every_machine_follows_a_wavy_pass_within_its_tolerances() {
    let wave = |k: u32| {
        let t = f64::from(k) / 60.0;
        let tip = DVec3::new(60.0 * t - 30.0, 10.0 * libm::sin(5.0 * t), 5.0 + 3.0 * libm::cos(7.0 * t));
        (pose(tip, 12.0 + 10.0 * libm::sin(4.0 * t), 40.0 + 300.0 * t), CUT)
    };
    let path = path((0..=60).map(wave));
    for (name, kinematics) in five_axis() {
        for chord in [1e-2, 1e-4] {
            let mut how = Following::new(Control::Axes);
            how.feed.chord = chord;
            let axes = drive(&kinematics, &path, &[], &how).unwrap_or_else(|e| panic!("{name}: {e}"));
            assert_follows(&kinematics, &path, &axes, &how);
            let length = path.length(Role::Cut);
            let seconds: f64 = axes.moves.iter().map(|m| m.seconds).sum();
            assert!(seconds >= 60.0 * length / 2000.0 - 1e-9, "{name}");
        }
    }
}

#[test]
fn three_axes_follow_without_a_point_more() {
    let path = path(
        [([0.0, 0.0, 5.0], RAPID), ([30.0, 0.0, 0.0], CUT), ([30.0, 20.0, 1.0], CUT)]
            .map(|(tip, how)| (pose(tip.into(), 0.0, 0.0), how)),
    );
    for (name, kinematics) in all() {
        let axes = drive(&kinematics, &path, &[], &Following::new(Control::Axes)).unwrap();
        assert_eq!(axes.moves.len(), 3, "{name}");
    }
}

/// A pass that leans to one side, goes upright past the pole at `miss` degrees, and leans to the other.
fn past_the_pole(miss: f64) -> Toolpath {
    let step = |k: i32| {
        let lean = 2.0 * f64::from(k).to_radians();
        let axis = DVec3::new(lean, miss.to_radians(), 1.0).normalize();
        (ClPoint { tip: DVec3::new(2.0 * f64::from(k), 25.0, 3.0), axis }, CUT)
    };
    path((-6..=6).map(step))
}

#[test]
fn the_pole_is_passed_within_the_tolerances_however_near() {
    for (name, kinematics) in five_axis() {
        for miss in [0.0, 1e-9, 1e-5, 1e-3, 0.004, 0.02, 0.5] {
            let (path, how) = (past_the_pole(miss), Following::new(Control::Axes));
            let axes =
                drive(&kinematics, &path, &[], &how).unwrap_or_else(|e| panic!("{name}, {miss}°: {e}"));
            assert_follows(&kinematics, &path, &axes, &how);
        }
    }
}

#[test]
fn a_tilt_that_may_not_change_sign_turns_the_table_in_the_pole() {
    let mut machine = example("table_table_ac");
    machine.axes[1].limits = Some([-2.0, 0.0]);
    let kinematics = Kinematics::new(&machine, 120.0).unwrap();
    for miss in [0.0, 1e-5, 1e-3] {
        let (path, how) = (past_the_pole(miss), Following::new(Control::Axes));
        let axes = drive(&kinematics, &path, &[], &how).unwrap();
        assert_follows(&kinematics, &path, &axes, &how);
        let c: Vec<f64> = axes.moves.iter().map(|m| m.at.rotary[0].to_degrees()).collect();
        let turned = (c[0] - c[c.len() - 1]).abs();
        assert!((turned - 180.0).abs() < 5.0, "C turned by {turned}°");
        // Tip and table turn together: no piece turns by more than was asked for.
        assert!(c.windows(2).all(|w| (w[1] - w[0]).abs() < 5.8), "{c:?}");
    }
}

#[test]
fn an_upright_stretch_turns_the_free_axis_on_its_way() {
    // Leaning to +x, upright over 40 mm, leaning to +y: C turns by 90° between.
    let lean = |k: i32| match k {
        ..0 => (f64::from(-k), 0.0),
        0..=20 => (0.0, 0.0),
        _ => (f64::from(k - 20), 90.0),
    };
    let path = path((-10..=30).map(|k| {
        let (lean, azimuth) = lean(k);
        (pose(DVec3::new(2.0 * f64::from(k), 10.0, 0.0), lean, azimuth), CUT)
    }));
    for name in ["table_table_ac", "head_table_bc", "head_head_ac"] {
        let kinematics = Kinematics::new(&example(name), 120.0).unwrap();
        let how = Following::new(Control::Axes);
        let axes = drive(&kinematics, &path, &[], &how).unwrap();
        assert_follows(&kinematics, &path, &axes, &how);
        let upright: Vec<f64> = axes
            .moves
            .iter()
            .filter(|m| m.is_end && (10..=30).contains(&m.source))
            .map(|m| m.at.rotary[0])
            .collect();
        let whole = (upright[20] - upright[0]).abs().to_degrees();
        assert!((whole - 90.0 * 20.0 / 22.0).abs() < 0.01, "{name}: {whole}°");
        // The tip never stands still while C turns.
        assert!(axes.moves.windows(2).all(|w| w[0].to.tip.distance(w[1].to.tip) > 1e-4), "{name}");
    }
}

#[test]
fn feed_is_that_of_the_contact_where_it_is_known() {
    let cut = |k: u32| (pose(DVec3::new(f64::from(k), 0.0, 20.0), 5.0, 0.0), CUT);
    let path = path((0..10).map(cut));
    // The contact goes twice as far as the tip, as on the outside of a bend.
    let touch = |m: &Move| Some(Touching { point: 2.0 * m.to.tip, normal: DVec3::Z });
    let contacts: Vec<_> = path.moves.iter().map(touch).collect();
    let kinematics = Kinematics::new(&example("head_head_ac"), 120.0).unwrap();
    let seconds = |contacts: &[Option<Touching>]| -> f64 {
        let axes = drive(&kinematics, &path, contacts, &Following::new(Control::Axes)).unwrap();
        axes.moves.iter().map(|m| m.seconds).sum()
    };
    assert!((seconds(&[]) - 60.0 * 9.0 / 2000.0).abs() < 1e-9);
    assert!((seconds(&contacts) - 60.0 * 18.0 / 2000.0).abs() < 1e-9);
}

#[test]
fn the_solution_that_lasts_is_taken_and_not_the_nearest_at_first() {
    // A of the trunnion goes from −120° to 30°. Leaning by 10° both solutions fit, and A = 10° with C = 0 is the nearer; leaning by
    // 60° only A = −60° does.
    let path =
        path((0..=50).map(|k| (pose(DVec3::new(f64::from(k), 0.0, 0.0), 10.0 + f64::from(k), -90.0), CUT)));
    let axes = driven(&example("table_table_ac"), &path).unwrap();
    assert!((axes.moves[0].at.rotary[1].to_degrees() + 10.0).abs() < 1e-3);
    assert_eq!(axes.turn_overs, 0);
}

/// A pass that goes round `turns` times while the tool leans outwards, in the manner of a cone's side.
fn around(turns: f64, how: (Rate, Role)) -> Vec<(ClPoint, (Rate, Role))> {
    let steps = (60.0 * turns) as u32;
    let at = |k: u32| {
        let azimuth = 360.0 * turns * f64::from(k) / f64::from(steps);
        let (s, c) = libm::sincos(azimuth.to_radians());
        (pose(DVec3::new(20.0 * c, 20.0 * s, 0.0), 20.0, azimuth), how)
    };
    (0..=steps).map(at).collect()
}

#[test]
fn an_axis_without_end_turns_on() {
    let axes = driven(&example("table_table_ac"), &path(around(4.0, CUT))).unwrap();
    let c: Vec<f64> = axes.moves.iter().map(|m| m.at.rotary[0].to_degrees()).collect();
    assert!(((c[c.len() - 1] - c[0]).abs() - 1440.0).abs() < 1e-3);
    assert!(c.windows(2).all(|w| (w[1] - w[0]).abs() < 6.1));
}

#[test]
fn an_axis_at_its_limit_turns_back_on_a_link_or_says_where_it_cannot() {
    let machine = example("table_table_bc");
    // Two turns fit between −360° and 360°; the first is chosen so that they do.
    assert_eq!(driven(&machine, &path(around(1.9, CUT))).unwrap().turn_overs, 0);
    let Err(MotionError::NoTurn { index, letter, .. }) = driven(&machine, &path(around(3.0, CUT))) else {
        panic!("three turns do not fit")
    };
    assert!(letter == 'C' && (115..=125).contains(&index), "{letter} {index}");

    let up =
        |step: &(ClPoint, (Rate, Role))| (ClPoint { tip: step.0.tip + 80.0 * step.0.axis, ..step.0 }, RAPID);
    let (first, second) = (around(1.5, CUT), around(1.5, CUT));
    let (last, begin) = (first[first.len() - 1], second[0]);
    let mut joined = vec![up(&first[0])];
    joined.extend(first);
    joined.push(up(&last));
    // As much again in the same sense, from where the first ended.
    let turned = |(at, how): (ClPoint, (Rate, Role))| {
        let turn = glam::DMat3::from_rotation_z(1.5 * std::f64::consts::TAU);
        (ClPoint { tip: turn * at.tip, axis: turn * at.axis }, how)
    };
    joined.push(up(&turned(begin)));
    joined.extend(second.into_iter().map(turned));
    let path = path(joined);
    let kinematics = Kinematics::new(&machine, 120.0).unwrap();
    let how = Following::new(Control::Axes);
    let axes = drive(&kinematics, &path, &[], &how).unwrap();
    assert_eq!(axes.turn_overs, 1);
    assert_follows(&kinematics, &path, &axes, &how);
    let back = axes.moves.iter().filter(|m| !m.is_end && m.rate == Rate::Rapid);
    let drawn = back.map(|m| m.to.tip.z).fold(f64::NEG_INFINITY, f64::max);
    assert!(drawn > 60.0, "drawn back to z = {drawn}");
}

#[test]
fn what_is_out_of_reach_is_named() {
    let machine = example("head_head_ab");
    let leaning = |lean: f64| {
        path([(pose(DVec3::ZERO, 0.0, 0.0), RAPID), (pose(DVec3::new(1.0, 0.0, 99.0), lean, 0.0), CUT)])
    };
    let why = driven(&machine, &leaning(51.0)).unwrap_err().to_string();
    assert!(
        why.contains("move 1 to (1.000, 0.000, 99.000)") && why.contains("B would go to 51.000°"),
        "{why}"
    );
    assert!(why.contains("-50.000 to 50.000°"), "{why}");
    let far = path([(pose(DVec3::new(2000.0, 0.0, 0.0), 0.0, 0.0), RAPID)]);
    let why = driven(&machine, &far).unwrap_err().to_string();
    assert!(why.contains("move 0") && why.contains("X would go to 2000.000 mm"), "{why}");
    let why = driven(&example("three_axis"), &leaning(5.0)).unwrap_err().to_string();
    assert!(why.contains("5.000°") && why.contains("without rotary axes"), "{why}");
    assert_eq!(driven(&machine, &Toolpath::default()), Err(MotionError::Empty));
    let nan = path([(pose(DVec3::NAN, 0.0, 0.0), RAPID)]);
    assert_eq!(driven(&machine, &nan), Err(MotionError::NotFinite { index: 0 }));
}

/// What bows a move is mostly along it, or rises quickly beside the pole: what one part of it does tells little of the others.
#[test]
fn moves_along_the_tool_and_beside_the_pole_keep_the_chord() {
    let moves = [
        ([22.977, -13.767, -29.349], [0.0, 0.0], [23.403, -9.149, 29.684], [0.0914, 0.085]),
        ([30.818, -31.444, 0.0], [-0.0904, -0.0558], [30.326, -39.3, 32.165], [0.0, 0.0]),
        ([0.0, -18.211, 0.0], [0.1237, 0.0985], [0.0, 4.258, 23.75], [0.0205, -0.0096]),
        ([0.0, -4.297, -36.919], [0.0803, 0.1919], [38.059, -16.597, 39.128], [-0.0172, 0.074]),
        ([0.0, 25.832, 0.0], [1.378e-7, 2.488e-6], [0.0, 0.0, 0.0], [0.1078, -0.0429]),
        ([0.0, 0.0, 0.0], [-0.2349, 0.0547], [16.454, 0.0, 0.0], [8.223e-6, 8.694e-6]),
    ];
    let leaning = |[x, y]: [f64; 2]| DVec3::new(x, y, (1.0 - x * x - y * y).sqrt());
    for (from, lean, to, then) in moves {
        let ends = [(from, lean), (to, then)]
            .map(|(tip, lean)| (ClPoint { tip: tip.into(), axis: leaning(lean) }, CUT));
        let path = path(ends);
        for (name, kinematics) in five_axis() {
            for degrees in [5.0f64, 0.7] {
                let how = Following { largest_turn: degrees.to_radians(), ..Following::new(Control::Axes) };
                let axes = drive(&kinematics, &path, &[], &how).unwrap_or_else(|e| panic!("{name}: {e}"));
                assert_follows(&kinematics, &path, &axes, &how);
            }
        }
    }
}

fn any_lean() -> impl Strategy<Value = ClPoint> {
    (prop::array::uniform3(-40.0..40.0f64), prop_oneof![0.0..25.0f64, 0.0..1e-3f64, Just(0.0)], 0.0..360.0f64)
        .prop_map(|(tip, lean, azimuth)| pose(tip.into(), lean, azimuth))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(25))]

    #[test]
    fn any_path_is_followed_or_refused(poses in prop::collection::vec(any_lean(), 2..8)) {
        let path = path(poses.into_iter().map(|pose| (pose, CUT)));
        for (name, kinematics) in five_axis() {
            for (control, largest_turn) in
                [(Control::Axes, 5.0f64), (Control::Axes, 0.7), (Control::Tip, 5.0), (Control::Tip, 0.7)]
            {
                let largest_turn = largest_turn.to_radians();
                let how = Following { largest_turn, ..Following::new(control) };
                let axes = match drive(&kinematics, &path, &[], &how) {
                    Ok(axes) => axes,
                    Err(e) => {
                        prop_assert!(matches!(e, MotionError::NoTurn { .. }), "{name}: {e}");
                        continue;
                    }
                };
                if control == Control::Axes {
                    assert_follows(&kinematics, &path, &axes, &how);
                }
                for pair in axes.moves.windows(2) {
                    for k in [0, 1] {
                        let jump = (pair[1].at.rotary[k] - pair[0].at.rotary[k]).abs();
                        prop_assert!(jump <= largest_turn + how.rotary_step, "{name}: a jump of {jump}");
                    }
                }
            }
        }
    }
}
