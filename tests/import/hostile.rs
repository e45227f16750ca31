//! Broken and malicious files: an error or a part that makes sense, never a panic and never memory for what is not there.

use super::data;
use proptest::prelude::*;
use stepover::geometry::Surface;
use stepover::import::{Format, ImportError, Part, Shape, Warning, read};

/// One small file of each kind.
const SMALL: [&str; 12] = [
    "assimp_malformed.obj",
    "bladex_root.iges",
    "confusingheader_bin.stl",
    "curvo_union.json",
    "flat_eight_point_star.stl",
    "geomdl_ex_surface01.cpt",
    "hourglass_ico.obj",
    "mt_bruno_elevation.csv",
    "multibody.stl",
    "nancolor.obj",
    "stl_empty_bin.stl",
    "wallhole.obj",
];

/// Whatever was read holds together.
fn check(part: &Part) {
    assert!(!part.items.is_empty());
    for item in &part.items {
        match &item.shape {
            Shape::Mesh(mesh) => {
                assert!(!mesh.triangles.is_empty());
                assert!(mesh.vertices.iter().all(|p| p.is_finite()));
                assert!(mesh.triangles.iter().flatten().all(|&v| (v as usize) < mesh.vertices.len()));
            }
            Shape::Surface(surface) => {
                let _ = surface.jet(surface.domain().at(0.3, 0.7));
            }
        }
    }
}

#[test]
fn files_cut_off_anywhere_do_no_harm() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.is_file());
    files.sort();
    for path in files {
        let bytes = std::fs::read(&path).unwrap();
        if bytes.len() >= 60_000 {
            continue;
        }
        for end in (0..bytes.len()).step_by(97) {
            if let Ok(part) = read("cut", &bytes[..end]) {
                check(&part);
            }
        }
    }
}

#[test]
fn a_binary_stl_cut_off_keeps_what_is_whole() {
    let bytes = data("octagonal_pocket.stl");
    let part = read("cut", &bytes[..84 + 50 * 1000 + 17]).unwrap();
    assert_eq!(part.warnings[0], Warning::Truncated { stated: 3262, found: 1000 });
    let padded = [&bytes[..], b"behind"].concat();
    assert_eq!(read("padded", &padded).unwrap().warnings[0], Warning::Trailing { count: 6 });
}

#[test]
fn a_huge_stated_count_takes_no_memory() {
    let mut bytes = data("confusingheader_bin.stl");
    bytes[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    let part = read("huge", &bytes).unwrap();
    assert_eq!(part.warnings, [Warning::Truncated { stated: u32::MAX as usize, found: 4 }]);
    let json = br#"{"degree_u": 18446744073709551615, "degree_v": 1, "knots_u": [0,1], "knots_v": [0,1], "control_points": [[[0,0,0]]]}"#;
    assert!(read("huge", json).is_err());
    let iges = String::from_utf8(data("bladex_root.iges")).unwrap();
    let iges = iges.replace("128,81,1,3,1,0,0,1,0,0,0.,", "128,9E8,1,3,1,0,0,1,0,0,0,");
    let error = read("huge", iges.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("entity D3 (type 128): 900000005 numbers should follow parameter 10"), "{error}");
}

#[test]
fn numbers_that_are_none_are_left_out_or_refused() {
    let mut bytes = data("confusingheader_bin.stl");
    bytes[84 + 12..84 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    let part = read("nan", &bytes).unwrap();
    let said: Vec<_> = part.warnings.iter().map(ToString::to_string).collect();
    assert!(
        said.iter()
            .any(|w| w.contains("1 triangles with coordinates that are not finite") && w.contains("byte 84")),
        "{said:?}"
    );
    let error = read("nan", b"v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n").unwrap_err();
    assert_eq!(error.to_string(), "OBJ, line 2: `v` must be followed by three finite numbers");
    let error = read("nan", b"1,2,3,4\n5,6,NaN,8\n").unwrap_err();
    assert!(error.to_string().starts_with("table, line 2, column 3: `NaN` is no height"), "{error}");
}

#[test]
fn nothing_and_nonsense_are_told_apart() {
    assert_eq!(read("a", b"").unwrap_err(), ImportError::Empty);
    assert_eq!(read("a", b" \r\n\t").unwrap_err(), ImportError::Empty);
    assert_eq!(read("a", b"Dear Sir or Madam,\nwith regards").unwrap_err(), ImportError::Unrecognised);
    assert_eq!(read("a", b"lorem\n").unwrap_err(), ImportError::Unrecognised);
    assert_eq!(read("a", &[0; 83]).unwrap_err(), ImportError::Unrecognised);
    for (start, format) in [
        (&b"PK\x03\x04...."[..], Format::Zip),
        (b"glTF\x02\x00\x00\x00", Format::Gltf),
        (b"OFF\n3 1 0\n", Format::Off),
        (b"  0\nSECTION\n", Format::Dxf),
        (b"700 0 1 0\n", Format::Acis),
        (b"<?xml version=\"1.0\"?><amf/>", Format::Xml),
    ] {
        assert_eq!(read("a", start).unwrap_err(), ImportError::Unsupported { format });
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn changed_bytes_do_no_harm(
        file in 0..SMALL.len(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..12),
    ) {
        let mut bytes = data(SMALL[file]);
        for (place, value) in changes {
            let place = place.index(bytes.len());
            bytes[place] = value;
        }
        if let Ok(part) = read("changed", &bytes) {
            check(&part);
        }
    }

    #[test]
    fn changed_digits_do_no_harm(
        file in 0..SMALL.len(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), prop::sample::select(&b"0123456789-.,;E "[..])), 1..6),
    ) {
        let mut bytes = data(SMALL[file]);
        let digits: Vec<usize> = (0..bytes.len()).filter(|&k| bytes[k].is_ascii_digit()).collect();
        for (place, value) in changes {
            if let Some(&k) = digits.get(place.index(digits.len().max(1))) {
                bytes[k] = value;
            }
        }
        if let Ok(part) = read("changed", &bytes) {
            check(&part);
        }
    }
}
