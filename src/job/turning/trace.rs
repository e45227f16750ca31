//! What the axes do, to draw.

use super::run::{TurningPlan, rpm};

/// What Z does along one turn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Motion {
    /// Five numbers a point: angle of the tool over the part (degrees, from the start of the turn's circle), distance from the axis
    /// (mm), height (mm), velocity (mm/s) and acceleration (mm/s²).
    pub points: Vec<f64>,
}

/// What Z does, turn by turn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Progress {
    /// Six numbers a turn: distance from the axis (mm), speed of the spindle (1/min), stroke of Z (mm), and its largest velocity,
    /// acceleration and jerk (mm, s).
    pub turns: Vec<f64>,
}

impl TurningPlan {
    /// The turn during which the nose first comes within `radius` mm of the axis, or leaves it behind.
    pub fn motion(&self, radius: f64) -> Motion {
        let points = &self.planned.path.points;
        let outward = points.first().zip(points.last()).is_some_and(|(a, b)| a.x < b.x);
        let start = points.partition_point(|p| (p.x > radius) != outward).min(points.len().saturating_sub(1));
        let Some(first) = points.get(start) else { return Motion::default() };
        let turn = std::f64::consts::TAU;
        let zero = (first.c / turn).floor() * turn;
        let within = points[start..].iter().take_while(|p| p.c <= first.c + turn * (1.0 + 1e-9));
        let flat = within
            .zip(&self.planned.accelerations[start..])
            .flat_map(|(p, a)| [(p.c - zero).to_degrees(), p.x, p.z, p.rates[1], a[1]]);
        Motion { points: flat.collect() }
    }

    /// What Z does, turn by turn from the start.
    pub fn progress(&self) -> Progress {
        let turns = self.planned.dynamics.turns.iter();
        let flat = turns.flat_map(|t| {
            let [v, a, j] = t.peaks;
            [t.x, rpm(t.speed), t.reach[1] - t.reach[0], v, a, j]
        });
        Progress { turns: flat.collect() }
    }

    /// The way of the nose over the part: x, y, z of its lowest point, point by point, mm.
    pub fn nose_path(&self) -> Vec<f32> {
        let r = self.nose.radius();
        let place = |p: &crate::toolpath::AxisPoint| {
            let (sin, cos) = libm::sincos(p.c);
            [p.x * cos, p.x * sin, p.z - r].map(|x| x as f32)
        };
        self.planned.path.points.iter().flat_map(place).collect()
    }

    /// Where the nose touches the part: x, y, z, point by point, mm.
    pub fn touches(&self) -> Vec<f32> {
        let place = |[x, y]: &[f64; 2]| [*x, *y, self.order.part.at(*x, *y).z].map(|x| x as f32);
        self.planned.touches.iter().flat_map(place).collect()
    }

    /// Height of the part at `(x, y)`, mm.
    pub fn height(&self, x: f64, y: f64) -> f64 {
        self.order.part.at(x, y).z
    }
}
