//! The cutter as a solid.

use crate::cutter::Cutter;
use glam::DVec2;

/// The cutter and its shank: a convex core of revolution, grown by the corner radius.
///
/// The core's outline in the half plane (radius, height above the tip) runs from the axis along the bottom line's
/// offset to the corner's centre `(e, f)`, up the side line's offset, and on up the shank, a cylinder of the cutter's
/// largest radius that ends `shank` above the height `h`. Growing it restores bottom, corner and side exactly; the point
/// of a conical bottom, which growing would blunt, is put back. Where a
/// widening side meets the shank, the edge is rounded with the corner radius, within `r (1/cos(β/2) − 1)` of the sharp one.
/// A side that narrows upwards (β < 0) ends at the height `h` and has no shank: with one the solid would not be convex.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    edges: Vec<Edge>,
    round: f64,
    pointed: bool,
    largest: f64,
    top: f64,
    working: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Edge {
    from: DVec2,
    along: DVec2,
    length: f64,
    outward: DVec2,
}

/// Signed distance to the body and its gradient in the half plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Distance {
    pub(super) value: f64,
    pub(super) by_radius: f64,
    pub(super) by_height: f64,
}

impl Body {
    /// The solid of `cutter` with `shank` millimetres above its height.
    pub fn new(cutter: &Cutter, shank: f64) -> Self {
        let r = cutter.corner_radius;
        let (sa, ca) = libm::sincos(cutter.taper);
        let corner = DVec2::new(cutter.center_radius, cutter.center_height);
        let mut outline = vec![DVec2::new(0.0, r / libm::cos(cutter.bottom_angle)), corner];
        // The side's length from the corner's end to the height h, and the core's end beside it.
        let (_, end_height) = cutter.corner_end();
        let rise = ((cutter.height - end_height) / ca).max(0.0);
        let side = DVec2::new(sa, ca);
        let top = if cutter.taper < 0.0 {
            // Not past the axis.
            let reach = if corner.x + side.x * rise < 0.0 { -corner.x / side.x } else { rise };
            let end = corner + side * reach;
            outline.push(end);
            end.y
        } else {
            let shank_core = (cutter.largest_radius() - r).max(corner.x);
            let climb = if sa > 0.0 { (shank_core - corner.x) / sa } else { 0.0 };
            let shoulder = DVec2::new(shank_core, corner.y + ca * climb);
            let top = (cutter.height + shank.max(0.0) - r).max(shoulder.y);
            outline.extend([shoulder, DVec2::new(shank_core, top)]);
            top
        };
        outline.push(DVec2::new(0.0, top));
        // A core as thin as its axis still has a lower and an upper end.
        let (sb, cb) = libm::sincos(cutter.bottom_angle);
        let last = outline.len() - 2;
        let edge = |i: usize| match i {
            // From the tip's own offset, beyond the axis: a conical bottom ends in a point, not in a ball.
            0 => Some(Edge::towards(
                DVec2::new(-r * sb, r * cb),
                DVec2::new(cb, sb),
                corner.x / cb + r * sb / cb,
            )),
            i if i == last => Some(Edge::towards(outline[i], DVec2::NEG_X, outline[i].x)),
            i => (outline[i + 1] - outline[i])
                .try_normalize()
                .map(|along| Edge::towards(outline[i], along, outline[i].distance(outline[i + 1]))),
        };
        let edges = (0..=last).filter_map(edge).collect();
        let widest = outline.iter().map(|p| p.x).fold(0.0, f64::max);
        Self {
            edges,
            round: r,
            pointed: cutter.bottom_angle > 0.0,
            largest: widest + r,
            top: top + r,
            working: cutter.height,
        }
    }

    /// Largest radius, millimetres.
    pub fn largest_radius(&self) -> f64 {
        self.largest
    }

    /// Height of the highest point above the tip, millimetres.
    pub fn top(&self) -> f64 {
        self.top
    }

    /// Radius of a ball that fits into the body at every point of its boundary: the corner radius, or 0 with a pointed
    /// bottom.
    pub(super) fn inscribed(&self) -> f64 {
        if self.pointed { 0.0 } else { self.round }
    }

    /// Farthest that a point of the cutting part is from the tip.
    pub(super) fn reach(&self) -> f64 {
        libm::hypot(self.largest, self.working)
    }

    /// Radius and height above the tip of the point of the body that lies farthest in a direction with these components away from
    /// the axis and up it, the first not negative.
    pub(super) fn support(&self, outwards: f64, up: f64) -> (f64, f64) {
        let ends = self.edges.iter().flat_map(|edge| [edge.from, edge.from + edge.along * edge.length]);
        let far = |p: &DVec2| p.x * outwards + p.y * up;
        let best = ends.filter(|p| p.x >= 0.0).reduce(|best, p| if far(&p) > far(&best) { p } else { best });
        let best = best.unwrap_or(DVec2::ZERO);
        (best.x + self.round * outwards, best.y + self.round * up)
    }

    /// Signed distance (mm, negative inside) of the point at `radius` from the axis and `height` above the tip. It is a
    /// convex function of the point in space.
    pub fn distance(&self, radius: f64, height: f64) -> f64 {
        self.probe(radius, height).value
    }

    pub(super) fn probe(&self, radius: f64, height: f64) -> Distance {
        let at = DVec2::new(radius, height);
        let mut inside = (f64::NEG_INFINITY, DVec2::ZERO);
        let mut vertex = (f64::INFINITY, DVec2::ZERO);
        for (i, edge) in self.edges.iter().enumerate() {
            let from = at - edge.from;
            let out = from.dot(edge.outward);
            if out > inside.0 {
                inside = (out, edge.outward);
            }
            if out > 0.0 {
                let along = from.dot(edge.along);
                if (0.0..=edge.length).contains(&along) {
                    return self.grown(out, edge.outward);
                }
                if i == 0 && along < 0.0 {
                    let distance = at.length();
                    return self.grown(distance + self.round, at / distance);
                }
                let away = if along < 0.0 { from } else { from - edge.along * edge.length };
                let square = away.length_squared();
                if square < vertex.0 {
                    vertex = (square, away);
                }
            }
        }
        if vertex.0 < f64::INFINITY {
            let distance = vertex.0.sqrt();
            return self.grown(distance, if distance > 0.0 { vertex.1 / distance } else { inside.1 });
        }
        self.grown(inside.0, inside.1)
    }

    fn grown(&self, core: f64, gradient: DVec2) -> Distance {
        Distance { value: core - self.round, by_radius: gradient.x, by_height: gradient.y }
    }
}

impl Edge {
    fn towards(from: DVec2, along: DVec2, length: f64) -> Self {
        Self { from, along, length, outward: DVec2::new(along.y, -along.x) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cutters_outline_is_where_the_distance_vanishes() {
        let cutters = [
            Cutter::flat(10.0, 30.0),
            Cutter::ball(10.0, 30.0),
            Cutter::bull_nose(10.0, 2.0, 30.0),
            Cutter::tapered(4.0, 1.0, 0.1, 25.0),
            Cutter::conical(12.0, 1.5, 0.3, 20.0),
            Cutter::new(8.0, 1.0, 0.2, 0.15, 20.0),
            Cutter::new(8.0, 1.0, 0.0, -0.15, 20.0),
        ];
        for cutter in cutters.map(Result::unwrap) {
            let body = Body::new(&cutter, 100.0);
            // The rounded shoulder of a tapered side begins a little below the height.
            for i in 0..=95 {
                let z = cutter.height * f64::from(i) / 100.0;
                let rho = cutter.radius_at(z).unwrap();
                assert!(body.distance(rho, z).abs() < 1e-9, "{cutter:?} {z} {}", body.distance(rho, z));
            }
            for i in 0..=50 {
                let rho = cutter.largest_radius() * f64::from(i) / 50.0;
                let z = cutter.height_at(rho).unwrap();
                assert!(z > 0.95 * cutter.height || body.distance(rho, z).abs() < 1e-9, "{cutter:?} {rho}");
            }
            assert!(body.distance(0.0, 0.5 * cutter.height) < 0.0);
            if cutter.taper >= 0.0 {
                let beside = body.distance(cutter.largest_radius() + 1.0, cutter.height + 50.0);
                assert!((beside - 1.0).abs() < 1e-9);
                assert!((body.distance(0.0, cutter.height + 101.0) - 1.0).abs() < 1e-9);
            }
        }
    }
}
