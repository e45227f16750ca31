//! Where a face comes nearest to a cutter, followed down from a place nearby.

use super::body::Body;
use crate::geometry::{Domain, Face, Jet, Uv};
use glam::{DMat2, DVec2, DVec3};

/// Steps at most.
const MOST_STEPS: usize = 60;
/// The reach of a step, in those given: the first, the longest, and the shortest that is still looked at.
const FIRST_REACH: f64 = 1.0;
const MOST_REACH: f64 = 4.0;
const LEAST_REACH: f64 = 1e-3;
/// What counts as nothing lower, mm.
const SLOW: f64 = 1e-6;
/// A step is taken where it gains more than the first share of what was expected; where it gains more than the second, the next may
/// reach twice as far.
const TAKEN: f64 = 0.1;
const TRUSTED: f64 = 0.7;
/// Halvings that find by how much a step is held back.
const HALVINGS: usize = 24;

/// What is to be told of the least distance, mm: what is below `enough` is not followed further down, nor what surely ends above `above`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Asked {
    pub(super) enough: f64,
    pub(super) above: f64,
}

/// A place of a face and its distance from a cutter.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub(super) uv: Uv,
    pub(super) point: DVec3,
    /// Signed, mm.
    pub(super) distance: f64,
}

/// The place of `face` nearest to `body` that the way down from `from` leads to, as far as it is `asked` for; the way ends early where
/// `is_known` says so of a point. A step of about a cell is `step`.
///
/// By Newton's method within a reach that grows and shrinks with how well second order foretells the distance (J. Nocedal, S. J. Wright,
/// Numerical Optimization, 2nd ed. 2006, ch. 4): where curvatures nearly match, valleys are long, shallow and bent, and run aslant to
/// the parameters. Parameters at a border stay there while the way down leads out.
pub(super) fn nearest(
    face: &Face,
    body: &Body,
    from: Uv,
    step: Uv,
    asked: Asked,
    is_known: &dyn Fn(DVec3) -> bool,
) -> Place {
    let domain = face.domain();
    let look = |uv: Uv| {
        let jet = face.jet(uv);
        (Place { uv, point: jet.p, distance: body.distance(jet.p) }, jet)
    };
    let (mut here, mut jet) = look(from);
    let mut reach = FIRST_REACH;
    // The least distance that second order foretold from the place before.
    let mut foretold = None;
    for _ in 0..MOST_STEPS {
        if here.distance < asked.enough || reach < LEAST_REACH || is_known(here.point) {
            break;
        }
        let model = Model::new(body, &jet, step).held_at(&domain, here.uv, step);
        let least = model.least(reach).map(|lower| here.distance - lower);
        if here.distance >= asked.above && is_surely_above(asked.above, least, foretold) {
            break;
        }
        let way = model.way(reach);
        let gain = model.gain(way);
        if gain < SLOW || gain.is_nan() {
            break;
        }
        let next = look(domain.clamp(Uv::new(here.uv.u + way.x * step.u, here.uv.v + way.y * step.v)));
        let share = (here.distance - next.0.distance) / gain;
        if share > TAKEN {
            (here, jet) = next;
            foretold = least;
            if share > TRUSTED && way.length() > 0.9 * reach {
                reach = (2.0 * reach).min(MOST_REACH);
            }
        } else {
            reach = 0.25 * way.length();
        }
    }
    here
}

/// Whether the least distance is above `limit`: second order foretold it so from two places near to it, and by twice as much as
/// they differ.
fn is_surely_above(limit: f64, least: Option<f64>, before: Option<f64>) -> bool {
    least.zip(before).is_some_and(|(least, before)| least - limit > 2.0 * (least - before).abs())
}

/// The distance near a place to second order, over steps of a cell in both parameters.
struct Model {
    slope: DVec2,
    bend: DMat2,
}

impl Model {
    fn new(body: &Body, jet: &Jet, step: Uv) -> Self {
        let (normal, bend) = (body.gradient(jet.p), body.bend(jet.p));
        let (du, dv) = (jet.du * step.u, jet.dv * step.v);
        let second = [jet.duu * (step.u * step.u), jet.duv * (step.u * step.v), jet.dvv * (step.v * step.v)];
        let [uu, uv, vv] = [(du, du), (du, dv), (dv, dv)].map(|(a, b)| {
            bend.iter().map(|(curvature, along)| curvature * a.dot(*along) * b.dot(*along)).sum::<f64>()
        });
        let [uu, uv, vv] =
            [uu + normal.dot(second[0]), uv + normal.dot(second[1]), vv + normal.dot(second[2])];
        Self {
            slope: DVec2::new(normal.dot(du), normal.dot(dv)),
            bend: DMat2::from_cols_array(&[uu, uv, uv, vv]),
        }
    }

    /// The same, where the way down does not lead out over a border on which `at` lies.
    fn held_at(mut self, domain: &Domain, at: Uv, step: Uv) -> Self {
        let ranges = [(&domain.u, at.u, step.u), (&domain.v, at.v, step.v)];
        for (k, (range, x, step)) in ranges.into_iter().enumerate() {
            let near = LEAST_REACH * step;
            let is_out = (x - range.lo <= near && self.slope[k] > 0.0)
                || (range.hi - x <= near && self.slope[k] < 0.0);
            if !range.periodic && is_out {
                self.slope[k] = 0.0;
                self.bend.col_mut(1 - k)[k] = 0.0;
                self.bend.col_mut(k)[1 - k] = 0.0;
                self.bend.col_mut(k)[k] = self.bend.col(k)[k].abs();
            }
        }
        self
    }

    /// By how much the lowest place of the model is lower; `None` where it is no bowl, or lowest beyond the `reach`.
    fn least(&self, reach: f64) -> Option<f64> {
        let is_bowl = self.bend.determinant() > 0.0 && self.bend.x_axis.x > 0.0;
        let way = is_bowl.then(|| self.bend.inverse() * self.slope);
        way.filter(|way| way.length() <= reach).map(|way| 0.5 * self.slope.dot(way))
    }

    /// By how much the model is lower one `way` on.
    fn gain(&self, way: DVec2) -> f64 {
        -self.slope.dot(way) - 0.5 * way.dot(self.bend * way)
    }

    /// The way to the lowest place of the model within `reach`.
    fn way(&self, reach: f64) -> DVec2 {
        let [xx, xy, yy] = [self.bend.x_axis.x, self.bend.x_axis.y, self.bend.y_axis.y];
        let (mean, half) = (0.5 * (xx + yy), 0.5 * (xx - yy));
        let least_bend = mean - (half * half + xy * xy).sqrt();
        let held =
            |more: f64| -((self.bend + DMat2::from_diagonal(DVec2::splat(more))).inverse() * self.slope);
        if least_bend > 0.0 {
            let way = held(0.0);
            if way.length() <= reach {
                return way;
            }
        }
        // Held back by so much every way is shorter than the reach, and by the other most are longer.
        let mut low = (-least_bend).max(0.0);
        let mut high = low + self.slope.length() / reach;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            *(if held(middle).length() > reach { &mut low } else { &mut high }) = middle;
        }
        held(high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cutter::Cutter;
    use crate::geometry::{NurbsSurface, Side};
    use crate::toolpath::ClPoint;

    const ASKED: Asked = Asked { enough: f64::NEG_INFINITY, above: f64::INFINITY };

    /// A valley that runs aslant and bends, 40 × 40 mm.
    fn valley() -> Face {
        let knots = vec![0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0, 1.0];
        let at = |k: usize| 40.0 * (k % 5) as f64 / 4.0 - 20.0;
        let points: Vec<DVec3> = (0..25)
            .map(|k| {
                let (x, y) = (at(k / 5), at(k));
                let across = x - 0.7 * y + 0.012 * y * y;
                DVec3::new(x, y, 0.018 * across * across)
            })
            .collect();
        Face::new(NurbsSurface::new([3, 3], [knots.clone(), knots], &points, None).unwrap(), Side::Front)
    }

    /// The least distance on a fine grid, and where.
    fn looked_for(face: &Face, body: &Body) -> (f64, Uv) {
        let places =
            (0..=400 * 400).map(|k| face.domain().at((k % 401) as f64 / 400.0, (k / 401) as f64 / 400.0));
        let all = places.map(|uv| (body.distance(face.surface.point(uv)), uv));
        all.fold((f64::INFINITY, Uv::default()), |least, next| if next.0 < least.0 { next } else { least })
    }

    #[test]
    fn the_way_down_a_bent_valley_ends_where_it_is_lowest() {
        let face = valley();
        for (cutter, lead) in [
            (Cutter::bull_nose(20.0, 3.0, 40.0).unwrap(), 0.3),
            (Cutter::ball(12.0, 40.0).unwrap(), 0.0),
            (Cutter::conical(16.0, 2.0, 0.2, 30.0).unwrap(), 0.1),
        ] {
            for turn in 0..6 {
                let (s, c) = libm::sincos(f64::from(turn));
                let axis = DVec3::new(libm::sin(lead) * c, libm::sin(lead) * s, libm::cos(lead));
                let body = Body::new(&cutter, &ClPoint { tip: DVec3::new(2.0 * c, 3.0 * s, 6.0), axis });
                let (least, beside) = looked_for(&face, &body);
                let start = face.domain().clamp(Uv::new(beside.u + 0.06, beside.v + 0.06));
                let step = Uv::new(0.02, 0.02);
                let end = nearest(&face, &body, start, step, ASKED, &|_| false);
                assert!(end.distance < least + 1e-5, "{turn}: {} {least}", end.distance);
                // What is surely above is told so on the way, and never by mistake.
                for above in [1e-3, -1e-3].map(|more| end.distance + more) {
                    let told = nearest(&face, &body, start, step, Asked { above, ..ASKED }, &|_| false);
                    assert!(
                        (told.distance < above) == (end.distance < above),
                        "{turn}: {} {above}",
                        told.distance
                    );
                }
            }
        }
    }

    #[test]
    fn at_a_border_the_way_goes_on_along_it() {
        let face = valley();
        let cutter = Cutter::ball(12.0, 40.0).unwrap();
        let body = Body::new(&cutter, &ClPoint { tip: DVec3::new(23.0, 4.0, 8.0), axis: DVec3::Z });
        let (least, at) = looked_for(&face, &body);
        assert_eq!(at.u, 1.0);
        let end = nearest(&face, &body, Uv::new(0.9, 0.5), Uv::new(0.02, 0.02), ASKED, &|_| false);
        assert!((end.distance - least).abs() < 1e-4 && end.uv.u == 1.0, "{} {least}", end.distance);
    }
}
