//! A face divided between families, each where its strips are widest.

use crate::geometry::FaceGrid;

/// Families at most.
const FAMILIES: usize = 6;
/// Another family must save this share.
const SAVES: f64 = 0.01;
/// What a millimetre of the line costs along which families meet, mm: passes of both end there, each a little beyond.
const MEETING: f64 = 0.5;
/// Lines aslant to the grid are counted as stairs, which are longer by 4/π on the mean.
const STAIRS: f64 = std::f64::consts::FRAC_PI_4;
/// Over how many cells to either side shares are evened out before the smaller is taken: the finer the longer the lines between.
const EVEN: [usize; 4] = [1, 2, 4, 8];

/// Which of some functions each node of a grid goes by, and how long the passes should be, mm.
#[derive(Debug, Clone)]
pub(super) struct Division {
    pub(super) expected: f64,
    /// The numbers of the functions.
    pub(super) families: Vec<usize>,
    /// For every node which of these it goes by.
    pub(super) labels: Vec<usize>,
}

/// The division of the nodes of `grid` between functions with these shares of the passes at them, [`crate::strategy::coarea::shares`];
/// `None` where one function alone is as good.
pub(super) fn divided(grid: &FaceGrid, shares: &[Vec<f64>]) -> Option<Division> {
    let total = |k: usize| shares[k].iter().sum::<f64>();
    let first = (0..shares.len()).min_by(|a, b| total(*a).total_cmp(&total(*b)))?;
    let even: Vec<Vec<Vec<f64>>> =
        EVEN.iter().map(|&by| shares.iter().map(|own| evened(grid, own, by)).collect()).collect();
    let count = grid.points().len();
    let mut best = Division { expected: total(first), families: vec![first], labels: vec![0; count] };
    while best.families.len() < FAMILIES {
        let mut next: Option<Division> = None;
        for k in (0..shares.len()).filter(|k| !best.families.contains(k)) {
            let families: Vec<usize> = best.families.iter().copied().chain([k]).collect();
            for even in &even {
                let least = |node: usize| {
                    (0..families.len())
                        .min_by(|a, b| even[families[*a]][node].total_cmp(&even[families[*b]][node]))
                        .unwrap_or(0)
                };
                let mut labels: Vec<usize> = (0..count).map(least).collect();
                let families = used(&families, &mut labels);
                let expected = labels
                    .iter()
                    .enumerate()
                    .map(|(node, &label)| shares[families[label]][node])
                    .sum::<f64>()
                    + MEETING * meeting(grid, &labels);
                if next.as_ref().is_none_or(|next| expected < next.expected) {
                    next = Some(Division { expected, families, labels });
                }
            }
        }
        match next {
            Some(next) if next.expected < (1.0 - SAVES) * best.expected => best = next,
            _ => break,
        }
    }
    (best.families.len() > 1).then_some(best)
}

/// Those of `families` that some node goes by; `labels` are their numbers from then on.
fn used(families: &[usize], labels: &mut [usize]) -> Vec<usize> {
    let is_used: Vec<bool> = (0..families.len()).map(|k| labels.contains(&k)).collect();
    let before = |k: usize| is_used[..k].iter().filter(|is_used| **is_used).count();
    labels.iter_mut().for_each(|label| *label = before(*label));
    (0..families.len()).filter(|&k| is_used[k]).map(|k| families[k]).collect()
}

/// How long the lines are between nodes with different labels, mm.
fn meeting(grid: &FaceGrid, labels: &[usize]) -> f64 {
    let (nu, nv) = grid.size();
    let at = |i: usize, j: usize| grid.points()[j * nu + i];
    let mut length = 0.0;
    for j in 0..nv {
        for i in 0..nu {
            let label = labels[j * nu + i];
            if i + 1 < nu && labels[j * nu + i + 1] != label {
                let (low, high) = (j.saturating_sub(1), (j + 1).min(nv - 1));
                length += at(i, low).distance(at(i, high)) / (high - low) as f64;
            }
            if j + 1 < nv && labels[(j + 1) * nu + i] != label {
                let (low, high) = (i.saturating_sub(1), (i + 1).min(nu - 1));
                length += at(low, j).distance(at(high, j)) / (high - low) as f64;
            }
        }
    }
    STAIRS * length
}

/// The means of `values` over the nodes up to `by` away along both parameters, three times over.
fn evened(grid: &FaceGrid, values: &[f64], by: usize) -> Vec<f64> {
    let (nu, nv) = grid.size();
    let mut values = values.to_vec();
    for _ in 0..3 {
        for (count, stride, lines, step) in [(nu, 1, nv, nu), (nv, nu, nu, 1)] {
            let before = values.clone();
            for line in 0..lines {
                let at = |k: usize| line * step + k * stride;
                for k in 0..count {
                    let window = k.saturating_sub(by)..=(k + by).min(count - 1);
                    let size = window.clone().count() as f64;
                    values[at(k)] = window.map(|n| before[at(n)]).sum::<f64>() / size;
                }
            }
        }
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Face, Plane, Range, Side};
    use crate::math::frame::Frame;
    use glam::DVec3;

    /// A plane of 40 × 20 mm, with nodes a millimetre apart.
    fn grid() -> FaceGrid {
        let frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
        let (u, v) = (Range::open(0.0, 40.0), Range::open(0.0, 20.0));
        FaceGrid::new(&Face::new(Plane { origin: DVec3::ZERO, frame, u, v }, Side::Front), 1.0, 4, 100)
    }

    fn shares(grid: &FaceGrid, share: impl Fn(DVec3) -> f64) -> Vec<f64> {
        grid.points().iter().map(|p| share(*p)).collect()
    }

    #[test]
    fn each_half_goes_by_the_function_that_is_better_there() {
        let grid = grid();
        let [left, right] = [true, false]
            .map(|is_left| shares(&grid, move |p| if (p.x < 20.25) == is_left { 1.0 } else { 1.5 }));
        let even = shares(&grid, |_| 1.2);
        let found = divided(&grid, &[even, left, right]).unwrap();
        let nodes = grid.points().len() as f64;
        assert!((found.expected - (nodes + MEETING * STAIRS * 20.0)).abs() < 0.5, "{}", found.expected);
        for (p, &label) in grid.points().iter().zip(&found.labels) {
            assert_eq!(found.families[label], if p.x < 20.25 { 1 } else { 2 }, "{p}");
        }
    }

    #[test]
    fn a_family_that_others_leave_nothing_to_is_gone() {
        let mut labels = [2, 0, 2, 2, 0];
        assert_eq!(used(&[7, 3, 5], &mut labels), [7, 5]);
        assert_eq!(labels, [1, 0, 1, 1, 0]);
    }

    #[test]
    fn one_family_stays_where_meeting_costs_more() {
        let grid = grid();
        // Better on a spot of 2 × 2 mm, by as much as meeting round it costs.
        let spot = shares(&grid, |p| if p.distance(DVec3::new(20.0, 10.0, 0.0)) < 1.2 { 0.4 } else { 1.5 });
        assert!(divided(&grid, &[shares(&grid, |_| 1.0), spot.clone()]).is_none());
        assert!(divided(&grid, &[spot]).is_none());
    }
}
