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
        /// Height found there, mm, negative.
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
    /// By how much the side grows with θ at the contact, mm per radian.
    pub speed: f64,
    /// +1 or −1: the direction of θ.
    pub toward: f64,
    /// Relative accuracy of the height at the edge.
    pub accuracy: f64,
}

/// A place that was looked at: θ in the searched direction, by how much the root of the height there exceeds that of the
/// limit, and the distance to the side.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub(super) theta: f64,
    pub(super) gap: f64,
    pub(super) side: f64,
}

/// Steps of a march out from the contact: enough to double from 1e-9 to π.
const MARCH: usize = 60;
/// Steps to the edge between two places: enough to halve from π to a rounding error, with a failed try before each.
const REFINE: usize = 100;
/// Steps of the march that aim at the edge itself; later ones, which keep falling short, go ever farther beyond it.
const PATIENCE: usize = 3;

/// The θ on one side at which `read` reaches the scallop height.
///
/// The height grows like the square of the way from the contact, so its root is nearly linear, with the slope that
/// second order states: θ as a polynomial of it lands within a few calls. The bracket keeps that safe near the jumps of
/// a flat bottom.
pub(super) fn search(read: &mut dyn FnMut(f64) -> Reading, how: Search) -> HalfStrip {
    let target = how.scallop.sqrt();
    let first = how.first_step();
    let mut aims = Aims::new(target, first);
    let mut inner = Place { theta: 0.0, gap: -target, side: 0.0 };
    let mut theta = first.unwrap_or(1e-6);
    for step in 0..MARCH {
        let reading = read(how.toward * theta);
        if !reading.height.is_finite() {
            return border(read, &how, inner, theta);
        }
        if reading.height < -how.gouge {
            return HalfStrip::Gouge { height: reading.height };
        }
        let here = how.place(theta, reading);
        if here.gap.abs() <= how.tolerance() {
            return how.reached(here);
        }
        let aim = aims.add(here);
        if here.gap > 0.0 {
            return refine(read, &how, (inner, here), aims, aim);
        }
        if theta >= PI {
            return HalfStrip::Whole { side: here.side };
        }
        inner = here;
        let way = (aim - theta) * f64::from(1 << step.saturating_sub(PATIENCE).min(30) as u32);
        theta = if way > 0.0 { (theta + way).min(3.0 * theta) } else { 3.0 * theta }.min(PI);
    }
    HalfStrip::Whole { side: inner.side }
}

impl Search {
    /// The first step of the march: where second order expects the edge, if it does.
    fn first_step(&self) -> Option<f64> {
        let wish = self.expected.min(1e3) / self.speed;
        (wish.is_finite() && wish > 0.0).then(|| wish.clamp(1e-9, 1.0))
    }

    pub(super) fn place(&self, theta: f64, reading: Reading) -> Place {
        Place { theta, gap: reading.height.max(0.0).sqrt() - self.scallop.sqrt(), side: reading.side }
    }

    /// Error of the height's root that counts as none.
    fn tolerance(&self) -> f64 {
        0.5 * self.accuracy * self.scallop.sqrt()
    }

    pub(super) fn reached(&self, at: Place) -> HalfStrip {
        HalfStrip::Reached { theta: self.toward * at.theta, side: at.side }
    }
}

/// Places through which θ is interpolated.
const NODES: usize = 4;

/// Inverse interpolation: θ as the polynomial of the gap through the latest places, by Neville's scheme.
pub(super) struct Aims {
    /// The latest first.
    gaps: [f64; NODES],
    /// The polynomials through the latest one, two, … places, at a gap of zero.
    zeros: [f64; NODES],
    count: usize,
}

impl Aims {
    /// Begins with the contact, where the gap is `-target`; twice, that is with a slope, if the edge is `expected` by it.
    fn new(target: f64, expected: Option<f64>) -> Self {
        let mut zeros = [0.0; NODES];
        zeros[1] = expected.unwrap_or(0.0);
        Self { gaps: [-target; NODES], zeros, count: 1 + usize::from(expected.is_some()) }
    }

    /// Begins with nothing.
    pub(super) fn none() -> Self {
        Self { gaps: [0.0; NODES], zeros: [0.0; NODES], count: 0 }
    }

    /// Takes in a place; the θ at which the gap is expected to be zero, if it is a number.
    pub(super) fn add(&mut self, at: Place) -> f64 {
        let before = self.count.min(NODES - 1);
        let mut zeros = [at.theta; NODES];
        for m in 1..=before {
            let gap = self.gaps[m - 1];
            zeros[m] = (gap * zeros[m - 1] - at.gap * self.zeros[m - 1]) / (gap - at.gap);
        }
        self.gaps.copy_within(..NODES - 1, 1);
        self.gaps[0] = at.gap;
        self.zeros = zeros;
        self.count = before + 1;
        zeros[before]
    }
}

/// The edge between a place within the limit and one beyond it.
pub(super) fn refine(
    read: &mut dyn FnMut(f64) -> Reading,
    how: &Search,
    (mut inner, mut outer): (Place, Place),
    mut aims: Aims,
    mut aim: f64,
) -> HalfStrip {
    // Two tries in a row that leave more than half of the bracket are answered by halving it.
    let mut slow = 0u32;
    for _ in 0..REFINE {
        let width = outer.theta - inner.theta;
        if width < 1e-15 * outer.theta {
            break;
        }
        let inside = inner.theta < aim && aim < outer.theta;
        let theta = if inside && slow < 2 { aim } else { 0.5 * (inner.theta + outer.theta) };
        let reading = read(how.toward * theta);
        if !reading.height.is_finite() {
            return HalfStrip::Border { theta: how.toward * inner.theta };
        }
        if reading.height < -how.gouge {
            return HalfStrip::Gouge { height: reading.height };
        }
        let here = how.place(theta, reading);
        if here.gap.abs() <= how.tolerance() {
            return how.reached(here);
        }
        aim = aims.add(here);
        *(if here.gap > 0.0 { &mut outer } else { &mut inner }) = here;
        let halved = outer.theta - inner.theta <= 0.5 * width;
        slow = if halved { slow.saturating_sub(1) } else { slow + 1 };
    }
    how.reached(if outer.gap <= -inner.gap { outer } else { inner })
}

/// The envelope ran off the surface between `inner` (over it) and `outer` (not): the border, unless the limit is
/// reached before it.
pub(super) fn border(
    read: &mut dyn FnMut(f64) -> Reading,
    how: &Search,
    mut inner: Place,
    mut outer: f64,
) -> HalfStrip {
    for _ in 0..40 {
        let theta = 0.5 * (inner.theta + outer);
        let reading = read(how.toward * theta);
        if !reading.height.is_finite() {
            outer = theta;
        } else {
            let here = how.place(theta, reading);
            if here.gap >= 0.0 {
                let mut aims = Aims::new(how.scallop.sqrt(), None);
                let aim = aims.add(here);
                return refine(read, how, (inner, here), aims, aim);
            }
            inner = here;
        }
        if outer - inner.theta < 1e-6 * outer {
            break;
        }
    }
    HalfStrip::Border { theta: how.toward * inner.theta }
}
