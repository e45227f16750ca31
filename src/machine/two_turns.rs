//! Pointing a direction by turning it about two lines in turn.

use crate::math::angle::turn_about;
use glam::DVec3;

/// The ways to turn one direction into another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TwoTurns {
    /// Both pairs of angles about the first and the second line, each in (−π, π]; equal where there is but one.
    pub(super) pairs: [[f64; 2]; 2],
    /// How far apart the two ways are: the sine of the angle from where they become one. For lines at right angles that is the
    /// angle between `to` and the first line. Along `to = ±first` the angle about the first is free, and given as 0.
    pub(super) apart: f64,
}

/// How far beyond reach, as a square of a sine, still counts as a rounding error.
const ROUNDING: f64 = 1e-12;

/// The angles θ₁ about `first` and θ₂ about `second` with `R(first, θ₁) R(second, θ₂) from = to`; all unit, the two lines not
/// parallel. `None` if no angles do it.
///
/// The first pair is the one for which `R(second, θ₂) from` lies on the side of `first × second`; along a path a pair changes into the
/// other only where [`TwoTurns::apart`] is 0.
///
/// Source: R. M. Murray, Z. Li, S. S. Sastry, A Mathematical Introduction to Robotic Manipulation, 1994, ch. 3, Paden–Kahan
/// subproblem 2. We differ in taking γ from `|first × to|`, which keeps its digits near the pole, and in finding θ₁ from what θ₂ has
/// made of `from`, so that an error of θ₂ there does not become one of the direction.
pub(super) fn two_turns(first: DVec3, second: DVec3, from: DVec3, to: DVec3) -> Option<TwoTurns> {
    let across = first.cross(second);
    let (cosine, s2) = (first.dot(second), across.length_squared());
    // c = α first + β second ± γ across is where both circles meet: `from` about `second`, `to` about `first`.
    let (of_second, of_first) = (second.dot(from), first.dot(to));
    let alpha = (of_first - cosine * of_second) / s2;
    let beta = (of_second - cosine * of_first) / s2;
    let gamma2 = first.cross(to).length_squared() / s2 - beta * beta;
    if gamma2 < -ROUNDING {
        return None;
    }
    let gamma = gamma2.max(0.0).sqrt();
    let pair = |gamma: f64| {
        let middle = alpha * first + beta * second + gamma * across;
        let second_angle = turn(second, from, middle);
        let turned = turn_about(second, second_angle) * from;
        [turn(first, turned, to), second_angle]
    };
    Some(TwoTurns { pairs: [pair(gamma), pair(-gamma)], apart: gamma * s2.sqrt() })
}

/// The angle about `line` that brings `from` nearest to `to`, in (−π, π]; 0 if either lies along the line.
fn turn(line: DVec3, from: DVec3, to: DVec3) -> f64 {
    // Of what both have square to the line: near it the difference `from · to − …` would lose its digits.
    libm::atan2(line.dot(from.cross(to)), line.cross(from).dot(line.cross(to)))
}
