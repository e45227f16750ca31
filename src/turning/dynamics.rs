//! What a path asks of the axes.

use crate::toolpath::AxisPoint;

/// A point of the path with all that the axes do there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Position, time and velocity.
    pub point: AxisPoint,
    /// Accelerations of X and Z, mm/s², and of C, rad/s².
    pub acceleration: [f64; 3],
    /// Whether the spindle is getting going or coming to rest.
    pub is_ramp: bool,
}

/// The largest magnitude of something along the path.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Peak {
    /// mm or radians, by seconds to the power that it is of.
    pub value: f64,
    /// Distance from the axis, mm.
    pub x: f64,
    /// Angle, radians.
    pub c: f64,
}

/// What the axes do in one turn.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Trend {
    /// Mean distance from the axis, mm.
    pub x: f64,
    /// Mean speed of the spindle, rad/s.
    pub speed: f64,
    /// Lowest and highest X and Z, mm, and C, radians.
    pub reach: [[f64; 2]; 3],
    /// For X, Z and C: the largest velocity, acceleration and jerk. X and Z in mm, C in radians.
    pub peaks: [[f64; 3]; 3],
}

/// What a path asks of the axes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Dynamics {
    /// Seconds from the first to the last point.
    pub time: f64,
    /// For X, Z and C: the largest velocity, acceleration and jerk on the way. X and Z in mm, C in radians.
    pub peaks: [[Peak; 3]; 3],
    /// The same while the spindle gets going and comes to rest.
    pub ramps: [[Peak; 3]; 3],
    /// Turn by turn, from the start.
    pub turns: Vec<Trend>,
}

/// What `moments` ask of the axes. Velocity and acceleration are those of the curve at its points; jerk is the change of
/// acceleration between neighbouring points over their time.
///
/// For linear interpolation these are of the curve that the points are taken from: the control rounds the corners of the
/// chords, and no more exact statement holds for all controls.
pub fn dynamics(moments: &[Moment]) -> Dynamics {
    let mut found = Dynamics::default();
    let Some(first) = moments.first() else { return found };
    let mut turn = 0;
    let mut trend = Started::default();
    for (i, m) in moments.iter().enumerate() {
        let jerk = moments.get(i + 1).map_or([0.0; 3], |next| jerk(m, next));
        let all = [m.point.rates, m.acceleration, jerk];
        // Between a point of the ramp and one that is not there is the ramp's last stretch.
        let is_ramp = m.is_ramp || moments.get(i + 1).is_some_and(|next| next.is_ramp);
        let peaks = if is_ramp { &mut found.ramps } else { &mut found.peaks };
        for (axis, peaks) in peaks.iter_mut().enumerate() {
            for (peak, values) in peaks.iter_mut().zip(&all) {
                if values[axis].abs() > peak.value {
                    *peak = Peak { value: values[axis].abs(), x: m.point.x, c: m.point.c };
                }
            }
        }
        let now = ((m.point.c - first.point.c).abs() / std::f64::consts::TAU) as usize;
        if now != turn {
            found.turns.extend(trend.ended());
            (turn, trend) = (now, Started::default());
        }
        trend.add(m, all);
    }
    found.turns.extend(trend.ended());
    found.time = moments.last().map_or(0.0, |last| last.point.time - first.point.time);
    found
}

/// The change of acceleration from `m` to `next` over their time.
fn jerk(m: &Moment, next: &Moment) -> [f64; 3] {
    let dt = next.point.time - m.point.time;
    [0, 1, 2].map(|k| (next.acceleration[k] - m.acceleration[k]) / dt)
}

impl Dynamics {
    /// What is asked where everything goes `share` times as fast.
    #[must_use]
    pub fn scaled(&self, share: f64) -> Self {
        let powers = [share, share * share, share * share * share];
        let mut scaled = self.clone();
        scaled.time /= share;
        for peaks in scaled.peaks.iter_mut().chain(&mut scaled.ramps) {
            for (peak, power) in peaks.iter_mut().zip(powers) {
                peak.value *= power;
            }
        }
        for turn in &mut scaled.turns {
            turn.speed *= share;
            for peaks in &mut turn.peaks {
                for (peak, power) in peaks.iter_mut().zip(powers) {
                    *peak *= power;
                }
            }
        }
        scaled
    }
}

/// A turn that is being gone through.
#[derive(Default)]
struct Started {
    count: usize,
    sums: [f64; 2],
    trend: Trend,
}

impl Started {
    /// `values` are velocity, acceleration and jerk of X, Z and C.
    fn add(&mut self, m: &Moment, values: [[f64; 3]; 3]) {
        let t = &mut self.trend;
        for (axis, at) in [m.point.x, m.point.z, m.point.c].into_iter().enumerate() {
            let [low, high] = t.reach[axis];
            t.reach[axis] = if self.count == 0 { [at; 2] } else { [low.min(at), high.max(at)] };
            for (peak, value) in t.peaks[axis].iter_mut().zip(&values) {
                *peak = peak.max(value[axis].abs());
            }
        }
        self.count += 1;
        self.sums = [self.sums[0] + m.point.x, self.sums[1] + m.point.rates[2]];
    }

    fn ended(&self) -> Option<Trend> {
        let count = self.count as f64;
        (self.count > 0).then(|| Trend { x: self.sums[0] / count, speed: self.sums[1] / count, ..self.trend })
    }
}
