//! The excess in a few numbers.

use crate::math::order::{rank, sort_by_key};
use glam::DVec3;

/// An extreme excess and where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extreme {
    /// Excess, millimetres; negative for a gouge.
    pub excess: f64,
    /// The surface point.
    pub point: DVec3,
}

/// What a path leaves of a surface, outside the zone that was excluded. Areas in mm², the rest in millimetres.
#[derive(Debug, Clone, PartialEq)]
pub struct Statistics {
    /// Samples that count, without those added between them.
    pub count: usize,
    /// Samples added where the extremes might have hidden.
    pub refined: usize,
    /// Area that counts.
    pub area: f64,
    /// Area inside the excluded zone.
    pub excluded_area: f64,
    /// Area that no move came nearer to than the search height. Its excess is infinite, and the largest excess is then
    /// only that of the rest.
    pub uncut_area: f64,
    /// The largest excess met where anything was cut; `None` if nothing was.
    pub max: Option<Extreme>,
    /// The least excess met: the deepest gouge if negative. At the depth searched it may be deeper still.
    pub min: Option<Extreme>,
    /// The deepest gouge that a sample in the excluded zone met, if any did: not looked for between the samples.
    pub excluded_gouge: Option<Extreme>,
    /// How much the true largest excess can exceed [`Statistics::max`] between the samples; infinite for a cutter
    /// without a corner radius, and where the surface bends too wildly between samples for any bound.
    pub excess_error: f64,
    /// How much deeper than [`Statistics::min`] the cutter can be between the samples, at most down to the depth searched.
    pub gouge_error: f64,
    /// The excess that half of the area does not exceed.
    pub median: f64,
    /// The excess that 95 % of the area does not exceed.
    pub q95: f64,
    /// The excess that 99 % of the area does not exceed.
    pub q99: f64,
    /// Share of the area whose excess is at most the allowed height, 0 to 1; gouged area counts as reached.
    pub share_within: f64,
    /// How the area is spread over the excess.
    pub histogram: Histogram,
}

/// Area by excess, in bins of the same width.
#[derive(Debug, Clone, PartialEq)]
pub struct Histogram {
    /// Where the first bin begins, mm: 0, or the deepest gouge.
    pub low: f64,
    /// Where the last bin ends, mm: the allowed height, or the largest excess where that is higher.
    pub high: f64,
    /// Area of each bin, mm²; what was not cut is in none.
    pub areas: [f64; BINS],
}

/// Bins: what a side panel has room for.
const BINS: usize = 40;

impl Histogram {
    /// Of the values and areas in `weighted`, between the extremes and 0 and the allowed `height`.
    pub(super) fn new(
        weighted: &[(f64, f64)],
        min: Option<Extreme>,
        max: Option<Extreme>,
        height: f64,
    ) -> Self {
        let low = min.map_or(0.0, |extreme| extreme.excess.min(0.0));
        let high = max.map_or(height, |extreme| extreme.excess.max(height));
        let mut areas = [0.0; BINS];
        for (value, area) in weighted.iter().filter(|(value, _)| value.is_finite()) {
            let bin = (value - low) / (high - low) * BINS as f64;
            areas[(bin as usize).min(BINS - 1)] += area;
        }
        Self { low, high, areas }
    }

    /// `low`, `high` and the areas, to draw.
    pub fn flat(&self) -> Vec<f32> {
        [self.low, self.high].iter().chain(&self.areas).map(|x| *x as f32).collect()
    }
}

/// Least value that the `shares` (rising, 0 to 1) of the weight in `weighted` (value, weight) do not exceed.
/// Not a number for no weight at all.
pub(super) fn quantiles<const N: usize>(weighted: &mut [(f64, f64)], shares: [f64; N]) -> [f64; N] {
    sort_by_key(weighted, |(_, weight)| (rank(*weight), 0));
    sort_by_key(weighted, |(value, _)| (rank(*value), 0));
    let total: f64 = weighted.iter().map(|(_, w)| w).sum();
    let mut sum = 0.0;
    let mut found = [f64::NAN; N];
    let mut next = 0;
    for (value, weight) in weighted.iter() {
        sum += weight;
        while next < N && sum > 0.0 && sum >= shares[next] * total * (1.0 - 1e-12) {
            found[next] = *value;
            next += 1;
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_weigh_by_area() {
        let mut weighted = [(3.0, 1.0), (1.0, 8.0), (2.0, 1.0), (f64::INFINITY, 0.0)];
        assert_eq!(quantiles(&mut weighted, [0.5, 0.8, 0.9, 1.0]), [1.0, 1.0, 2.0, 3.0]);
        assert!(quantiles(&mut [], [0.5])[0].is_nan());
    }
}
