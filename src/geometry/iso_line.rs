//! Level lines of a field on a face.

use super::{Face, FaceGrid, Field, Uv};
use crate::math::root;
use std::collections::BTreeMap;

/// A level line as nodes on the face, each on the level; between nodes it is close to straight in parameters.
///
/// Parameters run on over a periodic seam, so that neighbours are always near one another.
#[derive(Debug, Clone, PartialEq)]
pub struct IsoLine {
    /// The level.
    pub level: f64,
    /// At least two nodes; a closed line repeats its first one (a turn further on, where it goes round).
    pub nodes: Vec<Uv>,
    /// Whether the line is closed.
    pub closed: bool,
}

impl IsoLine {
    /// Its length on `face` from node to node, mm.
    pub fn length(&self, face: &Face) -> f64 {
        let points =
            self.nodes.windows(2).map(|w| face.surface.point(w[0]).distance(face.surface.point(w[1])));
        points.sum()
    }

    /// Its pieces of at least two nodes that are `kept`, with a node to either side; each after its place among the nodes.
    pub fn pieces(&self, kept: &[bool]) -> Vec<(std::ops::Range<usize>, Self)> {
        let last = self.nodes.len() - 1;
        let grown: Vec<bool> =
            (0..=last).map(|i| kept[i] || kept[i.saturating_sub(1)] || kept[(i + 1).min(last)]).collect();
        let mut pieces = Vec::new();
        let mut start = 0;
        for run in grown.chunk_by(|a, b| a == b) {
            let place = start..start + run.len();
            start = place.end;
            if run[0] && run.len() > 1 {
                let nodes = self.nodes[place.clone()].to_vec();
                let closed = self.closed && run.len() == self.nodes.len();
                pieces.push((place, Self { level: self.level, nodes, closed }));
            }
        }
        pieces
    }
}

/// A field sampled on a grid, from which level lines are traced.
#[derive(Debug, Clone)]
pub struct FieldGrid {
    face: Face,
    field: Field,
    grid: FaceGrid,
    values: Vec<f64>,
}

/// An edge of the grid that a level line crosses: node and direction (0 along u, 1 along v).
type Crossing = (usize, usize, usize);

impl FieldGrid {
    /// Samples `field` on `grid`, which must be of `face`.
    pub fn new(face: &Face, field: Field, grid: FaceGrid) -> Self {
        let (nu, nv) = grid.size();
        let nodes = (0..nv).flat_map(|j| (0..nu).map(move |i| (i, j)));
        let values = nodes.map(|(i, j)| field.value(grid.uv(i, j), grid.point(i, j))).collect();
        Self { face: face.clone(), field, grid, values }
    }

    /// Takes another field with these values at the nodes of the grid, u running fastest.
    pub fn set(&mut self, field: Field, values: &[f64]) {
        self.field = field;
        self.values = values.to_vec();
    }

    /// Lowest and highest sampled value.
    pub fn range(&self) -> (f64, f64) {
        self.values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), &x| (lo.min(x), hi.max(x)))
    }

    /// The grid's nodes whose value is above `level`, or below it if not `higher`.
    pub fn nodes_beyond(&self, level: f64, higher: bool) -> impl Iterator<Item = Uv> + '_ {
        let nu = self.grid.size().0;
        let is_beyond = move |value: f64| if higher { value > level } else { value < level };
        let beyond = self.values.iter().enumerate().filter(move |(_, value)| is_beyond(**value));
        beyond.map(move |(k, _)| self.grid.uv(k % nu, k / nu))
    }

    /// The grid.
    pub fn grid(&self) -> &FaceGrid {
        &self.grid
    }

    /// The field.
    pub fn field(&self) -> &Field {
        &self.field
    }

    /// The lines of `level`, in a fixed order. A line smaller than a cell of the grid may be missed.
    pub fn lines(&self, level: f64) -> Vec<IsoLine> {
        let (nu, nv) = self.grid.size();
        let all_u = || (0..nu).map(|i| self.grid.uv(i, 0).u);
        let all_v = || (0..nv).map(|j| self.grid.uv(0, j).v);
        let domain = self.face.domain();
        match &self.field {
            Field::U => vec![IsoLine {
                level,
                nodes: all_v().map(|v| Uv::new(level, v)).collect(),
                closed: domain.v.periodic,
            }],
            Field::V => vec![IsoLine {
                level,
                nodes: all_u().map(|u| Uv::new(u, level)).collect(),
                closed: domain.u.periodic,
            }],
            Field::Along(_) | Field::Given(_) => {
                self.chains(level).into_iter().map(|c| self.line(level, &c)).collect()
            }
        }
    }

    fn value(&self, i: usize, j: usize) -> f64 {
        self.values[j * self.grid.size().0 + i]
    }

    /// The crossing's name; the two sides of a periodic seam are one edge.
    fn name(&self, (i, j, along): Crossing) -> Crossing {
        let ((nu, nv), domain) = (self.grid.size(), self.face.domain());
        let i = if domain.u.periodic && i == nu - 1 { 0 } else { i };
        let j = if domain.v.periodic && j == nv - 1 { 0 } else { j };
        (i, j, along)
    }

    /// Marching squares: the crossings of `level`, joined cell by cell into chains. A chain that is closed ends with
    /// its first crossing.
    fn chains(&self, level: f64) -> Vec<Vec<Crossing>> {
        let (nu, nv) = self.grid.size();
        let above = |i, j| self.value(i, j) >= level;
        let mut joins: BTreeMap<Crossing, Vec<Crossing>> = BTreeMap::new();
        let mut join = |a: Crossing, b: Crossing| {
            joins.entry(a).or_default().push(b);
            joins.entry(b).or_default().push(a);
        };
        for j in 0..nv - 1 {
            for i in 0..nu - 1 {
                let corners = [above(i, j), above(i + 1, j), above(i + 1, j + 1), above(i, j + 1)];
                if corners.iter().all(|&c| c == corners[0]) {
                    continue;
                }
                let edges = [(i, j, 0), (i + 1, j, 1), (i, j + 1, 0), (i, j, 1)].map(|e| self.name(e));
                let crossed: Vec<usize> = (0..4).filter(|&k| corners[k] != corners[(k + 1) % 4]).collect();
                match crossed[..] {
                    [a, b] => join(edges[a], edges[b]),
                    // A saddle: the middle decides which corners belong together.
                    _ => {
                        let middle = 0.25
                            * (self.value(i, j)
                                + self.value(i + 1, j)
                                + self.value(i + 1, j + 1)
                                + self.value(i, j + 1));
                        let around_first = (middle >= level) != corners[0];
                        let pairs = if around_first { [(3, 0), (1, 2)] } else { [(0, 1), (2, 3)] };
                        for (a, b) in pairs {
                            join(edges[a], edges[b]);
                        }
                    }
                }
            }
        }
        walk(joins)
    }

    fn line(&self, level: f64, chain: &[Crossing]) -> IsoLine {
        let domain = self.face.domain();
        let closed = chain.len() > 2 && chain.first() == chain.last();
        let mut nodes: Vec<Uv> = Vec::with_capacity(chain.len());
        for &crossing in chain {
            let mut uv = self.place(level, crossing);
            if let Some(last) = nodes.last() {
                uv.u = domain.u.turned(uv.u, last.u);
                uv.v = domain.v.turned(uv.v, last.v);
            }
            nodes.push(uv);
        }
        IsoLine { level, nodes, closed }
    }

    /// Where `level` crosses the edge.
    fn place(&self, level: f64, (i, j, along): Crossing) -> Uv {
        let (i2, j2) = if along == 0 { (i + 1, j) } else { (i, j + 1) };
        let (a, b) = (self.grid.uv(i, j), self.grid.uv(i2, j2));
        let at = |t: f64| a.lerp(b, t);
        let miss = |t: f64| self.field.value(at(t), self.face.surface.point(at(t))) - level;
        let ends = ((0.0, self.value(i, j) - level), (1.0, self.value(i2, j2) - level));
        at(root::bracketed(miss, ends.0, ends.1, 1e-12, 60).x)
    }
}

/// Chains through a graph in which every crossing has one or two neighbours: open ones from their lower end first.
fn walk(mut joins: BTreeMap<Crossing, Vec<Crossing>>) -> Vec<Vec<Crossing>> {
    let ends: Vec<Crossing> = joins.iter().filter(|(_, n)| n.len() == 1).map(|(&c, _)| c).collect();
    let mut chains = Vec::new();
    let mut follow = |joins: &mut BTreeMap<Crossing, Vec<Crossing>>, start: Crossing| {
        let mut chain = vec![start];
        let mut at = start;
        while let Some(next) = joins.get_mut(&at).and_then(Vec::pop) {
            if let Some(back) = joins.get_mut(&next)
                && let Some(k) = back.iter().position(|&c| c == at)
            {
                back.remove(k);
            }
            chain.push(next);
            at = next;
        }
        if chain.len() > 1 {
            chains.push(chain);
        }
    };
    for end in ends {
        follow(&mut joins, end);
    }
    let loops: Vec<Crossing> = joins.keys().copied().collect();
    for start in loops {
        follow(&mut joins, start);
    }
    chains
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Cylinder, Plane, Range, Side, Sphere, Surface};
    use crate::math::frame::Frame;
    use glam::DVec3;
    use std::f64::consts::TAU;

    const WORLD: Frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };

    fn lines(surface: impl Surface + 'static, d: DVec3, level: f64) -> (Face, Vec<IsoLine>) {
        let face = Face::new(surface, Side::Front);
        let grid = FaceGrid::new(&face, 1.0, 8, 400);
        let lines = FieldGrid::new(&face, Field::Along(d), grid).lines(level);
        (face, lines)
    }

    #[test]
    fn plane_section_is_one_straight_line() {
        let plane =
            Plane { origin: DVec3::ZERO, frame: WORLD, u: Range::open(0.0, 10.0), v: Range::open(0.0, 10.0) };
        let d = DVec3::new(0.6, 0.8, 0.0);
        let (_, found) = lines(plane, d, 5.0);
        assert_eq!(found.len(), 1);
        assert!(!found[0].closed);
        for uv in &found[0].nodes {
            assert!((0.6 * uv.u + 0.8 * uv.v - 5.0).abs() < 1e-9);
        }
    }

    #[test]
    fn sphere_section_is_a_circle_over_the_seam() {
        let sphere = Sphere::new(DVec3::ZERO, WORLD, 10.0, [0.0, TAU], [-1.5, 1.5]).unwrap();
        let d = DVec3::new(0.1, 0.2, 0.9).normalize();
        let (face, found) = lines(sphere, d, 3.0);
        assert_eq!(found.len(), 1);
        assert!(found[0].closed);
        let points: Vec<_> = found[0].nodes.iter().map(|&uv| face.surface.point(uv)).collect();
        let length: f64 = points.windows(2).map(|w| w[0].distance(w[1])).sum();
        assert!((length / (TAU * 91f64.sqrt()) - 1.0).abs() < 1e-3, "{length}");
        assert!(points.iter().all(|p| (p.dot(d) - 3.0).abs() < 1e-9));
    }

    #[test]
    fn cylinder_cut_along_its_axis_gives_two_lines() {
        let cylinder = Cylinder::new(DVec3::ZERO, WORLD, 5.0, [0.0, TAU], [0.0, 20.0]).unwrap();
        let (_, found) = lines(cylinder, DVec3::X, 3.0);
        assert_eq!(found.len(), 2);
        assert!(found.iter().all(|l| !l.closed));
    }
}
