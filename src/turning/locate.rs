//! Where the nose stands when it touches the surface.

use super::error::TurningError;
use super::height_jet::{HeightJet, PolarJet};
use super::placed::Placed;
use super::round::round_down;
use crate::toolpath::Nose;

/// Where the nose touches, seen from its centre and turned with the tool: along the radius and square to it, mm. A good guess
/// for the next place.
pub type Offset = [f64; 2];

/// The nose at one place of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Location {
    /// Height of the nose centre over the plane, with derivatives along X and C (mm, radians).
    pub center: PolarJet,
    /// Where it touches on the workpiece, mm.
    pub touch: [f64; 2],
    /// z component of the unit normal there: what height errors are times to become distances.
    pub normal_z: f64,
    /// For the next guess.
    pub offset: Offset,
}

/// Halvings of a radius: three digits are said.
const LOOKS: usize = 12;
/// Newton steps before giving up: it doubles the digits with each, and a path gives guesses of three.
const MOST_STEPS: usize = 60;

/// The nose centre at distance `x` (mm) from the axis and the direction `(cos, sin)`: the height at which it touches
/// `part`, by the normal for a ball, and within the X-Z plane for an insert.
///
/// With the point of contact `p`, its gradient `g` and `w = √(1 + |g|²)`, a ball's centre is at `p − r g/w` and height
/// `f + r/w`; an insert's likewise within its section. The slopes of the centre's surface are those of the part at the contact,
/// since parallel surfaces have parallel tangent planes.
///
/// Errors: no contact is found, which only happens where the nose is larger than a hollow; says which nose would do.
pub fn locate(
    part: &Placed,
    nose: Nose,
    x: f64,
    (cos, sin): (f64, f64),
    guess: Offset,
) -> Result<Location, TurningError> {
    touching(part, nose, x, (cos, sin), guess).ok_or_else(|| TurningError::NoTouch {
        x,
        degrees: libm::atan2(sin, cos).to_degrees(),
        most: round_down(largest(part, nose, x, (cos, sin))),
    })
}

/// The same; `None` where no contact is found.
pub(super) fn touching(
    part: &Placed,
    nose: Nose,
    x: f64,
    direction: (f64, f64),
    guess: Offset,
) -> Option<Location> {
    match nose {
        Nose::Ball(r) => ball(part, r, x, direction, guess),
        Nose::Insert(r) => insert(part, r, x, direction, guess[0]),
    }
}

/// The largest radius of a nose of this kind, up to its own, that touches there, mm.
fn largest(part: &Placed, nose: Nose, x: f64, direction: (f64, f64)) -> f64 {
    let [mut low, mut high] = [0.0, nose.radius()];
    for _ in 0..LOOKS {
        let middle = 0.5 * (low + high);
        let there = touching(part, nose.with_radius(middle), x, direction, [0.0; 2]).is_some();
        *(if there { &mut low } else { &mut high }) = middle;
    }
    low
}

/// How far the centre of a nose is above a place of it that lies `aside` of it. At the contact this is `r/w`, and since no place lets the
/// nose come lower, a contact that is a little off tells the height to second order.
fn above(r: f64, [u, v]: [f64; 2]) -> f64 {
    (r * r - u * u - v * v).max(0.0).sqrt()
}

fn ball(part: &Placed, r: f64, x: f64, (cos, sin): (f64, f64), [along, across]: Offset) -> Option<Location> {
    let q = [x * cos, x * sin];
    let mut p = [q[0] + along * cos - across * sin, q[1] + along * sin + across * cos];
    let close = 1e-9 * (r + x.abs());
    for _ in 0..MOST_STEPS {
        let f = part.at(p[0], p[1]);
        let w = f.stretch();
        let [gx, gy] = f.g;
        let e = [p[0] - r * gx / w - q[0], p[1] - r * gy / w - q[1]];
        // J = I − r M H with M = (I − g gᵀ/w²)/w, the derivative of g/w.
        let k = r / w;
        let [mxx, mxy, myy] =
            [k * (1.0 - gx * gx / (w * w)), -k * gx * gy / (w * w), k * (1.0 - gy * gy / (w * w))];
        let [hxx, hxy, hyy] = f.h;
        let (a, b) = (1.0 - (mxx * hxx + mxy * hxy), -(mxx * hxy + mxy * hyy));
        let (c, d) = (-(mxy * hxx + myy * hxy), 1.0 - (mxy * hxy + myy * hyy));
        let det = a * d - b * c;
        if !(det > 0.0 && a + d > 0.0) {
            // Larger than the hollow here: halfway back to under the centre.
            p = [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
            continue;
        }
        if e[0] * e[0] + e[1] * e[1] <= close * close {
            let second = |x: f64, y: f64| [(x * d - y * c) / det, (y * a - x * b) / det];
            // H J⁻¹, symmetric in exact arithmetic.
            let [xx, xy] = second(hxx, hxy);
            let [yx, yy] = second(hxy, hyy);
            let seen = [p[0] - q[0], p[1] - q[1]];
            let z = f.z + above(r, seen);
            let center = HeightJet { z, g: f.g, h: [xx, 0.5 * (xy + yx), yy] };
            return Some(Location {
                center: center.polar(x, cos, sin),
                touch: p,
                normal_z: 1.0 / w,
                offset: [seen[0] * cos + seen[1] * sin, seen[1] * cos - seen[0] * sin],
            });
        }
        let mut step = [(e[0] * d - e[1] * b) / det, (e[1] * a - e[0] * c) / det];
        let length = libm::hypot(step[0], step[1]);
        if length > r {
            step = step.map(|s| s * r / length);
        }
        p = [p[0] - step[0], p[1] - step[1]];
    }
    None
}

fn insert(part: &Placed, r: f64, x: f64, (cos, sin): (f64, f64), along: f64) -> Option<Location> {
    let mut rho = x + along;
    let close = 1e-9 * (r + x.abs());
    for _ in 0..MOST_STEPS {
        let jet = part.at(rho * cos, rho * sin);
        let f = jet.polar(rho, cos, sin);
        let w = (1.0 + f.r * f.r).sqrt();
        let k = r / (w * w * w);
        let slope = 1.0 - k * f.rr;
        if slope <= 0.0 {
            rho = 0.5 * (rho + x);
            continue;
        }
        let e = rho - r * f.r / w - x;
        if e.abs() <= close {
            let q = 1.0 / slope;
            let center = PolarJet {
                z: f.z + above(r, [rho - x, 0.0]),
                r: f.r,
                t: f.t,
                rr: f.rr * q,
                rt: f.rt * q,
                tt: f.tt + f.rt * f.rt * k * q,
            };
            return Some(Location {
                center,
                touch: [rho * cos, rho * sin],
                normal_z: 1.0 / jet.stretch(),
                offset: [rho - x, 0.0],
            });
        }
        rho -= (e / slope).clamp(-r, r);
    }
    None
}
