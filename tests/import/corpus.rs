//! Real files, a row each: what they give, or why they are refused. Bounds and counts of surfaces were made with another kernel
//! (Open CASCADE), those of meshes with another mesh library (trimesh).

use super::data;
use glam::DVec3;
use stepover::geometry::{Along, Surface, Uv};
use stepover::import::{Part, Shape, Summary, Unit, read};

enum Expect {
    /// Triangles, vertices, edges of one triangle, edges of more than two; bounds; fragments of the warnings, in order.
    Mesh([usize; 4], [f64; 6], &'static [&'static str]),
    /// Degrees and control points of each surface; unit; bounds of all; fragments of the warnings, in order.
    Surfaces(&'static [[usize; 4]], Option<Unit>, [f64; 6], &'static [&'static str]),
    /// A fragment of the error.
    Refused(&'static str),
}
use Expect::{Mesh, Refused, Surfaces};

const OPEN: &str = "the mesh is open";
const MANY: &str = "belong to more than two triangles";
const JOINED: &str = "objects were joined";
const STEP: &str = "STEP is not read; export the faces as IGES";

const BOTTOM: [usize; 4] = [3, 3, 21, 5];
const TOP: [usize; 4] = [3, 3, 22, 5];

const CORPUS: &[(&str, Expect)] = &[
    (
        "bladex_propeller_and_shaft.stl",
        Mesh(
            [6888, 3446, 0, 20],
            [-1350.0, -125.0, -124.7, 133.7, 119.5, 120.7],
            &["11 triangles without area", "20 edges belong to more than two"],
        ),
    ),
    (
        "bladex_upper.stl",
        Mesh([522, 291, 58, 0], [-24.55, -55.99, -124.6, 45.55, 47.16, -31.27], &["58 edges"]),
    ),
    (
        "bladex_lower.iges",
        Surfaces(
            &[[3, 2, 526, 13]],
            Some(Unit::Millimetre),
            [-24.55, -56.0, -124.6, 45.29, 47.16, -31.48],
            &[],
        ),
    ),
    (
        "bladex_root.iges",
        Surfaces(
            &[[3, 1, 82, 2]],
            Some(Unit::Millimetre),
            [-23.07, -14.29, -34.38, 10.76, 7.314, -31.26],
            &[],
        ),
    ),
    (
        "tigl_D150_wing.igs",
        Surfaces(
            &[BOTTOM, TOP, BOTTOM, TOP, BOTTOM, TOP],
            Some(Unit::Millimetre),
            [12740.0, 0.0, -1846.0, 22140.0, 16960.0, -107.0],
            &["2 × plane surface (entity 190) were left out"],
        ),
    ),
    ("tigl_face.stp", Refused(STEP)),
    ("flat_eight_point_star.stl", Mesh([16, 17, 16, 0], [0.0, 0.0, 0.0, 1.0, 1.0, 0.0], &[OPEN])),
    ("axom_revolved_sphere.step", Refused(STEP)),
    ("axom_sliced_cylinder.step", Refused(STEP)),
    (
        "car_prius_body.obj",
        Mesh([1676, 860, 86, 70], [-100.6, -226.9, 14.48, 100.6, 234.9, 153.0], &[OPEN, MANY, JOINED]),
    ),
    ("nist_ctc_03_asme1_rc.stp", Refused(STEP)),
    ("asi_test-joinsurf_01.stp", Refused(STEP)),
    ("featuretype.STEP", Refused(STEP)),
    ("featuretype.STL", Mesh([3476, 2010, 576, 0], [-2.5, -1.25, 0.0, 2.5, 1.25, 1.375], &[OPEN])),
    ("cube_hole.step", Refused(STEP)),
    (
        "terrain_small.stl",
        Mesh(
            [40322, 20246, 174, 0],
            [0.0, 0.0, 0.0, 100.0, 73.33, 52.57],
            &["20 triangles without area", OPEN],
        ),
    ),
    ("wavy_mesh_with_hole.ply", Refused("PLY is not read; export the mesh as STL or OBJ")),
    (
        "canonical_face_model.obj",
        Mesh([898, 468, 36, 0], [-6.81, -8.614, -3.877, 7.454, 6.719, 7.35], &[OPEN]),
    ),
    (
        "demosthenes-low-res.obj",
        Mesh([16719, 8394, 67, 0], [-0.7473, -0.4922, -0.5806, 1.003, 2.201, 0.9548], &[OPEN]),
    ),
    ("hourglass_ico.obj", Mesh([40, 23, 0, 0], [-0.8944, -2.0, -0.8506, 0.8944, 2.0, 0.8506], &[])),
    ("octagonal_pocket.stl", Mesh([3262, 1658, 54, 0], [0.0, 0.0, 0.0, 0.2286, 0.1647, 0.01588], &[OPEN])),
    // The other library cuts polygons into fans and finds an edge of more than two triangles.
    ("wallhole.obj", Mesh([66, 35, 0, 0], [0.0, 0.0, -10.0, 10.0, 15.0, 0.0], &[])),
    ("wecsim_float.stl", Mesh([516, 264, 24, 0], [-9.987, -10.0, -2.308, 9.987, 10.0, 2.721], &[OPEN])),
    ("empty.stl", Refused("ASCII STL, line 2: the file ends without a whole facet")),
    ("stl_empty_bin.stl", Refused("binary STL, byte 80: the file states 0 triangles")),
    (
        "multibody.stl",
        Mesh(
            [32, 20, 0, 0],
            [-0.5108, -0.7188, -0.05193, 0.1252, 0.3696, 0.288],
            &["2 objects were joined", "26 triangles were turned"],
        ),
    ),
    ("nancolor.obj", Mesh([12, 8, 0, 0], [-0.5, -0.5, -0.5, 0.5, 0.5, 0.5], &[])),
    ("polygonfaces.obj", Mesh([3, 5, 5, 0], [-500.0, 0.0, -500.0, 500.0, 500.0, 500.0], &[OPEN])),
    ("points_emptyface.ply", Refused("PLY is not read")),
    (
        "triangle_with_two_solids.stl",
        Mesh([2, 6, 6, 0], [-1.0, -1.0, 0.0, 3.0, 3.0, 0.0], &["2 objects were joined", OPEN]),
    ),
    ("sphereWithHole.stl", Mesh([285, 146, 9, 0], [0.0, 0.0, 0.0, 3.0, 3.0, 3.0], &[OPEN])),
    (
        "assimp_malformed.obj",
        Refused("OBJ, line 23: vertex 12 does not exist: they are numbered from 1 to 8"),
    ),
    ("confusingheader_bin.stl", Mesh([4, 4, 0, 0], [0.0, 0.0, 0.0, 1.0, 1.0, 1.0], &[])),
    ("dos.stl", Mesh([116, 60, 0, 0], [0.0, 0.0, 0.0, 1.628, 0.35, 3.0], &[])),
    ("mt_bruno_elevation.csv", Surfaces(&[[3, 3, 24, 25]], None, [0.0, 0.0, -48.6, 23.0, 24.0, 374.3], &[])),
    (
        "curvo_union.json",
        Surfaces(
            &[[1, 1, 2, 2]],
            None,
            [-4.11, -3.833, 0.0, 3.833, 4.61, 0.0],
            &["it is trimmed by `exterior`"],
        ),
    ),
    (
        "geomdl_ex_surface01.cpt",
        Surfaces(&[[3, 3, 6, 6]], None, [-25.0, -25.0, -10.0, 25.0, 25.0, 1.4], &["degrees 3 and 3"]),
    ),
    ("geomdl_ex_torus.cptw", Refused("points with weights need the degrees and knots")),
];

/// Bounds over all items.
fn bounds(part: &Part) -> (DVec3, DVec3) {
    let all = part.items.iter().map(|item| match item.summary() {
        Summary::Mesh { bounds, .. } | Summary::Surface { bounds, .. } => bounds,
    });
    all.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(lo, hi), (a, b)| (lo.min(a), hi.max(b)))
}

#[track_caller]
fn check_common(file: &str, part: &Part, expected: &[f64; 6], warnings: &[&str]) {
    let (lo, hi) = bounds(part);
    let (low, high) = (DVec3::from_slice(expected), DVec3::from_slice(&expected[3..]));
    // The expected figures have four digits, and boxes of splines are a little wide in the other kernel.
    let tolerance = 1e-3 * low.distance(high);
    let off = (lo - low).abs().max((hi - high).abs()).max_element();
    assert!(off <= tolerance, "{file}: bounds {lo} .. {hi}, expected {low} .. {high}");
    let said: Vec<String> = part.warnings.iter().map(ToString::to_string).collect();
    let as_expected = said.len() == warnings.len() && said.iter().zip(warnings).all(|(w, e)| w.contains(e));
    assert!(as_expected, "{file}: warnings {said:?}, expected {warnings:?}");
}

#[test]
fn every_file_gives_what_its_row_says() {
    for (file, expect) in CORPUS {
        let result = read(file, &data(file));
        match (expect, result) {
            (Refused(fragment), Err(error)) => {
                assert!(error.to_string().contains(fragment), "{file}: {error}");
            }
            (Mesh(counts, expected, warnings), Ok(part)) => {
                let [Summary::Mesh { triangles, vertices, topology, .. }] =
                    part.items.iter().map(|i| i.summary()).collect::<Vec<_>>()[..]
                else {
                    panic!("{file}: one mesh expected");
                };
                let found = [triangles, vertices, topology.boundary_edges, topology.non_manifold_edges];
                assert_eq!(&found, counts, "{file}");
                assert_eq!(topology.disagreeing_edges, 0, "{file}");
                assert_eq!(part.unit, None, "{file}");
                check_common(file, &part, expected, warnings);
            }
            (Surfaces(surfaces, unit, expected, warnings), Ok(part)) => {
                let found: Vec<_> = part
                    .items
                    .iter()
                    .map(|item| match item.summary() {
                        Summary::Surface { degrees: [p, q], counts: [n, m], .. } => [p, q, n, m],
                        Summary::Mesh { .. } => panic!("{file}: {} is a mesh", item.name),
                    })
                    .collect();
                assert_eq!(&found, surfaces, "{file}");
                assert_eq!(part.unit, *unit, "{file}");
                check_common(file, &part, expected, warnings);
            }
            (Refused(fragment), Ok(_)) => panic!("{file}: was read, but {fragment} was expected"),
            (_, Err(error)) => panic!("{file}: {error}"),
        }
    }
}

#[test]
fn every_file_has_a_row() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data");
    for entry in std::fs::read_dir(folder).unwrap() {
        let entry = entry.unwrap();
        // Folders hold other tests' tables.
        if entry.file_type().unwrap().is_dir() {
            continue;
        }
        let name = entry.file_name().into_string().unwrap();
        let known = CORPUS.iter().any(|(file, _)| *file == name) || name.ends_with(".md");
        assert!(known, "tests/data/{name} has no row in the corpus");
    }
}

#[test]
fn scaling_scales_every_coordinate() {
    for file in ["bladex_root.iges", "dos.stl", "mt_bruno_elevation.csv"] {
        let part = read(file, &data(file)).unwrap();
        let (lo, hi) = bounds(&part);
        let (low, high) = bounds(&part.clone().scaled(25.4));
        assert!(low.distance(lo * 25.4) < 1e-9 && high.distance(hi * 25.4) < 1e-9, "{file}");
        let assumed = part.clone().in_millimetres(Unit::Inch);
        assert_eq!(assumed.unit, Some(Unit::Millimetre));
        let factor = if part.unit.is_some() { 1.0 } else { 25.4 };
        assert!(bounds(&assumed).1.distance(hi * factor) < 1e-9, "{file}");
    }
}

#[test]
fn the_blade_is_smooth_over_spans_of_a_billionth() {
    let part = read("blade", &data("bladex_lower.iges")).unwrap();
    let Shape::Surface(blade) = &part.items[0].shape else { panic!("a surface") };
    let breaks = blade.breaks(Along::U);
    let smallest = breaks.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
    assert!(smallest < 2e-9, "{smallest:e}");
    for &u in &breaks[1..breaks.len() - 1] {
        for v in [0.0, 0.31, 0.77, 1.0] {
            let (below, at) = (blade.jet(Uv::new(u - 1e-12, v)), blade.jet(Uv::new(u, v)));
            // Over a step of 1e-12 tangents were measured to turn by up to 3e-8; a crease or a lost span would be far above this.
            assert!(below.du.distance(at.du) < 1e-7 * at.du.length(), "u = {u}, v = {v}");
            assert!(below.dv.distance(at.dv) < 1e-7 * at.dv.length(), "u = {u}, v = {v}");
        }
    }
}
