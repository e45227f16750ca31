//! Which parts of a motion come near a cell.

use super::body::Body;
use super::cells::{Cell, Seen};
use super::entry::TOUCH;
use super::motion::{Piece, parts};
use crate::math::order::{Key, rank};
use crate::toolpath::{ClPoint, Toolpath};
use glam::DVec3;

/// A motion as a tree of poses.
///
/// Each node stands for parts that lie near to one another in space and lean alike, whenever they are run: a link that
/// retracts from the middle of a pass shall not blur the pass. It holds one pose and how far any other differs. Moving
/// and turning a body brings it nearer to a point by no more than they move the point in the body's frame, so one distance
/// bounds them all: no boxes, which a leaning shank fills badly.
#[derive(Debug, Clone)]
pub(super) struct Sweeps {
    /// In the tree's order.
    parts: Vec<Piece>,
    nodes: Vec<Node>,
}

#[derive(Debug, Clone, Copy)]
struct Node {
    pose: Piece,
    /// How far any tip is from the pose's, millimetres.
    shift: f64,
    /// How far any axis is turned from the pose's, radians.
    turn: f64,
    /// Parts below, first and last but one.
    first: u32,
    end: u32,
    /// The second child; the first one follows its parent. None in the lowest nodes.
    second: Option<u32>,
}

/// A node or a part that may come near.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Candidate {
    Node(u32),
    /// The part's number and its distance midway from the cell's place.
    Part(u32, f64),
}

impl Candidate {
    /// Parts before nodes, the nearest first, and equal ones by number.
    pub(super) fn by_distance(&self) -> Key {
        match *self {
            Self::Part(number, distance) => (rank(distance), number),
            Self::Node(number) => (rank(f64::INFINITY), number),
        }
    }
}

/// Parts in the lowest nodes: testing as many is cheaper than another level.
const LOWEST: usize = 4;
/// A node is opened where its poses differ by more than this many sizes of the cell: half as many and twice as many are
/// both a little slower.
const BLUR: f64 = 1.0;

impl Sweeps {
    pub(super) fn new(body: &Body, path: &Toolpath) -> Self {
        let parts = parts(body, path);
        let mut sweeps = Self { nodes: Vec::new(), parts: Vec::with_capacity(parts.len()) };
        let mut sticks: Vec<Stick> =
            parts.iter().enumerate().map(|(i, part)| Stick::of(part, i as u32, body.reach())).collect();
        let poses: Vec<_> = parts.iter().map(|part| [part.pose(0.0), part.pose(1.0)]).collect();
        if !sticks.is_empty() {
            sweeps.grow(&mut sticks, &parts, &poses);
        }
        sweeps
    }

    fn grow(&mut self, sticks: &mut [Stick], parts: &[Piece], poses: &[[ClPoint; 2]]) {
        let number = self.nodes.len();
        let first = self.parts.len() as u32;
        self.nodes.push(Node::around(sticks, poses, first));
        if sticks.len() <= LOWEST {
            self.parts.extend(sticks.iter().map(|stick| parts[stick.number as usize]));
            return;
        }
        let middle = Stick::halve(sticks);
        let (left, right) = sticks.split_at_mut(middle);
        self.grow(left, parts, poses);
        self.nodes[number].second = Some(self.nodes.len() as u32);
        self.grow(right, parts, poses);
    }

    pub(super) fn part(&self, number: u32) -> &Piece {
        &self.parts[number as usize]
    }

    /// What to begin with.
    pub(super) fn root(&self) -> Option<Candidate> {
        (!self.nodes.is_empty()).then_some(Candidate::Node(0))
    }

    /// Appends to `found` what of `candidate` may enter a line of `cell`: parts, and unless `to_parts` also nodes that are
    /// as good as parts for a cell of that size.
    pub(super) fn sift(
        &self,
        body: &Body,
        cell: &Cell,
        candidate: Candidate,
        to_parts: bool,
        found: &mut Vec<Candidate>,
    ) {
        match candidate {
            Candidate::Part(number, _) => self.sift_parts(body, cell, number..number + 1, found),
            Candidate::Node(number) => {
                let node = &self.nodes[number as usize];
                let probe = node.pose.probe(body, 0.0, cell.place(), cell.direction);
                let nearer = node.shift + node.turn * probe.lever;
                let seen = Seen { distance: probe.distance, by_line: probe.by_line, nearer, turn: node.turn };
                if cell.least(&seen) >= -TOUCH {
                    return;
                }
                if !to_parts && nearer + node.turn * cell.size() <= BLUR * cell.size() {
                    found.push(candidate);
                } else if let Some(second) = node.second {
                    self.sift(body, cell, Candidate::Node(number + 1), to_parts, found);
                    self.sift(body, cell, Candidate::Node(second), to_parts, found);
                } else {
                    self.sift_parts(body, cell, node.first..node.end, found);
                }
            }
        }
    }

    fn sift_parts(
        &self,
        body: &Body,
        cell: &Cell,
        numbers: std::ops::Range<u32>,
        found: &mut Vec<Candidate>,
    ) {
        for number in numbers {
            let part = self.part(number);
            let probe = part.probe(body, 0.5, cell.place(), cell.direction);
            let nearer = 0.5 * probe.by_time.abs() + part.sag(probe.lever);
            let (distance, by_line) = (probe.distance, probe.by_line);
            if cell.least(&Seen { distance, by_line, nearer, turn: part.half_turn() }) < -TOUCH {
                found.push(Candidate::Part(number, distance));
            }
        }
    }
}

impl Node {
    fn around(sticks: &[Stick], poses: &[[ClPoint; 2]], first: u32) -> Self {
        let poses = || sticks.iter().flat_map(|stick| &poses[stick.number as usize]);
        let (lo, hi) = poses().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(lo, hi), pose| {
            (lo.min(pose.tip), hi.max(pose.tip))
        });
        let axis = poses().map(|pose| pose.axis).sum::<DVec3>().normalize_or(DVec3::Z);
        let middle = ClPoint { tip: 0.5 * (lo + hi), axis };
        let (mut shift, mut chord) = (0.0_f64, 0.0_f64);
        for pose in poses() {
            shift = shift.max(pose.tip.distance(middle.tip));
            chord = chord.max(pose.axis.distance_squared(axis));
        }
        let chord = chord.sqrt();
        // Between two axes inside a cap of less than a half sphere, the shorter arc stays inside.
        let turn = if chord < 1.4 { 2.0 * libm::asin(0.5 * chord) } else { f64::INFINITY };
        let end = first + sticks.len() as u32;
        Self { pose: Piece::still(&middle), shift, turn, first, end, second: None }
    }
}

/// A part as its tip and a point up its axis, midway.
#[derive(Debug, Clone, Copy)]
struct Stick {
    ends: [DVec3; 2],
    number: u32,
}

impl Stick {
    fn of(part: &Piece, number: u32, length: f64) -> Self {
        let pose = part.pose(0.5);
        Self { ends: [pose.tip, pose.tip + pose.axis * length], number }
    }

    fn halve(sticks: &mut [Self]) -> usize {
        super::cells::halve(sticks, |stick| stick.ends, |stick| stick.number)
    }
}
