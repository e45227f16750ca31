//! Axes to poses and back.

use crate::examples::{all, example, five_axis};
use glam::DVec3;
use proptest::prelude::*;
use stepover::machine::{Axis, Carries, Joint, Kinematics, Machine, Position};
use stepover::toolpath::ClPoint;

fn at(linear: [f64; 3], degrees: [f64; 2]) -> Position {
    Position { linear: linear.into(), rotary: degrees.map(f64::to_radians) }
}

fn assert_near(a: DVec3, b: DVec3) {
    assert!(a.distance(b) < 1e-9, "{a} is not {b}");
}

#[test]
fn with_rotary_axes_at_zero_words_are_workpiece_coordinates() {
    for (name, kinematics) in all() {
        let words = DVec3::new(3.0, -4.0, 5.0);
        let pose = kinematics.pose(&Position { linear: kinematics.program_zero() + words, rotary: [0.0; 2] });
        assert!(pose.tip.distance(words) < 1e-9 && pose.axis == DVec3::Z, "{name}: {pose:?}");
    }
}

#[test]
fn a_trunnion_table_turns_the_part_under_an_upright_tool() {
    let kinematics = Kinematics::new(&example("table_table_ac"), 120.0).unwrap();
    // A = 30° counts the tool's turn about +x over the part, so the tool leans to −y there.
    let leaning = kinematics.pose(&at([0.0; 3], [0.0, 30.0]));
    assert_near(leaning.axis, DVec3::new(0.0, -0.5, 0.75f64.sqrt()));
    // C = 90° more carries that lean round to +x.
    assert_near(kinematics.pose(&at([0.0; 3], [90.0, 30.0])).axis, DVec3::new(0.5, 0.0, 0.75f64.sqrt()));
    // The tip at the crossing of both axes stays there: 420 − 400 mm above the part's origin.
    for degrees in [[0.0, 0.0], [0.0, -70.0], [0.0, 25.0]] {
        let pose = kinematics.pose(&at([0.0, 0.0, -280.0], degrees));
        assert_near(pose.tip, DVec3::new(0.0, 0.0, 20.0));
    }
}

#[test]
fn a_swivel_head_swings_the_tip_about_its_pivot() {
    let kinematics = Kinematics::new(&example("head_table_bc"), 120.0).unwrap();
    // The pivot is 180 mm above the spindle's nose and so 300 mm above the tip; 600 mm from the nose to the part's origin.
    let pose = kinematics.pose(&at([0.0; 3], [0.0, 90.0]));
    assert_near(pose.axis, DVec3::X);
    assert_near(pose.tip, DVec3::new(-300.0, 0.0, 600.0 + 180.0));
    // With C = 90° the tool is seen turned about the table's axis.
    let turned = kinematics.pose(&at([0.0; 3], [90.0, 90.0]));
    assert_near(turned.axis, DVec3::Y);
    assert_near(turned.tip, DVec3::new(0.0, -300.0, 780.0));
}

/// A unit vector.
fn direction() -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-1.0..1.0f64)
        .prop_map(DVec3::from)
        .prop_filter("no direction", |v| v.length() > 0.2)
        .prop_map(DVec3::normalize)
}

fn point() -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-500.0..500.0f64).prop_map(DVec3::from)
}

/// Any machine: axes in any directions, order and arrangement, not near to parallel.
fn any_machine() -> impl Strategy<Value = Machine> {
    let directions = prop::array::uniform5(direction()).prop_filter("too near to parallel", |d| {
        d[0].cross(d[1]).dot(d[2]).abs() > 0.2 && d[3].cross(d[4]).length() > 0.2
    });
    let order = Just([0, 1, 2, 3, 4]).prop_shuffle();
    (directions, prop::array::uniform5(point()), order, 0..6usize, direction(), point()).prop_filter_map(
        "the tool lies along the second rotary axis",
        |(directions, points, order, tables, tool_axis, gauge)| {
            let axis = |(place, k): (usize, usize)| Axis {
                letter: ['X', 'Y', 'Z', 'A', 'C'][k],
                joint: match k {
                    0..3 => Joint::Linear { direction: directions[k] },
                    _ => Joint::Rotary { direction: directions[k], point: points[k] },
                },
                carries: if place < tables { Carries::Workpiece } else { Carries::Tool },
                limits: Some([-10.0, 10.0]),
                speed: 1.0,
                acceleration: 1.0,
                jerk: 1.0,
            };
            let second = *order.iter().rfind(|k| **k > 2)?;
            let axes = order.into_iter().enumerate().map(axis).collect();
            let machine = Machine {
                name: "any".into(),
                axes,
                tool_axis,
                gauge,
                longest_tool: 300.0,
                workpiece_zero: points[0],
            };
            (directions[second].cross(tool_axis).length() > 0.2).then_some(machine)
        },
    )
}

fn any_position() -> impl Strategy<Value = Position> {
    (prop::array::uniform3(-500.0..500.0f64), prop::array::uniform2(-180.0..180.0f64))
        .prop_map(|(linear, rotary)| at(linear, rotary))
}

/// Both inverse solutions lead back to the pose, and one of them is the position that it came from.
fn assert_inverse(kinematics: &Kinematics, position: &Position) {
    let pose = kinematics.pose(position);
    let both = kinematics.inverse(&pose).expect("a pose of the machine can be reached");
    for solution in both {
        let again = kinematics.pose(&solution);
        let (tip, axis) = (again.tip.distance(pose.tip), again.axis.distance(pose.axis));
        // Where linear axes stand on both sides of rotary ones, the other solution may be miles away.
        let grain = 1e-9 * (solution.linear.length() / 1e4).max(1.0);
        assert!(tip < grain && axis < 1e-9, "{position:?}: {solution:?} is off by {tip} mm and {axis}");
    }
    let off = |solution: &Position| {
        let turns = |k: usize| {
            let turns = (solution.rotary[k] - position.rotary[k]) / std::f64::consts::TAU;
            (turns - turns.round()).abs()
        };
        turns(0).max(turns(1))
    };
    // Near the pole the angles are lost, though the pose is not.
    let lost = both[0].rotary[1] - both[1].rotary[1];
    assert!(lost.abs() < 1e-4 || off(&both[0]).min(off(&both[1])) < 1e-9, "{position:?}: {both:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn inverse_leads_back_on_any_machine(machine in any_machine(), position in any_position()) {
        assert_inverse(&Kinematics::new(&machine, 120.0).unwrap(), &position);
    }

    #[test]
    fn inverse_leads_back_on_every_shipped_machine(position in any_position()) {
        for (_, kinematics) in five_axis() {
            assert_inverse(&kinematics, &position);
        }
    }

    #[test]
    fn nothing_is_lost_near_the_pole(exponent in -14.0..-1.0f64, azimuth in -180.0..180.0f64, first in -180.0..180.0f64) {
        let lean = libm::pow(10.0, exponent).to_degrees();
        for (_, kinematics) in five_axis() {
            let position = at([10.0, 20.0, -30.0], [first, lean]);
            assert_inverse(&kinematics, &position);
            let (sine, cosine) = libm::sincos(azimuth.to_radians());
            let axis = DVec3::new(cosine * lean.to_radians(), sine * lean.to_radians(), 1.0).normalize();
            let pose = ClPoint { tip: DVec3::new(1.0, 2.0, 3.0), axis };
            for solution in kinematics.inverse(&pose).unwrap() {
                prop_assert!(kinematics.pose(&solution).axis.distance(axis) < 1e-12);
                prop_assert!(kinematics.pose(&solution).tip.distance(pose.tip) < 1e-9);
            }
        }
    }
}

#[test]
fn a_nutating_head_reaches_only_half_of_all_directions() {
    let mut machine = example("head_table_bc");
    // A head whose axis leans by 45°, as on many machines: it reaches from upright to level, and no farther.
    machine.axes[4].joint =
        Joint::Rotary { direction: DVec3::new(0.0, 0.5f64.sqrt(), 0.5f64.sqrt()), point: DVec3::ZERO };
    let kinematics = Kinematics::new(&machine, 120.0).unwrap();
    let leaning = |degrees: f64| ClPoint {
        tip: DVec3::ZERO,
        axis: DVec3::new(libm::sin(degrees.to_radians()), 0.0, libm::cos(degrees.to_radians())),
    };
    assert!(kinematics.inverse(&leaning(91.0)).is_none());
    for degrees in [0.0, 1e-7, 30.0, 89.999, 90.0] {
        for solution in kinematics.inverse(&leaning(degrees)).unwrap() {
            assert!(kinematics.pose(&solution).axis.distance(leaning(degrees).axis) < 1e-9, "{degrees}");
        }
    }
}

#[test]
fn a_three_axis_machine_keeps_its_tool_upright() {
    let kinematics = Kinematics::new(&example("three_axis"), 60.0).unwrap();
    let pose = |x: f64| ClPoint { tip: DVec3::new(1.0, 2.0, 3.0), axis: DVec3::new(x, 0.0, 1.0).normalize() };
    assert!(kinematics.inverse(&pose(1e-3)).is_none());
    let [position, _] = kinematics.inverse(&pose(0.0)).unwrap();
    assert_near(position.linear - kinematics.program_zero(), DVec3::new(1.0, 2.0, 3.0));
}
