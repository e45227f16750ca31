//! Numbers that are known at some places of a face, evened out.

use crate::math::order::{rank, sort_by_key};
use glam::DVec3;

/// Squares of distances, in what is evened out over, beyond which places count as nothing.
const FAR: f64 = 32.0;

/// Numbers that are known at some of the nodes of a grid.
#[derive(Debug, Clone, Default)]
pub(super) struct Known {
    /// In their order along `axis`, along which they are spread most.
    spots: Vec<Spot>,
    axis: usize,
}

/// A node, where it is, mm, the number there, and what it counts for, mm².
#[derive(Debug, Clone, Copy)]
pub(super) struct Spot {
    pub(super) node: usize,
    pub(super) point: DVec3,
    pub(super) value: f64,
    pub(super) area: f64,
}

impl Known {
    /// What is known at these spots.
    pub(super) fn new(mut spots: Vec<Spot>) -> Self {
        let (low, high) = spots.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), spot| {
            (low.min(spot.point), high.max(spot.point))
        });
        let axis = (high - low).max_position();
        sort_by_key(&mut spots, |spot| (rank(spot.point[axis]), 0));
        Self { spots, axis }
    }

    /// The mean over the area; not a number where nothing is known.
    pub(super) fn mean(&self) -> f64 {
        let sum = |of: fn(&Spot) -> f64| self.spots.iter().map(of).sum::<f64>();
        sum(|spot| spot.value * spot.area) / sum(|spot| spot.area)
    }

    /// The mean within about `reach` (mm) of `place`; far from all spots that of the nearest. Not a number where nothing is known.
    pub(super) fn near(&self, place: DVec3, reach: f64) -> f64 {
        let along = |spot: &Spot| spot.point[self.axis] - place[self.axis];
        let (before, behind) = self.spots.split_at(self.spots.partition_point(|spot| along(spot) < 0.0));
        let nearer = |least: f64, spot: &Spot| least.min(spot.point.distance_squared(place));
        let mut least = f64::INFINITY;
        for spot in before.iter().rev() {
            if along(spot) * along(spot) > least {
                break;
            }
            least = nearer(least, spot);
        }
        for spot in behind {
            if along(spot) * along(spot) > least {
                break;
            }
            least = nearer(least, spot);
        }
        let (mut weights, mut sum) = (0.0, 0.0);
        let far = (least + FAR * reach * reach).sqrt();
        let from = self.spots.partition_point(|spot| along(spot) < -far);
        for spot in self.spots[from..].iter().take_while(|spot| along(spot) <= far) {
            let beyond = (spot.point.distance_squared(place) - least) / (reach * reach);
            if beyond < FAR {
                let weight = spot.area * libm::exp(-0.5 * beyond);
                (weights, sum) = (weights + weight, sum + weight * spot.value);
            }
        }
        sum / weights
    }

    /// Each number over the one in `values`, which are at all nodes.
    pub(super) fn over(&self, values: &[f64]) -> Self {
        let over = |spot: &Spot| Spot { value: spot.value / values[spot.node], ..*spot };
        Self { spots: self.spots.iter().map(over).collect(), axis: self.axis }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn known(values: impl Iterator<Item = (DVec3, f64)>) -> Known {
        let spot = |(node, (point, value))| Spot { node, point, value, area: 1.0 };
        Known::new(values.enumerate().map(spot).collect())
    }

    #[test]
    fn far_from_all_spots_the_nearest_counts() {
        let two = known([(DVec3::ZERO, 2.0), (DVec3::X, 4.0)].into_iter());
        assert!((two.near(1000.0 * DVec3::X, 3.0) - 4.0).abs() < 1e-12);
        // Next to one of them the other hardly counts where less is evened out.
        let near = |reach| two.near(DVec3::ZERO, reach);
        assert!(near(0.2) < 2.01 && near(3.0) > 2.9, "{} {}", near(0.2), near(3.0));
    }

    #[test]
    fn one_number_that_is_off_among_many_hardly_counts() {
        let place = |k: usize| DVec3::new((k % 20) as f64, (k / 20) as f64, 0.0);
        let near =
            known((0..400).map(|k| (place(k), if k == 210 { 2.5 } else { 5.0 }))).near(place(210), 5.0);
        assert!((4.97..5.0).contains(&near), "{near}");
    }

    #[test]
    fn a_number_counts_as_much_as_its_area() {
        let spot = |value, area| Spot { node: 0, point: DVec3::ZERO, value, area };
        let two = Known::new(vec![spot(2.0, 3.0), spot(6.0, 1.0)]);
        assert_eq!(two.mean(), 3.0);
        assert_eq!(two.near(DVec3::Y, 1.0), 3.0);
        assert_eq!(two.over(&[0.5]).mean(), 6.0);
        assert!(Known::default().mean().is_nan());
    }
}
