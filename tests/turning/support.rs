//! The paper's lens, and how it is proven without a specification.

use std::sync::Arc;
use stepover::monitor::Stage;
use stepover::toolpath::{Interpolation, Nose, TurningPath};
use stepover::turning::sag::{Sag, Toric, ToricKind};
use stepover::turning::{
    Aperture, Asked, Curve, Limits, Order, Outline, Pace, Placed, Planned, Spacing, Speed, Step, Tool, Way,
    Ways, plan,
};
use stepover::verify::{Surface, TurnedOptions, TurnedPart, TurnedProof, verify_turned};

pub(crate) fn toric() -> Toric {
    Toric::new(ToricKind::Convex, 40.0, 150.0).unwrap()
}

pub(crate) fn held(sag: impl Sag + 'static) -> Placed {
    Placed::new(Arc::new(sag), [0.0; 2], 0.0)
}

pub(crate) const PLANE_INSERT: Tool =
    Tool::Insert { radius: 15.0, rake: 0.0, least_rake: -1.0, clearance: 0.6, sweep: 1.3 };

/// The paper's lens with turns `step` mm and points `degrees` apart, one radian of C a second.
pub(crate) fn order(step: f64, degrees: f64) -> Order {
    Order {
        part: held(toric()),
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

pub(crate) fn planned(order: &Order) -> Planned {
    plan(order, &Stage::silent()).unwrap()
}

/// What `path` leaves of the part of `order` under this nose.
pub(crate) fn proof(order: &Order, nose: Nose, path: &TurningPath, spacing: f64) -> TurnedProof {
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
    verify_turned(&part, nose, path, &options, &Stage::silent()).unwrap()
}

/// Least and largest residue in µm.
pub(crate) fn extremes(proof: &TurnedProof) -> [f64; 2] {
    [proof.form.lowest.unwrap(), proof.form.highest.unwrap()].map(|r| 1e3 * r.value)
}

#[track_caller]
pub(crate) fn near(found: f64, wanted: f64, tolerance: f64) {
    assert!((found - wanted).abs() <= tolerance, "{found} is not {wanted} ± {tolerance}");
}
