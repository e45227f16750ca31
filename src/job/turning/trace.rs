//! What the axes do, to draw and to tabulate.

use super::run::{TurningPlan, rpm};
use std::f64::consts::TAU;

/// Most points of a turn that are drawn: one a degree and a little.
const MOST_DRAWN: usize = 480;

impl TurningPlan {
    /// The turn during which the nose first comes within `radius` mm of the axis, or leaves it behind: 13 numbers a point.
    /// The angle of the tool over the part (degrees, from the start of the turn's circle), then for X, Z and C position, velocity, acceleration
    /// and jerk; X and Z in mm, C in degrees, and seconds.
    pub fn motion(&self, radius: f64) -> Vec<f64> {
        let points = &self.planned.path.points;
        let accelerations = &self.planned.accelerations;
        let outward = points.first().zip(points.last()).is_some_and(|(a, b)| a.x < b.x);
        let start = points.partition_point(|p| (p.x > radius) != outward).min(points.len().saturating_sub(1));
        let Some(first) = points.get(start) else { return Vec::new() };
        let zero = (first.c / TAU).floor() * TAU;
        let count = points[start..].iter().take_while(|p| p.c <= first.c + TAU * (1.0 + 1e-9)).count();
        let mut flat = Vec::new();
        for i in (start..start + count).step_by(count.div_ceil(MOST_DRAWN).max(1)) {
            // The jerk of a last point is that before it.
            let k = i.min(points.len().saturating_sub(2));
            let dt = points.get(k + 1).map_or(f64::INFINITY, |next| next.time - points[k].time);
            let p = &points[i];
            flat.push((p.c - zero).to_degrees());
            for (axis, position) in [p.x, p.z, p.c - zero].into_iter().enumerate() {
                let after = accelerations.get(k + 1).map_or(accelerations[k][axis], |a| a[axis]);
                let jerk = (after - accelerations[k][axis]) / dt;
                let all = [position, p.rates[axis], accelerations[i][axis], jerk];
                flat.extend(all.map(|value| value * scale(axis)));
            }
        }
        flat
    }

    /// What the axes do turn by turn from the start: 14 numbers a turn. Distance from the axis (mm), speed of the spindle (1/min), then for
    /// X, Z and C the stroke and the largest velocity, acceleration and jerk; X and Z in mm, C in degrees, and seconds.
    pub fn turns(&self) -> Vec<f64> {
        let mut flat = Vec::new();
        for t in &self.planned.dynamics.turns {
            flat.extend([t.x, rpm(t.speed)]);
            for axis in 0..3 {
                let [v, a, j] = t.peaks[axis];
                let stroke = t.reach[axis][1] - t.reach[axis][0];
                flat.extend([stroke, v, a, j].map(|value| value * scale(axis)));
            }
        }
        flat
    }

    /// [`TurningPlan::turns`] as a table.
    pub fn turns_csv(&self) -> String {
        use std::fmt::Write;
        let mut text = String::from("radius_mm,spindle_rpm");
        for (axis, unit) in [("x", "mm"), ("z", "mm"), ("c", "deg")] {
            let _ = write!(
                text,
                ",{axis}_stroke_{unit},{axis}_{unit}_per_s,{axis}_{unit}_per_s2,{axis}_{unit}_per_s3"
            );
        }
        for turn in self.turns().chunks_exact(14) {
            for (i, value) in turn.iter().enumerate() {
                // Writing to a string cannot fail.
                let _ = write!(text, "{}{value:.6}", if i == 0 { '\n' } else { ',' });
            }
        }
        text.push('\n');
        text
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
            let (sin, cos) = libm::sincos(TAU * ray as f64 / rays as f64);
            for ring in 0..rings {
                let (x, y) = (step * ring as f64 * cos, step * ring as f64 * sin);
                let inside = self.order.aperture.contains(x, y);
                all.push(if inside { self.order.part.at(x, y).z as f32 } else { f32::NAN });
            }
        }
        all
    }
}

/// What a number of an axis is multiplied by for a person: C is in radians inside.
fn scale(axis: usize) -> f64 {
    if axis == 2 { 1.0_f64.to_degrees() } else { 1.0 }
}
