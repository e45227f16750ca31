//! Whether the whole cutter clears a face that one point of it touches.

use super::approach::{Asked, nearest};
use super::body::Body;
use crate::cutter::{Cutter, Holder};
use crate::geometry::{Domain, Face, FaceGrid, Jet, Uv};
use crate::math::frame::Frame;
use crate::math::parabola::vertex;
use crate::toolpath::ClPoint;
use glam::DVec3;

/// A face as an obstacle: its points on a grid, in three levels of blocks.
#[derive(Debug, Clone)]
pub struct FaceObstacle {
    face: Face,
    grid: FaceGrid,
    blocks: Vec<Block>,
    cell: f64,
}

/// Nodes of the grid with a ball around them and the plates that hold them, and the blocks inside.
#[derive(Debug, Clone)]
struct Block {
    center: DVec3,
    radius: f64,
    /// Unit, and how far the nodes lie from the plane through the centre that is square to it, mm.
    normal: DVec3,
    thickness: f64,
    i: (usize, usize),
    j: (usize, usize),
    children: Vec<Block>,
}

/// Rings on which the neighbourhood of a contact is looked at, in cells: a rolled-over edge bends within hundredths of
/// a millimetre.
const RINGS: [f64; 6] = [0.04, 0.1, 0.22, 0.45, 0.8, 1.4];
/// Points on each: along and across the feed and between.
const SPOKES: usize = 8;

/// Places looked at between a spoke and its neighbours.
const PARABOLAS: usize = 3;
/// The least way to the next of them, as a share of the ground between.
const NEAR: f64 = 0.01;

/// The least part of a step beside a contact.
const SHORTEST: f64 = 1e-3;

/// Nodes a side of the largest blocks, of those inside, and of those inside these.
const SIDES: [usize; 3] = [64, 16, 4];

impl FaceObstacle {
    /// Samples `face` at most about `cell` mm apart. A feature that a cutter can touch between samples is followed
    /// down from its nearest sample, so `cell` must only be small against the cutter's corner.
    pub fn new(face: &Face, cell: f64) -> Self {
        let grid = FaceGrid::new(face, cell, 16, 1000);
        let (nu, nv) = grid.size();
        let blocks = tiled(&grid, (0, nu), (0, nv), &SIDES);
        Self { face: face.clone(), grid, blocks, cell }
    }

    /// Samples `face` densely enough for `cutter`: a quarter of its corner apart, within what a plan can afford.
    pub fn for_cutter(face: &Face, cutter: &Cutter) -> Self {
        Self::new(face, (0.25 * cutter.corner_radius).clamp(0.2, 1.0))
    }

    /// Lowest and highest coordinates of the samples.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let first = self.grid.point(0, 0);
        self.grid.points().iter().fold((first, first), |(lo, hi), &p| (lo.min(p), hi.max(p)))
    }

    /// How deep the cutter at `cl` reaches into the face beyond the neighbourhood of its contact, mm: 0 or negative.
    ///
    /// The neighbourhood is one and a half cells around `contact`; there only samples deeper than `enough` tell, and the
    /// rest is for [`FaceObstacle::digs_beside`]. Depths are found to about a hundredth of the cell's own sag. What is deeper than
    /// `enough` (mm, negative) is not followed further down.
    pub fn depth(&self, cutter: &Cutter, cl: &ClPoint, contact: DVec3, enough: f64) -> f64 {
        self.lowest(cutter, cl, contact, Asked { enough, above: 0.0 }).min(0.0)
    }

    /// Whether [`FaceObstacle::depth`] is more than `allowed` (mm, negative): far quicker than how much it is.
    pub fn digs(&self, cutter: &Cutter, cl: &ClPoint, contact: DVec3, allowed: f64) -> bool {
        self.lowest(cutter, cl, contact, Asked { enough: allowed, above: allowed }) < allowed
    }

    /// The least distance of the face from the cutter at `cl` beyond the neighbourhood of its `contact`, as far as it is asked for, mm.
    fn lowest(&self, cutter: &Cutter, cl: &ClPoint, contact: DVec3, asked: Asked) -> f64 {
        let body = Body::new(cutter, cl);
        let margin = self.margin(cutter);
        let mut lowest = f64::INFINITY;
        for (i, j, here) in self.nearer(&body, margin) {
            if here < asked.enough {
                return here;
            }
            if self.is_beside(contact, i, j) {
                continue;
            }
            if self.is_lowest(&body, (i, j), here) {
                lowest = lowest.min(self.descend_from(&body, (i, j), contact, asked));
                if lowest < asked.enough {
                    break;
                }
            }
        }
        lowest
    }

    /// Whether the cutter at `cl`, larger by `more` (mm) to every side, certainly touches the face nowhere: it also says no where it
    /// only comes nearer than the face may bulge between samples, hundredths of a millimetre.
    pub fn clears(&self, cutter: &Cutter, cl: &ClPoint, more: f64) -> bool {
        let stout = Cutter { corner_radius: cutter.corner_radius + more, ..*cutter };
        let body = Body::new(&stout, cl);
        self.nearer(&body, self.margin(&stout)).next().is_none()
    }

    /// [`FaceObstacle::clears`] for what holds the cutter at `cl`.
    pub fn clears_holder(&self, holder: &Holder, cl: &ClPoint, more: f64) -> bool {
        let (solid, up) = holder.solid();
        self.clears(&solid, &ClPoint { tip: cl.tip + up * cl.axis, axis: cl.axis }, more)
    }

    /// The nodes nearer to the cutter than `margin`, and how near; looked for as they are asked for.
    fn nearer<'a>(&'a self, body: &'a Body, margin: f64) -> impl Iterator<Item = (usize, usize, f64)> + 'a {
        let mut open: Vec<&Block> = self.blocks.iter().collect();
        let blocks = std::iter::from_fn(move || {
            while let Some(block) = open.pop() {
                if block.is_beyond(body, margin) {
                    continue;
                }
                if block.children.is_empty() {
                    return Some(block);
                }
                open.extend(&block.children);
            }
            None
        });
        let nodes = |block: &Block| {
            let (is, js) = (block.i.0..block.i.1, block.j.0..block.j.1);
            js.flat_map(move |j| is.clone().map(move |i| (i, j)))
        };
        blocks
            .flat_map(nodes)
            .map(|(i, j)| (i, j, body.distance(self.grid.point(i, j))))
            .filter(move |(_, _, here)| *here < margin)
    }

    /// How much nearer than at any sample the face may come to the cutter between samples, mm: the sag of a cell against
    /// the corner, twice.
    fn margin(&self, cutter: &Cutter) -> f64 {
        0.25 * self.cell * self.cell * (1.0 / cutter.corner_radius.max(0.1) + 0.1)
    }

    /// Whether the cutter at `cl` reaches deeper than `allowed` (mm, negative) into the face right beside its contact at `uv`, in the
    /// neighbourhood that [`FaceObstacle::depth`] leaves out. Found on rings around the contact and, where one of them dips below the
    /// cutter, followed down from there.
    pub fn digs_beside(&self, cutter: &Cutter, cl: &ClPoint, uv: Uv, frame: &Frame, allowed: f64) -> bool {
        let body = Body::new(cutter, cl);
        let domain = self.face.domain();
        let jet = self.face.jet(uv);
        for (ring, radius) in RINGS.map(|share| share * self.cell).into_iter().enumerate() {
            let look = |turn: f64| {
                let (s, c) = libm::sincos(std::f64::consts::TAU * turn / SPOKES as f64);
                let step = jet.pull_back((frame.f * c + frame.b * s) * radius)?;
                let (beside, point) = self.beside(&domain, jet.p, uv, step, radius);
                Some((body.distance(point), beside))
            };
            // Every other ring looks between the spokes of the last.
            let turn = |k: usize| k as f64 + 0.5 * (ring % 2) as f64;
            let looks: [_; SPOKES] = std::array::from_fn(|k| look(turn(k)));
            // Where curvatures nearly match, what digs in lies at the bottom of valleys to both sides, between two spokes.
            for k in 0..SPOKES {
                let Some(low) = looks[k] else { continue };
                let beside = |k: usize| looks[k % SPOKES].map_or(f64::INFINITY, |(here, _)| here);
                let (before, after) = (beside(k + SPOKES - 1), beside(k + 1));
                if before.min(after) < low.0 {
                    continue;
                }
                let around = [(turn(k) - 1.0, before), (turn(k), low.0), (turn(k) + 1.0, after)];
                let (lowest, at) = between(look, low, around);
                if lowest < 0.0 && self.leads_below(&body, at, &jet, radius, allowed) {
                    return true;
                }
            }
        }
        false
    }

    /// Whether the way down from `at`, `radius` mm beside the contact with this jet, leads below `allowed`.
    fn leads_below(&self, body: &Body, at: Uv, jet: &Jet, radius: f64, allowed: f64) -> bool {
        let [u, v] = [jet.du, jet.dv].map(|along| 0.5 * radius / along.length());
        let asked = Asked { enough: allowed, above: allowed };
        let is_below = || nearest(&self.face, body, at, Uv::new(u, v), asked, &|_| false).distance < allowed;
        u.is_finite() && v.is_finite() && is_below()
    }

    /// The point one `step` of parameters beside `uv`, where the face's point is `p`. Near a border that all but shrinks to
    /// a point the step leads anywhere: then a shorter one that does not go farther than `radius` by much.
    fn beside(&self, domain: &Domain, p: DVec3, uv: Uv, step: (f64, f64), radius: f64) -> (Uv, DVec3) {
        let mut share = 1.0;
        loop {
            let beside = domain.clamp(Uv::new(uv.u + share * step.0, uv.v + share * step.1));
            let point = self.face.surface.point(beside);
            if share < SHORTEST || point.distance_squared(p) < 4.0 * radius * radius {
                return (beside, point);
            }
            share *= 0.5;
        }
    }

    /// Whether the node lies in the neighbourhood of the `contact`.
    fn is_beside(&self, contact: DVec3, i: usize, j: usize) -> bool {
        self.grid.point(i, j).distance_squared(contact) < 2.25 * self.cell * self.cell
    }

    /// Whether no neighbour of the node is nearer to the cutter.
    fn is_lowest(&self, body: &Body, (i, j): (usize, usize), here: f64) -> bool {
        let (nu, nv) = self.grid.size();
        let around = |k: usize, n: usize| k.saturating_sub(1)..(k + 2).min(n);
        around(j, nv).all(|b| around(i, nu).all(|a| body.distance(self.grid.point(a, b)) >= here))
    }

    /// The least distance near the node, 0 where the way down leads to the `contact`.
    fn descend_from(&self, body: &Body, (i, j): (usize, usize), contact: DVec3, asked: Asked) -> f64 {
        let (nu, nv) = self.grid.size();
        let (low, high) = (
            self.grid.uv(i.saturating_sub(1), j.saturating_sub(1)),
            self.grid.uv((i + 1).min(nu - 1), (j + 1).min(nv - 1)),
        );
        let step = Uv::new(0.5 * (high.u - low.u), 0.5 * (high.v - low.v));
        // What slides back to the contact is the contact.
        let is_contact = |point: DVec3| point.distance_squared(contact) < self.cell * self.cell;
        let end = nearest(&self.face, body, self.grid.uv(i, j), step, asked, &is_contact);
        if is_contact(end.point) { 0.0 } else { end.distance }
    }
}

/// The lowest value found between the outer ones of three places with their values, of which the middle one, `low`, is the least, and
/// what `look` tells with it: where the parabola through the three is lowest, again and again (R. P. Brent, Algorithms for minimization
/// without derivatives, 1973, ch. 5).
fn between<T: Copy>(
    look: impl Fn(f64) -> Option<(f64, T)>,
    mut low: (f64, T),
    mut around: [(f64, f64); 3],
) -> (f64, T) {
    for _ in 0..PARABOLAS {
        let [a, b, c] = around;
        let is_far = |place: &f64| (place - b.0).abs() > NEAR * (c.0 - a.0);
        let Some(place) = vertex(around).filter(is_far) else { break };
        let Some(next) = look(place) else { break };
        let here = (place, next.0);
        if here.1 < b.1 {
            low = next;
            around = if place > b.0 { [b, here, c] } else { [a, here, b] };
        } else {
            around = if place > b.0 { [a, b, here] } else { [here, b, c] };
        }
    }
    low
}

/// Blocks of the first of `sides` that tile the nodes, with blocks of the others inside.
fn tiled(grid: &FaceGrid, i: (usize, usize), j: (usize, usize), sides: &[usize]) -> Vec<Block> {
    let Some((&side, others)) = sides.split_first() else { return Vec::new() };
    tile(i, j, side).map(|(i, j)| Block::new(grid, i, j, tiled(grid, i, j, others))).collect()
}

impl Block {
    fn new(grid: &FaceGrid, i: (usize, usize), j: (usize, usize), children: Vec<Block>) -> Self {
        let points = || (j.0..j.1).flat_map(|b| (i.0..i.1).map(move |a| grid.point(a, b)));
        let (low, high) = points()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(lo, hi): (DVec3, DVec3), p| {
                (lo.min(p), hi.max(p))
            });
        let center = 0.5 * (low + high);
        let radius = points().map(|p| p.distance(center)).fold(0.0, f64::max);
        let [a, b] = [(i.0, j.0, i.1 - 1, j.1 - 1), (i.1 - 1, j.0, i.0, j.1 - 1)];
        let diagonal = |(i, j, k, l): (usize, usize, usize, usize)| grid.point(k, l) - grid.point(i, j);
        let normal = diagonal(a).cross(diagonal(b)).try_normalize().unwrap_or(DVec3::Z);
        let thickness = points().map(|p| (p - center).dot(normal).abs()).fold(0.0, f64::max);
        Self { center, radius, normal, thickness, i, j, children }
    }

    /// Whether no node is nearer to the cutter than `margin`, mm: the cutter is convex, so that none is nearer than the tangent plane of
    /// its distance at the centre has it.
    fn is_beyond(&self, body: &Body, margin: f64) -> bool {
        let room = body.distance(self.center) - margin;
        if room > self.radius || room <= 0.0 {
            return room > self.radius;
        }
        let gradient = body.gradient(self.center);
        let across = gradient.dot(self.normal);
        let aside = (1.0 - across * across).max(0.0).sqrt();
        room > aside * self.radius + across.abs() * self.thickness
    }
}

/// The rectangles of at most `side` by `side` nodes that tile the given one.
fn tile(
    i: (usize, usize),
    j: (usize, usize),
    side: usize,
) -> impl Iterator<Item = ((usize, usize), (usize, usize))> {
    (j.0..j.1).step_by(side).flat_map(move |b| {
        (i.0..i.1).step_by(side).map(move |a| ((a, (a + side).min(i.1)), (b, (b + side).min(j.1))))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::cl_of;
    use crate::geometry::{Cylinder, Range, Side, Surface};
    use crate::math::frame::Frame;
    use crate::toolpath::{CcPoint, Posture};

    /// A cutter inside a trough of `radius`, feed along it, with `lead` degrees.
    fn depth_in_trough(radius: f64, lead: f64, yaw: f64) -> f64 {
        let world = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
        let trough = Cylinder::new(DVec3::ZERO, world, radius, [-1.2, 1.2], [-40.0, 40.0]).unwrap();
        let face = Face::new(trough, Side::Back);
        let (jet, n) = face.at(Uv::new(0.05, 1.0)).unwrap();
        let frame = Frame::from_normal(n, DVec3::Z).unwrap();
        let posture = Posture { lead: lead.to_radians(), yaw: yaw.to_radians() };
        let cutter = Cutter::bull_nose(16.0, 2.0, 50.0).unwrap();
        let cc = CcPoint { point: jet.p, frame, posture };
        FaceObstacle::new(&face, 0.7).depth(&cutter, &cl_of(&cutter, &cc), jet.p, f64::NEG_INFINITY)
    }

    #[test]
    fn upright_disc_in_a_trough_digs_in_with_both_sides() {
        // Flat on the bottom the rim of the disc (R1 = 6, r = 2) lies below the trough of radius 50: the tube's
        // circle touches at a distance of 50 − 2 from the axis where the disc's rim is √((48)² …) away from it.
        let depth = depth_in_trough(50.0, 0.0, 90.0);
        // Contact is taken on the rim; the far rim, 12 mm across, sinks by the sag of that chord.
        let chord: f64 = 12.0;
        let far = libm::hypot(chord, 48.0) + 2.0 - 50.0;
        assert!((depth + far).abs() < 1e-3, "{depth} {far}");
    }

    /// A narrow ridge along a line that is turned from the first parameter: it is level at the origin, and highest 0.7 mm on to both
    /// sides.
    #[derive(Debug)]
    struct Ridge {
        /// cos and sin.
        along: [f64; 2],
        height: f64,
    }

    impl Surface for Ridge {
        fn domain(&self) -> Domain {
            let range = Range::open(-3.0, 3.0);
            Domain { u: range, v: range }
        }

        fn jet(&self, Uv { u, v }: Uv) -> Jet {
            let ([c, s], k) = (self.along, 4.0 * self.height);
            let (t, w) = (u * c + v * s, v * c - u * s);
            let (dt, dw) = (k * (2.0 * t - 4.0 * t * t * t), -0.8 * w);
            let (dtt, dww) = (k * (2.0 - 12.0 * t * t), -0.8);
            let z = |z| DVec3::Z * z;
            Jet {
                p: DVec3::new(u, v, k * t * t * (1.0 - t * t) - 0.4 * w * w),
                du: DVec3::X + z(c * dt - s * dw),
                dv: DVec3::Y + z(s * dt + c * dw),
                duu: z(c * c * dtt + s * s * dww),
                duv: z(c * s * (dtt - dww)),
                dvv: z(s * s * dtt + c * c * dww),
            }
        }
    }

    /// Below a flat bottom, in whatever direction the ridge runs: where curvatures nearly match, it is a direction that nobody chose.
    #[test]
    fn a_ridge_beside_the_contact_is_dug_into() {
        let cutter = Cutter::bull_nose(20.0, 2.0, 50.0).unwrap();
        let cl = ClPoint { tip: DVec3::ZERO, axis: DVec3::Z };
        let frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
        for (height, digs) in [(0.002, true), (0.0004, false)] {
            for turn in 0..16 {
                let (s, c) = libm::sincos(f64::from(turn).to_radians() * 3.0);
                let face = Face::new(Ridge { along: [c, s], height }, Side::Front);
                let obstacle = FaceObstacle::new(&face, 0.5);
                let found = obstacle.digs_beside(&cutter, &cl, Uv::default(), &frame, -0.0005);
                assert_eq!(found, digs, "{turn}: {height}");
            }
        }
    }

    #[test]
    fn enough_lead_clears() {
        assert_eq!(depth_in_trough(50.0, 20.0, 0.0), 0.0);
        assert!(depth_in_trough(50.0, 2.0, 0.0) < -0.01);
    }
}
