//! The length that no finishing path of its class can stay below: `∬ dA / w_max`.
//!
//! `w_max` is the widest strip at a place, over all directions of feed and all postures of the class. Nothing here is the planner's: the
//! cutter is the solid that [`super::verify`] cuts with, set on the surface by its support, moved along, and asked what it leaves.

use super::body::Body;
use crate::cutter::Cutter;
use crate::geometry::{Curvature, Face, FaceGrid};
use crate::math::frame::Frame;
use crate::monitor::{Cancelled, Stage};
use glam::DVec3;
use std::f64::consts::PI;

/// Cells a side of the grid at whose nodes strips are measured.
const CELLS: usize = 24;
/// Directions of feed in half a turn; postures lean by as much apart.
const DIRECTIONS: usize = 16;
/// Where the cutter is asked whether it digs in beside its contact: so far from it, in cutter radii, in so many directions.
const BESIDE: f64 = 0.03;
const AROUND: usize = 16;
/// Halvings of a lead and of a half width.
const HALVINGS: usize = 16;
/// Steps, each to two thirds of the last, in which the instant is found at which the cutter comes nearest to a place.
const THIRDS: usize = 16;
/// First step beside the contact, in half strips of the corner alone, and by how much steps grow.
const STEP: f64 = 0.4;
const GROWTH: f64 = 1.12;

/// Which postures a path may have. One contact at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Class {
    /// Always these, radians.
    Fixed {
        /// Lead.
        lead: f64,
        /// Yaw.
        yaw: f64,
    },
    /// Any within these limits, radians, with the least lead at which the cutter does not dig in beside its contact: more
    /// makes strips narrower.
    Free {
        /// Least lead.
        least_lead: f64,
        /// Most lead.
        most_lead: f64,
        /// Most yaw to either side.
        most_yaw: f64,
    },
}

/// The floor and what it is for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Floor {
    /// No path of the class is shorter, mm.
    pub length: f64,
    /// The area that it counts, mm²: where some posture of the class does not dig in beside its contact.
    pub area: f64,
}

/// The floor of the paths that finish `face` with `cutter` to cusps of `scallop` (mm).
///
/// The surface counts to second order at every node, so that the floor is one up to what it bends beyond that over a strip. Where
/// the cutter fits in no posture of the class the area does not count.
pub fn floor(
    face: &Face,
    cutter: &Cutter,
    class: Class,
    scallop: f64,
    stage: &Stage,
) -> Result<Floor, Cancelled> {
    let grid = FaceGrid::new(face, f64::INFINITY, CELLS, CELLS);
    let (nu, nv) = grid.size();
    let body = Body::new(cutter, 0.0);
    let widest = |k: usize| {
        let (jet, n) = face.at(grid.uv(k % nu, k / nu))?;
        let frame = Frame::from_normal(n, jet.du).unwrap_or_else(|| Frame::any(n));
        let ground = Ground { body: &body, k: Curvature::of(&jet, &frame)?, scallop };
        ground.widest(class)
    };
    let widths = stage.map(nu * nv, widest)?;
    let mut floor = Floor { length: 0.0, area: 0.0 };
    for j in 0..nv - 1 {
        for i in 0..nu - 1 {
            let corners = [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)].map(|(i, j)| widths[j * nu + i]);
            let quarter = 0.25 * grid.cell_area(i, j);
            for width in corners.into_iter().flatten() {
                floor.length += quarter / width;
                floor.area += quarter;
            }
        }
    }
    Ok(floor)
}

/// A cutter over the surface `z = ½ (ff x² + 2 fb x y + bb y²)`.
struct Ground<'a> {
    body: &'a Body,
    k: Curvature,
    scallop: f64,
}

/// Where a cutter stands.
#[derive(Clone, Copy)]
struct Place {
    tip: DVec3,
    axis: DVec3,
}

impl Ground<'_> {
    /// The widest strip of the class, mm; `None` where every posture digs in.
    fn widest(&self, class: Class) -> Option<f64> {
        let turn = PI / DIRECTIONS as f64;
        let along = |d: usize| Self { k: self.k.turned(turn * d as f64), ..*self };
        match class {
            Class::Fixed { lead, yaw } => {
                let widths = (0..DIRECTIONS).filter_map(|d| {
                    let ground = along(d);
                    (!ground.digs_in(lead, yaw)).then(|| ground.strip(lead, yaw))
                });
                widths.reduce(f64::max)
            }
            Class::Free { least_lead, most_lead, most_yaw } => {
                // By the direction in which the axis leans, whatever the feed.
                let lean = |d: usize| along(d).least_lead(least_lead, most_lead);
                let leads: Vec<Option<f64>> = (0..2 * DIRECTIONS).map(lean).collect();
                let aside = (most_yaw / turn) as usize;
                let mut best: Option<f64> = None;
                for d in 0..DIRECTIONS {
                    let ground = along(d);
                    for y in 0..=2 * aside {
                        let at = (d + 2 * DIRECTIONS + y - aside) % (2 * DIRECTIONS);
                        let yaw = turn * (y as f64 - aside as f64);
                        let width = leads[at].map(|lead| ground.strip(lead, yaw));
                        best = best.into_iter().chain(width).reduce(f64::max);
                    }
                }
                best
            }
        }
    }

    /// The least lead, leaning along the feed, at which the cutter does not dig in beside its contact.
    fn least_lead(&self, least: f64, most: f64) -> Option<f64> {
        if !self.digs_in(least, 0.0) {
            return Some(least);
        }
        if self.digs_in(most, 0.0) {
            return None;
        }
        let (mut low, mut high) = (least, most);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            *(if self.digs_in(middle, 0.0) { &mut low } else { &mut high }) = middle;
        }
        Some(high)
    }

    /// Whether the cutter reaches into the surface right beside its contact.
    fn digs_in(&self, lead: f64, yaw: f64) -> bool {
        let place = self.place(lead, yaw, 0.0);
        let far = BESIDE * self.body.largest_radius();
        (0..AROUND).any(|a| {
            let (s, c) = libm::sincos(2.0 * PI * a as f64 / AROUND as f64);
            self.distance(&place, self.point(far * c, far * s)) < -1e-9 * far
        })
    }

    /// The width of the strip that is cut within the scallop, mm.
    fn strip(&self, lead: f64, yaw: f64) -> f64 {
        self.half(lead, yaw, 1.0) + self.half(lead, yaw, -1.0)
    }

    fn half(&self, lead: f64, yaw: f64, side: f64) -> f64 {
        let most = 2.0 * self.body.largest_radius();
        let first =
            STEP * (2.0 * self.scallop * self.body.inscribed().max(0.1 * self.body.largest_radius())).sqrt();
        let (mut low, mut high, mut step) = (0.0, first, first);
        while self.is_cut(lead, yaw, side * high) {
            step *= GROWTH;
            (low, high) = (high, high + step);
            if high > most {
                return most;
            }
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            *(if self.is_cut(lead, yaw, side * middle) { &mut low } else { &mut high }) = middle;
        }
        low
    }

    /// Whether the cutter, on its way along the surface over `y = 0`, cuts what stands a scallop above the surface at `(0, y)`.
    fn is_cut(&self, lead: f64, yaw: f64, y: f64) -> bool {
        let top = self.point(0.0, y) + self.normal(0.0, y) * self.scallop;
        let away = |t: f64| self.distance(&self.place(lead, yaw, t), top);
        let most = self.body.largest_radius().max(y.abs());
        let (mut low, mut high) = (-most, most);
        for _ in 0..THIRDS {
            let (one, two) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            let (at_one, at_two) = (away(one), away(two));
            if at_one <= 0.0 || at_two <= 0.0 {
                return true;
            }
            *(if at_one < at_two { &mut high } else { &mut low }) = if at_one < at_two { two } else { one };
        }
        away(0.5 * (low + high)) <= 0.0
    }

    fn point(&self, x: f64, y: f64) -> DVec3 {
        let k = &self.k;
        DVec3::new(x, y, 0.5 * (k.ff * x * x + 2.0 * k.fb * x * y + k.bb * y * y))
    }

    fn normal(&self, x: f64, y: f64) -> DVec3 {
        let k = &self.k;
        DVec3::new(-(k.ff * x + k.fb * y), -(k.fb * x + k.bb * y), 1.0).normalize()
    }

    /// Where the cutter stands that touches the surface over `(t, 0)`: what of it lies farthest against the normal is there.
    fn place(&self, lead: f64, yaw: f64, t: f64) -> Place {
        let n = self.normal(t, 0.0);
        let f = DVec3::new(1.0, 0.0, self.k.ff * t).normalize();
        let ((sl, cl), (sy, cy)) = (libm::sincos(lead), libm::sincos(yaw));
        let axis = n * cl + (f * cy + n.cross(f) * sy) * sl;
        let outward = (axis * n.dot(axis) - n).try_normalize().unwrap_or(f);
        let (radius, height) = self.body.support(-n.dot(outward), -n.dot(axis));
        Place { tip: self.point(t, 0.0) - outward * radius - axis * height, axis }
    }

    fn distance(&self, place: &Place, point: DVec3) -> f64 {
        let from = point - place.tip;
        let height = from.dot(place.axis);
        self.body.distance((from - place.axis * height).length(), height)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Cylinder, Plane, Range, Side};

    const WORLD: Frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };

    fn of(face: &Face, cutter: &Cutter, class: Class) -> Floor {
        floor(face, cutter, class, 0.01, &Stage::silent()).unwrap()
    }

    /// `../data/reference` has the exact strips of a straight feed: R1 = 3, r = 2, h = 0.01.
    #[test]
    fn on_a_plane_and_a_rod_it_is_the_area_by_the_known_strips() {
        let cutter = Cutter::bull_nose(10.0, 2.0, 40.0).unwrap();
        let range = Range::open(0.0, 20.0);
        let plane = Face::new(Plane { origin: DVec3::ZERO, frame: WORLD, u: range, v: range }, Side::Front);
        let five = 5f64.to_radians();
        let fixed = of(&plane, &cutter, Class::Fixed { lead: five, yaw: 0.0 });
        assert!((fixed.length * 1.6923 / 400.0 - 1.0).abs() < 1e-3, "{fixed:?}");
        // A hollow of 15 mm at 15°, fed along it, and that is the best of all directions.
        let trough = Cylinder::new(DVec3::ZERO, WORLD, 15.0, [0.0, 1.0], [0.0, 20.0]).unwrap();
        let trough = Face::new(trough, Side::Back);
        let lead = 15f64.to_radians();
        let fixed = of(&trough, &cutter, Class::Fixed { lead, yaw: 0.0 });
        // Over a strip so wide the circle rises above its parabola by a sixtieth of the scallop.
        assert!((fixed.length * 2.8933 / fixed.area - 1.0).abs() < 8e-3, "{fixed:?}");
        // Choosing never makes it longer; and a hollow tighter than the corner takes the cutter in no posture.
        let class = Class::Free { least_lead: 0.03, most_lead: 0.8, most_yaw: 0.5 };
        let free = of(&trough, &cutter, class);
        assert!(free.length < fixed.length && (free.area / fixed.area - 1.0).abs() < 1e-9, "{free:?}");
        let groove = Cylinder::new(DVec3::ZERO, WORLD, 1.8, [0.0, 1.0], [0.0, 20.0]).unwrap();
        assert_eq!(of(&Face::new(groove, Side::Back), &cutter, class).area, 0.0);
    }

    #[test]
    fn a_ball_has_the_strips_of_its_radius_whatever_way_it_leans() {
        let cutter = Cutter::ball(6.0, 40.0).unwrap();
        let rod = Cylinder::new(DVec3::ZERO, WORLD, 20.0, [0.0, 1.0], [0.0, 20.0]).unwrap();
        let rod = Face::new(rod, Side::Front);
        // Fed round the rod the strip is that of a plane: 2 √(2 r h − h²).
        let wanted = 2.0 * (6.0f64 * 0.01 - 1e-4).sqrt();
        for yaw in [0.0, 0.7] {
            let found = of(&rod, &cutter, Class::Fixed { lead: 0.2, yaw });
            assert!((found.length * wanted / found.area - 1.0).abs() < 1e-3, "{found:?} {wanted}");
        }
    }
}
