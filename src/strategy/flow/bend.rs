//! A function on a face bent so that passes along its level lines have wide strips and lie edge to edge.

use crate::geometry::{Domain, FaceGrid, GradientFit, Wish, triangles};
use crate::strategy::line_field::LineField;
use crate::strategy::potential::Potential;

/// Rounds in which the function comes to agree with the directions that it is bent towards.
const ROUNDS: usize = 5;
/// How much a level line that strays counts against a strip's width that is off, at least.
const STRAY: f64 = 0.2;
/// The same where places along lines are told apart.
const COLUMN: f64 = 0.3;

/// The function with `values` at the nodes of `grid`, bent: it rises by about one over every strip. From 0 on.
///
/// In every round it is fitted to rise by `1/w` in the direction that is best there; which of the two ways is up, and how to go on
/// where no direction is better than another, it knows from the round before. Where the widest strip is wider than the narrowest by the
/// share `soft`, as much is given to its direction as to what the function has.
pub(super) fn bent(
    grid: &FaceGrid,
    potential: &Potential,
    lines: &LineField,
    (values, domain): (&[f64], Domain),
    soft: f64,
) -> Vec<f64> {
    let mut values = values.to_vec();
    for _ in 0..ROUNDS {
        let mut fit = GradientFit::new(domain, grid);
        for triangle in triangles(grid) {
            let Some(rise) = triangle.flat(triangle.gradient(&values)) else { continue };
            let (best, matters) = lines.rise(&triangle, rise);
            let share = matters / (matters + soft);
            let Some(along) = triangle.flat(rise * (1.0 - share) + best * share) else { continue };
            let feed = triangle.normal.cross(along);
            let width = potential.mean_width(&triangle, feed);
            if width > 0.0 {
                let weight = triangle.normal.length() * width * width;
                fit.add(&triangle, &Wish { change: along / width, along, aside: STRAY + share, weight });
            }
        }
        values = fit.solved_near(&values, []);
    }
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    values.iter().map(|x| x - low).collect()
}

/// The function that tells places along the level lines of the one with `values` apart, about one for a millimetre.
pub(super) fn columns(grid: &FaceGrid, values: &[f64], domain: Domain) -> Vec<f64> {
    let mut fit = GradientFit::new(domain, grid);
    for triangle in triangles(grid) {
        if let Some(along) = triangle.flat(triangle.normal.cross(triangle.gradient(values))) {
            let weight = triangle.normal.length();
            fit.add(&triangle, &Wish { change: along, along, aside: COLUMN, weight });
        }
    }
    fit.solved([])
}
