//! Which of both solutions, and which turn of each rotary axis, at the end of every move: the least travel over the whole program.

use super::axis::within;
use super::beyond::{beyond, out_of_limits};
use super::ends::{End, ends};
use super::spread::spread;
use super::turns::Turns;
use super::{Kinematics, MotionError};
use crate::toolpath::{Move, Role, Toolpath};
use std::collections::BTreeMap;

/// The rotary axes at the end of a move, radians, running on beyond a turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Chosen {
    /// As the move ends.
    pub(super) arrive: [f64; 2],
    /// As the next one begins, if the tool is turned over between them.
    pub(super) leave: Option<[f64; 2]>,
}

/// What turning the tool over on a link costs besides the travel of its axes, s: drawing back and returning, and more, since nobody
/// likes to watch it.
const TURN_OVER: f64 = 10.0;

/// The rotary axes for every move of `path`.
///
/// The shortest path through a lattice: at each move both solutions, each with all of its turns within the limits, joined to
/// the next move's wherever the tool can follow the move between (the same solution, or the other one through the pole, by less than half a turn).
/// Between two moves of a link any may follow any, since there the tool can draw back and turn over. Its length is the travel of the rotary
/// axes at their greatest speeds, s, counted from 0, where machines start.
///
/// `pole` is how far the tool may pass the pole by and still count as going through it, radians.
pub(super) fn choose(
    kinematics: &Kinematics,
    path: &Toolpath,
    pole: f64,
) -> Result<Vec<Chosen>, MotionError> {
    let ends = ends(kinematics, path)?;
    let lattice = Lattice::new(kinematics, &ends, &path.moves, pole);
    let walked = lattice.walk()?;
    let mut chosen = lattice.angles(&walked);
    spread(&mut chosen, &ends, &path.moves);
    Ok(chosen)
}

/// A solution and the turn of each rotary axis.
#[derive(Debug, Clone, Copy)]
struct Node {
    way: usize,
    turns: [usize; 2],
}

struct Lattice<'a> {
    kinematics: &'a Kinematics,
    ends: &'a [End],
    moves: &'a [Move],
    turns: [Turns; 2],
    pole: f64,
}

/// Where the shortest ways come from.
struct Walked {
    /// For every move and node, the node at the end of the move before.
    from: Vec<u8>,
    /// For the moves at whose end the tool may be turned over, the node that each node was turned from; itself for most.
    turned: BTreeMap<usize, Vec<u8>>,
    last: usize,
}

impl<'a> Lattice<'a> {
    fn new(kinematics: &'a Kinematics, ends: &'a [End], moves: &'a [Move], pole: f64) -> Self {
        let turns = [3, 4].map(|k| Turns::of(kinematics.axes().get(k)));
        Self { kinematics, ends, moves, turns, pole }
    }

    /// At most 2 · 11², as limits lie within five turns.
    fn width(&self) -> usize {
        2 * self.turns[0].count * self.turns[1].count
    }

    fn node(&self, index: usize) -> Node {
        let [_, second] = self.turns.map(|turns| turns.count);
        let way = index / (self.width() / 2);
        let rest = index % (self.width() / 2);
        Node { way, turns: [rest / second, rest % second] }
    }

    fn index(&self, node: Node) -> usize {
        let [first, second] = self.turns.map(|turns| turns.count);
        (node.way * first + node.turns[0]) * second + node.turns[1]
    }

    fn angles_of(&self, end: &End, node: Node) -> [f64; 2] {
        [0, 1].map(|k| self.turns[k].angle(end.rotary[node.way][k], node.turns[k]))
    }

    fn stands(&self, end: &End, node: Node) -> bool {
        let angles = self.angles_of(end, node);
        end.holds[node.way] && [0, 1].into_iter().all(|k| within(self.turns[k].limits, angles[k]))
    }

    fn travel(&self, from: [f64; 2], to: [f64; 2]) -> f64 {
        [0, 1].map(|k| self.turns[k].travel(from[k], to[k]).abs() / self.turns[k].speed).iter().sum()
    }

    /// The node that the tool comes to by following move `i` into solution `way`.
    fn next(&self, i: usize, from: Node, way: usize) -> Option<Node> {
        let (before, end) = (&self.ends[i - 1], &self.ends[i]);
        if !end.holds[way] || (way != from.way && !self.meets_pole(i)) {
            return None;
        }
        let angles = self.angles_of(before, from);
        let turn = |k: usize| self.turns[k].nearest(end.rotary[way][k], angles[k]);
        Some(Node { way, turns: [turn(0)?, turn(1)?] })
    }

    /// Whether the tool passes the pole on move `i`, where one solution becomes the other.
    fn meets_pole(&self, i: usize) -> bool {
        let Some(pole) = self.kinematics.pole() else { return true };
        let (from, to) = (self.moves[i - 1].to.axis, self.moves[i].to.axis);
        let way = to - from;
        if self.ends[i - 1].apart.min(self.ends[i].apart) > way.length() + self.pole {
            return false;
        }
        let pole = if from.dot(pole) < 0.0 { -pole } else { pole };
        let share = ((pole - from).dot(way) / way.length_squared()).clamp(0.0, 1.0);
        let nearest = if share.is_finite() { from + share * way } else { from };
        nearest.cross(pole).length() <= self.pole
    }

    /// Whether the tool may be turned over at the end of move `i`: between two moves of a link, from where it can draw back.
    fn is_on_link(&self, i: usize) -> bool {
        let links = |step: &Move| step.role == Role::Link;
        links(&self.moves[i]) && self.moves.get(i + 1).is_some_and(links)
    }

    fn walk(&self) -> Result<Walked, MotionError> {
        let width = self.width();
        let mut from = vec![0u8; width * self.ends.len()];
        let mut turned = BTreeMap::new();
        let start = |index| {
            let node = self.node(index);
            let angles = self.angles_of(&self.ends[0], node);
            if self.stands(&self.ends[0], node) { self.travel([0.0; 2], angles) } else { f64::INFINITY }
        };
        let mut costs: Vec<f64> = (0..width).map(start).collect();
        if costs.iter().all(|cost| cost.is_infinite()) {
            return Err(self.out_of_limits(0));
        }
        let mut next = vec![f64::INFINITY; width];
        for i in 1..self.ends.len() {
            next.fill(f64::INFINITY);
            for (index, &cost) in costs.iter().enumerate().filter(|(_, cost)| cost.is_finite()) {
                let node = self.node(index);
                let angles = self.angles_of(&self.ends[i - 1], node);
                for to in [0, 1].into_iter().filter_map(|way| self.next(i, node, way)) {
                    let cost = cost + self.travel(angles, self.angles_of(&self.ends[i], to));
                    let to = self.index(to);
                    if cost < next[to] {
                        next[to] = cost;
                        from[i * width + to] = index as u8;
                    }
                }
            }
            if next.iter().all(|cost| cost.is_infinite()) {
                return Err(self.stuck(i, &costs));
            }
            if self.is_on_link(i) {
                turned.insert(i, self.turn_over(i, &mut next));
            }
            std::mem::swap(&mut costs, &mut next);
        }
        let last = (0..width).min_by(|a, b| costs[*a].total_cmp(&costs[*b])).unwrap_or(0);
        Ok(Walked { from, turned, last })
    }

    /// Lets any node follow any at the end of move `i`, where that is shorter.
    fn turn_over(&self, i: usize, costs: &mut [f64]) -> Vec<u8> {
        let before = costs.to_vec();
        let mut turned: Vec<u8> = (0..before.len()).map(|index| index as u8).collect();
        let end = &self.ends[i];
        for to in (0..before.len()).filter(|index| self.stands(end, self.node(*index))) {
            for (from, cost) in before.iter().enumerate().filter(|(_, cost)| cost.is_finite()) {
                let travel =
                    self.travel(self.angles_of(end, self.node(from)), self.angles_of(end, self.node(to)));
                if cost + travel + TURN_OVER < costs[to] {
                    costs[to] = cost + travel + TURN_OVER;
                    turned[to] = from as u8;
                }
            }
        }
        turned
    }

    /// The angles along the shortest way, running on where an axis has no end.
    fn angles(&self, walked: &Walked) -> Vec<Chosen> {
        let mut nodes = Vec::with_capacity(self.ends.len());
        let mut leave = walked.last;
        for i in (0..self.ends.len()).rev() {
            let arrive = walked.turned.get(&i).map_or(leave, |turned| usize::from(turned[leave]));
            nodes.push((arrive, leave));
            leave = usize::from(walked.from[i * self.width() + arrive]);
        }
        let mut at = [0.0; 2];
        let mut go = |end: &End, index: usize| {
            let angles = self.angles_of(end, self.node(index));
            at = [0, 1].map(|k| at[k] + self.turns[k].travel(at[k], angles[k]));
            at
        };
        let choose = |(end, (arrive, leave)): (&End, (usize, usize))| {
            let arrived = go(end, arrive);
            Chosen { arrive: arrived, leave: (leave != arrive).then(|| go(end, leave)) }
        };
        self.ends.iter().zip(nodes.into_iter().rev()).map(choose).collect()
    }

    /// Why the tool cannot follow move `i` from any of the nodes of `costs`.
    fn stuck(&self, i: usize, costs: &[f64]) -> MotionError {
        let stands = (0..self.width()).any(|index| self.stands(&self.ends[i], self.node(index)));
        if !stands {
            return self.out_of_limits(i);
        }
        let best = (0..costs.len()).min_by(|a, b| costs[*a].total_cmp(&costs[*b])).unwrap_or(0);
        let node = self.node(best);
        let (end, angles) = (&self.ends[i], self.angles_of(&self.ends[i - 1], node));
        let is_at_end = |k: &usize| self.turns[*k].nearest(end.rotary[node.way][*k], angles[*k]).is_none();
        let axis = match [0, 1].iter().find(|k| is_at_end(k)) {
            Some(k) => self.kinematics.axes().get(3 + k),
            None => beyond(self.kinematics, &self.moves[i], end, node.way).first().map(|found| found.axis),
        };
        let letter = axis.or_else(|| self.kinematics.axes().last()).map_or('?', |axis| axis.letter);
        let since = (0..i).rev().find(|k| self.is_on_link(*k)).unwrap_or(0);
        MotionError::NoTurn { index: i, point: self.moves[i].to.tip, letter, since }
    }

    fn out_of_limits(&self, i: usize) -> MotionError {
        out_of_limits(self.kinematics, i, &self.moves[i], &self.ends[i])
    }
}
