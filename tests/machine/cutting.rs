//! Speeds, feeds at the contact, and what the bottom of the cutter does.

use crate::examples::example;
use glam::DVec3;
use stepover::cutter::Cutter;
use stepover::job::machines::{
    Choice, Contact, Dialect, MATERIALS, Matter, PostOptions, clearing_lead, contacts, least_diameter, notes,
    post_program,
};
use stepover::monitor::Stage;
use stepover::post::{Program, Unit, csv};
use stepover::toolpath::{ClPoint, Move, Posture, Rate, Role, Toolpath, Touch, Work};

/// A cutter that goes over the plane z = 0 with a lead, and where it touches.
fn plane(cutter: &Cutter, lead: f64) -> (Program, Vec<Option<Contact>>) {
    let lead = lead.to_radians();
    let (s, c) = libm::sincos(lead);
    // The contact is ahead of the axis by R1 cos λ, and the axis leans along the feed.
    let axis = DVec3::new(s, 0.0, c);
    let location = |x: f64| {
        let out = if s > 0.0 { DVec3::new(-c, 0.0, s) } else { DVec3::NEG_X };
        let ring = DVec3::new(x, 0.0, cutter.corner_radius) + out * cutter.center_radius;
        ClPoint { tip: ring - cutter.center_height * axis, axis }
    };
    let step = |k: u32| Move {
        to: location(f64::from(k)),
        rate: if k == 0 { Rate::Rapid } else { Rate::Feed(1000.0) },
        role: if k == 0 { Role::Link } else { Role::Cut },
    };
    let toolpath = Toolpath { moves: (0..20).map(step).collect() };
    let contact = |k: u32| Some(Contact { point: DVec3::new(f64::from(k), 0.0, 0.0), lead });
    let program = Program {
        part: "plane".into(),
        unit: Unit::Mm,
        cutter: *cutter,
        tool: 1,
        spindle_rpm: Some(8000.0),
        toolpath,
    };
    (program, (0..20).map(contact).collect())
}

#[test]
fn least_diameter_is_that_of_the_lowest_ring_of_the_cutter() {
    let cutter = Cutter::bull_nose(10.0, 2.0, 30.0).unwrap();
    // The same by looking: points of corner and bottom that are lower than the allowance, in the plane of the lean.
    for (lead, depth) in [(1.0f64, 0.02), (3.0, 0.05), (8.0, 0.1), (15.0, 0.3), (30.0, 0.2), (2.0, 0.5)] {
        let (s, c) = libm::sincos(lead.to_radians());
        let height =
            |radius: f64, up: f64| cutter.corner_radius - (s * (radius - 3.0) - c * (up - 2.0)) + 0.0 * c;
        let corner = (0..=200_000).map(|k| {
            let (sa, ca) = libm::sincos(f64::from(k) * 1e-5 * 0.5 * std::f64::consts::PI);
            (3.0 + 2.0 * sa, 2.0 - 2.0 * ca)
        });
        let bottom = (0..=100_000).map(|k| (3e-5 * f64::from(k), 0.0));
        let cut = corner.chain(bottom).filter(|(radius, up)| height(*radius, *up) <= depth);
        let least = 2.0 * cut.map(|(radius, _)| radius).fold(f64::INFINITY, f64::min);
        let found = least_diameter(&cutter, lead.to_radians(), depth);
        assert!((found - least).abs() < 1e-3, "{lead}°, {depth} mm: {found} is not {least}");
    }
    assert_eq!(least_diameter(&cutter, 0.0, 0.001), 0.0);
    let clearing = clearing_lead(&cutter, 0.1);
    assert!(
        least_diameter(&cutter, clearing + 1e-6, 0.1) > 0.0
            && least_diameter(&cutter, clearing - 1e-6, 0.1) == 0.0
    );
}

#[test]
fn a_lead_near_zero_cuts_at_zero_speed_and_says_so() {
    let machine = example("table_table_ac");
    let cutter = Cutter::bull_nose(10.0, 2.0, 30.0).unwrap();
    let options = PostOptions::new(Dialect::LinuxCnc);
    for (lead, stands) in [(0.5, true), (8.0, false)] {
        let (program, contacts) = plane(&cutter, lead);
        let posted = post_program(program, &contacts, &machine, &options, &Stage::silent()).unwrap();
        let cutting = posted.cutting.unwrap();
        assert_eq!(cutting.least == 0.0, stands, "{cutting:?}");
        let told = notes(&posted).iter().any(|note| matches!(note.matter, Matter::ZeroSpeed { .. }));
        assert_eq!(told, stands);
    }
    // A ball with a lead of 0: every contact stands still, and no spindle helps.
    let ball = Cutter::ball(10.0, 30.0).unwrap();
    let (program, contacts) = plane(&ball, 0.0);
    let speeds = Some(Choice { material: MATERIALS[4], teeth: 2.0, most_rpm: 20_000.0 });
    let why =
        post_program(program, &contacts, &machine, &PostOptions { speeds, ..options }, &Stage::silent());
    assert!(why.unwrap_err().to_string().contains("zero speed"));
}

#[test]
fn spindle_and_feed_follow_from_material_and_cutter() {
    let cutter = Cutter::ball(10.0, 30.0).unwrap();
    let (program, contacts) = plane(&cutter, 30.0);
    let steel = MATERIALS.into_iter().find(|material| material.name == "steel").unwrap();
    let machine = example("head_head_ac");
    let speeds = |most_rpm| PostOptions {
        speeds: Some(Choice { material: steel, teeth: 2.0, most_rpm }),
        ..PostOptions::new(Dialect::FanucTip)
    };
    let posted =
        post_program(program.clone(), &contacts, &machine, &speeds(50_000.0), &Stage::silent()).unwrap();
    // 220 m/min on 5 mm are 14005 a minute; 2 teeth of 0.07 mm.
    assert_eq!(posted.read.spindle_rpm, Some(14_000.0));
    assert!(posted.text.contains("S14000 M3") && posted.text.contains("F1960."), "{}", posted.text);
    let slow = post_program(program, &contacts, &machine, &speeds(6000.0), &Stage::silent()).unwrap();
    assert!(slow.text.contains("S6000 M3") && slow.text.contains("F840."));
}

#[test]
fn the_table_of_a_path_gives_its_contacts() {
    let cutter = Cutter::bull_nose(10.0, 2.0, 30.0).unwrap();
    let (program, contacts_before) = plane(&cutter, 8.0);
    let posture = Posture { lead: 8f64.to_radians(), yaw: 0.0 };
    let touches: Vec<Touch> = contacts_before
        .iter()
        .map(|c| Touch { point: c.unwrap().point, contact: Some((posture, Work::default())) })
        .collect();
    let table = csv::write(&program.toolpath, &touches);
    let found = contacts(&table, &program.toolpath).unwrap();
    for (a, b) in found.iter().zip(&contacts_before) {
        let (a, b) = (a.unwrap(), b.unwrap());
        assert!(a.point.distance(b.point) < 1e-5 && (a.lead - b.lead).abs() < 1e-5);
    }
    let wrong = |table: &str| contacts(table, &program.toolpath).unwrap_err().to_string();
    assert!(wrong(&table.replacen("lead_deg", "tilt", 1)).contains("line 1: the column lead_deg is missing"));
    let cut: String = table.lines().take(12).map(|line| format!("{line}\n")).collect();
    assert!(wrong(&cut).contains("line 12: the path has 20 moves, and the table ends after 11"));
    assert!(wrong(&table.replacen(",8.000,", ",eight,", 1)).contains("lead_deg: eight is no number"));
    let (other, _) = plane(&cutter, 20.0);
    assert!(contacts(&table, &other.toolpath).unwrap_err().to_string().contains("no move of this path"));
}
