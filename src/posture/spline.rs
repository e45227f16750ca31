//! Smooth weights along one parameter.

/// The nodes of one parameter.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Axis {
    at: Vec<f64>,
    /// Where the parameter is periodic; its last node is then the one before the first's image.
    period: Option<f64>,
}

/// Three neighbouring nodes, and a weight for each.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Weights {
    pub(super) nodes: [usize; 3],
    pub(super) value: [f64; 3],
    /// Derivatives of the weights by the parameter.
    pub(super) slope: [f64; 3],
}

impl Axis {
    /// `nodes` rise, at least three of them; on a periodic parameter the last repeats the first a `period` on.
    pub(super) fn new(mut nodes: Vec<f64>, period: Option<f64>) -> Self {
        if period.is_some() {
            nodes.pop();
        }
        Self { at: nodes, period }
    }

    pub(super) fn len(&self) -> usize {
        self.at.len()
    }

    pub(super) fn node(&self, i: usize) -> f64 {
        self.at[i]
    }

    /// The node after `i`.
    pub(super) fn after(&self, i: usize) -> Option<usize> {
        match self.period {
            Some(_) => Some((i + 1) % self.len()),
            None => (i + 1 < self.len()).then_some(i + 1),
        }
    }

    /// The node nearest to `x`.
    pub(super) fn nearest(&self, x: f64) -> usize {
        self.weights(x).nodes[1]
    }

    /// Length of parameter that belongs to the node `i`.
    pub(super) fn share(&self, i: usize) -> f64 {
        let i = i as isize;
        let ends = |k: isize| if self.period.is_none() { self.place(k).1 } else { self.extended(k) };
        0.5 * (ends(i + 1) - ends(i - 1))
    }

    /// The node that stands for the number `k`, which may lie outside, and its parameter there.
    fn place(&self, k: isize) -> (usize, f64) {
        let count = self.len() as isize;
        match self.period {
            Some(_) => (k.rem_euclid(count) as usize, self.extended(k)),
            None => {
                let i = k.clamp(0, count - 1) as usize;
                (i, self.at[i])
            }
        }
    }

    /// The parameter of the node `k`, going on beyond the ends: round, or at the distance of the last two.
    fn extended(&self, k: isize) -> f64 {
        let count = self.len() as isize;
        if let Some(period) = self.period {
            return self.at[k.rem_euclid(count) as usize] + period * k.div_euclid(count) as f64;
        }
        let last = count - 1;
        if k < 0 {
            self.at[0] + (self.at[1] - self.at[0]) * k as f64
        } else if k > last {
            self.at[last as usize] + (self.at[last as usize] - self.at[last as usize - 1]) * (k - last) as f64
        } else {
            self.at[k as usize]
        }
    }

    /// The quadratic B-spline weights at `x`, with knots half way between nodes: once differentiable, never negative, and
    /// never larger in slope than the steps between nodes. Beyond the ends what is there at the end goes on.
    pub(super) fn weights(&self, x: f64) -> Weights {
        let x = match self.period {
            Some(period) => self.at[0] + (x - self.at[0]).rem_euclid(period),
            None => x.clamp(self.at[0], self.at[self.len() - 1]),
        };
        let knot = |k: isize| 0.5 * (self.extended(k) + self.extended(k + 1));
        let mut i = self.at.partition_point(|&node| node <= x) as isize - 1;
        if x > knot(i) {
            i += 1;
        }
        let [a, b, c, d] = [knot(i - 2), knot(i - 1), knot(i), knot(i + 1)];
        let (before, after) = ((c - a) * (c - b), (d - b) * (c - b));
        let (low, high) = ((c - x) * (c - x) / before, (x - b) * (x - b) / after);
        let (low_slope, high_slope) = (2.0 * (x - c) / before, 2.0 * (x - b) / after);
        Weights {
            nodes: [i - 1, i, i + 1].map(|k| self.place(k).0),
            value: [low, 1.0 - low - high, high],
            slope: [low_slope, -low_slope - high_slope, high_slope],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(axis: &Axis, numbers: &[f64], x: f64) -> (f64, f64) {
        let w = axis.weights(x);
        let sum = |weights: [f64; 3]| (0..3).map(|k| weights[k] * numbers[w.nodes[k]]).sum::<f64>();
        (sum(w.value), sum(w.slope))
    }

    #[test]
    fn weights_are_smooth_and_never_overshoot() {
        let numbers = [0.3, 2.0, -1.0, 0.5, 0.5, 4.0];
        for axis in [
            Axis::new(vec![0.0, 1.0, 1.5, 3.0, 4.0, 4.2], None),
            Axis::new(vec![0.0, 1.0, 1.5, 3.0, 4.0, 4.2, 5.0], Some(5.0)),
        ] {
            let d = 1e-6;
            for k in -10..=60 {
                let x = 0.1 * f64::from(k) + 0.013;
                let (here, slope) = value(&axis, &numbers, x);
                let (ahead, slope_ahead) = value(&axis, &numbers, x + d);
                assert!((-1.0..=4.0).contains(&here));
                let inside = axis.period.is_some() || (0.0..4.2).contains(&x);
                assert!(!inside || ((ahead - here) / d - slope).abs() < 1e-4, "{x}");
                assert!((slope_ahead - slope).abs() < 1e-3 || !inside, "{x}");
            }
        }
    }
}
