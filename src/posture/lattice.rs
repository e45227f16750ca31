//! The nodes at which postures are chosen, and how much a number may differ between neighbours.

use super::choose::Ground;
use super::spline::Axis;
use crate::geometry::{Curvature, FaceGrid, Uv};
use crate::math::frame::Frame;
use crate::monitor::{Cancelled, Stage};
use glam::DVec3;

/// Nodes of a face with what is needed to choose a posture there.
pub(super) struct Lattice {
    pub(super) axes: [Axis; 2],
    /// u running fastest.
    pub(super) nodes: Vec<Node>,
    /// Pairs of neighbours along u, then along v.
    pub(super) pairs: Vec<Pair>,
}

/// A place where a posture is chosen.
pub(super) struct Node {
    pub(super) uv: Uv,
    pub(super) point: DVec3,
    /// Area that it stands for, mm².
    pub(super) area: f64,
    /// What the cutter meets there; nothing where the feed has no direction.
    pub(super) contact: Option<Contact>,
    /// How far the cutter may be lifted there and at the nodes around, mm.
    pub(super) most_lift: f64,
}

/// Contact frame and the surface's curvature in it.
#[derive(Clone, Copy)]
pub(super) struct Contact {
    pub(super) frame: Frame,
    pub(super) surface: Curvature,
}

/// Two neighbouring nodes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    pub(super) nodes: [usize; 2],
    /// The way between them along the feed and across it, mm.
    pub(super) way: [f64; 2],
}

impl Node {
    /// At `uv`, standing for a unit of parameters.
    pub(super) fn new(ground: &Ground, uv: Uv, reversed: bool) -> Self {
        let jet = ground.face.jet(uv);
        let contact = (ground.feed)(uv, reversed)
            .and_then(|(jet, frame)| Some(Contact { frame, surface: Curvature::of(&jet, &frame)? }));
        let hollow = contact.is_none_or(|contact| contact.surface.ff > 0.0);
        let most_lift = ground.most_lift[usize::from(hollow)];
        Self { uv, point: jet.p, area: jet.area_density(), contact, most_lift }
    }
}

impl Lattice {
    /// The nodes of `grid`, in contact frames turned about if `reversed`.
    pub(super) fn new(
        ground: &Ground,
        grid: &FaceGrid,
        reversed: bool,
        stage: &Stage,
    ) -> Result<Self, Cancelled> {
        let (domain, (nu, nv)) = (ground.face.domain(), grid.size());
        let period = |range: crate::geometry::Range| range.periodic.then(|| range.length());
        let axes = [
            Axis::new((0..nu).map(|i| grid.uv(i, 0).u).collect(), period(domain.u)),
            Axis::new((0..nv).map(|j| grid.uv(0, j).v).collect(), period(domain.v)),
        ];
        let row = |j: usize| -> Vec<Node> {
            (0..axes[0].len())
                .map(|i| {
                    let uv = Uv::new(axes[0].node(i), axes[1].node(j));
                    let node = Node::new(ground, uv, reversed);
                    Node { area: node.area * axes[0].share(i) * axes[1].share(j), ..node }
                })
                .collect()
        };
        let nodes: Vec<Node> = stage.map(axes[1].len(), row)?.into_iter().flatten().collect();
        let pairs = pairs(&axes, &nodes);
        // Between nodes of either kind moves may run above their path.
        let mut lattice = Self { axes, nodes, pairs };
        let mosts =
            lattice.largest_around(&lattice.nodes.iter().map(|node| -node.most_lift).collect::<Vec<_>>());
        for (node, most) in lattice.nodes.iter_mut().zip(mosts) {
            node.most_lift = -most;
        }
        Ok(lattice)
    }

    /// For each node the largest of `values` at it and at the nodes around it, over corners too.
    pub(super) fn largest_around(&self, values: &[f64]) -> Vec<f64> {
        let [us, vs] = &self.axes;
        let mut rows = values.to_vec();
        let mut both = |along: &Axis, across: usize, step: usize, stride: usize| {
            let from = rows.clone();
            for k in 0..across {
                for i in 0..along.len() {
                    let Some(next) = along.after(i) else { continue };
                    let (a, b) = (k * stride + i * step, k * stride + next * step);
                    rows[a] = rows[a].max(from[b]);
                    rows[b] = rows[b].max(from[a]);
                }
            }
        };
        both(us, vs.len(), 1, us.len());
        both(vs, us.len(), us.len(), 1);
        rows
    }

    /// The least numbers that are nowhere below `values` and differ between the neighbours of each pair by no more than
    /// `allowed` for it.
    pub(super) fn raised(&self, mut values: Vec<f64>, allowed: &[f64]) -> Vec<f64> {
        loop {
            let mut raised = false;
            let mut relax = |k: usize| {
                let [a, b] = self.pairs[k].nodes;
                if values[a] < values[b] - allowed[k] {
                    values[a] = values[b] - allowed[k];
                    raised = true;
                } else if values[b] < values[a] - allowed[k] {
                    values[b] = values[a] - allowed[k];
                    raised = true;
                }
            };
            // To and fro, so that what is high spreads both ways in one turn.
            (0..self.pairs.len()).for_each(&mut relax);
            (0..self.pairs.len()).rev().for_each(&mut relax);
            if !raised {
                return values;
            }
        }
    }

    /// Numbers near `values` that differ between neighbours by no more than `allowed`: half way between the least that are
    /// nowhere below and the largest that are nowhere above, which both keep to it.
    pub(super) fn steadied(&self, values: &[f64], allowed: &[f64]) -> Vec<f64> {
        let upper = self.raised(values.to_vec(), allowed);
        let lower = self.raised(values.iter().map(|x| -x).collect(), allowed);
        upper.iter().zip(lower).map(|(high, low)| 0.5 * (high - low)).collect()
    }
}

fn pairs(axes: &[Axis; 2], nodes: &[Node]) -> Vec<Pair> {
    let count = axes[0].len();
    let pair = |a: usize, b: usize| {
        let chord = nodes[b].point - nodes[a].point;
        let way = match nodes[a].contact.or(nodes[b].contact) {
            Some(Contact { frame, .. }) => {
                let along = chord.dot(frame.f).abs();
                [along, (chord.length_squared() - along * along).max(0.0).sqrt()]
            }
            None => [chord.length(), 0.0],
        };
        Pair { nodes: [a, b], way }
    };
    let along_u = (0..axes[1].len()).flat_map(|j| {
        (0..count).filter_map(move |i| Some(pair(j * count + i, j * count + axes[0].after(i)?)))
    });
    let along_v = (0..axes[1].len())
        .filter_map(|j| Some((j, axes[1].after(j)?)))
        .flat_map(|(j, next)| (0..count).map(move |i| pair(j * count + i, next * count + i)));
    along_u.chain(along_v).collect()
}
