//! The whole plan: from part, tool and what is asked to the motion of the axes.

use super::aperture::Aperture;
use super::choose::{Asked, chosen_angle, chosen_step, whole_turn};
use super::chord::{Chord, chord_error};
use super::cusp::{Cusp, highest_cusp};
use super::dynamics::{Dynamics, Moment, dynamics};
use super::error::TurningError;
use super::fit::{Fit, fit};
use super::guide::{Guide, Ways};
use super::limits::{Limits, Strictest, strictest};
use super::locate::locate;
use super::outer::{innermost, outermost};
use super::pace::Pace;
use super::placed::Placed;
use super::ramp::Ramp;
use super::round::round_down;
use super::spacing::{MOST_POINTS, Spacing, angles};
use super::tool::Tool;
use crate::monitor::Stage;
use crate::toolpath::{AxisPoint, Interpolation, TurningPath};
use std::f64::consts::TAU;

/// Whether something is given or chosen from what is asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Step<T> {
    /// As it stands.
    Given(T),
    /// Of this kind, as large as [`Asked`] allows; what it holds says the kind and not the size.
    Chosen(T),
}

/// How fast the path goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Speed {
    /// At this pace; that the limits are kept is checked.
    Given(Pace),
    /// As many times this pace as the limits allow, its spindle speed not exceeding `most` and not below `least`, both rad/s.
    Highest {
        /// What is scaled.
        pace: Pace,
        /// Lowest speed at which the spindle runs evenly, rad/s; 0 for none.
        least: f64,
        /// Highest speed of the spindle, rad/s.
        most: f64,
    },
}

/// Everything that a plan is made from.
#[derive(Clone)]
pub struct Order {
    /// The part.
    pub part: Placed,
    /// How much of it is wanted.
    pub aperture: Aperture,
    /// What cuts.
    pub tool: Tool,
    /// Which way the nose goes.
    pub ways: Ways,
    /// Distance between turns, mm.
    pub step: Step<f64>,
    /// How points lie along them.
    pub spacing: Step<Spacing>,
    /// What the control makes of them.
    pub interpolation: Interpolation,
    /// What must be kept.
    pub asked: Asked,
    /// How fast.
    pub speed: Speed,
    /// What the axes can do.
    pub limits: Limits,
}

/// A planned path.
#[derive(Debug, Clone, PartialEq)]
pub struct Planned {
    /// The motion.
    pub path: TurningPath,
    /// Its accelerations of X, Z and C, point by point.
    pub accelerations: Vec<[f64; 3]>,
    /// Where the nose touches, point by point, mm.
    pub touches: Vec<[f64; 2]>,
    /// The guide curve.
    pub guide: Guide,
    /// How points lie along it.
    pub spacing: Spacing,
    /// The distances of the nearest and the farthest nose centre that touches the aperture, mm; the nearest is 0 if the aperture holds
    /// the axis.
    pub reach: [f64; 2],
    /// How tool and surface go together.
    pub fit: Fit,
    /// The highest cusp to be expected.
    pub cusp: Cusp,
    /// What interpolation leaves and digs in at most.
    pub chord: [Chord; 2],
    /// What is asked of the axes.
    pub dynamics: Dynamics,
    /// The limit that would be reached first.
    pub strictest: Option<Strictest>,
    /// The speeds.
    pub pace: Pace,
}

/// Plans the path that `order` asks for.
pub fn plan(order: &Order, stage: &Stage) -> Result<Planned, TurningError> {
    stage.at(0.0)?;
    let Order { part, aperture, tool, .. } = order;
    let nose = tool.nose();
    let fit = fit(part, aperture, tool)?;
    let reach = [innermost(part, aperture, nose), outermost(part, aperture, nose)];
    let span = reach[1] - reach[0];
    let step = match order.step {
        Step::Given(step) => step,
        Step::Chosen(_) => chosen_step(part, aperture, nose, &order.asked).min(span),
    };
    let turns = span / step;
    if turns.is_nan() || turns >= MOST_POINTS as f64 / 8.0 {
        let hint = "a larger step between turns would do";
        return Err(TurningError::TooMany { count: 8.0 * turns, limit: MOST_POINTS, hint });
    }
    let guide = Guide::new(&order.ways, reach, step);
    let mut spacing = match order.spacing {
        Step::Given(spacing) => spacing,
        Step::Chosen(kind) => {
            chosen_angle(part, aperture, nose, order.interpolation, &guide, &kind, &order.asked)?
        }
    };
    let reference = match order.speed {
        Speed::Given(pace) | Speed::Highest { pace, .. } => pace,
    };
    stage.at(0.1)?;
    let mut tries = if matches!(order.spacing, Step::Chosen(_)) { RETRIES } else { 0 };
    let mut laying = stage.part("Laying the path", 0.1, 0.6);
    let (laid, mut points, chord) = loop {
        let laid = lay(order, &guide, &spacing, &reference, &laying)?;
        let points: Vec<AxisPoint> = laid.moments.iter().map(|m| m.point).collect();
        let chord = chord_error(part, aperture, nose, order.interpolation, &points)?;
        let Err(error) = check_chord(&chord, order, &spacing) else { break (laid, points, chord) };
        if tries == 0 {
            return Err(error);
        }
        tries -= 1;
        // Progress never falls: what is done again is not told of.
        laying = laying.quiet();
        spacing = whole_turn(fitting(order, &spacing, largest(&chord).error));
        stage.at(0.6)?;
    };
    stage.at(0.9)?;
    let found = dynamics(&laid.moments);
    let first = strictest(&found, &order.limits);
    let share = speed_up(order, &reference, first)?;
    for p in &mut points {
        p.time /= share;
        p.rates = p.rates.map(|v| v * share);
    }
    stage.at(1.0)?;
    Ok(Planned {
        path: TurningPath { points, interpolation: order.interpolation },
        accelerations: laid.moments.iter().map(|m| m.acceleration.map(|a| a * share * share)).collect(),
        touches: laid.touches,
        cusp: highest_cusp(part, aperture, nose, guide.step()),
        guide,
        spacing,
        reach,
        fit,
        chord,
        dynamics: found.scaled(share),
        strictest: first.map(|f| Strictest { share: f.share / share, ..f }),
        pace: reference.scaled(share),
    })
}

/// How often a chosen spacing is tried again: the quick look that it comes from misses little, and the path itself says by how much.
const RETRIES: usize = 5;

struct Laid {
    moments: Vec<Moment>,
    touches: Vec<[f64; 2]>,
}

/// Points between two looks at whether to stop.
const STRIDE: usize = 1 << 14;

fn lay(
    order: &Order,
    guide: &Guide,
    spacing: &Spacing,
    pace: &Pace,
    stage: &Stage,
) -> Result<Laid, TurningError> {
    let nose = order.tool.nose();
    let all = angles(guide, spacing)?;
    let room = all.len();
    let mut laid = Laid { moments: Vec::with_capacity(room), touches: Vec::with_capacity(room) };
    let mut guess = [0.0; 2];
    let ramp = Ramp::new(guide.length());
    let (mut time, mut before): (f64, Option<(f64, f64)>) = (0.0, None);
    for (i, &c) in all.iter().enumerate() {
        if i % STRIDE == 0 {
            stage.at(i as f64 / room as f64)?;
        }
        let [x, x1, x2] = guide.at(c);
        let (sin, cos) = libm::sincos(c);
        let at = locate(&order.part, nose, x, (cos, sin), guess)?;
        guess = at.offset;
        let f = at.center;
        let z1 = f.r * x1 + f.t;
        let z2 = f.rr * x1 * x1 + 2.0 * f.rt * x1 + f.tt + f.r * x2;
        let [full, change] = pace.at(x);
        let ramped = ramp.at(c);
        let omega = full * ramped.share;
        let faster = change * x1 * omega * ramped.share + full * full * ramped.change;
        if let Some((s0, slow0)) = before {
            // Simpson's rule for ∫ ds/Ω, of which s is the time at 1 rad/s.
            let middle = 1.0 / pace.at(guide.at(ramp.angle(0.5 * (s0 + ramped.time)))[0])[0];
            time += (ramped.time - s0) * (slow0 + 4.0 * middle + 1.0 / full) / 6.0;
        }
        before = Some((ramped.time, 1.0 / full));
        let second = |d1: f64, d2: f64| d2 * omega * omega + d1 * faster;
        laid.moments.push(Moment {
            point: AxisPoint { x, z: f.z, c, time, rates: [x1 * omega, z1 * omega, omega] },
            acceleration: [second(x1, x2), second(z1, z2), faster],
            is_ramp: !ramp.is_done(c),
        });
        laid.touches.push(at.touch);
    }
    Ok(laid)
}

fn check_chord(chord: &[Chord; 2], order: &Order, spacing: &Spacing) -> Result<(), TurningError> {
    let limit = order.asked.chord;
    let worst = largest(chord);
    if worst.error.abs() <= limit {
        return Ok(());
    }
    let least = match fitting(order, spacing, worst.error) {
        Spacing::Angle(angle) => {
            format!("points at most {:.6}° apart would do", round_down(angle.to_degrees()))
        }
        Spacing::Arc { length, .. } | Spacing::Hybrid { length, .. } => {
            format!("points at most {:.6} mm apart would do", round_down(length))
        }
    };
    Err(TurningError::Chord {
        error: worst.error,
        limit,
        x: worst.x,
        degrees: (worst.c % TAU).to_degrees(),
        least,
    })
}

fn largest(chord: &[Chord; 2]) -> Chord {
    if chord[0].error > -chord[1].error { chord[0] } else { chord[1] }
}

/// `spacing` as much closer as keeps the limit, when it makes this error.
fn fitting(order: &Order, spacing: &Spacing, error: f64) -> Spacing {
    let power = match order.interpolation {
        Interpolation::Linear => 0.5,
        Interpolation::Pvt => 0.25,
    };
    spacing.scaled(0.98 * libm::pow(order.asked.chord / error.abs(), power))
}

/// By how many times the reference pace is gone.
fn speed_up(order: &Order, reference: &Pace, first: Option<Strictest>) -> Result<f64, TurningError> {
    let rpm = |omega: f64| omega * 60.0 / TAU;
    match (order.speed, first) {
        (Speed::Given(_), None) => Ok(1.0),
        (Speed::Given(_), Some(f)) => {
            // What is asked to be the limit itself must not fail by rounding.
            if f.share >= 1.0 - 1e-9 {
                return Ok(1.0);
            }
            let (unit, scale) = f.unit();
            Err(TurningError::Limit {
                what: f.kind_name(),
                axis: f.axis_name(),
                unit,
                value: f.peak.value * scale,
                limit: f.limit * scale,
                x: f.peak.x,
                degrees: (f.peak.c % TAU).to_degrees(),
                rpm: (rpm(reference.largest() * f.share) * 1000.0).floor() / 1000.0,
            })
        }
        (Speed::Highest { least, most, .. }, first) => {
            let spindle = most / reference.largest();
            let Some(f) = first.filter(|f| f.share < spindle) else { return Ok(spindle) };
            let reached = reference.largest() * f.share;
            if reached >= least {
                return Ok(f.share);
            }
            let (unit, scale) = f.unit();
            let faster = least / reached;
            let power = [faster, faster * faster, faster * faster * faster][f.kind];
            Err(TurningError::TooSlow {
                rpm: rpm(reached),
                least: rpm(least),
                what: f.kind_name(),
                axis: f.axis_name(),
                unit,
                needed: f.limit * scale * power,
                x: f.peak.x,
                degrees: (f.peak.c % TAU).to_degrees(),
            })
        }
    }
}
