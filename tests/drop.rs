//! Lowered cutters against heights from elsewhere and against brute force.

use glam::{DVec2, DVec3};
use proptest::prelude::*;
use stepover::contact::{DropMesh, Feature, Underside, drop_cutter, drop_cutter_above, is_in_mesh};
use stepover::cutter::Cutter;
use stepover::geometry::TriMesh;

#[path = "support/sculpt.rs"]
mod sculpt;

/// OpenCAMLib 2023.1.11 (`tests/data/dropcutter/ORIGIN.md`) states eight digits; that is how far the heights agree.
#[test]
fn heights_are_those_of_opencamlib() {
    let mesh = DropMesh::new(&sculpt::sculpt(50));
    for (text, cutter) in [
        (include_str!("data/dropcutter/dropcutter_5k_ball.csv"), Cutter::ball(10.0, 50.0)),
        (include_str!("data/dropcutter/dropcutter_5k_bull.csv"), Cutter::bull_nose(10.0, 2.0, 50.0)),
        (include_str!("data/dropcutter/dropcutter_5k_cyl.csv"), Cutter::flat(10.0, 50.0)),
    ] {
        let under = Underside::new(&cutter.unwrap());
        for line in text.lines().skip(1) {
            let row: Vec<f64> = line.split(',').map(|n| n.parse().unwrap()).collect();
            let ours = drop_cutter(&mesh, &under, row[0], row[1]).unwrap().tip_z;
            assert!((ours - row[2]).abs() < 2e-7, "{line}: {ours}");
        }
    }
}

fn cutters() -> impl Strategy<Value = Cutter> {
    let shape = (1.0..8.0f64, 0.0..1.0f64, 0.0..0.6f64, -0.3..0.6f64, 0usize..6);
    shape.prop_map(|(d, share, alpha, beta, kind)| {
        let r = 0.5 * d * share;
        match kind {
            0 => Cutter::flat(d, 30.0),
            1 => Cutter::ball(d, 30.0),
            2 => Cutter::conical(d, 0.4 * r, alpha, 30.0),
            3 => Cutter::tapered(d, 0.4 * r, beta, 10.0),
            _ => Cutter::bull_nose(d, r, 30.0),
        }
        .unwrap()
    })
}

/// Loose triangles: big, small, upright, level and collapsed ones.
fn triangles() -> impl Strategy<Value = TriMesh> {
    let c = || -6.0..6.0f64;
    let point = move || (c(), c(), c()).prop_map(|(x, y, z)| DVec3::new(x, y, z));
    let triangle = (point(), point(), point(), 0usize..5).prop_map(|(a, u, v, kind)| match kind {
        0 => [a, a + 0.1 * u, a + 0.1 * v],
        1 => [a, u, a + DVec3::Z * v.z],
        2 => [a, u.with_z(a.z), v.with_z(a.z)],
        3 => [a, u, a + 0.5 * (u - a)],
        _ => [a, u, v],
    });
    proptest::collection::vec(triangle, 1..12).prop_map(|list| TriMesh {
        triangles: (0..list.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        vertices: list.into_iter().flatten().collect(),
    })
}

/// How high the mesh's points lift the tip of a cutter at the origin, by sampling each triangle on a grid.
fn sampled(mesh: &TriMesh, cutter: &Cutter, n: u32) -> Option<f64> {
    let mut best: Option<f64> = None;
    for i in 0..mesh.triangles.len() {
        let [a, b, c] = mesh.corners(i);
        for s in 0..=n {
            for t in 0..=n - s {
                let p = a + (b - a) * f64::from(s) / f64::from(n) + (c - a) * f64::from(t) / f64::from(n);
                if let Some(height) = cutter.height_at(p.truncate().length()) {
                    best = Some(best.map_or(p.z - height, |old| old.max(p.z - height)));
                }
            }
        }
    }
    best
}

/// Distance of `p` from triangle `i`, by its feature's definition.
fn off_feature(mesh: &TriMesh, feature: Feature, p: DVec3) -> f64 {
    let vertex = |i: u32| mesh.vertices[i as usize];
    match feature {
        Feature::Vertex(i) => p.distance(vertex(i)),
        Feature::Edge(i, j) => {
            let (a, b) = (vertex(i), vertex(j));
            let t = (p - a).dot(b - a) / (b - a).length_squared();
            p.distance(a.lerp(b, t.clamp(0.0, 1.0)))
        }
        Feature::Facet(i) => {
            let [a, b, c] = mesh.corners(i as usize);
            let n = (b - a).cross(c - a);
            let inside = [(a, b), (b, c), (c, a)].iter().all(|(a, b)| (b - a).cross(p - a).dot(n) >= -1e-7);
            if inside { (p - a).dot(n.normalize()).abs() } else { f64::INFINITY }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    /// No point of the mesh is in the cutter, and the named contact holds it up.
    #[test]
    fn cutter_rests_on_the_mesh(mesh in triangles(), cutter in cutters()) {
        let n = 60;
        let brute = sampled(&mesh, &cutter, n);
        let touch = drop_cutter(&DropMesh::new(&mesh), &Underside::new(&cutter), 0.0, 0.0);
        let Some(touch) = touch else {
            prop_assert_eq!(brute, None);
            return Ok(());
        };
        if let Some(brute) = brute {
            prop_assert!(touch.tip_z >= brute - 1e-6, "{} gouges to {brute}", touch.tip_z);
        }
        // The contact is on what it names and as high above the tip as the underside.
        prop_assert!(off_feature(&mesh, touch.feature, touch.point) < 1e-6, "{touch:?}");
        let radius = touch.point.truncate().length();
        let reach = cutter.largest_radius();
        prop_assert!(radius <= reach * (1.0 + 1e-9));
        let height = cutter.height_at(radius.min(reach)).unwrap();
        prop_assert!(
            (touch.point.z - touch.tip_z - height).abs() < 1e-6 || reach - radius < 1e-9,
            "{touch:?} {height}"
        );
        // Lower it is in the mesh, higher it is not.
        let prepared = DropMesh::new(&mesh);
        let under = Underside::new(&cutter);
        prop_assert!(is_in_mesh(&prepared, &under, DVec3::Z * (touch.tip_z - 1e-6)));
        prop_assert!(!is_in_mesh(&prepared, &under, DVec3::Z * (touch.tip_z + 1e-6)));
        let above = |floor| drop_cutter_above(&prepared, &under, 0.0, 0.0, floor).map(|t| t.tip_z);
        prop_assert_eq!(above(touch.tip_z), None);
        prop_assert!((above(touch.tip_z - 1e-6).unwrap() - touch.tip_z).abs() < 1e-9);
        // The normal leans towards the axis.
        prop_assert!((touch.normal.length() - 1.0).abs() < 1e-12 && touch.normal.z >= 0.0);
        prop_assert!(touch.normal.truncate().dot(touch.point.truncate()) < 1e-6);
    }

    /// A shift moves the contact with the mesh, and turned triangles are the same.
    #[test]
    fn shifted_and_turned_meshes_give_the_same(mesh in triangles(), cutter in cutters(), x in -50.0..50.0f64) {
        let under = Underside::new(&cutter);
        let by = DVec3::new(x, 3.0, -7.0);
        let moved = TriMesh {
            vertices: mesh.vertices.iter().map(|v| v + by).collect(),
            triangles: mesh.triangles.iter().rev().map(|[a, b, c]| [*b, *a, *c]).collect(),
        };
        let here = drop_cutter(&DropMesh::new(&mesh), &under, 0.0, 0.0);
        let there = drop_cutter(&DropMesh::new(&moved), &under, by.x, by.y);
        // Where the shadow's rim just grazes a triangle, rounding decides.
        if let (Some(here), Some(there)) = (here, there) {
            let rim = DVec2::length(here.point.truncate()) > under.reach() - 1e-6;
            prop_assert!(rim || (here.tip_z + by.z - there.tip_z).abs() < 1e-6, "{here:?} {there:?}");
        }
    }
}

#[test]
fn nothing_under_the_cutter_is_none() {
    let under = Underside::new(&Cutter::ball(10.0, 50.0).unwrap());
    assert_eq!(drop_cutter(&DropMesh::new(&TriMesh::default()), &under, 0.0, 0.0), None);
    assert_eq!(drop_cutter(&DropMesh::new(&sculpt::sculpt(4)), &under, 55.1, 0.0), None);
}
