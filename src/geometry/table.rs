//! A function on a face given at the nodes of a grid.

use super::{Domain, FaceGrid, Range, Uv};

/// A function of the parameters, smooth (C¹) between given values: a cubic in either parameter in every cell, whose slopes
/// at the nodes are those of the parabola through the three nodes around.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    axes: [Axis; 2],
    /// Value, slopes along u and v, and twist at every node, u running fastest.
    nodes: Vec<[f64; 4]>,
}

/// A function's value with its first and second derivatives.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Local {
    /// The value.
    pub value: f64,
    /// ∂/∂u and ∂/∂v.
    pub slope: (f64, f64),
    /// ∂²/∂u², ∂²/∂u∂v and ∂²/∂v²; they jump from cell to cell.
    pub bend: (f64, f64, f64),
}

#[derive(Debug, Clone, PartialEq)]
struct Axis {
    range: Range,
    nodes: Vec<f64>,
}

impl Table {
    /// The function with `values` at the nodes of `grid`, u running fastest, on a face with the parameters `domain`. Where
    /// that is periodic, the last row must repeat the first.
    pub fn new(domain: Domain, grid: &FaceGrid, values: &[f64]) -> Self {
        let (nu, nv) = grid.size();
        let axes = [
            Axis { range: domain.u, nodes: (0..nu).map(|i| grid.uv(i, 0).u).collect() },
            Axis { range: domain.v, nodes: (0..nv).map(|j| grid.uv(0, j).v).collect() },
        ];
        let mut nodes: Vec<[f64; 4]> = values.iter().map(|&value| [value, 0.0, 0.0, 0.0]).collect();
        for j in 0..nv {
            let row: Vec<f64> = (0..nu).map(|i| nodes[j * nu + i][0]).collect();
            (0..nu).for_each(|i| nodes[j * nu + i][1] = axes[0].slope(&row, i));
        }
        for i in 0..nu {
            for (from, to) in [(0, 2), (1, 3)] {
                let column: Vec<f64> = (0..nv).map(|j| nodes[j * nu + i][from]).collect();
                (0..nv).for_each(|j| nodes[j * nu + i][to] = axes[1].slope(&column, j));
            }
        }
        Self { axes, nodes }
    }

    /// The function at `uv`; outside the grid as it goes on from the nearest cell.
    pub fn at(&self, uv: Uv) -> Local {
        let [(i, a), (j, b)] = [self.axes[0].cubics(uv.u), self.axes[1].cubics(uv.v)];
        let nu = self.axes[0].nodes.len();
        let mut sum = [[0.0; 3]; 3];
        for (dj, (b_value, b_slope)) in [(0, (b[0], b[1])), (1, (b[2], b[3]))] {
            for (di, (a_value, a_slope)) in [(0, (a[0], a[1])), (1, (a[2], a[3]))] {
                let node = self.nodes[(j + dj) * nu + i + di];
                for (p, row) in sum.iter_mut().enumerate() {
                    for (q, term) in row.iter_mut().enumerate() {
                        *term += node[0] * a_value[p] * b_value[q]
                            + node[1] * a_slope[p] * b_value[q]
                            + node[2] * a_value[p] * b_slope[q]
                            + node[3] * a_slope[p] * b_slope[q];
                    }
                }
            }
        }
        Local { value: sum[0][0], slope: (sum[1][0], sum[0][1]), bend: (sum[2][0], sum[1][1], sum[0][2]) }
    }

    /// Lowest and highest value at a node.
    pub fn range(&self) -> (f64, f64) {
        let values = self.nodes.iter().map(|node| node[0]);
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), x| (lo.min(x), hi.max(x)))
    }
}

/// A cubic that is 1, or has the slope 1, at one end of a cell and is otherwise level: value, first and second derivative.
type Cubic = [f64; 3];

impl Axis {
    /// Slope at node `k` of the parabola through the nodes around it.
    fn slope(&self, values: &[f64], k: usize) -> f64 {
        let last = self.nodes.len() - 1;
        let secant = |a: usize, b: usize| (values[b] - values[a]) / (self.nodes[b] - self.nodes[a]);
        let width = |a: usize, b: usize| self.nodes[b] - self.nodes[a];
        let mixed = |(before, h): (f64, f64), (after, g): (f64, f64)| (before * g + after * h) / (h + g);
        let inner =
            |k: usize| mixed((secant(k - 1, k), width(k - 1, k)), (secant(k, k + 1), width(k, k + 1)));
        match k {
            _ if (k == 0 || k == last) && self.range.periodic => {
                mixed((secant(last - 1, last), width(last - 1, last)), (secant(0, 1), width(0, 1)))
            }
            _ if last == 1 => secant(0, 1),
            0 => 2.0 * secant(0, 1) - inner(1),
            k if k == last => 2.0 * secant(last - 1, last) - inner(last - 1),
            k => inner(k),
        }
    }

    /// The cell that holds `x` and its four cubics: value and slope at its lower end, then at its upper end.
    fn cubics(&self, x: f64) -> (usize, [Cubic; 4]) {
        let x = if self.range.periodic { self.range.hold(x) } else { x };
        let cell = self.nodes.partition_point(|&node| node <= x).saturating_sub(1).min(self.nodes.len() - 2);
        let h = self.nodes[cell + 1] - self.nodes[cell];
        let t = (x - self.nodes[cell]) / h;
        let scaled = |[value, slope, bend]: Cubic, by: f64| [by * value, by * slope / h, by * bend / (h * h)];
        let falls = [(1.0 + 2.0 * t) * (1.0 - t) * (1.0 - t), 6.0 * t * (t - 1.0), 12.0 * t - 6.0];
        let rises = [t * t * (3.0 - 2.0 * t), -falls[1], -falls[2]];
        let leaves = [t * (1.0 - t) * (1.0 - t), (1.0 - t) * (1.0 - 3.0 * t), 6.0 * t - 4.0];
        let arrives = [t * t * (t - 1.0), t * (3.0 * t - 2.0), 6.0 * t - 2.0];
        (cell, [scaled(falls, 1.0), scaled(leaves, h), scaled(rises, 1.0), scaled(arrives, h)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Cylinder, Face, Plane, Side};
    use crate::math::frame::Frame;
    use glam::DVec3;
    use std::f64::consts::TAU;

    const WORLD: Frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };

    fn table(face: &Face, cell: f64, f: impl Fn(Uv) -> f64) -> Table {
        let grid = FaceGrid::new(face, cell, 4, 400);
        let (nu, nv) = grid.size();
        let values: Vec<f64> =
            (0..nv).flat_map(|j| (0..nu).map(move |i| (i, j))).map(|(i, j)| f(grid.uv(i, j))).collect();
        Table::new(face.domain(), &grid, &values)
    }

    #[test]
    fn parabolas_are_themselves() {
        let (u, v) = (Range::open(-3.0, 7.0), Range::open(2.0, 6.0));
        let face = Face::new(Plane { origin: DVec3::ZERO, frame: WORLD, u, v }, Side::Front);
        let f = |p: Uv| 1.0 + 2.0 * p.u - p.v + 0.3 * p.u * p.u + 0.2 * p.u * p.v - 0.1 * p.v * p.v;
        let table = table(&face, 1.3, f);
        for k in 0..50 {
            let p = Uv::new(-3.0 + 0.2 * f64::from(k), 2.0 + 0.08 * f64::from(k));
            let Local { value, slope, bend } = table.at(p);
            assert!((value - f(p)).abs() < 1e-12);
            let wanted = [2.0 + 0.6 * p.u + 0.2 * p.v, -1.0 + 0.2 * p.u - 0.2 * p.v, 0.6, 0.2, -0.2];
            for (got, wanted) in [slope.0, slope.1, bend.0, bend.1, bend.2].into_iter().zip(wanted) {
                assert!((got - wanted).abs() < 1e-11, "{got} {wanted}");
            }
        }
    }

    #[test]
    fn waves_run_over_a_seam() {
        let face =
            Face::new(Cylinder::new(DVec3::ZERO, WORLD, 5.0, [0.0, TAU], [0.0, 9.0]).unwrap(), Side::Front);
        let table = table(&face, 0.2, |p| libm::sin(p.u) * p.v);
        for k in 0..100 {
            let p = Uv::new(-1.0 + 0.1 * f64::from(k), 0.09 * f64::from(k));
            let Local { value, slope, .. } = table.at(p);
            assert!((value - libm::sin(p.u) * p.v).abs() < 1e-4);
            assert!((slope.0 - libm::cos(p.u) * p.v).abs() < 1e-2);
        }
        let (a, b) = (table.at(Uv::new(-1e-9, 4.0)), table.at(Uv::new(1e-9, 4.0)));
        assert!((a.slope.0 - b.slope.0).abs() < 1e-6);
    }
}
