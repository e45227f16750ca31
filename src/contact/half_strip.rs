//! Searching along the envelope for the point where it has risen to the scallop limit.

use std::f64::consts::PI;

/// The envelope at one θ.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reading {
    /// Height above the surface along its normal, mm; not a number where there is no surface below.
    pub height: f64,
    /// Distance to the side of the pass, mm, positive on the side that is searched.
    pub side: f64,
}

/// How one side of a strip ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum HalfStrip {
    /// The envelope reaches the limit at this θ, so far to the side (mm).
    Reached {
        /// Angle on the centre circle.
        theta: f64,
        /// Distance from the contact, mm.
        side: f64,
    },
    /// The surface ends first; at this θ the envelope was still over it.
    Border {
        /// Angle on the centre circle.
        theta: f64,
    },
    /// The envelope lies deeper than the allowance below the surface: the cutter gouges beside its contact.
    Gouge {
        /// Deepest height found, mm, negative.
        height: f64,
    },
    /// The whole half of the cutter stays within the limit; the last θ and the distance there (mm).
    Whole {
        /// Distance at the far end of the search, mm.
        side: f64,
    },
}

/// What the search is allowed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Search {
    /// Height to reach, mm.
    pub scallop: f64,
    /// How deep below the surface counts as rounding, mm.
    pub gouge: f64,
    /// Where second order expects the edge, mm (infinite if it expects none).
    pub expected: f64,
    /// +1 or −1: the direction of θ.
    pub toward: f64,
    /// Relative accuracy of the height at the edge.
    pub accuracy: f64,
}

/// Steps of a march out from the contact: enough to double from 1e-9 to π.
const MARCH: usize = 60;
/// Bisection alone needs 45 calls from π to a rounding error.
const REFINE: usize = 60;

/// The θ on one side at which `read` reaches the scallop height.
///
/// The height grows like the square of the way from the contact, so its root is nearly linear and a secant on it
/// lands within a few calls; the bracket keeps it safe near the jumps of a flat bottom.
pub(super) fn search(mut read: impl FnMut(f64) -> Reading, how: Search) -> HalfStrip {
    let target = how.scallop.sqrt();
    let root = |r: &Reading| r.height.max(0.0).sqrt() - target;
    let (mut inner, mut inner_gap, mut inner_side) = (0.0, -target, 0.0);
    let mut outer = None;
    let mut step = first_step(&mut read, &how);
    for _ in 0..MARCH {
        let theta = (inner + step).min(PI);
        let reading = read(how.toward * theta);
        if !reading.height.is_finite() {
            return border(read, how, inner, theta, inner_gap, target);
        }
        if reading.height < -how.gouge {
            return HalfStrip::Gouge { height: reading.height };
        }
        let gap = root(&reading);
        if gap >= 0.0 {
            outer = Some((theta, gap, reading.side));
            break;
        }
        // Aim at the edge by the last chord of the root, but never further than three times as far, nor less than 1.3 times.
        let slope = (gap - inner_gap) / (theta - inner);
        let aim = if slope > 0.0 { 1.05 * (-gap / slope) } else { f64::INFINITY };
        (inner, inner_gap, inner_side) = (theta, gap, reading.side);
        if theta >= PI {
            return HalfStrip::Whole { side: inner_side };
        }
        step = aim.clamp(0.3 * theta, 2.0 * theta);
    }
    let Some(outer) = outer else { return HalfStrip::Whole { side: inner_side } };
    refine(read, &how, (inner, inner_gap, inner_side), outer, target)
}

/// The first step of the march: where second order expects the edge.
fn first_step(read: &mut impl FnMut(f64) -> Reading, how: &Search) -> f64 {
    // A θ small enough for the side to be linear, large enough not to drown in rounding.
    let probe = 1e-5;
    let side = read(how.toward * probe).side;
    let wish = how.expected.min(1e3) * probe / side;
    if wish.is_finite() && wish > 0.0 { wish.clamp(1e-9, 1.0) } else { 1e-6 }
}

fn refine(
    mut read: impl FnMut(f64) -> Reading,
    how: &Search,
    (mut a, mut ya, mut side_a): (f64, f64, f64),
    (mut b, mut yb, mut side_b): (f64, f64, f64),
    target: f64,
) -> HalfStrip {
    // Illinois: a secant that halves the weight of an end that stays.
    let tolerance = 0.5 * how.accuracy * target;
    let (mut wa, mut wb) = (ya, yb);
    for k in 0..REFINE {
        if yb.abs() <= tolerance || -ya <= tolerance || (b - a) < 1e-15 * b {
            break;
        }
        let secant = (wb * a - wa * b) / (wb - wa);
        let theta = if k % 8 == 7 || !(secant > a && secant < b) { 0.5 * (a + b) } else { secant };
        let reading = read(how.toward * theta);
        if !reading.height.is_finite() {
            return HalfStrip::Border { theta: how.toward * a };
        }
        let y = reading.height.max(0.0).sqrt() - target;
        if y >= 0.0 {
            (b, yb, wb, side_b) = (theta, y, y, reading.side);
            wa *= 0.5;
        } else {
            (a, ya, wa, side_a) = (theta, y, y, reading.side);
            wb *= 0.5;
        }
    }
    if yb.abs() <= ya.abs() {
        HalfStrip::Reached { theta: how.toward * b, side: side_b }
    } else {
        HalfStrip::Reached { theta: how.toward * a, side: side_a }
    }
}

/// The envelope ran off the surface between `inner` (over it) and `outer` (not): the border, unless the limit is
/// reached before it.
fn border(
    mut read: impl FnMut(f64) -> Reading,
    how: Search,
    mut inner: f64,
    mut outer: f64,
    inner_gap: f64,
    target: f64,
) -> HalfStrip {
    let start = (inner, inner_gap, 0.0);
    for _ in 0..40 {
        let theta = 0.5 * (inner + outer);
        let reading = read(how.toward * theta);
        if !reading.height.is_finite() {
            outer = theta;
        } else {
            let gap = reading.height.max(0.0).sqrt() - target;
            if gap >= 0.0 {
                return refine(read, &how, start, (theta, gap, reading.side), target);
            }
            inner = theta;
        }
        if outer - inner < 1e-6 * outer {
            break;
        }
    }
    HalfStrip::Border { theta: how.toward * inner }
}
