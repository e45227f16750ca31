//! Exact strip over the quadratic model of a surface.

use super::envelope::{Sweep, distinct_tilt};
use super::half_strip::{HalfStrip, Reading, Search, search};
use super::place::Tilt;
use super::relative::second_order_strip_width;
use crate::cutter::Cutter;
use crate::geometry::Curvature;
use crate::math::frame::Frame;
use crate::toolpath::Posture;
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// The strip that one contact point finishes, each side on its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModelStrip {
    /// The `+b` side.
    pub left: HalfStrip,
    /// The `−b` side.
    pub right: HalfStrip,
}

impl ModelStrip {
    /// Left and right half widths, mm; `None` where a side gouges.
    pub fn half_widths(&self) -> Option<(f64, f64)> {
        let width = |side: &HalfStrip| match *side {
            HalfStrip::Reached { side, .. } | HalfStrip::Whole { side } => Some(side),
            HalfStrip::Border { .. } | HalfStrip::Gouge { .. } => None,
        };
        Some((width(&self.left)?, width(&self.right)?))
    }
}

/// The exact strip within `scallop` (mm, above 0) over the surface `z = ½(k_ff x² + 2 k_fb x y + k_bb y²)`, while the
/// contact runs along the surface curve over `y = 0` with lead and yaw constant in its frame.
///
/// A half width is the `|y|` at which the height cut along the surface normal at `(0, y)` reaches `scallop`. The
/// envelope is exact; the search stops at a millionth of the height.
pub fn model_strip(cutter: &Cutter, posture: Posture, k: &Curvature, scallop: f64) -> ModelStrip {
    let expected = 0.5 * second_order_strip_width(cutter, posture, k, scallop);
    let model = Model { cutter, tilt: distinct_tilt(posture), k };
    let start = model.sweep(0.0);
    let side = |left: bool| {
        let y_sign = if left { 1.0 } else { -1.0 };
        let toward = start.left(DVec3::Y) * y_sign;
        let departure = start.departure(toward);
        // The instant at which the foot of the envelope's point lies over x = 0, per |θ|: from call to call it changes
        // little.
        let mut pace = -departure.x;
        let mut read = |theta: f64| model.read(theta, &mut pace, y_sign);
        let speed = departure.y * y_sign;
        let how = Search { scallop, gouge: 0.01 * scallop, expected, speed, toward, accuracy: 1e-6 };
        search(&mut read, how)
    };
    ModelStrip { left: side(true), right: side(false) }
}

/// The envelope over the same surface in the same motion, to look at: pairs of the distance to the side (mm, above 0 on the `+b`
/// side) and the height along the surface normal (mm), from right to left, no farther than `reach` (mm) to either side.
pub fn model_section(cutter: &Cutter, posture: Posture, k: &Curvature, reach: f64) -> Vec<[f64; 2]> {
    let model = Model { cutter, tilt: distinct_tilt(posture), k };
    let start = model.sweep(0.0);
    let side = |y_sign: f64| {
        let toward = start.left(DVec3::Y) * y_sign;
        let mut pace = -start.departure(toward).x;
        let mut places = Vec::new();
        for i in 1..=LOOKS {
            let share = f64::from(i) / f64::from(LOOKS);
            // Closer together where the profile rises least.
            let Reading { height, side } = model.read(toward * FRAC_PI_2 * share * share, &mut pace, y_sign);
            if !(side.is_finite() && height.is_finite() && side <= reach) {
                break;
            }
            places.push([side * y_sign, height]);
        }
        places
    };
    let mut all = side(-1.0);
    all.reverse();
    all.push([0.0; 2]);
    all.extend(side(1.0));
    all
}

/// Places at which a half of the envelope is looked at.
const LOOKS: u32 = 160;

/// A cutter over a quadratic surface.
struct Model<'a> {
    cutter: &'a Cutter,
    tilt: Tilt,
    k: &'a Curvature,
}

impl Model<'_> {
    /// The cutter in motion when its contact is at `x = t`.
    fn sweep(&self, t: f64) -> Sweep {
        let k = self.k;
        let slope = k.ff * t;
        let velocity = DVec3::new(1.0, 0.0, slope);
        let stretch = velocity.length_recip();
        let f = velocity * stretch;
        let m = DVec3::new(-slope, -k.fb * t, 1.0);
        let shrink = m.length_recip();
        let n = m * shrink;
        let frame = Frame { f, b: n.cross(f), n };
        // The frame's rates of change give its angular velocity: f′ = Ω × f and n′ = Ω × n.
        let f_rate = DVec3::new(-slope, 0.0, 1.0) * (k.ff * stretch * stretch * stretch);
        let n_rate = {
            let m_rate = DVec3::new(-k.ff, -k.fb, 0.0);
            (m_rate - n * n.dot(m_rate)) * shrink
        };
        let spin =
            frame.f * -n_rate.dot(frame.b) + frame.b * n_rate.dot(frame.f) + frame.n * f_rate.dot(frame.b);
        let pivot = DVec3::new(t, 0.0, 0.5 * k.ff * t * t);
        Sweep::of_tilt(self.cutter, &self.tilt, pivot, &frame, velocity, spin)
    }

    /// The envelope's point at `theta` where it lies over `x = 0`; `pace` is the instant of that per |θ|, as it was found last.
    fn read(&self, theta: f64, pace: &mut f64, y_sign: f64) -> Reading {
        let mut t = *pace * theta.abs();
        let mut foot = self.foot(self.sweep(t).point(theta));
        for _ in 0..3 {
            if foot.x.abs() < 1e-7 * (1.0 + foot.y.abs()) {
                break;
            }
            t -= foot.x;
            foot = self.foot(self.sweep(t).point(theta));
        }
        *pace = t / theta.abs();
        Reading { height: foot.z, side: foot.y * y_sign }
    }

    /// Foot `(x, y)` of the point `e` along its normal, and the height over it as `z`.
    fn foot(&self, e: DVec3) -> DVec3 {
        let k = self.k;
        let (mut x, mut y, mut height) = (e.x, e.y, 0.0);
        // A contraction by height × curvature, below 1e-2 for every strip that fits its surface.
        for _ in 0..4 {
            let (zx, zy) = (k.ff * x + k.fb * y, k.fb * x + k.bb * y);
            let square = 1.0 + zx * zx + zy * zy;
            let z = 0.5 * (x * zx + y * zy);
            let share = (e.z - z + (e.x - x) * -zx + (e.y - y) * -zy) / square;
            height = share * square.sqrt();
            let (from_x, from_y) = (x, y);
            (x, y) = (e.x + share * zx, e.y + share * zy);
            // The next would be a hundredth of this, at most.
            if (x - from_x).abs() + (y - from_y).abs() < 1e-9 {
                break;
            }
        }
        DVec3::new(x, y, height)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLANE: Curvature = Curvature { ff: 0.0, fb: 0.0, bb: 0.0 };

    fn mill(center_radius: f64, corner_radius: f64) -> Cutter {
        Cutter::bull_nose(2.0 * (center_radius + corner_radius), corner_radius, 100.0).unwrap()
    }

    fn width(cutter: &Cutter, lead: f64, yaw: f64, k: &Curvature, h: f64) -> f64 {
        let posture = Posture { lead: lead.to_radians(), yaw: yaw.to_radians() };
        let (left, right) = model_strip(cutter, posture, k, h).half_widths().unwrap();
        left + right
    }

    #[test]
    fn plane_closed_forms() {
        // Widths of 4.08, 3.71 and 3.50 mm by lead, 3.45, 2.73 and 2.65 mm by lateral tilt, for h = 0.5.
        let cutter = mill(1.0, 2.0);
        for (tilt, lead, lateral) in
            [(0.0, 4.6458, 4.646), (15.0, 4.0801, 3.452), (30.0, 3.7083, 2.725), (45.0, 3.5036, 2.646)]
        {
            let by_lead = width(&cutter, tilt, 0.0, &PLANE, 0.5);
            assert!((by_lead - lead).abs() < 1e-4, "lead {tilt}: {by_lead}");
            for yaw in [90.0, -90.0] {
                let by_side = width(&cutter, tilt, yaw, &PLANE, 0.5);
                assert!((by_side - lateral).abs() < 1e-3, "lateral {tilt}: {by_side}");
            }
        }
        assert!((width(&mill(3.0, 2.0), 5.0, 0.0, &PLANE, 0.01) - 1.6923).abs() < 1e-4);
    }

    #[test]
    fn ball_leaves_the_chord_of_its_circle() {
        let ball = Cutter::ball(10.0, 50.0).unwrap();
        for (lead, yaw) in [(0.0, 0.0), (20.0, 0.0), (35.0, 70.0), (10.0, -140.0)] {
            let expected = 2.0 * (5.0f64 * 5.0 - 4.9 * 4.9).sqrt();
            assert!((width(&ball, lead, yaw, &PLANE, 0.1) - expected).abs() < 1e-6);
        }
    }

    #[test]
    fn offset_ellipse_of_a_lead_on_a_plane() {
        // y = R1 sin t + r b sin t/D, z = b(1 − cos t) + r(1 − R1 cos t/D), b = R1 sin λ, D² = b² sin² t + R1² cos² t.
        let (r1, r, lead) = (9.5, 3.0, 8f64.to_radians());
        let b = r1 * libm::sin(lead);
        for t in [0.02, 0.1, 0.3, 0.6] {
            let (s, c) = libm::sincos(t);
            let d = libm::hypot(b * s, r1 * c);
            let y = r1 * s + r * b * s / d;
            let z = b * (1.0 - c) + r * (1.0 - r1 * c / d);
            let found = width(&mill(r1, r), 8.0, 0.0, &PLANE, z);
            assert!((found - 2.0 * y).abs() < 1e-5 * y, "{t}: {found} {}", 2.0 * y);
        }
    }

    #[test]
    fn mirrored_surface_and_yaw_swap_the_sides() {
        let posture = Posture { lead: 0.15, yaw: -0.4 };
        let k = Curvature { ff: -0.01, fb: 0.004, bb: 0.006 };
        let mirrored = model_strip(
            &mill(5.0, 1.0),
            Posture { yaw: 0.4, ..posture },
            &Curvature { fb: -0.004, ..k },
            0.02,
        );
        let (l, r) = model_strip(&mill(5.0, 1.0), posture, &k, 0.02).half_widths().unwrap();
        let (ml, mr) = mirrored.half_widths().unwrap();
        assert!((l - mr).abs() < 1e-6 && (r - ml).abs() < 1e-6);
        assert!((l - r).abs() > 1e-3);
    }

    #[test]
    fn the_section_passes_through_the_ends_of_the_strip() {
        let posture = Posture { lead: 0.15, yaw: -0.4 };
        let k = Curvature { ff: -0.01, fb: 0.004, bb: 0.006 };
        let (left, right) = model_strip(&mill(5.0, 1.0), posture, &k, 0.02).half_widths().unwrap();
        let section = model_section(&mill(5.0, 1.0), posture, &k, 3.0);
        assert!(section.is_sorted_by(|a, b| a[0] < b[0]));
        for end in [left, -right] {
            let above = section.partition_point(|[y, _]| *y < end);
            let ([y0, z0], [y1, z1]) = (section[above - 1], section[above]);
            let height = z0 + (z1 - z0) * (end - y0) / (y1 - y0);
            assert!((height - 0.02).abs() < 1e-3, "{end}: {height}");
        }
    }

    #[test]
    fn deep_concave_surface_is_a_gouge() {
        let k = Curvature { ff: 0.0, fb: 0.0, bb: 0.5 };
        let strip = model_strip(&mill(9.5, 3.0), Posture { lead: 0.05, yaw: 0.0 }, &k, 0.01);
        assert_eq!(strip.half_widths(), None);
    }
}
