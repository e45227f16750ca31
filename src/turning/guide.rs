//! The curve that the nose centre follows in the plane square to the spindle axis: its distance from the axis for each angle.

use std::f64::consts::TAU;

/// Which curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Curve {
    /// An Archimedean spiral: the distance changes evenly with the angle.
    Spiral,
    /// Concentric circles; between two the distance changes within this angle, radians, above 0.
    Circles(f64),
}

/// Which way the nose goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// From the rim towards the axis.
    Inward,
    /// From the axis, or where the aperture begins, to the rim.
    Outward,
}

/// What a guide is made from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ways {
    /// The curve.
    pub curve: Curve,
    /// Its direction.
    pub way: Way,
    /// Turns at the start in which a spiral gets going (its feed rises smoothly from rest) or the first circle is held.
    pub lead_in: f64,
    /// Turns at the end in which it comes to rest, or the last circle is held.
    pub lead_out: f64,
}

/// A guide curve. X never goes back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guide {
    curve: Curve,
    way: Way,
    /// Distance of its inner end from the axis, mm.
    inner: f64,
    /// The way from there to where a spiral has its full feed, mm.
    span: f64,
    /// mm a turn.
    step: f64,
    /// Angles of the leads at the rim and at the inner end, radians, without the whole turn there.
    leads: [f64; 2],
    /// Angle of the whole, radians.
    length: f64,
}

impl Guide {
    /// The guide from `innermost` out to `outermost`, mm from the axis, with `step` mm between neighbouring turns. It is carried one turn
    /// further out, so that in every direction a turn passes at or beyond `outermost`, and has a whole turn at its inner end, without
    /// which an insert would leave up to one and a half steps between its last two passes on the axis. Concentric circles divide the
    /// way evenly and so may lie closer.
    ///
    /// `innermost` must be 0 or more, `outermost` above it, `step` above 0, leads 0 or more.
    pub fn new(ways: &Ways, [innermost, outermost]: [f64; 2], step: f64) -> Self {
        let leads = match ways.way {
            Way::Inward => [ways.lead_in, ways.lead_out],
            Way::Outward => [ways.lead_out, ways.lead_in],
        }
        .map(|turns| TAU * turns);
        match ways.curve {
            Curve::Spiral => {
                let span = outermost - innermost + step;
                let feed = step / TAU;
                // Coming to rest takes half the way that full feed would.
                let inner = leads[1].min(2.0 * span / feed);
                let even = span / feed - 0.5 * inner;
                Self {
                    curve: ways.curve,
                    way: ways.way,
                    inner: innermost,
                    span,
                    step,
                    leads: [leads[0], inner],
                    length: leads[0] + even + inner + TAU,
                }
            }
            Curve::Circles(turn) => {
                let span = outermost - innermost;
                let count = (span / step).ceil().max(1.0);
                let length = leads[0] + count * (TAU + turn) + TAU + leads[1];
                let step = span / count;
                Self { curve: ways.curve, way: ways.way, inner: innermost, span, step, leads, length }
            }
        }
    }

    /// Angle of the whole curve, radians.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Distance between neighbouring turns, mm.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// The distance from the axis at its outer end, mm.
    pub fn farthest(&self) -> f64 {
        self.inward(0.0)[0]
    }

    /// Distance from the axis (mm) and its first and second derivatives along the angle `c`, from 0 to [`Guide::length`].
    pub fn at(&self, c: f64) -> [f64; 3] {
        match self.way {
            Way::Inward => self.inward(c),
            Way::Outward => {
                let [x, x1, x2] = self.inward(self.length - c);
                [x, -x1, x2]
            }
        }
    }

    fn inward(&self, c: f64) -> [f64; 3] {
        let [x, x1, x2] = match self.curve {
            Curve::Spiral => self.spiral(c),
            Curve::Circles(turn) => self.circles(c, turn),
        };
        [self.inner + x, x1, x2]
    }

    /// From the inner end.
    fn spiral(&self, c: f64) -> [f64; 3] {
        let feed = self.step / TAU;
        let [rim, axis] = self.leads;
        let left = self.length - TAU - c;
        if left <= 0.0 {
            return [0.0; 3];
        }
        if c < rim {
            let [s, s1, s2] = going(c / rim);
            return [self.span + feed * rim * (0.5 - s), -feed * s1, -feed * s2 / rim];
        }
        if left < axis {
            let [s, s1, s2] = going(left / axis);
            return [feed * axis * s, -feed * s1, feed * s2 / axis];
        }
        // From the inner end, so that the last place is there whatever the rounding.
        [feed * (left - 0.5 * axis), -feed, 0.0]
    }

    /// Likewise.
    fn circles(&self, c: f64, turn: f64) -> [f64; 3] {
        let u = c - self.leads[0];
        let period = TAU + turn;
        let count = (self.span / self.step).round();
        if u <= 0.0 {
            return [self.span, 0.0, 0.0];
        }
        let circle = (u / period).floor().min(count);
        let over = u - circle * period - TAU;
        let from = self.step * (count - circle);
        if over <= 0.0 || circle >= count {
            return [from, 0.0, 0.0];
        }
        let [s, s1, s2] = across(over / turn);
        [from - self.step * s, -self.step * s1 / turn, -self.step * s2 / (turn * turn)]
    }
}

/// The way covered while the feed rises from 0 to 1 over `u` from 0 to 1, the feed, and its derivative: the feed is
/// `3u² − 2u³`, so that acceleration begins and ends at 0.
fn going(u: f64) -> [f64; 3] {
    let v = u * u;
    [u * v - 0.5 * v * v, 3.0 * v - 2.0 * u * v, 6.0 * u - 6.0 * v]
}

/// A step from 0 to 1 with no velocity and no acceleration at its ends: `6u⁵ − 15u⁴ + 10u³` with two derivatives.
fn across(u: f64) -> [f64; 3] {
    let v = u * u;
    [
        v * u * (10.0 - 15.0 * u + 6.0 * v),
        30.0 * v * (1.0 - u) * (1.0 - u),
        60.0 * u * (1.0 - u) * (1.0 - 2.0 * u),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn guides_go_one_way_and_their_derivatives_are_theirs() {
        for curve in [Curve::Spiral, Curve::Circles(0.3)] {
            for way in [Way::Inward, Way::Outward] {
                let ways = Ways { curve, way, lead_in: 1.0, lead_out: 2.0 };
                let guide = Guide::new(&ways, [2.0, 10.0], 0.7);
                let n = 400_000;
                let at = |i: usize| guide.at(guide.length() * i as f64 / f64::from(n));
                let sign = if way == Way::Inward { -1.0 } else { 1.0 };
                let h = guide.length() / f64::from(n);
                for i in 0..n as usize {
                    let (a, b) = (at(i), at(i + 1));
                    assert!(sign * (b[0] - a[0]) >= -1e-12, "{curve:?} {way:?} {i}");
                    let lack = (b[0] - a[0] - 0.5 * h * (a[1] + b[1])).abs();
                    assert!(lack < 1e-7, "{curve:?} {way:?} {i}: {lack}");
                    assert!((b[1] - a[1] - 0.5 * h * (a[2] + b[2])).abs() < 1e-4, "{curve:?} {way:?} {i}");
                }
                let ends = [at(0)[0], at(n as usize)[0]];
                let (low, high) = if way == Way::Inward { (ends[1], ends[0]) } else { (ends[0], ends[1]) };
                assert!((low - 2.0).abs() < 1e-9 && high >= 10.0, "{ends:?}");
            }
        }
    }
}
