//! The lens of paper 004 in numbers.

use std::sync::Arc;
use stepover::monitor::Stage;
use stepover::toolpath::{Interpolation, Nose};
use stepover::turning::sag::{Sag, Toric, ToricKind};
use stepover::turning::*;
use stepover::verify::{Surface, TurnedOptions, TurnedPart, TurnedProof, verify_turned};

pub fn toric() -> Toric {
    Toric::new(ToricKind::Convex, 40.0, 150.0).unwrap()
}

pub fn order(step: f64, degrees: f64) -> Order {
    Order {
        part: Placed::new(Arc::new(toric()), [0.0; 2], 0.0),
        aperture: Aperture { outline: Outline::Round(30.0), center: [0.0; 2], angle: 0.0 },
        tool: Tool::Ball { radius: 15.0 },
        ways: Ways { curve: Curve::Spiral, way: Way::Inward, lead_in: 0.0, lead_out: 0.0 },
        step: Step::Given(step),
        spacing: Step::Given(Spacing::Angle(degrees.to_radians())),
        interpolation: Interpolation::Linear,
        asked: Asked { residue: 0.01, chord: 0.01 },
        speed: Speed::Given(Pace::Even(1.0)),
        limits: Limits { most: [[f64::INFINITY; 3]; 3] },
    }
}

pub fn proof(order: &Order, nose: Nose, planned: &Planned, spacing: f64) -> TurnedProof {
    let surface = |x: f64, y: f64| {
        order.aperture.contains(x, y).then(|| {
            let f = order.part.at(x, y);
            let w = f.stretch();
            Surface { z: f.z, normal: [-f.g[0] / w, -f.g[1] / w, 1.0 / w] }
        })
    };
    let part = TurnedPart {
        surface: &surface,
        farthest: order.aperture.farthest(),
        meridians: ([0.0; 2], vec![0.0, std::f64::consts::FRAC_PI_2]),
    };
    let options = TurnedOptions { spacing, search: 1.0, bands: vec![0.01, 0.02], chord: 40.0 };
    verify_turned(&part, nose, &planned.path, &options, &Stage::silent()).unwrap()
}

#[test]
fn numbers() {
    for (step, interpolation) in [
        (0.5, Interpolation::Linear),
        (0.5, Interpolation::Pvt),
        (2.0, Interpolation::Linear),
        (2.0, Interpolation::Pvt),
    ] {
        let order = Order { interpolation, ..order(step, 3.0) };
        let planned = plan(&order, &Stage::silent()).unwrap();
        let t = std::time::Instant::now();
        let proof = proof(&order, Nose::Ball(15.0), &planned, 0.1);
        eprintln!(
            "{step} {interpolation:?} {} points, outer {} chord {:?} cusp {:?}",
            planned.path.points.len(),
            planned.outermost,
            planned.chord,
            planned.cusp
        );
        eprintln!("{:?} {:?} {:?}", proof.form, proof.sagittas, t.elapsed());
    }
    for r in [15.0, 1.5, 0.5] {
        let ball =
            Order { interpolation: Interpolation::Pvt, tool: Tool::Ball { radius: r }, ..order(0.1, 3.0) };
        let planned = plan(&ball, &Stage::silent()).unwrap();
        let proof1 = proof(&ball, Nose::Insert(r), &planned, 0.1);
        eprintln!("ball under insert {r} {:?}", proof1.form);
        let ball = Order { tool: Tool::Insert { radius: r, rake: 0.0, clearance: 1.0, sweep: 1.4 }, ..ball };
        let planned = plan(&ball, &Stage::silent()).unwrap();
        let proof1 = proof(&ball, Nose::Insert(r), &planned, 0.1);
        eprintln!("insert {r} {:?} {:?}", proof1.form, planned.outermost);
    }
    let _ = toric().at(0.0, 0.0);
}
