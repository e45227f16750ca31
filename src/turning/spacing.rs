//! At which angles of the guide points are put.

use super::error::TurningError;
use super::guide::Guide;

/// How far points are apart. Angles in radians, lengths in mm along the guide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spacing {
    /// By equal angles: the C axis goes evenly.
    Angle(f64),
    /// By equal arcs: points lie evenly over the part. Near the axis by no more than `most` radians.
    Arc {
        /// Length of the arc.
        length: f64,
        /// Largest angle.
        most: f64,
    },
    /// By equal arcs outside a distance from the axis, and inside by the angle that the arc has there.
    Hybrid {
        /// Length of the arc.
        length: f64,
        /// The distance from the axis, mm.
        switch: f64,
    },
}

/// Most points of a path: a program of them is about a gigabyte of text.
pub(super) const MOST_POINTS: usize = 20_000_000;

impl Spacing {
    /// The angle to the next point at the distance `x` from the axis.
    pub fn angle(&self, x: f64) -> f64 {
        match *self {
            Self::Angle(angle) => angle,
            Self::Arc { length, most } => (length / x.max(f64::MIN_POSITIVE)).min(most),
            Self::Hybrid { length, switch } => length / x.max(switch),
        }
    }

    /// The spacing with points `share` times as far apart.
    #[must_use]
    pub fn scaled(&self, share: f64) -> Self {
        match *self {
            Self::Angle(angle) => Self::Angle(angle * share),
            Self::Arc { length, most } => Self::Arc { length: length * share, most },
            Self::Hybrid { length, switch } => Self::Hybrid { length: length * share, switch },
        }
    }
}

/// The angles of the points along `guide`, its two ends among them.
///
/// Errors: more than 20 million.
pub fn angles(guide: &Guide, spacing: &Spacing) -> Result<Vec<f64>, TurningError> {
    let end = guide.length();
    // Equal angles are the most, if they are those of the rim.
    let least = spacing.angle(guide.farthest());
    let too_many = |count| TurningError::TooMany {
        count,
        limit: MOST_POINTS,
        hint: "larger steps between turns or between points would do",
    };
    let count = end / least;
    if count.is_nan() || count >= MOST_POINTS as f64 {
        return Err(too_many(count));
    }
    let mut all = Vec::with_capacity((end / least) as usize + 2);
    if let Spacing::Angle(angle) = *spacing {
        // By counting, not by adding up.
        let whole = (end / angle * (1.0 - 1e-12)).ceil() as usize;
        all.extend((0..whole).map(|i| i as f64 * angle));
    } else {
        let mut c = 0.0;
        while c < end {
            all.push(c);
            // The arc's middle tells its angle to the second order.
            let half = 0.5 * spacing.angle(guide.at(c)[0]);
            c += spacing.angle(guide.at((c + half).min(end))[0]);
        }
    }
    // A last step of next to nothing would be a point twice.
    if all.len() > 1 && all.last().is_some_and(|last| end - last < 1e-6 * least) {
        all.pop();
    }
    all.push(end);
    Ok(all)
}
