//! The machining potential of a face: how wide a strip can be at a place, for every direction of feed.
//!
//! Source: Liu and Liu, machining potential field, 2013: the widest strip at a point over directions and postures. There it is
//! to second order, here the exact strip over the quadratic model of the surface.

use super::Finish;
use crate::contact::{matching_lead, model_strip, second_order_strip_width};
use crate::cutter::Cutter;
use crate::geometry::{Curvature, Face, FaceGrid, Triangle};
use crate::math::frame::Frame;
use crate::monitor::{Cancelled, Stage};
use crate::posture::{Limits, Rule};
use crate::toolpath::Posture;
use glam::DVec3;
use std::f64::consts::PI;

/// Directions of feed that are looked at; as many again are the same, backwards.
pub(super) const DIRECTIONS: usize = 16;
/// Yaws that are looked at, where they are chosen.
const YAWS: usize = 7;
/// The lead for which strips on flat ground are as wide as chosen postures make them, roughly, radians.
const CHOSEN: f64 = 0.2;
/// The widest and narrowest strips that are believed, in strips on flat ground: where the cutter cannot stand, or fits like
/// a stamp, a field must still go on.
const BELIEVED: [f64; 2] = [0.1, 4.0];

/// Cells of a grid on which ways over a face are compared: in strips on flat ground, and at least and at most so many a side.
const CELL: f64 = 0.7;
const CELLS: [usize; 2] = [24, 56];

/// Widths of strips at the nodes of a grid.
#[derive(Debug)]
pub struct Potential {
    nodes: Vec<Option<Node>>,
    arm: f64,
}

#[derive(Debug)]
struct Node {
    frame: Frame,
    /// By direction, evenly from the frame's `f` towards its `b` and to `−f`, mm.
    widths: [f64; DIRECTIONS],
}

impl Potential {
    /// Of `face` at the nodes of `grid`, for a cutter that leans by `rule`.
    pub fn new(
        (face, grid): (&Face, &FaceGrid),
        cutter: &Cutter,
        rule: &Rule,
        finish: &Finish,
        stage: &Stage,
    ) -> Result<Self, Cancelled> {
        let flat = Self::flat(cutter, rule, finish);
        let (nu, count) = (grid.size().0, grid.points().len());
        let node = |k: usize| {
            let (jet, n) = face.at(grid.uv(k % nu, k / nu))?;
            let frame = Frame::from_normal(n, jet.du).unwrap_or_else(|| Frame::any(n));
            let curvature = Curvature::of(&jet, &frame)?;
            let [least, most] = BELIEVED.map(|share| share * flat);
            let width = |d: usize| {
                let k = curvature.turned(PI * d as f64 / DIRECTIONS as f64);
                widest(cutter, rule, &k, finish.scallop).map_or(least, |w| w.clamp(least, most))
            };
            Some(Node { frame, widths: std::array::from_fn(width) })
        };
        let (s, c) = libm::sincos(Self::typical(rule).lead);
        let arm = cutter.center_radius * c + cutter.corner_radius * s;
        Ok(Self { nodes: stage.map(count, node)?, arm })
    }

    /// About how far the cutter's tip is from its contact along the feed, mm.
    pub(super) fn arm(&self) -> f64 {
        self.arm
    }

    /// A posture for what is alike for all that `rule` allows.
    fn typical(rule: &Rule) -> Posture {
        match *rule {
            Rule::Fixed(posture) => posture,
            Rule::Matched(_) | Rule::Widest(_) | Rule::TwoContacts(_) => Posture { lead: CHOSEN, yaw: 0.0 },
        }
    }

    /// A grid of `face` fine enough to compare ways over it, for strips that are `flat` mm wide on flat ground.
    pub(super) fn grid(face: &Face, flat: f64) -> FaceGrid {
        FaceGrid::new(face, CELL * flat, CELLS[0], CELLS[1])
    }

    /// About how wide strips are on flat ground, mm.
    pub(super) fn flat(cutter: &Cutter, rule: &Rule, finish: &Finish) -> f64 {
        second_order_strip_width(cutter, Self::typical(rule), &Curvature::default(), finish.scallop)
    }

    /// The width at a node for a feed along `feed` or against it, mm; `None` at a pole.
    pub fn width(&self, node: usize, feed: DVec3) -> Option<f64> {
        let Node { frame, widths } = self.nodes[node].as_ref()?;
        let turn = libm::atan2(feed.dot(frame.b), feed.dot(frame.f)) / PI;
        let place = (turn - turn.floor()) * DIRECTIONS as f64;
        let (at, part) = (place.floor(), place - place.floor());
        let near = |by: usize| widths[(at as usize + by) % DIRECTIONS];
        Some(near(0) + (near(1) - near(0)) * part)
    }

    /// The mean width at the corners of a triangle for a feed along `feed` or against it, mm; not a number at poles.
    pub(super) fn mean_width(&self, triangle: &Triangle, feed: DVec3) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for width in triangle.nodes.iter().filter_map(|&k| self.width(k, feed)) {
            sum += width;
            count += 1.0;
        }
        sum / count
    }

    /// The unit direction of the widest strip at a node and the widest and narrowest strip there, mm; `None` at a pole.
    pub fn best(&self, node: usize) -> Option<(DVec3, [f64; 2])> {
        let Node { frame, widths } = self.nodes[node].as_ref()?;
        let mut best = 0;
        let mut least = widths[0];
        for (d, &width) in widths.iter().enumerate() {
            if width > widths[best] {
                best = d;
            }
            least = least.min(width);
        }
        // The top of the parabola through the best and its neighbours.
        let near = |by: usize| widths[(best + by) % DIRECTIONS];
        let (before, here, after) = (near(DIRECTIONS - 1), near(0), near(1));
        let bend = before - 2.0 * here + after;
        let aside = if bend < 0.0 { 0.5 * (before - after) / bend } else { 0.0 };
        let (s, c) = libm::sincos(PI * (best as f64 + aside) / DIRECTIONS as f64);
        Some((frame.f * c + frame.b * s, [here, least]))
    }
}

/// The width of the widest strip that `rule` allows for feed along `f` on a surface with the curvature `k`, mm; `None` where
/// the cutter digs in in every posture.
fn widest(cutter: &Cutter, rule: &Rule, k: &Curvature, scallop: f64) -> Option<f64> {
    let strip = |posture| model_strip(cutter, posture, k, scallop).half_widths().map(|(a, b)| a + b);
    let at_least_lead = |limits: &Limits, yaw: f64| {
        let lead = matching_lead(cutter, k, yaw)?.max(limits.least_lead);
        if lead > limits.most_lead { None } else { strip(Posture { lead, yaw }) }
    };
    match rule {
        Rule::Fixed(posture) => strip(*posture),
        Rule::Matched(limits) | Rule::TwoContacts(limits) => at_least_lead(limits, 0.0),
        Rule::Widest(limits) => (0..YAWS)
            .filter_map(|y| {
                at_least_lead(limits, limits.most_yaw * (2.0 * y as f64 / (YAWS - 1) as f64 - 1.0))
            })
            .reduce(f64::max),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Cylinder, Side, Sphere};

    const WORLD: Frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
    const FINISH: Finish = Finish { scallop: 0.01, chord: 0.0002 };

    fn potential(face: &Face, rule: Rule) -> (FaceGrid, Potential) {
        let cutter = Cutter::bull_nose(10.0, 2.0, 40.0).unwrap();
        let grid = FaceGrid::new(face, 2.0, 4, 20);
        let potential = Potential::new((face, &grid), &cutter, &rule, &FINISH, &Stage::silent()).unwrap();
        (grid, potential)
    }

    #[test]
    fn the_strip_on_a_rod_is_widest_along_it() {
        let rod = Cylinder::new(DVec3::ZERO, WORLD, 20.0, [0.0, 2.0], [0.0, 30.0]).unwrap();
        let face = Face::new(rod, Side::Front);
        let (grid, potential) = potential(&face, Rule::Matched(Limits::default()));
        for node in 0..grid.points().len() {
            let (along, [most, least]) = potential.best(node).unwrap();
            // Feed round the rod keeps its axis in the strip, where nothing bends away.
            assert!(along.z.abs() < 0.02 && most > 1.2 * least, "{along} {most} {least}");
            let here = potential.width(node, along).unwrap();
            assert!((here / most - 1.0).abs() < 0.01, "{here} {most}");
            assert_eq!(potential.width(node, -along).map(f64::to_bits), Some(here.to_bits()));
        }
    }

    #[test]
    fn where_all_directions_are_alike_so_are_widths() {
        let ball = Sphere::new(DVec3::ZERO, WORLD, 40.0, [0.0, 1.0], [-0.3, 0.4]).unwrap();
        let (grid, potential) =
            potential(&Face::new(ball, Side::Front), Rule::Fixed(Posture { lead: 0.1, yaw: 0.0 }));
        for node in 0..grid.points().len() {
            let (_, [most, least]) = potential.best(node).unwrap();
            assert!((most / least - 1.0).abs() < 1e-6, "{most} {least}");
        }
    }
}
