//! The claims: a million points planned, checked for dynamics and written in at most three seconds of one core; verified
//! over a million samples in at most ten.

use divan::Bencher;
use std::sync::Arc;
use stepover::monitor::Stage;
use stepover::post::xzc::{self, CWord, Reference, Rounding, XWord, XzcProgram};
use stepover::toolpath::{Interpolation, Nose};
use stepover::turning::sag::{Toric, ToricKind};
use stepover::turning::{
    Aperture, Asked, Curve, Limits, Order, Outline, Pace, Placed, Planned, Spacing, Speed, Step, Tool, Way,
    Ways, plan,
};
use stepover::verify::{Surface, TurnedOptions, TurnedPart, verify_turned};

fn main() {
    divan::main();
}

/// The paper's lens with a step and an angle that make a million points.
fn order(tool: Tool) -> Order {
    let toric = Toric::new(ToricKind::Convex, 40.0, 150.0).expect("a toric");
    Order {
        part: Placed::new(Arc::new(toric), [0.0; 2], 0.0),
        aperture: Aperture { outline: Outline::Round(30.0), center: [0.0; 2], angle: 0.0 },
        tool,
        ways: Ways { curve: Curve::Spiral, way: Way::Inward, lead_in: 1.0, lead_out: 1.0 },
        step: Step::Given(0.06),
        spacing: Step::Given(Spacing::Angle(0.248_f64.to_radians())),
        interpolation: Interpolation::Linear,
        asked: Asked { residue: 0.001, chord: 0.0001 },
        speed: Speed::Highest { pace: Pace::Even(1.0), least: 0.0, most: 20.0 },
        limits: Limits { most: [[100.0, 1000.0, 1e5]; 3] },
    }
}

const BALL: Tool = Tool::Ball { radius: 15.0 };
const INSERT: Tool = Tool::Insert { radius: 1.5, rake: 0.0, least_rake: -1.0, clearance: 0.5, sweep: 1.2 };

fn planned(tool: Tool) -> Planned {
    plan(&order(tool), &Stage::silent()).expect("a plan")
}

fn written(tool: Tool, planned: Planned) -> String {
    let program = XzcProgram {
        part: "lens".into(),
        nose: tool.nose(),
        reference: Reference::Tip,
        x_word: XWord::Radius,
        c_word: CWord::Tool,
        tool: 1,
        spindle_rpm: None,
        clearance: 5.0,
        approach: 100.0,
        blend: 1e-5,
        path: planned.path,
    };
    xzc::write_gcode(&program, xzc::Dialect::LinuxCnc, xzc::Feed::InverseTime, &Rounding::default())
        .expect("a program")
}

#[divan::bench(sample_count = 3, sample_size = 1)]
fn a_million_points_planned_and_written(bencher: Bencher<'_, '_>) {
    bencher.bench(|| {
        let planned = planned(BALL);
        assert!(planned.path.points.len() > 1_000_000);
        written(BALL, planned).len()
    });
}

#[divan::bench(sample_count = 3, sample_size = 1)]
fn a_million_insert_points_planned_and_written(bencher: Bencher<'_, '_>) {
    bencher.bench(|| written(INSERT, planned(INSERT)).len());
}

#[divan::bench(sample_count = 1, sample_size = 1)]
fn a_million_points_read_and_verified_over_a_million_samples(bencher: Bencher<'_, '_>) {
    verify(bencher, BALL);
}

#[divan::bench(sample_count = 1, sample_size = 1)]
fn a_million_insert_points_read_and_verified_over_a_million_samples(bencher: Bencher<'_, '_>) {
    verify(bencher, INSERT);
}

fn verify(bencher: Bencher<'_, '_>, tool: Tool) {
    let order = order(tool);
    let text = written(tool, planned(tool));
    let surface = |x: f64, y: f64| {
        order.aperture.contains(x, y).then(|| {
            let f = order.part.at(x, y);
            let w = f.stretch();
            Surface { z: f.z, normal: [-f.g[0] / w, -f.g[1] / w, 1.0 / w] }
        })
    };
    let part = TurnedPart { surface: &surface, farthest: 30.0, meridians: ([0.0; 2], vec![0.0]) };
    let options = TurnedOptions { spacing: 0.075, search: 0.5, bands: vec![0.01], chord: 40.0 };
    bencher.bench(|| {
        let (nose, path): (Nose, _) = xzc::read_gcode(&text, xzc::Dialect::LinuxCnc).expect("a path");
        let proof = verify_turned(&part, nose, &path, &options, &Stage::silent()).expect("a proof");
        assert!(proof.form.samples > 1_000_000);
        proof.form.peak_to_valley
    });
}
