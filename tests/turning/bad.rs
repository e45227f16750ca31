//! What cannot be done is refused with the place and a value that would do; and that value does.

use crate::support::{PLANE_INSERT, held, order};
use std::f64::consts::TAU;
use stepover::monitor::{Cancelled, Monitor, Stage};
use stepover::turning::sag::Conic;
use stepover::turning::{
    Aperture, Limits, Order, Outline, Pace, Spacing, Speed, Step, Tool, TurningError, plan,
};

fn refused(order: &Order) -> TurningError {
    plan(order, &Stage::silent()).map(|found| found.path.points.len()).unwrap_err()
}

fn works(order: &Order) -> bool {
    plan(order, &Stage::silent()).is_ok()
}

#[test]
fn apertures_beyond_the_surface() {
    let wide = |radius| Order {
        aperture: Aperture { outline: Outline::Round(radius), center: [0.0; 2], angle: 0.0 },
        ..order(2.0, 1.0)
    };
    let TurningError::Reach { at, reach, percent } = refused(&wide(45.0)) else { panic!() };
    assert!(at.y.abs() > 39.0 && reach.contains("|y| = 39.395"), "{at} {reach}");
    let most = 45.0 * percent / 100.0;
    assert!(most > 39.3 && works(&Order { spacing: Step::Given(Spacing::Angle(0.004)), ..wide(most) }));
}

#[test]
fn noses_larger_than_a_hollow() {
    let bowl =
        |tool| Order { part: held(Conic::new(1.0 / 50.0, -0.5, vec![], 30.0)), tool, ..order(2.0, 3.0) };
    for insert in [false, true] {
        let tool = |radius| {
            if insert {
                Tool::Insert { radius, rake: 0.0, least_rake: -1.0, clearance: 0.6, sweep: 1.3 }
            } else {
                Tool::Ball { radius }
            }
        };
        let TurningError::Hollow { radius, hollow, most, at } = refused(&bowl(tool(60.0))) else { panic!() };
        assert!(radius == 60.0 && (hollow - 50.0).abs() < 1e-6 && at.x.abs() < 1e-9, "{hollow} {at}");
        assert!(most > 45.0 && works(&bowl(tool(most))), "{most}");
    }
}

#[test]
fn points_too_far_apart() {
    let at = |degrees: f64| Order {
        spacing: Step::Given(Spacing::Angle(degrees.to_radians())),
        ..order(1.0, 3.0)
    };
    let error = refused(&at(6.0));
    let TurningError::Chord { x, least, .. } = &error else { panic!("{error}") };
    assert!(*x > 30.0 && error.to_string().contains("C "), "{error}");
    let value: f64 = least.split(' ').nth(3).unwrap().trim_end_matches('°').parse().unwrap();
    assert!(value > 3.0 && works(&at(value)), "{least}");
}

#[test]
fn edges_that_reach_or_clear_too_little() {
    let with = |clearance: f64, sweep: f64| Order {
        tool: Tool::Insert {
            radius: 2.0,
            rake: 0.0,
            least_rake: -1.0,
            clearance: clearance.to_radians(),
            sweep: sweep.to_radians(),
        },
        ..order(2.0, 3.0)
    };
    let TurningError::Sweep { least, at, .. } = refused(&with(30.0, 40.0)) else { panic!() };
    assert!(at.y.abs() > 29.9 && works(&with(30.0, least)), "{at} {least}");
    let TurningError::Clearance { least, slope, at, .. } = refused(&with(7.0, 60.0)) else { panic!() };
    assert!(slope > 15.0 && slope < 25.0 && at.x * at.y != 0.0 && works(&with(least, 60.0)), "{slope} {at}");
}

#[test]
fn faces_that_lean_too_far_back() {
    let with = |rake: f64| Order {
        tool: Tool::Insert {
            radius: 2.0,
            rake: rake.to_radians(),
            least_rake: -0.3,
            clearance: 0.6,
            sweep: 1.3,
        },
        ..order(2.0, 3.0)
    };
    let TurningError::Rake { slope, rake, least, .. } = refused(&with(0.0)) else { panic!() };
    assert!(slope > 18.0 && (rake + slope).abs() < 1e-9 && works(&with(least)), "{slope} {rake} {least}");
}

/// Beyond the aperture, where the ball must go, a ring bends up more than the ball.
#[test]
fn noses_that_touch_nowhere_beyond_the_aperture() {
    let wall = Conic::new(0.0, 0.0, vec![0.0, 0.0, 0.0, 7.7e-13], 40.0);
    let with = |radius| Order {
        part: held(wall.clone()),
        aperture: Aperture { outline: Outline::Round(12.0), center: [0.0; 2], angle: 0.0 },
        tool: Tool::Ball { radius },
        asked: stepover::turning::Asked { residue: 1.0, chord: 1.0 },
        ways: stepover::turning::Ways { lead_in: 6.0, ..order(1.0, 3.0).ways },
        ..order(1.0, 3.0)
    };
    let TurningError::NoTouch { most, x, .. } = refused(&with(15.0)) else { panic!() };
    assert!(most > 0.0 && most < 15.0 && x > 12.0 && works(&with(0.5 * most)), "{most} {x}");
}

fn limited(kind: usize, most: f64, speed: Speed) -> Order {
    let mut limits = Limits { most: [[f64::INFINITY; 3]; 3] };
    limits.most[1][kind] = most;
    Order { limits, speed, ..order(1.0, 3.0) }
}

#[test]
fn speeds_that_an_axis_cannot_follow() {
    for (kind, most, what) in [(0, 50.0, "velocity"), (1, 500.0, "acceleration"), (2, 3000.0, "jerk")] {
        let at = |rpm: f64| limited(kind, most, Speed::Given(Pace::Even(rpm * TAU / 60.0)));
        let error = refused(&at(200.0));
        let TurningError::Limit { what: found, axis, rpm, x, .. } = error else { panic!("{error}") };
        assert!(found == what && axis == "Z" && x > 40.0, "{error}");
        assert!(works(&at(rpm)) && !works(&at(1.01 * rpm)), "{rpm}");
    }
}

#[test]
fn limits_that_no_speed_meets() {
    let omega = |rpm: f64| rpm * TAU / 60.0;
    let highest = Speed::Highest { pace: Pace::Even(1.0), least: omega(30.0), most: omega(300.0) };
    let error = refused(&limited(1, 100.0, highest));
    let TurningError::TooSlow { rpm, needed, axis, .. } = error else { panic!("{error}") };
    assert!(rpm < 30.0 && axis == "Z" && error.to_string().contains("mm/s²"), "{error}");
    assert!(works(&limited(1, needed * 1.000_001, highest)));
}

#[test]
fn too_many_points() {
    let error = refused(&order(1e-6, 3.0));
    assert!(matches!(error, TurningError::TooMany { .. }), "{error}");
}

struct Now;
impl Monitor for Now {
    fn progress(&self, _: &str, _: f64) {}
    fn is_cancelled(&self) -> bool {
        true
    }
}

#[test]
fn told_to_stop_it_stops() {
    let stage = Stage::whole(&Now, std::num::NonZeroUsize::MIN);
    let order = Order { tool: PLANE_INSERT, ..order(1.0, 3.0) };
    assert_eq!(plan(&order, &stage).unwrap_err(), TurningError::Cancelled(Cancelled));
}
