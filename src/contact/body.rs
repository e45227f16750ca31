//! The solid of the cutter, and how far a point is from it.

use crate::cutter::Cutter;
use crate::toolpath::ClPoint;
use glam::DVec3;

/// A cutter at a location, with its side line running on upwards without end.
#[derive(Debug, Clone, Copy)]
pub struct Body {
    center: DVec3,
    axis: DVec3,
    center_radius: f64,
    corner_radius: f64,
    bottom: (f64, f64),
    side: (f64, f64),
}

impl Body {
    /// The body of `cutter` at `cl`.
    pub fn new(cutter: &Cutter, cl: &ClPoint) -> Self {
        Self {
            center: cl.tip + cl.axis * cutter.center_height,
            axis: cl.axis,
            center_radius: cutter.center_radius,
            corner_radius: cutter.corner_radius,
            bottom: libm::sincos(cutter.bottom_angle),
            side: libm::sincos(cutter.taper),
        }
    }

    /// The body of the same `cutter` at `cl`, without working out its lines anew.
    pub fn moved(&self, cutter: &Cutter, cl: &ClPoint) -> Self {
        Self { center: cl.tip + cl.axis * cutter.center_height, axis: cl.axis, ..*self }
    }

    /// Whether `point` surely is farther than `away` (mm) from the cutter, told without a root; `false` says nothing.
    pub fn is_clear(&self, point: DVec3, away: f64) -> bool {
        let v = point - self.center;
        let z = v.dot(self.axis);
        let reach = self.corner_radius + away;
        // A bottom that is a cone reaches lower than its corner, and a side that widens upwards may come nearer from above.
        let below = self.bottom.0 <= 0.0 && -z > reach;
        let wide = self.center_radius + reach;
        below || (z <= 0.0 && self.side.0 <= 0.0 && v.length_squared() - z * z > wide * wide)
    }

    /// Signed distance of `point` to the cutter's surface, mm, negative inside. Outside it is exact; inside it is at
    /// most the true depth.
    ///
    /// The body is a core (bottom line, centre circle, side line, each moved inwards by `r`) grown by the corner radius.
    pub fn distance(&self, point: DVec3) -> f64 {
        let v = point - self.center;
        let z = v.dot(self.axis);
        let x = (v - self.axis * z).length() - self.center_radius;
        let ((sa, ca), (sb, cb)) = (self.bottom, self.side);
        let (along_bottom, below) = (-x * ca - z * sa, x * sa - z * ca);
        let (along_side, beside) = (x * sb + z * cb, x * cb - z * sb);
        let core = match (along_bottom >= 0.0, along_side >= 0.0) {
            (true, true) => below.max(beside),
            (true, false) => below,
            (false, true) => beside,
            (false, false) => (x * x + z * z).sqrt(),
        };
        core - self.corner_radius
    }

    /// The unit gradient of [`Body::distance`] at `point`; on the axis one of many.
    pub(super) fn gradient(&self, point: DVec3) -> DVec3 {
        let Slope { out, along: [outwards, upwards], .. } = self.slope(point);
        out * outwards + self.axis * upwards
    }

    /// The directions in which [`Body::gradient`] turns, with by how much, 1/mm. On the axis, where rings shrink to a point, it turns
    /// around as it does within the plane of the axis: so it is below a ball, and not at all below a flat bottom.
    pub(super) fn bend(&self, point: DVec3) -> [(f64, DVec3); 2] {
        let Slope { out, rho, along: [outwards, upwards], turn } = self.slope(point);
        let within = (turn, out * upwards - self.axis * outwards);
        let around = (if rho > 0.0 { outwards / rho } else { turn }, self.axis.cross(out));
        [within, around]
    }

    fn slope(&self, point: DVec3) -> Slope {
        let v = point - self.center;
        let z = v.dot(self.axis);
        let beside = v - self.axis * z;
        let rho = beside.length();
        let x = rho - self.center_radius;
        let out = if rho > 0.0 { beside / rho } else { self.axis.any_orthonormal_vector() };
        let ((sa, ca), (sb, cb)) = (self.bottom, self.side);
        let (bottom, side) = (([sa, -ca], 0.0), ([cb, -sb], 0.0));
        // Right below the middle of a ball all is corner.
        let (along, turn) = match (-x * ca - z * sa > 0.0, x * sb + z * cb > 0.0) {
            (true, true) if x * sa - z * ca < x * cb - z * sb => side,
            (true, _) => bottom,
            (false, true) => side,
            (false, false) => {
                let away = (x * x + z * z).sqrt();
                if away > 0.0 { ([x / away, z / away], 1.0 / away) } else { bottom }
            }
        };
        Slope { out, rho, along, turn }
    }
}

/// How the distance from a cutter changes at a place.
struct Slope {
    /// Unit, away from the axis.
    out: DVec3,
    /// Distance from the axis, mm.
    rho: f64,
    /// The gradient's parts away from the axis and along it.
    along: [f64; 2],
    /// By how much it turns within the plane of both, 1/mm.
    turn: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outline_is_the_zero_of_the_distance() {
        for cutter in [
            Cutter::bull_nose(10.0, 2.0, 30.0).unwrap(),
            Cutter::flat(8.0, 30.0).unwrap(),
            Cutter::ball(6.0, 30.0).unwrap(),
            Cutter::new(8.0, 1.0, 0.2, 0.15, 20.0).unwrap(),
        ] {
            let axis = DVec3::new(0.3, -0.2, 0.9).normalize();
            let across = axis.any_orthonormal_vector();
            let cl = ClPoint { tip: DVec3::new(1.0, 2.0, 3.0), axis };
            let body = Body::new(&cutter, &cl);
            for i in 0..=100 {
                let radius = cutter.largest_radius() * f64::from(i) / 100.0;
                let z = cutter.height_at(radius).unwrap();
                let on = cl.tip + across * radius + axis * z;
                assert!(body.distance(on).abs() < 1e-9, "{cutter:?} {radius}");
                assert!(body.distance(on - axis * 0.01) > 0.0);
                assert_slopes(&body, on + (across * 0.3 - axis) * 0.2);
                for (away, deep) in [(0.0, 0.5), (0.3, 0.5), (0.3, 0.2)] {
                    let below = on - axis * deep + across * deep;
                    let told = body.is_clear(below, away);
                    assert!(!told || body.distance(below) > away, "{cutter:?} {radius}");
                }
                let aside = across * 3.0 * cutter.largest_radius() - axis * (z + 1.0);
                assert!(body.is_clear(on + aside - axis, 0.1) || cutter.taper > 0.0);
            }
        }
    }

    /// Gradient and bend beside differences, along three directions and where the place is not on an edge of two kinds of outline.
    fn assert_slopes(body: &Body, p: DVec3) {
        const STEP: f64 = 1e-4;
        for d in [DVec3::X, DVec3::new(0.6, 0.8, 0.0), DVec3::new(0.0, 0.28, 0.96)] {
            let at = |k: f64| body.distance(p + d * (k * STEP));
            let slope = (at(1.0) - at(-1.0)) / (2.0 * STEP);
            assert!((slope - body.gradient(p).dot(d)).abs() < 1e-6, "{slope}");
            let bend = (at(1.0) - 2.0 * at(0.0) + at(-1.0)) / (STEP * STEP);
            let told: f64 = body.bend(p).iter().map(|(turn, along)| turn * along.dot(d).powi(2)).sum();
            let sides = [-1.0, 1.0].map(|k| body.bend(p + d * (k * STEP))[0].0);
            let is_smooth = (sides[0] > 0.0) == (sides[1] > 0.0);
            assert!(!is_smooth || (bend - told).abs() < 1e-4 * (1.0 + told.abs()), "{bend} {told}");
        }
    }
}
