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

    /// Where the nose touches the part: x, y, z, mm, at every so many points of the path that they are no more than about `most`.
    pub fn touches(&self, most: usize) -> Vec<f32> {
        let all = &self.planned.touches;
        let place = |[x, y]: &[f64; 2]| [*x, *y, self.order.part.at(*x, *y).z].map(|x| x as f32);
        all.iter().step_by(all.len().div_ceil(most.max(1)).max(1)).flat_map(place).collect()
    }

    /// No place of the aperture is farther from the axis, mm.
    pub fn farthest(&self) -> f64 {
        self.order.aperture.farthest()
    }

    /// Heights of the part, mm, on `rays` rays with `rings` places each, out to [`TurningPlan::farthest`]; not numbers outside of the
    /// aperture.
    pub fn heights(&self, rays: usize, rings: usize) -> Vec<f32> {
        let step = self.farthest() / (rings.max(2) - 1) as f64;
        let mut all = Vec::with_capacity(rays * rings);
        for ray in 0..rays {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * ray as f64 / rays as f64);
            for ring in 0..rings {
                let (x, y) = (step * ring as f64 * cos, step * ring as f64 * sin);
                let inside = self.order.aperture.contains(x, y);
                all.push(if inside { self.order.part.at(x, y).z as f32 } else { f32::NAN });
            }
        }
        all
    }
}
