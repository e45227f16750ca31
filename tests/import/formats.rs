//! Small files written for one point each.

use glam::DVec3;
use stepover::geometry::{Along, NurbsSurface, Surface, Uv};
use stepover::import::{Item, Part, Shape, Summary, Topology, Unit, read};

fn surface(item: &Item) -> &NurbsSurface {
    match &item.shape {
        Shape::Surface(surface) => surface,
        Shape::Mesh(_) => panic!("{} is a mesh", item.name),
    }
}

fn refusal(bytes: &[u8]) -> String {
    read("file", bytes).map(|part: Part| part.warnings).unwrap_err().to_string()
}

/// Cards of an IGES file: the global section, and entities as (directory type, matrix, label, parameters).
fn iges(global: &str, entities: &[(i64, usize, &str, String)]) -> Vec<u8> {
    let mut text = format!("{:72}S{:7}\n", "made for a test", 1);
    for (k, chunk) in global.as_bytes().chunks(72).enumerate() {
        text += &format!("{:72}G{:7}\n", std::str::from_utf8(chunk).unwrap(), k + 1);
    }
    let (mut directory, mut parameters, mut cards) = (String::new(), String::new(), 1);
    for (k, (kind, matrix, label, content)) in entities.iter().enumerate() {
        let number = 2 * k + 1;
        directory += &format!(
            "{kind:8}{cards:8}{:8}{:8}{:8}{:8}{matrix:8}{:8}{:>8}D{number:7}\n",
            0, 0, 0, 0, 0, "00000000"
        );
        let lines: Vec<&str> = wrap(content);
        directory += &format!(
            "{kind:8}{:8}{:8}{:8}{:8}{:8}{:8}{label:>8}{:8}D{:7}\n",
            0,
            0,
            lines.len(),
            0,
            "",
            "",
            0,
            number + 1
        );
        for line in &lines {
            parameters += &format!("{line:64}{number:8}P{cards:7}\n");
            cards += 1;
        }
    }
    (text + &directory + &parameters).into_bytes()
}

/// The record in lines of up to 64 columns that end behind a comma.
fn wrap(content: &str) -> Vec<&str> {
    let mut lines = Vec::new();
    let mut rest = content;
    while rest.len() > 64 {
        let end = rest[..64].rfind(',').map_or(64, |comma| comma + 1);
        lines.push(&rest[..end]);
        rest = &rest[end..];
    }
    lines.push(rest);
    lines
}

const GLOBAL_INCH: &str =
    ",,4Hpart,4Hfile,1Ha,1Hb,32,38,6,308,15,4Hpart,1.,1,4HINCH,1,0.1,13H261122.080000,1D-4,10.;";

/// A patch of degree 1 × 1 over the corners (0,0,0), (2,0,0), (0,3,0), (2,3,1), u along x.
fn patch() -> String {
    "128,1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,2.,0.,0.,0.,3.,0.,2.,3.,1.,0.,1.,0.,1.;".into()
}

#[test]
fn iges_keeps_u_and_v_apart_and_knows_its_unit() {
    let part = read("p", &iges(GLOBAL_INCH, &[(128, 0, "PATCH", patch())])).unwrap();
    assert_eq!((part.unit, part.items[0].name.as_str()), (Some(Unit::Inch), "PATCH 0 D1"));
    let inch = surface(&part.items[0]);
    assert_eq!(inch.point(Uv::new(1.0, 0.0)), DVec3::new(2.0, 0.0, 0.0));
    assert_eq!(inch.point(Uv::new(0.0, 1.0)), DVec3::new(0.0, 3.0, 0.0));
    let part = part.in_millimetres(Unit::Metre);
    assert_eq!(surface(&part.items[0]).point(Uv::new(1.0, 1.0)), DVec3::new(2.0, 3.0, 1.0) * 25.4);
}

#[test]
fn iges_applies_matrices_of_matrices_and_the_model_scale() {
    // A quarter turn about z and then a shift along x.
    let turn = "124,0.,-1.,0.,0.,1.,0.,0.,0.,0.,0.,1.,0.;".to_owned();
    let shift = "124,1.,0.,0.,10.,0.,1.,0.,0.,0.,0.,1.,0.;".to_owned();
    let global = GLOBAL_INCH.replace(",1.,1,4HINCH", ",0.5,2,2HMM");
    let part =
        read("p", &iges(&global, &[(128, 3, "", patch()), (124, 5, "", turn), (124, 0, "", shift)])).unwrap();
    assert_eq!(part.unit, Some(Unit::Millimetre));
    let p = surface(&part.items[0]).point(Uv::new(1.0, 0.0));
    // (2, 0, 0) turns to (0, 2, 0), shifts to (10, 2, 0), and doubles as the model is drawn at half size.
    assert!(p.distance(DVec3::new(20.0, 4.0, 0.0)) < 1e-12, "{p}");
}

#[test]
fn iges_tells_trimmed_faces_from_whole_ones() {
    let line = |a: [f64; 2], b: [f64; 2]| format!("110,{:?},{:?},0.,{:?},{:?},0.;", a[0], a[1], b[0], b[1]);
    let face = |corners: [[f64; 2]; 4], holes: &str| {
        let boundary = (0..4).map(|k| (110, 0, "", line(corners[k], corners[(k + 1) % 4])));
        let mut entities = vec![
            (128, 0, "", patch()),
            (144, 0, "F", format!("144,1,1,{holes};")),
            (142, 0, "", "142,0,1,7,0,1;".to_owned()),
            (102, 0, "", "102,4,9,11,13,15;".to_owned()),
        ];
        entities.extend(boundary);
        let part = read("p", &iges(GLOBAL_INCH, &entities)).unwrap();
        part.warnings.iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    let whole = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let cut = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.5, 1.0]];
    assert_eq!(face(whole, "0,5"), [""; 0]);
    assert_eq!(
        face(cut, "0,5"),
        ["F 0 D1: its outer boundary leaves the surface's border; the whole surface is read"]
    );
    assert_eq!(face(whole, "1,5,5"), ["F 0 D1: it has 1 holes; the whole surface is read"]);
}

#[test]
fn iges_tells_when_a_part_of_the_parameters_is_used() {
    let half = patch().replace(",0.,1.,0.,1.;", ",0.,0.5,0.,1.;");
    let part = read("p", &iges(GLOBAL_INCH, &[(128, 0, "", half)])).unwrap();
    assert!(part.warnings[0].to_string().contains("only a part of the parameters"), "{:?}", part.warnings);
}

#[test]
fn iges_faults_name_the_entity() {
    let of = |content: &str| refusal(&iges(GLOBAL_INCH, &[(128, 0, "", content.to_owned())]));
    assert_eq!(
        of("128,1,1,1,1,0,0;"),
        "IGES, entity D1 (type 128): 4 numbers should follow parameter 10, there are 0"
    );
    assert_eq!(
        of(&patch().replace("2.,3.,1.", "2.,x,1.")),
        "IGES, entity D1 (type 128): parameter 32 must be a number, found `x`"
    );
    let weight = patch().replace("1.,1.,1.,1.,0.,0.,0.,2.", "1.,1.,0.,1.,0.,0.,0.,2.");
    assert!(
        of(&weight).contains("weight of control point (0, 1), counted from 0, must be above 0"),
        "{}",
        of(&weight)
    );
    assert!(of("128,1,1").contains("the file ends before the record does"));
    let circle = "124,1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.;".to_owned();
    let error = refusal(&iges(GLOBAL_INCH, &[(128, 3, "", patch()), (124, 3, "", circle)]));
    assert!(error.contains("in a circle"), "{error}");
    let plane = refusal(&iges(GLOBAL_INCH, &[(108, 0, "", "108,0.,0.,1.,0.,0,0.,0.,0.,0.;".into())]));
    assert!(plane.contains("no NURBS surface (entity 128), but 1 × plane (entity 108)"), "{plane}");
}

#[test]
fn a_table_is_a_matrix_or_points_in_any_order() {
    let f = |x: f64, y: f64| 1.0 + 2.0 * x - 3.0 * y + 0.5 * x * y;
    let (xs, ys) = ([2.0, 2.5, 3.0, 3.5, 4.0], [10.0, 12.0, 14.0, 16.0]);
    let mut points: Vec<String> =
        xs.iter().flat_map(|&x| ys.iter().map(move |&y| format!("{x} {y} {}", f(x, y)))).collect();
    let sorted = points.join("\n");
    points.reverse();
    points.swap(3, 11);
    let shuffled = format!("# survey\r\nx\ty\tz\r\n{}\r\n", points.join("\r\n").replace(' ', "\t"));
    let exchanged = sorted
        .lines()
        .map(|l| l.split(' ').rev().collect::<Vec<_>>().join(";"))
        .collect::<Vec<_>>()
        .join("\n");
    let exchanged = format!("z;y;x\n{exchanged}");
    let row = |y: &f64| xs.iter().map(|&x| format!(",{}", f(x, *y))).collect::<String>();
    let matrix = ys.iter().rev().map(|y| format!("{y}{}\n", row(y))).collect::<String>();
    let matrix = format!(",{}\n{matrix}", xs.map(|x| x.to_string()).join(","));
    for text in [sorted, shuffled, exchanged, matrix] {
        let part = read("t", text.as_bytes()).unwrap_or_else(|error| panic!("{error} in\n{text}"));
        assert_eq!(part.warnings, []);
        let surface = surface(&part.items[0]);
        assert_eq!([surface.count(Along::U), surface.count(Along::V)], [5, 4]);
        let p = surface.point(Uv::new(2.7, 13.1));
        assert!(p.distance(DVec3::new(2.7, 13.1, f(2.7, 13.1))) < 1e-12, "{p} in\n{text}");
    }
}

#[test]
fn a_bare_matrix_is_spaced_by_one_and_says_so() {
    let part = read("t", b"0;1;2;3\n1;2;3;4\n").unwrap();
    assert_eq!(surface(&part.items[0]).point(Uv::new(1.5, 0.5)).z, 2.0);
    let said: Vec<_> = part.warnings.iter().map(ToString::to_string).collect();
    assert!(
        said[0].contains("along x were taken to be one unit apart") && said[1].contains("along y"),
        "{said:?}"
    );
}

#[test]
fn a_table_that_is_no_grid_is_refused_with_its_place() {
    assert_eq!(
        refusal(b"0 0 1\n1 0 1\n0 1 1\n"),
        "table, whole file: 3 points with 2 different x and 2 different y are no regular grid, which would need 2 × 2 points"
    );
    assert_eq!(
        refusal(b"0 0 1\n1 0 1\n0 1 1\n0 1 2\n"),
        "table, line 4: the place x = 0, y = 1 stands twice"
    );
    assert_eq!(
        refusal(b"0 0 1\n1 0 1\n5 0 1\n0 1 1\n1 1 1\n5 1 1\n"),
        "table, whole file: the values of x are not evenly spaced; only regular grids are read"
    );
    assert!(refusal(b"1,2,3,4\n5,,7,8\n").starts_with("table, line 2, column 2: the cell is empty"));
    assert!(refusal(b"1,2,3,4\n5,6,7\n").starts_with("table, line 2: 3 cells, but 4 in line 1"));
    assert_eq!(refusal(b"1;2;3;4\n5;6;7,5;8\n"), "table, line 2, column 3: `7,5` is no number");
}

#[test]
fn json_gives_one_surface_or_several() {
    let one = r#"{"name": "arch", "unit": "inch", "degree_u": 2, "degree_v": 1, "knots_u": [0,0,0,1,1,1],
        "knots_v": [0,0,1,1], "control_points": [[[1,0,0],[1,0,4]],[[1,1,0],[1,1,4]],[[0,1,0],[0,1,4]]],
        "weights": [[1,1],[0.7071067811865476,0.7071067811865476],[1,1]]}"#;
    let part = read("j", one.as_bytes()).unwrap();
    assert_eq!((part.unit, part.items[0].name.as_str()), (Some(Unit::Inch), "arch"));
    let p = surface(&part.items[0]).point(Uv::new(0.3, 0.5));
    assert!((p.truncate().length() - 1.0).abs() < 1e-15 && p.z == 2.0, "a quarter of a cylinder: {p}");
    let several =
        format!(r#"{{"unit": "mm", "surfaces": [{0}, {0}]}}"#, one.replace(r#""unit": "inch","#, ""));
    let part = read("j", several.as_bytes()).unwrap();
    assert_eq!((part.unit, part.items.len()), (Some(Unit::Millimetre), 2));
    assert_eq!(
        refusal(one.replace("[0,1,4]]", "[0,1]]").as_bytes()),
        "JSON, `control_points[2][1]`: must be three numbers"
    );
    assert_eq!(
        refusal(one.replace("[0,0,1,1]", "[0,0,0.5,1,1]").as_bytes()),
        "JSON, `control_points`: knots and degrees ask for 3 rows of 3 points, found 3 rows of 2"
    );
    assert!(refusal(b"{\"degree_u\": 3,").starts_with("JSON, line 1, column 15: "));
    assert_eq!(refusal(b"{}"), "JSON, `control_points`: must be there as a list of rows");
}

#[test]
fn homogeneous_points_are_divided_by_their_weight() {
    let text = r#"{"surface": {"control_points": [[[2,0,0,2],[0,4,0,4]],[[1,0,1,1],[0,1,1,1]]],
        "u_degree": 1, "v_degree": 1, "u_knots": [0,0,1,1], "v_knots": [0,0,1,1]}, "exterior": null, "interiors": []}"#;
    let part = read("c", text.as_bytes()).unwrap();
    assert_eq!(part.warnings, []);
    assert_eq!(surface(&part.items[0]).point(Uv::new(0.0, 0.0)), DVec3::new(1.0, 0.0, 0.0));
    assert_eq!(surface(&part.items[0]).point(Uv::new(0.0, 1.0)), DVec3::new(0.0, 1.0, 0.0));
}

#[test]
fn obj_continues_lines_counts_back_and_shares_vertices() {
    let text = b"o a\nv 0 0 0\nv 1 0 0\nv 1 1 0 # corner\nv 0 1 0\nf -4//1 -3/7 \\\n 3 4\no b\nv 1 0 0\nv 2 0 0\nv 1 1 0\nf 5 6 7\nl 1 2\n";
    let part = read("o", text).unwrap();
    let Summary::Mesh { triangles, vertices, topology, .. } = part.items[0].summary() else { panic!() };
    assert_eq!(
        (triangles, vertices, topology),
        (3, 5, Topology { boundary_edges: 5, ..Topology::default() })
    );
    assert!(refusal(b"v 0 0 0\nf 1 1\n").starts_with("OBJ, line 2: a face needs at least three vertices"));
    assert!(refusal(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n").starts_with("OBJ, line 4: `x` is no vertex"));
    assert!(refusal(b"v 0 0 0\nv 1 0 0\n").starts_with("OBJ, whole file: 2 vertices and no face"));
}

#[test]
fn ascii_stl_is_read_in_any_case_and_refused_by_line() {
    let facet = |word: &str| {
        format!(
            "FACET NORMAL 0 0 nan outer loop\n vertex 0 0 0 {word} 1e0 -0 0\nVERTEX 0 1 0 endloop endfacet\n"
        )
    };
    let part =
        read("s", format!("solid  my  part\n{}endsolid my part\n", facet("vertex")).as_bytes()).unwrap();
    assert_eq!(part.items[0].name, "my part");
    let wrong = format!("solid\n{}endsolid\n", facet("vortex"));
    assert_eq!(refusal(wrong.as_bytes()), "ASCII STL, line 3: `vortex` has no place in a facet");
    let four = format!("solid\n{}endsolid\n", facet("vertex 1 1 1 vertex"));
    assert_eq!(refusal(four.as_bytes()), "ASCII STL, line 4: a facet has three vertices, found 4");
    let cut = format!("solid\n{}facet normal 0 0 1\nouter loop\nvert", facet("vertex"));
    let warnings = read("s", cut.as_bytes()).unwrap().warnings;
    assert!(warnings[0].to_string().starts_with("line 7: the file ends within a facet"), "{warnings:?}");
}

/// A tetrahedron as text, the triangles named in `turned` reversed.
fn tetrahedron(turned: &[usize]) -> String {
    let mut text = String::from("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n");
    for (k, [a, b, c]) in [[1, 3, 2], [1, 2, 4], [2, 3, 4], [1, 4, 3]].into_iter().enumerate() {
        text += &if turned.contains(&k) { format!("f {a} {c} {b}\n") } else { format!("f {a} {b} {c}\n") };
    }
    text
}

#[test]
fn turned_triangles_are_mended_outwards() {
    let whole = read("t", tetrahedron(&[]).as_bytes()).unwrap();
    assert_eq!(whole.warnings, []);
    for turned in [&[1][..], &[0, 2], &[0, 1, 3]] {
        let part = read("t", tetrahedron(turned).as_bytes()).unwrap();
        let said: Vec<_> = part.warnings.iter().map(ToString::to_string).collect();
        assert_eq!(said, [format!("{} triangles were turned to agree with their neighbours", turned.len())]);
    }
    let inside_out = read("t", tetrahedron(&[0, 1, 2, 3]).as_bytes()).unwrap();
    assert!(inside_out.warnings[0].to_string().contains("faces its inside"));
    // A Möbius strip of five triangles cannot be mended.
    let moebius = "v 1 0 0\nv 0.3 0.9 0.1\nv -0.8 0.6 0\nv -0.8 -0.6 0.2\nv 0.3 -0.9 0\nf 1 2 3\nf 2 3 4\nf 3 4 5\nf 4 5 1\nf 5 1 2\n";
    let said: Vec<_> =
        read("m", moebius.as_bytes()).unwrap().warnings.iter().map(ToString::to_string).collect();
    assert!(said.iter().any(|w| w.contains("turning cannot mend it")), "{said:?}");
}
