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

/// Stands for no bound at all, millimetres; finite, so that it can be interpolated.
const UNBOUNDED: f64 = 1e6;

/// A bound of [`Sense::value`] over the triangle with the corners `samples`, which met `hits`, under a cutter whose
/// boundary is touched from inside by balls of radius `round` everywhere.
///
/// *Excess.* The cutter holds the ball that touches each corner's entry, so no excess exceeds the entry into that ball:
/// a convex function of the place, below the linear one through its values at the corners. The bound is the highest
/// point of the lowest of the three linear functions.
///
/// *Gouge.* At the deepest place the cutter is tangent to the surface and holds a ball that touches there; within the
/// distance `ρ` of the nearest corner (at most the longest edge over √3) the ball rises by no more than `ρ²/2r`-ish.
///
/// Where that does not suffice, [`Scene::spares`](super::cut::Scene::spares) asks the whole motion.
///
/// Both take the surface between the corners as bent no more than twice what the corners' normals show. Infinite for a
/// sharp cutter (`round` = 0): its edge may leave or cut anything between two samples.
pub(super) fn bound(sense: Sense, samples: [&Sample; 3], hits: [&Hit; 3], round: f64) -> f64 {
    if round <= 0.0 {
        return f64::INFINITY;
    }
    let bent = bow(samples);
    match sense {
        Sense::Excess => {
            let entry = |c: usize, k: usize| {
                if c == k { hits[c].t } else { into_ball(samples[k], hits[c].ball, round) }
            };
            let table = std::array::from_fn(|c| std::array::from_fn(|k| entry(c, k).min(UNBOUNDED)));
            let most = highest_lowest(&table);
            if most >= 1e-3 * UNBOUNDED { f64::INFINITY } else { most + bent }
        }
        Sense::Gouge => {
            let away = EDGES.into_iter().map(|e| length(samples, e)).fold(0.0, f64::max) / 3.0_f64.sqrt();
            if away >= round {
                return f64::INFINITY;
            }
            let rise = round - (round * round - away * away).sqrt();
            hits.iter().map(|hit| -hit.t).fold(f64::NEG_INFINITY, f64::max) + rise + bent
        }
    }
}

const EDGES: [(usize, usize); 3] = [(0, 1), (1, 2), (2, 0)];

fn length(samples: [&Sample; 3], (i, j): (usize, usize)) -> f64 {
    samples[i].point.distance(samples[j].point)
}

/// How far the surface between three samples may be from their plane, taken as bent no more than twice what their
/// normals show.
pub(super) fn bow(samples: [&Sample; 3]) -> f64 {
    // A bow over a chord L with the turn φ is L φ/8 high.
    let over =
        |e: (usize, usize)| 0.25 * length(samples, e) * samples[e.0].normal.distance(samples[e.1].normal);
    EDGES.into_iter().map(over).fold(0.0, f64::max)
}

/// Where the sample's line first enters a ball; infinite if it does not.
fn into_ball(sample: &Sample, centre: DVec3, radius: f64) -> f64 {
    let to = centre - sample.point;
    let along = to.dot(sample.normal);
    let under = radius * radius - (to - sample.normal * along).length_squared();
    if under >= 0.0 { along - under.sqrt() } else { f64::INFINITY }
}

/// The largest value over a triangle of the lowest of three linear functions, `table[c][k]` being the function `c` at the
/// corner `k`. The lowest of linear functions peaks where two conditions meet out of: on an edge, two functions equal.
fn highest_lowest(table: &[[f64; 3]; 3]) -> f64 {
    let lowest = |q: [f64; 3]| {
        let at = |row: &[f64; 3]| row[0] * q[0] + row[1] * q[1] + row[2] * q[2];
        table.iter().map(at).fold(f64::INFINITY, f64::min)
    };
    let mut most = f64::NEG_INFINITY;
    let pairs = [(0, 1), (1, 2), (2, 0)];
    let difference =
        |(a, b): (usize, usize)| -> [f64; 3] { std::array::from_fn(|k| table[a][k] - table[b][k]) };
    for k in 0..3 {
        let mut corner = [0.0; 3];
        corner[k] = 1.0;
        most = most.max(lowest(corner));
    }
    for (i, j) in pairs {
        for pair in pairs {
            let d = difference(pair);
            // The sign change along the edge from i to j.
            if d[i] * d[j] < 0.0 {
                let mut q = [0.0; 3];
                q[j] = d[i] / (d[i] - d[j]);
                q[i] = 1.0 - q[j];
                most = most.max(lowest(q));
            }
        }
    }
    let q = DVec3::from(difference((0, 1))).cross(DVec3::from(difference((1, 2))));
    let sum = q.x + q.y + q.z;
    let q = q / sum;
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
