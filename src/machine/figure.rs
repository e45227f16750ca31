//! A machine as simple solids, to be drawn. A description knows axes and no castings: slides ride on rails as long as their way, rotary
//! axes are drums, and beams join what is one body.

use super::chain::{Chain, JointOf, Tool};
use super::{Carries, Joint, Machine};
use glam::DVec3;
use std::f64::consts::TAU;

/// A convex solid, fixed to one of the machine's bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct Solid {
    /// The number of its body, as in [`Chain::bodies`].
    pub body: usize,
    /// What it stands for.
    pub part: Part,
    /// Corners while every axis stands at 0, machine frame, mm.
    pub corners: Vec<DVec3>,
    /// The corners of each face, counter-clockwise seen from outside.
    pub faces: Vec<Vec<usize>>,
}

/// What a solid stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// The machine's bed and column.
    Bed,
    /// What is between the bed and the workpiece.
    Table,
    /// What is between the bed and the tool.
    Head,
    /// Where a linear axis goes.
    Rail,
    /// What turns about a rotary axis.
    Drum,
    /// The cutter.
    Cutter,
}

/// Where the letter of an axis stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Label {
    /// The axis.
    pub letter: char,
    /// The body that it stands on.
    pub body: usize,
    /// While every axis stands at 0, machine frame, mm.
    pub at: DVec3,
}

/// A machine to be drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Figure {
    /// Its solids.
    pub solids: Vec<Solid>,
    /// Its letters.
    pub labels: Vec<Label>,
}

/// Corners of a drum's ends.
const ROUND: usize = 20;

/// What a figure is drawn around.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scene {
    /// The tool.
    pub tool: Tool,
    /// What is cut of the workpiece, low and high, workpiece frame, mm.
    pub workpiece: [DVec3; 2],
    /// From where to where each axis goes, as in [`Position::all`](super::Position::all).
    pub used: [[f64; 2]; 5],
}

pub(super) fn figure(chain: &Chain, machine: &Machine, scene: &Scene) -> Figure {
    let Scene { tool, workpiece: [low, high], used } = scene;
    let up = machine.tool_axis.normalize();
    let half = 0.5 * high.distance(*low);
    // What everything is drawn to: the part and the tool shall be seen.
    let size = half.max(0.6 * tool.length).max(1.0);
    let (figure, used) = (Figure::default(), *used);
    let mut drawing = Drawing { figure, chain, used, up, size, reach: 1.1 * half + 0.1 * size };
    drawing.tool(machine, tool);
    let spindle = machine.gauge + 0.55 * size * up;
    let column = drawing.side(Carries::Tool, chain.tool(), spindle);
    let middle = machine.workpiece_zero + 0.5 * (*low + *high);
    let under = middle + up * (low.dot(up).min(high.dot(up)) - 0.5 * (*low + *high).dot(up) - 0.15 * size);
    let base = drawing.side(Carries::Workpiece, chain.workpiece(), under);
    // The bed: along under everything to behind it, up, and over to the head.
    let foot = base - 0.1 * size * up;
    let back = drawing.behind(up);
    let far = drawing.reach + 0.7 * size;
    let rear = foot + back * ((base - foot).dot(back) + far);
    let top = rear + up * (column - rear).dot(up);
    for ends in [[foot, rear], [rear, top], [top, column]] {
        drawing.beam(0, Part::Bed, ends, 0.24 * size);
    }
    drawing.figure
}

struct Drawing<'a> {
    figure: Figure,
    chain: &'a Chain,
    used: [[f64; 2]; 5],
    up: DVec3,
    size: f64,
    /// How far from its middle the workpiece reaches, and a little more.
    reach: f64,
}

impl Drawing<'_> {
    fn tool(&mut self, machine: &Machine, tool: &Tool) {
        let (body, up, size) = (self.chain.tool(), self.up, self.size);
        let tip = machine.gauge - tool.length * up;
        let top = tip + tool.height.min(tool.length) * up;
        self.drum(body, Part::Cutter, [tip, top], tool.radius);
        self.drum(body, Part::Head, [top, machine.gauge], (1.6 * tool.radius).max(0.1 * size));
        self.drum(body, Part::Head, [machine.gauge, machine.gauge + 0.55 * size * up], 0.26 * size);
    }

    /// Draws the axes of one side, from what they carry to the bed; gives where the bed takes over.
    fn side(&mut self, carries: Carries, mut body: usize, mut at: DVec3) -> DVec3 {
        let part = if carries == Carries::Tool { Part::Head } else { Part::Table };
        while let Some(&joint) = body.checked_sub(1).and_then(|k| self.chain.joints().get(k)) {
            at = match joint.axis.joint {
                Joint::Linear { direction } => self.slide(&joint, part, body, at, direction.normalize()),
                Joint::Rotary { direction, point } => {
                    let direction = direction.normalize();
                    let middle = point + direction * (at - point).dot(direction);
                    if carries == Carries::Workpiece && direction.dot(self.up).abs() < 0.5 {
                        self.cradle(&joint, body, at, [middle, direction])
                    } else {
                        self.turning(&joint, part, body, at, [middle, direction])
                    }
                }
            };
            body = joint.parent;
        }
        at
    }

    /// Which way from what an axis carries to what carries it.
    fn towards_bed(&self, joint: &JointOf) -> DVec3 {
        if joint.axis.carries == Carries::Tool { self.up } else { -self.up }
    }

    fn slide(&mut self, joint: &JointOf, part: Part, body: usize, at: DVec3, along: DVec3) -> DVec3 {
        let size = self.size;
        let limits = joint.axis.limits.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        let [from, to] = self.used[joint.place];
        let (low, high) = ((from - 0.35 * size).max(limits[0]), (to + 0.35 * size).min(limits[1]));
        // Beside what it carries, and behind it where it goes up and down.
        let out = self.towards_bed(joint);
        let out = if along.dot(out).abs() < 0.7 { out } else { self.behind(along) };
        let carriage = at + 0.2 * size * out;
        self.beam(body, part, [at, carriage], 0.3 * size);
        self.beam(body, part, [carriage - 0.2 * size * along, carriage + 0.2 * size * along], 0.26 * size);
        let rail = carriage + 0.18 * size * out;
        self.beam(joint.parent, Part::Rail, [rail + low * along, rail + high * along], 0.12 * size);
        // At the nearer end, where nothing else is.
        let end = if along.dot(self.behind(self.up)) > 0.5 { low } else { high };
        self.label(joint, joint.parent, rail + end * along);
        // What carries the rail holds it in the middle of what is used of it.
        rail + 0.5 * (low + high) * along
    }

    /// A horizontal direction square to `along`, away from who looks.
    fn behind(&self, along: DVec3) -> DVec3 {
        let square = |v: DVec3| v - along * v.dot(along);
        square(DVec3::Y).try_normalize().unwrap_or(DVec3::X)
    }

    /// A drum about its axis, as a head or a round table.
    fn turning(
        &mut self,
        joint: &JointOf,
        part: Part,
        body: usize,
        at: DVec3,
        [middle, direction]: [DVec3; 2],
    ) -> DVec3 {
        let size = self.size;
        let is_table = joint.axis.carries == Carries::Workpiece;
        let (radius, half) = if is_table { (self.reach, 0.07 * size) } else { (0.3 * size, 0.22 * size) };
        let out = self.towards_bed(joint);
        let sense = if direction.dot(out) < 0.0 { -direction } else { direction };
        if !is_table {
            self.beam(body, part, [at, middle], 0.26 * size);
        }
        self.drum(body, Part::Drum, [middle - half * sense, middle + half * sense], radius);
        let end = middle + (half + 0.16 * size) * sense;
        self.drum(joint.parent, part, [middle + half * sense, end], 0.8 * radius.min(0.6 * size));
        self.label(joint, joint.parent, if is_table { middle } else { end });
        end
    }

    /// A table that hangs between two bearings.
    fn cradle(&mut self, joint: &JointOf, body: usize, at: DVec3, [middle, direction]: [DVec3; 2]) -> DVec3 {
        let (size, up) = (self.size, self.up);
        let under = at - 0.16 * size * up;
        let lower = middle.dot(up).min(under.dot(up)) - self.reach.max(0.4 * size);
        let foot = under + up * (lower - under.dot(up));
        let wide = self.reach + 0.2 * size;
        self.beam(body, Part::Table, [under - wide * direction, under + wide * direction], 0.16 * size);
        for side in [-wide, wide] {
            let bearing = middle + direction * ((under - middle).dot(direction) + side);
            self.beam(body, Part::Table, [under + side * direction, bearing], 0.16 * size);
            let outer = bearing + 0.24 * size * direction * side.signum();
            self.drum(body, Part::Drum, [bearing, outer], 0.16 * size);
            let post = outer + 0.08 * size * direction * side.signum();
            self.beam(joint.parent, Part::Bed, [post, post + up * (lower - post.dot(up))], 0.16 * size);
            if side > 0.0 {
                self.label(joint, body, outer);
            }
        }
        let across = wide + 0.32 * size;
        self.beam(
            joint.parent,
            Part::Bed,
            [foot - across * direction, foot + across * direction],
            0.16 * size,
        );
        foot
    }

    fn label(&mut self, joint: &JointOf, body: usize, at: DVec3) {
        self.figure.labels.push(Label { letter: joint.axis.letter, body, at });
    }

    /// A beam of a square section, a little longer than from end to end; nothing if the ends are one.
    fn beam(&mut self, body: usize, part: Part, [from, to]: [DVec3; 2], wide: f64) {
        if let Some(along) = (to - from).try_normalize() {
            let ends = [from - 0.5 * wide * along, to + 0.5 * wide * along];
            self.prism(body, part, ends, 0.5 * wide * std::f64::consts::SQRT_2, 4);
        }
    }

    fn drum(&mut self, body: usize, part: Part, ends: [DVec3; 2], radius: f64) {
        self.prism(body, part, ends, radius, ROUND);
    }

    /// A prism between two ends with `count` corners at `radius` around its middle line; nothing if the ends are one.
    fn prism(&mut self, body: usize, part: Part, ends: [DVec3; 2], radius: f64, count: usize) {
        let Some(along) = (ends[1] - ends[0]).try_normalize() else { return };
        let toward = if along.cross(self.up).length() > 0.1 { self.up } else { DVec3::X };
        let first = (toward - along * toward.dot(along)).normalize_or(along.any_orthonormal_vector());
        let second = along.cross(first);
        let around = |k: usize| {
            let (s, c) = libm::sincos(TAU * (k as f64 + 0.5) / count as f64);
            radius * (c * first + s * second)
        };
        let corners = ends.iter().flat_map(|end| (0..count).map(move |k| *end + around(k))).collect();
        let side = |k: usize| {
            let next = (k + 1) % count;
            vec![k, next, count + next, count + k]
        };
        let mut faces: Vec<Vec<usize>> = (0..count).map(side).collect();
        faces.push((0..count).rev().collect());
        faces.push((count..2 * count).collect());
        self.figure.solids.push(Solid { body, part, corners, faces });
    }
}
