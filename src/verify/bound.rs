//! What the excess can be between the samples at a triangle's corners.

use super::cut::Hit;
use super::samples::Sample;
use glam::DVec3;

/// Which end of the excess is sought.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sense {
    /// The largest excess.
    Excess,
    /// The deepest gouge, as a positive depth.
    Gouge,
}

impl Sense {
    /// The excess `t`, signed so that what is sought is large.
    pub(super) fn value(self, t: f64) -> f64 {
        match self {
            Sense::Excess => t,
            Sense::Gouge => -t,
        }
    }
}

/// A bound of [`Sense::value`] over the triangle with the corners `samples`, which met `hits`, under a cutter whose
/// boundary is touched from inside by balls of radius `round` everywhere.
///
/// *Excess.* The cutter holds the ball that touches each corner's entry; [`excess_over`] makes a bound of the three.
/// Where that does not suffice, [`Scene::excess_bound`](super::cut::Scene::excess_bound) asks more of the cutter.
///
/// *Gouge.* At the deepest place the cutter is tangent to the surface and holds a ball that touches there; within the
/// distance `ρ` of the nearest corner (at most the longest edge over √3) the ball rises by no more than `ρ²/2r`-ish.
/// Where that does not suffice, [`Scene::spares`](super::cut::Scene::spares) asks the whole motion.
///
/// Infinite for a sharp cutter (`round` = 0): no ball tells what its edge leaves or cuts between two samples.
pub(super) fn bound(sense: Sense, samples: [&Sample; 3], hits: [&Hit; 3], round: f64) -> f64 {
    if round <= 0.0 {
        return f64::INFINITY;
    }
    match sense {
        Sense::Excess => {
            let Some(up) = upward(samples) else { return f64::INFINITY };
            let row = |hit: &Hit| samples.map(|sample| into_ball(sample.point, up, hit.ball, round));
            excess_over(samples, up, &hits.map(row))
        }
        Sense::Gouge => {
            let away = longest(samples) / 3.0_f64.sqrt();
            if away >= round {
                return f64::INFINITY;
            }
            let rise = round - (round * round - away * away).sqrt();
            let deepest = hits.iter().map(|hit| -hit.t).fold(f64::NEG_INFINITY, f64::max);
            deepest + rise + bow(sense, samples)
        }
    }
}

/// A bound of the excess over the triangle with the corners `samples` where the cutter holds convex bodies: `rows` are the
/// heights at which the corners' lines along `up` enter each of them. Infinite without a row that is finite throughout.
///
/// Along parallel lines the entry into a convex body is a convex function of the place, below the linear one through its
/// values at the corners. So the lowest of these functions is the height of a sheet over the triangle that lies in the
/// cutter (where neighbours' sheets differ, lines along `up` inside the cutter join them). The surface's own normals,
/// which need not be parallel, cross that sheet, and from the surface to any point of it is no further than along `up`:
/// the sheet's height and what the surface sinks below the triangle. Under the surface a slanting normal falls short of
/// `up`; it is taken as slanting by no more than twice what the corners' do.
pub(super) fn excess_over(samples: [&Sample; 3], up: DVec3, rows: &[[f64; 3]]) -> f64 {
    let most = highest_lowest(rows) + bow(Sense::Excess, samples);
    if most >= 0.0 {
        return most;
    }
    let slant = samples.iter().map(|sample| 1.0 - sample.normal.dot(up)).fold(0.0, f64::max);
    // Twice the angle falls short by four times as much, at most.
    most * (1.0 - 4.0 * slant).max(0.0)
}

/// The corners' mean normal, if there is one.
pub(super) fn upward(samples: [&Sample; 3]) -> Option<DVec3> {
    samples.iter().map(|sample| sample.normal).sum::<DVec3>().try_normalize()
}

const EDGES: [(usize, usize); 3] = [(0, 1), (1, 2), (2, 0)];

/// The longest edge.
pub(super) fn longest(samples: [&Sample; 3]) -> f64 {
    EDGES.into_iter().map(|(i, j)| samples[i].point.distance(samples[j].point)).fold(0.0, f64::max)
}

/// How far the surface between three samples may be from their plane, where that makes what is sought larger: below it for
/// the excess, above it for a gouge. It is taken as bent no more than twice what the normals show along the edges.
pub(super) fn bow(sense: Sense, samples: [&Sample; 3]) -> f64 {
    // A bow over a chord L with the turn φ is L φ/8 high; up where the normals spread.
    let spread = |(i, j): (usize, usize)| {
        (samples[j].point - samples[i].point).dot(samples[j].normal - samples[i].normal)
    };
    EDGES.into_iter().map(|e| -0.25 * sense.value(spread(e))).fold(0.0, f64::max)
}

/// Where the line through `point` along `up` first enters a ball; infinite if it does not.
pub(super) fn into_ball(point: DVec3, up: DVec3, centre: DVec3, radius: f64) -> f64 {
    let to = centre - point;
    let along = to.dot(up);
    let under = radius * radius - (to - up * along).length_squared();
    if under >= 0.0 { along - under.sqrt() } else { f64::INFINITY }
}

/// The largest value over a triangle of the lowest of up to three linear functions, `rows[c][k]` being the function `c` at the
/// corner `k`; one that is not finite at every corner is left out, and the largest value of none is infinite. The lowest of
/// linear functions peaks where two conditions meet out of: on an edge, two functions equal.
fn highest_lowest(rows: &[[f64; 3]]) -> f64 {
    let rows = || rows.iter().filter(|row| row.iter().all(|t| t.is_finite()));
    let lowest = |q: [f64; 3]| {
        let at = |row: &[f64; 3]| row[0] * q[0] + row[1] * q[1] + row[2] * q[2];
        rows().map(at).fold(f64::INFINITY, f64::min)
    };
    let mut most = f64::NEG_INFINITY;
    for k in 0..3 {
        let mut corner = [0.0; 3];
        corner[k] = 1.0;
        most = most.max(lowest(corner));
    }
    let mut differences = [DVec3::ZERO; 3];
    let mut count = 0;
    for (a, first) in rows().enumerate() {
        for second in rows().skip(a + 1) {
            let d: [f64; 3] = std::array::from_fn(|k| first[k] - second[k]);
            for (i, j) in EDGES {
                // The sign change along the edge from i to j.
                if d[i] * d[j] < 0.0 {
                    let mut q = [0.0; 3];
                    q[j] = d[i] / (d[i] - d[j]);
                    q[i] = 1.0 - q[j];
                    most = most.max(lowest(q));
                }
            }
            differences[count] = d.into();
            count += 1;
        }
    }
    let q = differences[0].cross(differences[1]);
    let q = q / (q.x + q.y + q.z);
    if q.is_finite() && q.min_element() >= 0.0 {
        most = most.max(lowest(q.to_array()));
    }
    most
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_peak_of_the_lowest_function_is_found() {
        // Deterministic spread of tables; dense search never finds more, and comes close.
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1 << 24)
        };
        for _ in 0..200 {
            let table: [[f64; 3]; 3] = std::array::from_fn(|_| std::array::from_fn(|_| random()));
            let mut dense = f64::NEG_INFINITY;
            let n = 60;
            for i in 0..=n {
                for j in 0..=n - i {
                    let q = [f64::from(i), f64::from(j), f64::from(n - i - j)].map(|x| x / f64::from(n));
                    let at = |row: &[f64; 3]| row[0] * q[0] + row[1] * q[1] + row[2] * q[2];
                    dense = dense.max(table.iter().map(at).fold(f64::INFINITY, f64::min));
                }
            }
            let exact = highest_lowest(&table);
            assert!(exact >= dense - 1e-12 && exact <= dense + 0.05, "{table:?} {exact} {dense}");
        }
    }
}
