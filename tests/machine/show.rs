//! What the page draws and plays of a program.

use crate::examples::{TEXTS, example, post_program};
use glam::DVec3;
use stepover::cutter::Cutter;
use stepover::job::machines::{
    Dialect, Placement, PostOptions, Posted, Show, Timeline, band, report_json, told,
};
use stepover::machine::{Chain, Kinematics, Position};
use stepover::post::{Program, Unit, apt};
use stepover::toolpath::{ClPoint, Move, Rate, Role, Toolpath};

#[test]
fn the_bodies_of_every_machine_stand_as_its_kinematics_say() {
    for (name, _) in TEXTS {
        let machine = example(name);
        let kinematics = Kinematics::new(&machine, 120.0).unwrap();
        let chain = Chain::new(&machine, &kinematics);
        let tip = machine.gauge - 120.0 * machine.tool_axis;
        for k in 0..50 {
            let at = |scale: f64, shift: f64| scale * libm::sin(shift + 0.7 * f64::from(k));
            let turns = if kinematics.axes().len() > 3 { [at(1.5, 0.4), at(0.8, 2.0)] } else { [0.0; 2] };
            let position =
                Position { linear: DVec3::new(at(100.0, 0.0), at(80.0, 1.0), at(60.0, 3.0)), rotary: turns };
            let bodies = chain.bodies(&position);
            let tool = bodies[chain.tool()];
            let back = bodies[chain.workpiece()].inverse();
            let pose = kinematics.pose(&position);
            let seen = back.transform_point3(tool.transform_point3(tip)) - machine.workpiece_zero;
            assert!(seen.distance(pose.tip) < 1e-9, "{name}: {seen} is not {}", pose.tip);
            let axis = back.transform_vector3(tool.transform_vector3(machine.tool_axis));
            assert!(axis.distance(pose.axis) < 1e-12, "{name}");
        }
    }
}

fn program() -> Program {
    let step = |k: u32| {
        let t = f64::from(k) / 40.0;
        let axis = DVec3::new(0.3 * libm::sin(6.0 * t), 0.2, 1.0).normalize();
        let (rate, role) = if k == 0 { (Rate::Rapid, Role::Link) } else { (Rate::Feed(2000.0), Role::Cut) };
        Move { to: ClPoint { tip: DVec3::new(80.0 * t, 5.0, 3.0 * t), axis }, rate, role }
    };
    Program {
        part: "line".into(),
        unit: Unit::Mm,
        cutter: Cutter::bull_nose(8.0, 2.0, 30.0).unwrap(),
        tool: 1,
        spindle_rpm: Some(9000.0),
        toolpath: Toolpath { moves: (0..=40).map(step).collect() },
    }
}

fn posted(machine: &str, options: &PostOptions) -> Posted {
    post_program(&program(), &example(machine), options).unwrap()
}

#[test]
fn time_and_place_lead_to_one_another_and_the_plots_hold_what_moves() {
    for (machine, _) in TEXTS.iter().filter(|(name, _)| *name != "three_axis") {
        let posted = posted(machine, &PostOptions::new(Dialect::LinuxCnc));
        let timeline = Timeline::new(&posted);
        let whole = timeline.seconds();
        assert!((whole - (posted.times.total() - posted.times.settling)).abs() < 1e-9, "{machine}");
        for k in 0..=40 {
            let moment = timeline.at_seconds(whole * f64::from(k) / 40.0);
            let again = timeline.at_share(moment.share);
            assert!(
                (again.seconds - moment.seconds).abs() < 1e-6 * whole + 1e-9,
                "{machine}: {moment:?} {again:?}"
            );
            let pose = posted.kinematics.pose(&moment.position);
            let along = 80.0 * moment.share;
            assert!((pose.tip.x - along).abs() < 0.2, "{machine}: {} is not {along}", pose.tip.x);
        }
        for (place, axis) in posted.kinematics.axes().iter().enumerate() {
            let flat = band(&posted, &timeline, place, false, [0.0, whole], 100);
            let all = || flat.iter().filter(|x| !x.is_nan());
            let (low, high) =
                all().fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), x| (a.min(*x), b.max(*x)));
            let shown = |x: f64| if axis.is_rotary() { x.to_degrees() } else { x };
            let at = || posted.path.moves.iter().map(|step| shown(step.at.all()[place]));
            assert!((f64::from(low) - at().fold(f64::INFINITY, f64::min)).abs() < 1e-4);
            assert!((f64::from(high) - at().fold(f64::NEG_INFINITY, f64::max)).abs() < 1e-4);
            // No axis goes faster than it can.
            let speeds = band(&posted, &timeline, place, true, [0.0, whole], 100);
            let fastest = speeds.iter().filter(|x| !x.is_nan()).fold(0.0f32, |a, x| a.max(x.abs()));
            assert!(f64::from(fastest) <= shown(axis.speed) * (1.0 + 1e-6), "{machine} {}", axis.letter);
        }
        assert_eq!(told(&posted, &timeline, 0.5).len(), 6);
        let report = report_json(&posted, &timeline);
        assert!(report.contains("\"limits\"") && report.contains(&posted.machine.name), "{report}");
        let figure = Show::new(&posted).to_json();
        for letter in posted.kinematics.axes().iter().map(|axis| axis.letter) {
            assert!(figure.contains(&format!("\"letter\":\"{letter}\"")), "{machine} {letter}");
        }
    }
}

#[test]
fn a_part_is_clamped_as_asked_and_reads_back_in_its_own_frame() {
    let placement = Placement { turn_deg: [0.0, 0.0, 90.0], shift_mm: [30.0, -20.0, 10.0] };
    let options = PostOptions { placement, ..PostOptions::new(Dialect::FanucTip) };
    let (plain, moved) =
        (posted("table_table_ac", &PostOptions::new(Dialect::FanucTip)), posted("table_table_ac", &options));
    assert!(moved.text.contains("X25. Y-20.") || moved.text.contains("X25.0000 Y-20.0000"), "{}", moved.text);
    let worst = plain.read.toolpath.moves[0].to.tip.distance(moved.read.toolpath.moves[0].to.tip);
    assert!(worst < 1e-4, "{worst}");
    let again = apt::read(&moved.read_back()).unwrap();
    assert!(again.toolpath.moves[0].to.tip.distance(program().toolpath.moves[0].to.tip) < 1e-3);
    assert!(moved.deviation.tip_mm < 1e-3);
}
