//! Straight passes over a mesh, cut again by brute force.

use glam::{DVec2, DVec3};
use std::num::NonZeroUsize;
use stepover::cutter::Cutter;
use stepover::geometry::TriMesh;
use stepover::monitor::{Silent, Stage};
use stepover::strategy::{Raster, RasterError, RasterOptions, raster};

/// A height field over `size × size` mm with cells of `cell` mm.
fn field(size: f64, cell: f64, height: impl Fn(f64, f64) -> f64) -> TriMesh {
    let n = (size / cell) as u32;
    let at = |i: u32| size * f64::from(i) / f64::from(n);
    let vertex = |k: u32| {
        let (x, y) = (at(k / (n + 1)), at(k % (n + 1)));
        DVec3::new(x, y, height(x, y))
    };
    let cells = (0..n * n).map(|k| (k / n) * (n + 1) + k % n);
    TriMesh {
        vertices: (0..(n + 1) * (n + 1)).map(vertex).collect(),
        triangles: cells.flat_map(|a| [[a, a + n + 1, a + n + 2], [a, a + n + 2, a + 1]]).collect(),
    }
}

/// Hills, and a groove that a 6 mm cutter cannot enter.
fn hills(x: f64, y: f64) -> f64 {
    let groove = (x + 0.3 * y - 9.0) / 0.8;
    1.5 * libm::sin(0.5 * x) * libm::cos(0.4 * y) + 0.1 * y - libm::exp(-groove * groove)
}

/// Distance from `p` to the body of a bull-nose cutter standing upright with its tip at `tip`: to the disc through the
/// corner's centres less the corner's radius, below; to the cylinder above it. Negative inside.
fn distance(p: DVec3, tip: DVec3, r1: f64, r: f64) -> f64 {
    let up = p.z - tip.z - r;
    let out = DVec2::new(p.x - tip.x, p.y - tip.y).length();
    if up >= 0.0 {
        return out - r1 - r;
    }
    let beside = (out - r1).max(0.0);
    (up * up + beside * beside).sqrt() - r
}

/// Positions along all moves, at most `step` apart, by their x and y in squares of `cell` mm.
struct Positions {
    cell: f64,
    columns: i64,
    squares: Vec<Vec<DVec3>>,
}

impl Positions {
    fn new(raster: &Raster, step: f64, cell: f64, size: f64) -> Self {
        let columns = (size / cell) as i64 + 1;
        let mut squares = vec![Vec::new(); (columns * columns) as usize];
        for pass in &raster.passes {
            for w in pass.stations.windows(2) {
                let (a, b) = (w[0].cl.tip, w[1].cl.tip);
                let n = (a.distance(b) / step).ceil().max(1.0) as u32;
                for i in 0..=n {
                    let p = a.lerp(b, f64::from(i) / f64::from(n));
                    let (i, j) = ((p.x / cell) as i64, (p.y / cell) as i64);
                    squares[(i * columns + j) as usize].push(p);
                }
            }
        }
        Self { cell, columns, squares }
    }

    fn near(&self, p: DVec3, radius: f64) -> impl Iterator<Item = DVec3> + '_ {
        let span = move |c: f64| {
            let at = |c: f64| ((c / self.cell).floor() as i64).clamp(0, self.columns - 1);
            at(c - radius)..=at(c + radius)
        };
        let (columns, ys) = (self.columns, span(p.y));
        span(p.x)
            .flat_map(move |i| ys.clone().map(move |j| (i * columns + j) as usize))
            .flat_map(|k| self.squares[k].iter().copied())
    }
}

/// Excess along `n` over `p` that the positions leave, and how deep any of them cuts below `p`.
fn excess_and_gouge(at: &Positions, p: DVec3, n: DVec3, r1: f64, r: f64) -> (f64, f64) {
    let (mut excess, mut gouge) = (f64::INFINITY, 0f64);
    for tip in at.near(p, r1 + r) {
        let d = distance(p, tip, r1, r);
        gouge = gouge.max(-d);
        // Sphere tracing: the body is never nearer than its distance.
        let mut t = 0.0;
        for _ in 0..60 {
            let d = distance(p + t * n, tip, r1, r);
            if d < 1e-7 || t >= excess {
                break;
            }
            t += d;
        }
        if distance(p + t * n, tip, r1, r) < 1e-6 {
            excess = excess.min(t);
        }
    }
    (excess, gouge)
}

/// Points inside each triangle, with its normal.
fn samples(mesh: &TriMesh, n: u32) -> Vec<(DVec3, DVec3)> {
    let mut list = Vec::new();
    for i in 0..mesh.triangles.len() {
        let ([a, b, c], Some(normal)) = (mesh.corners(i), mesh.normal(i)) else { continue };
        for s in 0..n {
            for t in 0..n - s {
                let at = |k: u32| (f64::from(k) + 1.0 / 3.0) / f64::from(n);
                list.push((a + (b - a) * at(s) + (c - a) * at(t), normal));
            }
        }
    }
    list
}

fn plan(mesh: &TriMesh, cutter: &Cutter, options: &RasterOptions, workers: usize) -> Raster {
    let stage = Stage::whole(&Silent, NonZeroUsize::new(workers).unwrap());
    raster(mesh, cutter, options, &stage).unwrap()
}

#[test]
fn cusps_keep_the_limit_outside_the_zone_and_nothing_gouges() {
    let (size, scallop) = (16.0, 0.05);
    let mesh = field(size, 0.5, hills);
    for (r1, r, angle) in [(1.0, 2.0, 0.0), (0.0, 3.0, 0.7)] {
        let cutter = Cutter::bull_nose(2.0 * (r1 + r), r, 40.0).unwrap();
        let plan = plan(&mesh, &cutter, &RasterOptions { angle, scallop, chord: 0.001 }, 2);
        let at = Positions::new(&plan, 0.05, 1.0, size);
        let (mut checked, mut zone, mut needless) = (0, 0, 0);
        for (p, n) in samples(&mesh, 4) {
            let (excess, gouge) = excess_and_gouge(&at, p, n, r1, r);
            assert!(gouge < 1e-3, "{gouge} mm too deep at {p}");
            if plan.unreached.contains(p) {
                zone += 1;
                needless += usize::from(excess < 0.7 * scallop);
                continue;
            }
            checked += 1;
            // The positions themselves are 0.05 mm apart: that adds 0.05²/8r.
            assert!(excess < scallop + 2e-4, "{excess} mm left at {p} normal {n}");
        }
        // The groove, and what falls outwards at the border, since the axis stays over the mesh.
        assert!(zone > 0 && zone < checked, "{zone} in the zone, {checked} outside");
        // Cubes at the zone's rim also hold what is finished.
        assert!(needless * 4 < zone, "{needless} of {zone} in the zone are finished");
    }
}

#[test]
fn level_ground_needs_only_the_first_lines() {
    let cutter = Cutter::bull_nose(6.0, 2.0, 40.0).unwrap();
    let plan = plan(
        &field(20.0, 5.0, |_, _| 1.0),
        &cutter,
        &RasterOptions { angle: 0.0, scallop: 0.05, chord: 0.001 },
        1,
    );
    // 20 mm by 2 (1 + √(2·2·0.044)) = 2.84 mm.
    assert_eq!(plan.passes.len(), 8);
    for pass in &plan.passes {
        assert_eq!(pass.stations.len(), 2, "level passes are one move");
        assert!(pass.stations.iter().all(|s| s.cl.tip.z == 1.0 && s.cc.posture.lead == 0.0));
    }
    assert!(plan.unreached.is_empty());
}

#[test]
fn stations_touch_where_they_say() {
    let cutter = Cutter::bull_nose(6.0, 2.0, 40.0).unwrap();
    let options = RasterOptions { angle: 0.4, scallop: 0.1, chord: 0.002 };
    let plan = plan(&field(12.0, 0.5, hills), &cutter, &options, 1);
    for station in plan.passes.iter().flat_map(|p| &p.stations) {
        let (cc, cl) = (station.cc, station.cl);
        let (n, a) = (cc.frame.n, cl.axis);
        let (lead, yaw) = (cc.posture.lead, cc.posture.yaw);
        let leaned = libm::cos(lead) * n
            + libm::sin(lead) * (libm::cos(yaw) * cc.frame.f + libm::sin(yaw) * cc.frame.b);
        assert!(leaned.distance(a) < 1e-9);
        // The contact is on the cutter's skin.
        assert!(distance(cc.point, cl.tip, 1.0, 2.0).abs() < 1e-6, "{station:?}");
    }
}

#[test]
fn workers_do_not_change_the_result() {
    let cutter = Cutter::ball(6.0, 40.0).unwrap();
    let options = RasterOptions { angle: 0.2, scallop: 0.1, chord: 0.002 };
    let mesh = field(10.0, 0.5, hills);
    assert_eq!(plan(&mesh, &cutter, &options, 1), plan(&mesh, &cutter, &options, 3));
}

#[test]
fn impossible_options_name_the_field() {
    let cutter = Cutter::ball(6.0, 40.0).unwrap();
    let good = RasterOptions { angle: 0.0, scallop: 0.1, chord: 0.001 };
    for (options, wanted) in [
        (RasterOptions { scallop: 0.0, ..good }, "scallop"),
        (RasterOptions { chord: 0.06, ..good }, "chord"),
        (RasterOptions { angle: f64::NAN, ..good }, "angle"),
    ] {
        let error = raster(&field(4.0, 1.0, hills), &cutter, &options, &Stage::silent()).unwrap_err();
        assert!(matches!(error, RasterError::Option { field, .. } if field == wanted));
    }
    let nothing = raster(&TriMesh::default(), &cutter, &good, &Stage::silent()).unwrap();
    assert!(nothing.passes.is_empty() && nothing.unreached.is_empty());
}
