//! How much of the surface is wanted.

use std::f64::consts::TAU;

/// The outline, before it is shifted and turned. Lengths in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outline {
    /// A circle of this radius.
    Round(f64),
    /// An ellipse with these semi-axes along x and y.
    Ellipse([f64; 2]),
    /// A rectangle with these half sides along x and y.
    Rectangle([f64; 2]),
}

/// The part of the surface that must be finished.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aperture {
    /// Its outline.
    pub outline: Outline,
    /// Its centre from the spindle axis, mm.
    pub center: [f64; 2],
    /// How far its x axis is turned from C = 0, radians.
    pub angle: f64,
}

/// Rays on which [`Aperture::lattice`] puts its places, and places on each.
const LATTICE: [usize; 2] = [180, 24];

impl Aperture {
    fn half(&self) -> [f64; 2] {
        match self.outline {
            Outline::Round(r) => [r, r],
            Outline::Ellipse(half) | Outline::Rectangle(half) => half,
        }
    }

    /// Whether the place is in the aperture; its rim, to rounding, is.
    pub fn contains(&self, x: f64, y: f64) -> bool {
        let (sin, cos) = libm::sincos(self.angle);
        let (dx, dy) = (x - self.center[0], y - self.center[1]);
        let [hx, hy] = self.half();
        let (u, v) = ((cos * dx + sin * dy) / hx, (cos * dy - sin * dx) / hy);
        let level = match self.outline {
            Outline::Rectangle(_) => u.abs().max(v.abs()),
            _ => (u * u + v * v).sqrt(),
        };
        level <= 1.0 + 1e-9
    }

    /// The place at the share `k` (0 centre, 1 rim) of the way out in the direction `t` (radians, seen from the centre).
    pub fn place(&self, t: f64, k: f64) -> [f64; 2] {
        let (s, c) = libm::sincos(t);
        let [hx, hy] = self.half();
        let (u, v) = match self.outline {
            Outline::Rectangle(_) => {
                // Out to the rim of the square [−1, 1]².
                let m = c.abs().max(s.abs());
                (c / m * hx, s / m * hy)
            }
            _ => (c * hx, s * hy),
        };
        let (sin, cos) = libm::sincos(self.angle);
        [self.center[0] + k * (cos * u - sin * v), self.center[1] + k * (sin * u + cos * v)]
    }

    /// Places all over the aperture, its rim, centre and corners among them, in a fixed order.
    pub fn lattice(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let [rays, along] = LATTICE;
        (0..rays).flat_map(move |i| {
            let t = TAU * i as f64 / rays as f64;
            (0..=along).map(move |j| self.place(t, j as f64 / along as f64))
        })
    }

    /// The largest share of its size, seen from its centre, of which all rays lie where `holds` says yes; to 1/4096.
    pub fn largest_share(&self, holds: impl Fn([f64; 2]) -> bool) -> f64 {
        let [rays, _] = LATTICE;
        let mut most: f64 = 1.0;
        for i in 0..rays {
            let t = TAU * i as f64 / rays as f64;
            if holds(self.place(t, most)) {
                continue;
            }
            let (mut low, mut high) = (0.0, most);
            for _ in 0..12 {
                let middle = 0.5 * (low + high);
                if holds(self.place(t, middle)) { low = middle } else { high = middle }
            }
            most = low;
        }
        most
    }

    /// The longest distance of the rim from the spindle axis, mm, to within a millionth of the aperture's size.
    pub fn farthest(&self) -> f64 {
        let far = |t: f64| {
            let [x, y] = self.place(t, 1.0);
            libm::hypot(x, y)
        };
        highest_around(far).1
    }
}

/// Where `f` of an angle is highest, and its value: the best of 720 angles, then refined between its neighbours.
pub(super) fn highest_around(f: impl Fn(f64) -> f64) -> (f64, f64) {
    let step = TAU / 720.0;
    let mut best = (0.0, f64::NEG_INFINITY);
    for i in 0..720 {
        let t = step * f64::from(i);
        let y = f(t);
        if y > best.1 {
            best = (t, y);
        }
    }
    let mut width = step;
    // Each round keeps two thirds: 30 rounds leave a millionth.
    for _ in 0..30 {
        width *= 2.0 / 3.0;
        for t in [best.0 - width, best.0 + width] {
            let y = f(t);
            if y > best.1 {
                best = (t, y);
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn farthest_points_are_corners_and_ends() {
        let outline = Outline::Rectangle([4.0, 3.0]);
        let plain = Aperture { outline, center: [0.0; 2], angle: 0.7 };
        assert!((plain.farthest() - 5.0).abs() < 1e-6);
        let round = Aperture { outline: Outline::Round(5.0), center: [3.0, 4.0], angle: 0.0 };
        assert!((round.farthest() - 10.0).abs() < 1e-6);
        assert!(round.contains(6.0, 8.0) && !round.contains(6.01, 8.0));
        assert!(plain.lattice().all(|[x, y]| plain.contains(x, y)));
    }
}
