//! When the axes are where.

use super::post::Posted;
use crate::machine::{Position, durations};

/// The motion of a program over its time.
#[derive(Debug, Clone, PartialEq)]
pub struct Timeline {
    /// When each move of the axes ends, s, and how far along the toolpath its tip is then, mm.
    ends: Vec<[f64; 2]>,
    positions: Vec<Position>,
}

/// A moment of a program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Since its beginning, s.
    pub seconds: f64,
    /// Share of the toolpath's length that is done, 0 to 1.
    pub share: f64,
    /// Where the axes stand.
    pub position: Position,
}

/// What an axis does in each of the columns of a plot: least and greatest.
pub type Band = Vec<[f64; 2]>;

impl Timeline {
    /// The motion of what was written.
    pub fn new(posted: &Posted) -> Self {
        let toolpath = &posted.toolpath;
        // How far along the toolpath each of its moves ends.
        let mut lengths = vec![0.0; toolpath.moves.len()];
        for k in 1..lengths.len() {
            lengths[k] = lengths[k - 1] + toolpath.moves[k].to.tip.distance(toolpath.moves[k - 1].to.tip);
        }
        let mut ends = Vec::with_capacity(posted.path.moves.len());
        let (mut seconds, mut length) = (0.0, 0.0f64);
        for (step, taken) in posted.path.moves.iter().zip(durations(posted.kinematics.axes(), &posted.path)) {
            seconds += taken;
            let (from, to) = (lengths[step.source.saturating_sub(1)], lengths[step.source]);
            let begin = toolpath.moves[step.source.saturating_sub(1)].to.tip;
            let along = if step.is_end { to } else { (from + begin.distance(step.to.tip)).min(to) };
            length = length.max(along);
            ends.push([seconds, length]);
        }
        Self { ends, positions: posted.path.moves.iter().map(|step| step.at).collect() }
    }

    /// The whole time, s.
    pub fn seconds(&self) -> f64 {
        self.ends.last().map_or(0.0, |end| end[0])
    }

    /// When a share of the toolpath's length is done. Where the machine turns its tool without getting on, that is the end of it.
    pub fn at_share(&self, share: f64) -> Moment {
        self.moment(1, share.clamp(0.0, 1.0) * self.ends.last().map_or(0.0, |end| end[1]))
    }

    /// A moment by its time, s.
    pub fn at_seconds(&self, seconds: f64) -> Moment {
        self.moment(0, seconds)
    }

    fn moment(&self, by: usize, wanted: f64) -> Moment {
        let after = self.ends.partition_point(|end| end[by] <= wanted).min(self.ends.len() - 1);
        let before = after.saturating_sub(1);
        let (a, b) = (self.ends[before], self.ends[after]);
        let t = if b[by] > a[by] { ((wanted - a[by]) / (b[by] - a[by])).clamp(0.0, 1.0) } else { 1.0 };
        let length = self.ends.last().map_or(0.0, |end| end[1]);
        Moment {
            seconds: a[0] + t * (b[0] - a[0]),
            share: if length > 0.0 { (a[1] + t * (b[1] - a[1])) / length } else { 1.0 },
            position: self.positions[before].lerp(&self.positions[after], t),
        }
    }

    /// Positions of the axis at `place` (as in [`Position::all`]) from one time to another, s, in `columns` of equal time.
    pub fn positions(&self, place: usize, [from, to]: [f64; 2], columns: usize) -> Band {
        self.band([from, to], columns, |k, shares| {
            let (a, b) = (self.positions[k - 1].all()[place], self.positions[k].all()[place]);
            shares.map(|t| a + t * (b - a))
        })
    }

    /// Speeds of the axis, units a second, likewise.
    pub fn speeds(&self, place: usize, [from, to]: [f64; 2], columns: usize) -> Band {
        self.band([from, to], columns, |k, _| {
            let way = self.positions[k].all()[place] - self.positions[k - 1].all()[place];
            let speed = way / (self.ends[k][0] - self.ends[k - 1][0]);
            [speed; 2]
        })
    }

    /// Collects what `value` gives for the part of a move between two shares of it that lies in each column.
    fn band(
        &self,
        [from, to]: [f64; 2],
        columns: usize,
        value: impl Fn(usize, [f64; 2]) -> [f64; 2],
    ) -> Band {
        let mut band = vec![[f64::INFINITY, f64::NEG_INFINITY]; columns];
        let wide = (to - from) / columns as f64;
        let first = self.ends.partition_point(|end| end[0] < from).max(1);
        for k in first..self.ends.len() {
            let (begin, end) = (self.ends[k - 1][0], self.ends[k][0]);
            if begin >= to {
                break;
            }
            if end <= begin {
                continue;
            }
            let column = |seconds: f64| (((seconds - from) / wide).max(0.0) as usize).min(columns - 1);
            for (at, cell) in band.iter_mut().enumerate().take(column(end) + 1).skip(column(begin)) {
                let edge = |side: usize| from + wide * (at + side) as f64;
                let share = |seconds: f64| ((seconds - begin) / (end - begin)).clamp(0.0, 1.0);
                for x in value(k, [share(edge(0)), share(edge(1))]) {
                    *cell = [cell[0].min(x), cell[1].max(x)];
                }
            }
        }
        band
    }
}
