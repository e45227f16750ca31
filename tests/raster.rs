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
                    // Beyond the border the axis belongs to the squares beside it.
                    let at = |c: f64| ((c / cell).floor() as i64).clamp(0, columns - 1);
                    let (i, j) = (at(p.x), at(p.y));
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
        let plan = plan(&mesh, &cutter, &RasterOptions { angle, scallop, chord: 0.001, bridge: 8.0 }, 2);
        let at = Positions::new(&plan, 0.05, 1.0, size);
        let (mut checked, mut zone, mut needless) = (0, 0, 0);
        for (p, n) in samples(&mesh, 4) {
            let (excess, gouge) = excess_and_gouge(&at, p, n, r1, r);
            assert!(gouge < 1e-3, "{gouge} mm too deep at {p}");
            if plan.unreached.contains(p) || plan.unseen.contains(p) {
                zone += 1;
                needless += usize::from(excess < 0.7 * scallop);
                continue;
            }
            checked += 1;
            // The positions themselves are 0.05 mm apart: that adds 0.05²/8r.
            assert!(excess < scallop + 2e-4, "{excess} mm left at {p} normal {n}");
        }
        // The groove; at the border the axis goes beyond it.
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
        &RasterOptions { angle: 0.0, scallop: 0.05, chord: 0.001, bridge: 8.0 },
        1,
    );
    // 20 mm by 2 (1 + √(2·2·0.044)) = 2.84 mm.
    assert_eq!(plan.passes.len(), 8);
    for pass in &plan.passes {
        assert_eq!(pass.stations.len(), 2, "level passes are one move");
        assert!(pass.stations.iter().all(|s| s.cl.tip.z == 1.0 && s.cc.posture.lead == 0.0));
    }
    assert!(plan.unreached.is_empty() && plan.unseen.is_empty());
}

#[test]
fn stations_touch_where_they_say() {
    let cutter = Cutter::bull_nose(6.0, 2.0, 40.0).unwrap();
    let options = RasterOptions { angle: 0.4, scallop: 0.1, chord: 0.002, bridge: 8.0 };
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
    let options = RasterOptions { angle: 0.2, scallop: 0.1, chord: 0.002, bridge: 8.0 };
    let mesh = field(10.0, 0.5, hills);
    assert_eq!(plan(&mesh, &cutter, &options, 1), plan(&mesh, &cutter, &options, 3));
}

#[test]
fn impossible_options_name_the_field() {
    let cutter = Cutter::ball(6.0, 40.0).unwrap();
    let good = RasterOptions { angle: 0.0, scallop: 0.1, chord: 0.001, bridge: 8.0 };
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

/// Across a slope `s` the rim of a flat cutter leaves a sawtooth: lines `d` apart leave `d sin s` along the normal.
#[test]
fn a_flat_cutter_leaves_a_sawtooth_on_a_slope() {
    let (slope, size, scallop, radius) = (0.3, 12.0, 0.2, 3.0);
    let mesh = field(size, 3.0, |_, y| y * libm::tan(slope));
    let cutter = Cutter::flat(2.0 * radius, 40.0).unwrap();
    let plan = plan(&mesh, &cutter, &RasterOptions { angle: 0.0, scallop, chord: 0.002, bridge: 8.0 }, 2);
    let mut lines: Vec<f64> = plan.passes.iter().map(|p| p.stations[0].cl.tip.y).collect();
    lines.dedup();
    let widest = lines.windows(2).map(|w| w[1] - w[0]).fold(0.0, f64::max);
    // Halved until it is enough, and no more often.
    let left = widest * libm::sin(slope);
    assert!(left <= 0.9 * scallop && left > 0.4 * scallop, "{left}");
    // Over the mesh the uphill rim touches.
    let tips = plan.passes.iter().flat_map(|p| &p.stations).map(|s| s.cl.tip);
    for tip in tips.filter(|t| (0.0..=size).contains(&t.x)) {
        let rim = (tip.y + radius).min(size);
        assert!((tip.z - rim * libm::tan(slope)).abs() < 1e-6, "{tip}");
    }
    // The uphill rim goes to both borders: all is finished, and that takes the axis beyond the lower one.
    assert!(plan.unreached.is_empty() && lines[0] < 0.0, "{} {lines:?}", plan.unreached.area());
}

/// Ground that falls off towards the border is finished to its end, from beyond it.
#[test]
fn the_cutter_runs_past_the_border_where_ground_needs_it() {
    let (size, scallop) = (14.0, 0.1);
    let dome = |x: f64, y: f64| 40.0 - 0.06 * ((x - 7.0) * (x - 7.0) + (y - 7.0) * (y - 7.0));
    let cutter = Cutter::ball(6.0, 40.0).unwrap();
    let options = RasterOptions { angle: 0.0, scallop, chord: 0.002, bridge: 8.0 };
    let plan = plan(&field(size, 0.5, dome), &cutter, &options, 2);
    assert!(plan.unreached.is_empty(), "{} mm²", plan.unreached.area());
    let tips = || plan.passes.iter().flat_map(|p| &p.stations).map(|s| s.cl.tip);
    let beyond = tips().map(|t| (-t.x).max(t.x - size).max(-t.y).max(t.y - size)).fold(0.0, f64::max);
    assert!(beyond > 1.0 && beyond <= 3.0, "{beyond}");
}

/// What cannot be held in memory is refused with the limit that would do.
#[test]
fn too_fine_a_limit_says_what_would_do() {
    let cutter = Cutter::ball(6.0, 40.0).unwrap();
    let mesh = field(1000.0, 500.0, |_, _| 0.0);
    let options = RasterOptions { angle: 0.0, scallop: 0.001, chord: 0.0005, bridge: 8.0 };
    let Err(RasterError::TooFine { least }) = raster(&mesh, &cutter, &options, &Stage::silent()) else {
        panic!("accepted");
    };
    assert!(least > 0.01 && least <= 0.1, "{least}");
}
