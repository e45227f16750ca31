//! The edge of a strip whose cutter is lifted off its contact: in a hollow it then touches on both sides.
//!
//! Beside the contact the envelope falls from the lift to about 0 where the side touches, and rises again. With `y` the way
//! from the contact its height is nearly `L (y²/y_t² − 1)²`: beyond the touching place its root is straight in `y²`.

use super::half_strip::{Aims, HalfStrip, Reading, Search, border, refine};
use crate::cutter::Cutter;
use crate::math::parabola::vertex;
use std::f64::consts::PI;

/// Steps from the contact to where the edge is expected: enough to see the dip between.
const STEPS: f64 = 8.0;
/// Steps at most, growing beyond the expected edge.
const MARCH: usize = 40;
const GROWTH: f64 = 1.25;

/// About where the edge lies, as an angle on the centre circle, radians: exact to second order in the angle for a straight feed
/// along a round hollow in which both sides touch, `t² = 2 √(2 sin λ/R1) (√L + √h)/(sin λ cos λ)`.
fn expected(cutter: &Cutter, lead: f64, lift: f64, scallop: f64) -> f64 {
    let (s, c) = libm::sincos(lead.abs().max(1e-6));
    let bend = (2.0 * s / cutter.center_radius).sqrt();
    let square = 2.0 * bend * (lift.sqrt() + scallop.sqrt()) / (s * c);
    let angle = square.sqrt();
    if angle.is_finite() { angle.clamp(1e-4, 1.0) } else { 1.0 }
}

/// The first θ on one side at which `read` reaches the scallop height, for a cutter that stands `lift` (mm, above 0) off its
/// contact with this `lead`; and the least height before it, mm. A height below the allowance is a gouge.
pub(super) fn search_lifted(
    read: &mut dyn FnMut(f64) -> Reading,
    how: Search,
    cutter: &Cutter,
    (lead, lift): (f64, f64),
) -> (HalfStrip, f64) {
    // The heights at the latest places, and around the lowest one: angles and heights.
    let mut trail = [(0.0, lift); 2];
    let mut low = [(0.0, lift); 3];
    let mut dips = false;
    let start = how.place(0.0, Reading { height: lift, side: 0.0 });
    if start.gap >= 0.0 {
        return (how.reached(start), lift);
    }
    let mut inner = start;
    let mut step = expected(cutter, lead, lift, how.scallop) / STEPS;
    let mut theta = 0.0;
    let mut end = HalfStrip::Whole { side: 0.0 };
    for k in 0..MARCH {
        if k as f64 >= 1.5 * STEPS {
            step *= GROWTH;
        }
        theta = (theta + step).min(PI);
        let reading = read(how.toward * theta);
        if !reading.height.is_finite() {
            end = border(read, &how, inner, theta);
            break;
        }
        let here = how.place(theta, reading);
        let at = (theta, reading.height);
        if trail[1].1 <= trail[0].1 && trail[1].1 <= at.1 && trail[1].1 <= low[1].1 {
            low = [trail[0], trail[1], at];
            dips = trail[1].0 > 0.0;
        }
        trail = [trail[1], at];
        if here.gap > 0.0 {
            let mut aims = Aims::none();
            aims.add(inner);
            let aim = aims.add(here);
            end = refine(read, &how, (inner, here), aims, aim);
            break;
        }
        end = HalfStrip::Whole { side: here.side };
        inner = here;
        if theta >= PI {
            break;
        }
    }
    let mut lowest = low[1].1.min(trail[1].1);
    if dips && let Some(theta) = vertex(low) {
        // Where there is no number the least of the others is kept.
        lowest = lowest.min(read(how.toward * theta).height);
    }
    if lowest < -how.gouge { (HalfStrip::Gouge { height: lowest }, lowest) } else { (end, lowest) }
}
