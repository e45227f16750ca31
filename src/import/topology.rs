//! How the triangles of a mesh hang together.

use crate::geometry::TriMesh;
use crate::math::order::sort_by_key;

/// Counts of a mesh's edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Topology {
    /// Edges of one triangle only.
    pub boundary_edges: usize,
    /// Edges of more than two triangles.
    pub non_manifold_edges: usize,
    /// Edges of two triangles that face opposite sides.
    pub disagreeing_edges: usize,
}

/// A triangle's edge: its vertices, the lower first, the triangle, and whether it runs from the lower vertex.
type Edge = (u32, u32, u32, bool);

fn edges(mesh: &TriMesh) -> Vec<Edge> {
    let mut edges = Vec::with_capacity(3 * mesh.triangles.len());
    for (t, &[a, b, c]) in mesh.triangles.iter().enumerate() {
        edges.extend([(a, b), (b, c), (c, a)].map(|(p, q)| (p.min(q), p.max(q), t as u32, p < q)));
    }
    sort_by_key(&mut edges, |&(a, b, ..)| (u64::from(a) << 32 | u64::from(b), 0));
    edges
}

/// The runs of equal edges.
fn runs(edges: &[Edge]) -> impl Iterator<Item = &[Edge]> {
    edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1))
}

/// Counts the edges of `mesh`.
pub(super) fn of(mesh: &TriMesh) -> Topology {
    let mut topology = Topology::default();
    for run in runs(&edges(mesh)) {
        match run {
            [_] => topology.boundary_edges += 1,
            [a, b] if a.3 == b.3 => topology.disagreeing_edges += 1,
            [_, _] => {}
            _ => topology.non_manifold_edges += 1,
        }
    }
    topology
}

/// Turns triangles so that neighbours face one side, and returns how many were turned. A connected piece in which all agree stays;
/// of the others a closed one is made to face its outside, an open one the side of its greater number. Pieces hang together over
/// edges of two triangles; one that has no two sides, such as a Möbius strip, keeps edges that disagree.
pub(super) fn orient(mesh: &mut TriMesh) -> usize {
    let edges = edges(mesh);
    // Each pair both ways: (triangle, neighbour, whether they face opposite sides).
    let mut pairs: Vec<(u32, u32, bool)> = Vec::with_capacity(edges.len());
    for run in runs(&edges) {
        if let [a, b] = run {
            pairs.push((a.2, b.2, a.3 == b.3));
            pairs.push((b.2, a.2, a.3 == b.3));
        }
    }
    sort_by_key(&mut pairs, |&(t, other, _)| (u64::from(t), other));
    let neighbours = |t: u32| {
        let start = pairs.partition_point(|pair| pair.0 < t);
        pairs[start..].iter().take_while(move |pair| pair.0 == t)
    };
    let mut turned: Vec<Option<bool>> = vec![None; mesh.triangles.len()];
    let mut count = 0;
    for root in 0..mesh.triangles.len() {
        if turned[root].is_some() {
            continue;
        }
        turned[root] = Some(false);
        let mut piece = vec![root as u32];
        let mut next = 0;
        while let Some(&t) = piece.get(next) {
            next += 1;
            let own = turned[t as usize] == Some(true);
            for &(_, other, opposite) in neighbours(t) {
                if turned[other as usize].is_none() {
                    turned[other as usize] = Some(own != opposite);
                    piece.push(other);
                }
            }
        }
        let against: Vec<u32> = piece.iter().copied().filter(|&t| turned[t as usize] == Some(true)).collect();
        if against.is_empty() {
            continue;
        }
        for &t in &against {
            mesh.triangles[t as usize].swap(1, 2);
        }
        let closed = piece.iter().all(|&t| neighbours(t).count() == 3);
        let wrong = if closed { signed_volume(mesh, &piece) < 0.0 } else { 2 * against.len() > piece.len() };
        count += if wrong { piece.len() - against.len() } else { against.len() };
        if wrong {
            for &t in &piece {
                mesh.triangles[t as usize].swap(1, 2);
            }
        }
    }
    count
}

/// Six times the volume that the triangles numbered `piece` enclose, below 0 where they face its inside.
fn signed_volume(mesh: &TriMesh, piece: &[u32]) -> f64 {
    let origin = piece.first().map_or(glam::DVec3::ZERO, |&t| mesh.corners(t as usize)[0]);
    let tetrahedron = |&t: &u32| {
        let [a, b, c] = mesh.corners(t as usize).map(|p| p - origin);
        a.dot(b.cross(c))
    };
    piece.iter().map(tetrahedron).sum()
}

/// Whether a mesh without borders faces its inside.
pub(super) fn is_inside_out(mesh: &TriMesh) -> bool {
    let all: Vec<u32> = (0..mesh.triangles.len() as u32).collect();
    signed_volume(mesh, &all) < 0.0
}
