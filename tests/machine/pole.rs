//! What happens at a machine's pole, in each of the three ways.

use crate::examples::{example, five_axis};
use glam::DVec3;
use stepover::cutter::Cutter;
use stepover::job::machines::{Contact, Dialect, Matter, Pole, PostOptions, Posted, notes, post_program};
use stepover::math::angle::angle_between;
use stepover::monitor::Stage;
use stepover::post::{Program, Unit};
use stepover::toolpath::{ClPoint, Move, Rate, Role, Toolpath};

fn cutter() -> Cutter {
    Cutter::bull_nose(10.0, 2.0, 40.0).unwrap()
}

/// A pass over a cylinder along x with a lead of 8°, which passes the pole at `miss` degrees on its way; and its contacts.
fn pass(miss: f64) -> (Program, Vec<Option<Contact>>) {
    let cutter = cutter();
    let lead = 8f64.to_radians();
    let (mut moves, mut contacts) = (Vec::new(), Vec::new());
    for k in -60..=60 {
        // The normal swings so that normal and lead cancel in the middle.
        let angle = 0.004 * f64::from(k) - lead;
        let tilted = |angle: f64| {
            let (s, c) = libm::sincos(angle);
            DVec3::new(s, miss.to_radians(), c).normalize()
        };
        let normal = tilted(angle);
        let point = 60.0 * (normal - DVec3::Z) + DVec3::new(0.0, 10.0, 5.0);
        let axis = tilted(angle + lead);
        let out = (axis * axis.dot(normal) - normal).normalize();
        let ring = point + cutter.corner_radius * normal - cutter.center_radius * out;
        let to = ClPoint { tip: ring - cutter.center_height * axis, axis };
        moves.push(Move { to, rate: Rate::Feed(3000.0), role: Role::Cut });
        contacts.push(Some(Contact { point, lead: angle_between(axis, normal) }));
    }
    let program = Program {
        part: "pole".into(),
        unit: Unit::Mm,
        cutter,
        tool: 1,
        spindle_rpm: Some(9000.0),
        toolpath: Toolpath { moves },
    };
    (program, contacts)
}

fn posted(machine: &str, miss: f64, pole: Pole) -> Posted {
    let (program, contacts) = pass(miss);
    let mut machine = example(machine);
    // As on a machine whose tilt does not change sign: the first axis must swing.
    if let Some(limits) = &mut machine.axes[1].limits {
        limits[1] = limits[1].min(0.0);
    }
    let options = PostOptions { pole, ..PostOptions::new(Dialect::LinuxCnc) };
    post_program(program, &contacts, &machine, &options, &Stage::silent()).unwrap()
}

/// The greatest turn of the first rotary axis in a millimetre of the tip, degrees.
fn steepest(posted: &Posted) -> f64 {
    let steep = |pair: &[stepover::machine::AxisMove]| {
        let turn = (pair[1].at.rotary[0] - pair[0].at.rotary[0]).abs().to_degrees();
        turn / pair[0].to.tip.distance(pair[1].to.tip).max(1e-3)
    };
    posted.path.moves.windows(2).map(steep).fold(0.0, f64::max)
}

#[test]
fn each_way_through_the_pole_does_as_it_says() {
    let miss = 0.15;
    let insert = posted("table_table_ac", miss, Pole::Insert);
    let swing = notes(&insert).into_iter().find_map(|note| match note.matter {
        Matter::Pole { letter, degrees } => Some((letter, degrees)),
        _ => None,
    });
    assert!(swing.is_some_and(|(letter, degrees)| letter == 'C' && degrees > 90.0), "{swing:?}");
    // Tilted aside it turns as much, but steadily.
    let aside = posted("table_table_ac", miss, Pole::Aside { degrees: 2.0 });
    assert!(steepest(&aside) < 0.5 * steepest(&insert), "{} against {}", steepest(&aside), steepest(&insert));
    assert!(aside.aside.len() > 5);
    // Where it must swing all the same, deviating gives it a longer way to do it on.
    let deviate = posted("table_table_ac", miss, Pole::Deviate { degrees: 0.5 });
    assert!(steepest(&deviate) < steepest(&insert), "{} against {}", steepest(&deviate), steepest(&insert));
}

#[test]
fn where_the_tilt_may_change_sign_deviating_needs_no_swing() {
    let (program, contacts) = pass(0.15);
    for (name, _) in five_axis().into_iter().filter(|(name, _)| *name == "head_table_bc") {
        let swing = |pole| {
            let options = PostOptions { pole, ..PostOptions::new(Dialect::LinuxCnc) };
            let posted =
                post_program(program.clone(), &contacts, &example(name), &options, &Stage::silent()).unwrap();
            let c = posted.path.moves.iter().map(|step| step.at.rotary[0]);
            let (low, high) = c.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
            (high - low).to_degrees()
        };
        assert!(swing(Pole::Insert) > 60.0, "{}", swing(Pole::Insert));
        assert!(swing(Pole::Deviate { degrees: 1.0 }) <= swing(Pole::Insert) + 1e-6);
    }
}

#[test]
fn tilting_aside_keeps_every_contact_and_its_normal() {
    let angle = 2.0f64;
    let (program, contacts) = pass(0.05);
    let posted = posted("table_table_ac", 0.05, Pole::Aside { degrees: angle });
    let cutter = cutter();
    let mut tilted = 0;
    for ((step, before), contact) in posted.toolpath.moves.iter().zip(&program.toolpath.moves).zip(&contacts)
    {
        let touched = |cl: &ClPoint| {
            let ring = cl.tip + cutter.center_height * cl.axis;
            let out = contact.unwrap().point - ring;
            let out = (out - cl.axis * out.dot(cl.axis)).normalize();
            let corner = ring + cutter.center_radius * out;
            (corner.distance(contact.unwrap().point), (corner - contact.unwrap().point).normalize())
        };
        let ((d, n), (_, was)) = (touched(&step.to), touched(&before.to));
        assert!((d - cutter.corner_radius).abs() < 1e-9 && n.distance(was) < 1e-9);
        if step.to != before.to {
            tilted += 1;
            assert!((step.to.axis.z - libm::cos(angle.to_radians())).abs() < 1e-9);
            assert!(angle_between(step.to.axis, before.to.axis).to_degrees() < 2.0 * angle + 1e-6);
        }
    }
    assert_eq!(tilted, posted.aside.len());
    assert!(notes(&posted).iter().any(|note| note.matter == Matter::Aside));
}
