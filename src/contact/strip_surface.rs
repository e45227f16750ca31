//! Exact strip over the real surface.

use super::envelope::Sweep;
use super::half_strip::{HalfStrip, Reading, Search, search};
use super::lifted_strip::search_lifted;
use super::relative::second_order_strip_width;
use crate::cutter::Cutter;
use crate::geometry::{Curvature, Domain, Face, Jet, Uv};
use crate::toolpath::CcPoint;
use glam::DVec3;

/// One edge of a strip on a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Edge {
    /// The cusp reaches the limit here.
    Reached(Uv),
    /// The strip runs over the face's border, which it meets near here.
    Border(Uv),
    /// The cutter digs in beside its contact, as deep as this (mm, negative).
    Gouge(f64),
}

/// The strip that one contact point finishes on a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaceStrip {
    /// The `+b` side.
    pub left: Edge,
    /// The `−b` side.
    pub right: Edge,
    /// How low the cutter comes beside a contact that it is lifted off, mm above the surface; 0 where it is not lifted.
    pub lowest: f64,
}

/// What a strip is measured with.
#[derive(Debug, Clone, Copy)]
pub struct StripLimits {
    /// Height of the cusp at the strip's edge, mm, above 0.
    pub scallop: f64,
    /// How deep the cutter may dig beside its contact before it counts as a gouge, mm.
    pub gouge: f64,
}

/// Share of the scallop to which an edge is found.
const ACCURACY: f64 = 1e-3;
/// A foot is found when the point is no farther beside the normal at the place looked at than this share of the half
/// strip, nor than this many mm: from there the second derivatives lead on, so that the height errs by the cube of it, a
/// sixth of it at the most, times the change of the curvature over a millimetre.
const NEAR_SHARE: f64 = 0.01;
const NEAR: f64 = 0.01;
/// What counts as a lift, mm: less is rounding.
const LEAST_LIFT: f64 = 1e-6;

/// The exact strip about the contact `cc` at `uv` on `face`, while the contact moves along its feed at unit speed and
/// its frame turns by `spin` (radians per mm, in world axes).
///
/// The envelope is that of the true motion and the height is taken along the face's own normal, with no model in
/// between. An edge is found to a thousandth of the scallop. Where `cc` stands above the face, the cutter is lifted by as much:
/// then the height falls from there, to about 0 where both sides of a hollow are touched, before it rises to the edge. A lift
/// below a nanometre is none. `None` at a pole.
pub fn face_strip(
    face: &Face,
    cutter: &Cutter,
    cc: &CcPoint,
    uv: Uv,
    spin: DVec3,
    limits: StripLimits,
) -> Option<FaceStrip> {
    let (jet, n) = face.at(uv)?;
    let surface = Curvature::of(&jet, &cc.frame)?;
    let expected = 0.5 * second_order_strip_width(cutter, cc.posture, &surface, limits.scallop);
    let sweep = Sweep::new(cutter, cc, cc.frame.f, spin);
    let lift = (cc.point - jet.p).dot(n);
    let domain = face.domain();
    let edge = |left: bool| {
        let sign = if left { 1.0 } else { -1.0 };
        let toward = sweep.left(cc.frame.b) * sign;
        let near = NEAR.min(NEAR_SHARE * expected);
        let mut foot = Foot { face, domain, base: uv, jet, n, near, uv };
        let mut read = |theta: f64| {
            let e = sweep.point(theta);
            let side = (e - cc.point).dot(cc.frame.b) * sign;
            Reading { height: foot.height(e).unwrap_or(f64::NAN), side }
        };
        let how = Search {
            scallop: limits.scallop,
            gouge: limits.gouge,
            expected,
            speed: sweep.departure(toward).dot(cc.frame.b) * sign,
            toward,
            accuracy: ACCURACY,
        };
        let (end, lowest) = if lift < LEAST_LIFT {
            (search(&mut read, how), 0.0)
        } else {
            search_lifted(&mut read, how, cutter, (cc.posture.lead, lift))
        };
        let edge = match end {
            HalfStrip::Reached { theta, .. } => Edge::Reached(foot.at(sweep.point(theta))),
            HalfStrip::Whole { .. } => Edge::Reached(foot.uv),
            HalfStrip::Border { theta } => {
                let last = foot.at(sweep.point(theta));
                if domain.u.is_near_end(last.u) || domain.v.is_near_end(last.v) {
                    Edge::Border(last)
                } else {
                    Edge::Reached(last)
                }
            }
            HalfStrip::Gouge { height } => Edge::Gouge(height),
        };
        (edge, lowest)
    };
    let [(left, low_left), (right, low_right)] = [edge(true), edge(false)];
    Some(FaceStrip { left, right, lowest: low_left.min(low_right) })
}

/// A way in the parameters, and where it leads.
struct Step {
    u: f64,
    v: f64,
    /// Square of its length on the surface, to first order.
    way_squared: f64,
    /// Height over the surface at its end.
    height: f64,
}

/// The foot of a moving point on a face, followed from call to call.
struct Foot<'a> {
    face: &'a Face,
    domain: Domain,
    /// Where the surface was looked at last.
    base: Uv,
    jet: Jet,
    n: DVec3,
    /// How far from there, mm, its second derivatives are trusted.
    near: f64,
    uv: Uv,
}

impl Foot<'_> {
    /// Height of `e` over the face along its normal; `None` where its foot lies outside the face or none is found.
    fn height(&mut self, e: DVec3) -> Option<f64> {
        let mut clamped = false;
        for _ in 0..20 {
            let away = e - self.jet.p;
            let step = self.step(away)?;
            let next = Uv::new(self.base.u + step.u, self.base.v + step.v);
            let out = !self.domain.contains(next);
            if !out && step.way_squared <= self.near * self.near {
                self.uv = next;
                return Some(step.height);
            }
            if out && clamped {
                return None;
            }
            clamped = out;
            self.base = self.domain.clamp(next);
            self.jet = self.face.jet(self.base);
            self.n = self.face.normal(&self.jet)?;
        }
        None
    }

    /// From the base to the foot of a point `away` from it, by the surface's second derivatives; `None` at a pole.
    fn step(&self, away: DVec3) -> Option<Step> {
        let Self { jet, n, .. } = self;
        let (u, v) = jet.pull_back(away)?;
        let (rise_u, rise_v) = (jet.duu * u + jet.duv * v, jet.duv * u + jet.dvv * v);
        let way_squared = (jet.du * u + jet.dv * v).length_squared();
        let bend = (rise_u * u + rise_v * v) * 0.5;
        let height = (away - bend).dot(*n);
        // Where the surface bends as much as that, the next place looked at tells more.
        if bend.length_squared() > 0.1 * way_squared {
            return Some(Step { u, v, way_squared, height });
        }
        // The normal turns along the way, and what stands above the surface moves with it.
        let rest = away - bend;
        let (a, b) = (jet.du.dot(rest) + height * rise_u.dot(*n), jet.dv.dot(rest) + height * rise_v.dot(*n));
        let (u, v) = jet.raise(a, b)?;
        Some(Step { u, v, way_squared, height })
    }

    fn at(&mut self, e: DVec3) -> Uv {
        self.height(e);
        self.uv
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::model_strip;
    use crate::geometry::{Cylinder, Plane, Range, Side, Sphere, Surface};
    use crate::math::frame::Frame;
    use crate::toolpath::Posture;

    const LIMITS: StripLimits = StripLimits { scallop: 0.5, gouge: 1e-3 };
    const WORLD: Frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };

    fn mill(center_radius: f64, corner_radius: f64) -> Cutter {
        Cutter::bull_nose(2.0 * (center_radius + corner_radius), corner_radius, 100.0).unwrap()
    }

    fn chord(face: &Face, strip: FaceStrip) -> f64 {
        let (Edge::Reached(l), Edge::Reached(r)) = (strip.left, strip.right) else { panic!("{strip:?}") };
        face.jet(l).p.distance(face.jet(r).p)
    }

    /// The strip across a cylinder of `radius`, feed along its axis, cut on `side` with `lead` degrees.
    fn on_cylinder(radius: f64, side: Side, center_radius: f64, lead: f64, h: f64) -> f64 {
        let cylinder = Cylinder::new(DVec3::ZERO, WORLD, radius, [-1.0, 1.0], [-50.0, 50.0]).unwrap();
        let face = Face::new(cylinder, side);
        let uv = Uv::new(0.0, 0.0);
        let (jet, n) = face.at(uv).unwrap();
        let frame = Frame::from_normal(n, DVec3::Z).unwrap();
        let posture = Posture { lead: lead.to_radians(), yaw: 0.0 };
        let cc = CcPoint { point: jet.p, frame, posture };
        let limits = StripLimits { scallop: h, gouge: 1e-3 };
        chord(&face, face_strip(&face, &mill(center_radius, 2.0), &cc, uv, DVec3::ZERO, limits).unwrap())
    }

    #[test]
    fn cylinders_by_lead() {
        // Chords over convex and concave cylinders, r = 2, feed along the axis.
        for (radius, side, r1, lead, h, expected) in [
            (30.0, Side::Front, 1.0, 15.0, 0.5, 3.8201),
            (30.0, Side::Front, 1.0, 30.0, 0.5, 3.4813),
            (30.0, Side::Front, 1.0, 45.0, 0.5, 3.2999),
            (30.0, Side::Back, 1.0, 15.0, 0.5, 4.3745),
            (30.0, Side::Back, 1.0, 30.0, 0.5, 3.9694),
            (30.0, Side::Back, 1.0, 45.0, 0.5, 3.7378),
            (15.0, Side::Back, 1.0, 15.0, 0.5, 4.7073),
            (15.0, Side::Back, 1.0, 30.0, 0.5, 4.2725),
            (15.0, Side::Back, 1.0, 45.0, 0.5, 4.0104),
            (30.0, Side::Front, 3.0, 5.0, 0.01, 1.1449),
            (30.0, Side::Back, 3.0, 15.0, 0.01, 1.3996),
            (15.0, Side::Back, 3.0, 15.0, 0.01, 2.8933),
        ] {
            let found = on_cylinder(radius, side, r1, lead, h);
            let (s, t) = (found, expected);
            assert!((s / t - 1.0).abs() < 1e-3, "{radius} {side:?} {lead}: chord {s}, expected {t}");
        }
    }

    #[test]
    fn agrees_with_the_model_on_a_sphere() {
        let radius = 80.0;
        let face =
            Face::new(Sphere::new(DVec3::ZERO, WORLD, radius, [-1.0, 1.0], [-1.0, 1.0]).unwrap(), Side::Back);
        let uv = Uv::new(0.1, 0.2);
        let (jet, n) = face.at(uv).unwrap();
        let frame = Frame::from_normal(n, DVec3::new(0.3, 1.0, 0.2)).unwrap();
        let posture = Posture { lead: 0.2, yaw: -0.5 };
        let cc = CcPoint { point: jet.p, frame, posture };
        let k = 1.0 / radius;
        let limits = StripLimits { scallop: 0.01, gouge: 1e-3 };
        let cutter = mill(9.5, 3.0);
        let strip = face_strip(&face, &cutter, &cc, uv, frame.b * -k, limits).unwrap();
        let (l, r) =
            model_strip(&cutter, posture, &Curvature { ff: k, fb: 0.0, bb: k }, 0.01).half_widths().unwrap();
        // With yaw the two edges are cut at different instants, so they are compared across the feed.
        let (Edge::Reached(left), Edge::Reached(right)) = (strip.left, strip.right) else { panic!() };
        let across = |uv| (face.jet(uv).p - cc.point).dot(frame.b);
        assert!((across(left) / l - 1.0).abs() < 3e-3, "{} {l}", across(left));
        assert!((-across(right) / r - 1.0).abs() < 3e-3, "{} {r}", -across(right));
    }

    #[test]
    fn strip_ends_at_the_border() {
        let plane = Plane {
            origin: DVec3::ZERO,
            frame: WORLD,
            u: Range::open(-10.0, 10.0),
            v: Range::open(-10.0, 1.0),
        };
        assert!(plane.domain().contains(Uv::new(0.0, 1.0)));
        let face = Face::new(plane, Side::Front);
        let cc = CcPoint {
            point: DVec3::ZERO,
            frame: WORLD,
            posture: Posture { lead: 15f64.to_radians(), yaw: 0.0 },
        };
        let strip = face_strip(&face, &mill(1.0, 2.0), &cc, Uv::new(0.0, 0.0), DVec3::ZERO, LIMITS).unwrap();
        assert!(matches!(strip.left, Edge::Border(uv) if uv.v > 0.99), "{strip:?}");
        assert!(matches!(strip.right, Edge::Reached(uv) if (uv.v + 2.04).abs() < 0.01), "{strip:?}");
    }
}
