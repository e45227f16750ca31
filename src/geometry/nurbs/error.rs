//! What is wrong with the description of a spline surface, and the check that finds it.

use super::{Along, MAX_DEGREE};
use glam::DVec3;

/// Most control points of one surface. Each takes 32 bytes, so this is 128 MiB, a thirty-second of what a page can
/// address; the largest net met in real files has 6,838.
pub const MAX_POINTS: usize = 1 << 22;

/// Why a spline surface cannot exist.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NurbsError {
    /// The degree is 0 or too high.
    #[error("degree in {along}: must be 1 to {MAX_DEGREE}, found {found}")]
    Degree {
        /// Which parameter.
        along: Along,
        /// The degree given.
        found: usize,
    },
    /// Fewer knots than two for each control point of the smallest surface of this degree.
    #[error("knots in {along}: degree {degree} needs at least {least}, found {found}")]
    FewKnots {
        /// Which parameter.
        along: Along,
        /// Its degree.
        degree: usize,
        /// Smallest number of knots.
        least: usize,
        /// The number given.
        found: usize,
    },
    /// Knot counts and number of control points disagree.
    #[error(
        "control points: these knots and degrees ask for {across_u} × {across_v} = {} points, found {found}",
        across_u * across_v
    )]
    PointCount {
        /// Points along u, which is the number of knots less degree less 1.
        across_u: usize,
        /// Points along v.
        across_v: usize,
        /// The number given.
        found: usize,
    },
    /// More control points than [`MAX_POINTS`].
    #[error("control points: at most {MAX_POINTS}, found {found}")]
    ManyPoints {
        /// The number given.
        found: usize,
    },
    /// A knot is infinite or no number.
    #[error("knots in {along}: number {index} (counted from 0) is not finite")]
    KnotNotFinite {
        /// Which parameter.
        along: Along,
        /// The knot's number.
        index: usize,
    },
    /// A knot is smaller than the one before.
    #[error(
        "knots in {along}: number {index} (counted from 0) is below the one before it; knots must not fall"
    )]
    KnotFalls {
        /// Which parameter.
        along: Along,
        /// The knot's number.
        index: usize,
    },
    /// A knot repeats so often that the surface breaks there.
    #[error("knots in {along}: {value} stands {found} times, at most {most} are possible there")]
    Multiplicity {
        /// Which parameter.
        along: Along,
        /// The knot.
        value: f64,
        /// How often it stands.
        found: usize,
        /// How often it may: the degree, or one more for the first and last knot.
        most: usize,
    },
    /// A knot insertion outside the domain.
    #[error("knots in {along}: {value} is not inside the domain")]
    Outside {
        /// Which parameter.
        along: Along,
        /// The knot.
        value: f64,
    },
    /// The domain has no length.
    #[error("knots in {along}: the domain, from knot {degree} to the {degree}th from the end, has no length")]
    NoDomain {
        /// Which parameter.
        along: Along,
        /// Its degree.
        degree: usize,
    },
    /// A coordinate is infinite or no number.
    #[error("control point ({i}, {j}), counted from 0, is not finite")]
    PointNotFinite {
        /// Number along u.
        i: usize,
        /// Number along v.
        j: usize,
    },
    /// Not one weight for each control point.
    #[error("weights: {points} control points need as many weights, found {found}")]
    WeightCount {
        /// Number of control points.
        points: usize,
        /// Number of weights given.
        found: usize,
    },
    /// A weight is not above 0, or not finite.
    #[error("weight of control point ({i}, {j}), counted from 0, must be above 0 and finite, found {value}")]
    Weight {
        /// Number along u.
        i: usize,
        /// Number along v.
        j: usize,
        /// The weight.
        value: f64,
    },
}

/// The number of control points that `knots` of `degree` ask for.
pub(super) fn check_knots(along: Along, degree: usize, knots: &[f64]) -> Result<usize, NurbsError> {
    if !(1..=MAX_DEGREE).contains(&degree) {
        return Err(NurbsError::Degree { along, found: degree });
    }
    let least = 2 * (degree + 1);
    if knots.len() < least {
        return Err(NurbsError::FewKnots { along, degree, least, found: knots.len() });
    }
    if let Some(index) = knots.iter().position(|knot| !knot.is_finite()) {
        return Err(NurbsError::KnotNotFinite { along, index });
    }
    if let Some(index) = knots.windows(2).position(|pair| pair[1] < pair[0]) {
        return Err(NurbsError::KnotFalls { along, index: index + 1 });
    }
    for run in knots.chunk_by(|a, b| a == b) {
        let value = run[0];
        let at_end = value == knots[0] || value == knots[knots.len() - 1];
        let most = if at_end { degree + 1 } else { degree };
        if run.len() > most {
            return Err(NurbsError::Multiplicity { along, value, found: run.len(), most });
        }
    }
    let count = knots.len() - degree - 1;
    // The length may also overflow, for knots near the largest number.
    let length = knots[count] - knots[degree];
    if !(length > 0.0 && length.is_finite()) {
        return Err(NurbsError::NoDomain { along, degree });
    }
    Ok(count)
}

/// Checks control points and weights against the counts that the knots ask for.
pub(super) fn check_net(
    counts: [usize; 2],
    points: &[DVec3],
    weights: Option<&[f64]>,
) -> Result<(), NurbsError> {
    if points.len() > MAX_POINTS {
        return Err(NurbsError::ManyPoints { found: points.len() });
    }
    if counts[0].checked_mul(counts[1]) != Some(points.len()) {
        let [across_u, across_v] = counts;
        return Err(NurbsError::PointCount { across_u, across_v, found: points.len() });
    }
    let place = |k: usize| (k / counts[1], k % counts[1]);
    if let Some((i, j)) = points.iter().position(|p| !p.is_finite()).map(place) {
        return Err(NurbsError::PointNotFinite { i, j });
    }
    let Some(weights) = weights else { return Ok(()) };
    if weights.len() != points.len() {
        return Err(NurbsError::WeightCount { points: points.len(), found: weights.len() });
    }
    match weights.iter().position(|&w| !(w > 0.0 && w.is_finite())) {
        Some(k) => {
            let (i, j) = place(k);
            Err(NurbsError::Weight { i, j, value: weights[k] })
        }
        None => Ok(()),
    }
}
