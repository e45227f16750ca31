//! Which format a file is in.

use super::{ImportError, stl, text};

/// A file format, told by content.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// STL in its binary form.
    StlBinary,
    /// STL as text.
    StlAscii,
    /// Wavefront OBJ.
    Obj,
    /// IGES in its fixed-column text form.
    Iges,
    /// Numbers in rows: a matrix of heights, or x, y and z of a regular grid.
    Table,
    /// Rows of control points.
    ControlNet,
    /// JSON.
    Json,
    /// STEP; not read.
    Step,
    /// Stanford PLY; not read.
    Ply,
    /// IGES in its compressed or binary form; not read.
    IgesPacked,
    /// A ZIP archive, such as 3MF; not read.
    Zip,
    /// A gzip archive; not read.
    Gzip,
    /// XML, such as AMF or COLLADA; not read.
    Xml,
    /// glTF in its binary form; not read.
    Gltf,
    /// Geomview OFF; not read.
    Off,
    /// DXF; not read.
    Dxf,
    /// VRML; not read.
    Vrml,
    /// Rhino 3DM; not read.
    Rhino,
    /// An ACIS solid; not read.
    Acis,
    /// A Parasolid text; not read.
    Parasolid,
}

/// Words at the very start of files that are known and not read.
const BEGINNINGS: [(&[u8], Format); 13] = [
    (b"ISO-10303-21", Format::Step),
    (b"ply\n", Format::Ply),
    (b"ply\r", Format::Ply),
    (b"PK\x03\x04", Format::Zip),
    (b"\x1f\x8b", Format::Gzip),
    (b"<?xml", Format::Xml),
    (b"glTF", Format::Gltf),
    (b"OFF", Format::Off),
    (b"0\nSECTION", Format::Dxf),
    (b"0\r\nSECTION", Format::Dxf),
    (b"#VRML", Format::Vrml),
    (b"3D Geometry File Format", Format::Rhino),
    (b"**ABCDEFGHIJKLMNOPQRSTUVWXYZ", Format::Parasolid),
];

impl Format {
    /// The format of `bytes`.
    pub fn of(bytes: &[u8]) -> Result<Self, ImportError> {
        if bytes.is_empty() {
            return Err(ImportError::Empty);
        }
        let start = text::without_mark(bytes).trim_ascii_start();
        if start.is_empty() {
            return Err(ImportError::Empty);
        }
        if let Some(format) =
            BEGINNINGS.iter().find(|(word, _)| start.starts_with(word)).map(|(_, format)| *format)
        {
            return Ok(format);
        }
        // The size of a binary STL follows from its count: no text meets that by chance.
        let stated = stl::stated_count(bytes);
        if stated.is_some_and(|count| bytes.len() == stl::HEADER + stl::RECORD * count) {
            return Ok(Format::StlBinary);
        }
        if let Some(format) = iges_kind(text::without_mark(bytes)) {
            return Ok(format);
        }
        if start.len() >= 5 && start[..5].eq_ignore_ascii_case(b"solid") && !looks_binary(bytes) {
            return Ok(Format::StlAscii);
        }
        if matches!(start[0], b'{' | b'[') {
            return Ok(Format::Json);
        }
        if is_cut_or_padded_stl(bytes) {
            return Ok(Format::StlBinary);
        }
        if looks_binary(bytes) {
            return Err(ImportError::Unrecognised);
        }
        text_kind(start).ok_or(ImportError::Unrecognised)
    }

    /// What to export instead of a format that is not read.
    pub(super) fn instead(self) -> &'static str {
        match self {
            Format::Step | Format::Rhino | Format::Acis | Format::Parasolid | Format::IgesPacked => {
                "export the faces as IGES in ASCII form with NURBS surfaces (entity 128), or a fine mesh as STL"
            }
            Format::Gzip | Format::Zip => "unpack it, or export the mesh as STL or OBJ",
            _ => "export the mesh as STL or OBJ",
        }
    }
}

impl std::fmt::Display for Format {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Format::StlBinary => "binary STL",
            Format::StlAscii => "ASCII STL",
            Format::Obj => "OBJ",
            Format::Iges => "IGES",
            Format::Table => "table",
            Format::ControlNet => "control net",
            Format::Json => "JSON",
            Format::Step => "STEP",
            Format::Ply => "PLY",
            Format::IgesPacked => "compressed or binary IGES",
            Format::Zip => "a ZIP archive (3MF and others)",
            Format::Gzip => "a gzip archive",
            Format::Xml => "XML (AMF, COLLADA and others)",
            Format::Gltf => "glTF",
            Format::Off => "OFF",
            Format::Dxf => "DXF",
            Format::Vrml => "VRML",
            Format::Rhino => "Rhino 3DM",
            Format::Acis => "ACIS",
            Format::Parasolid => "Parasolid",
        })
    }
}

/// Whether the first kilobytes hold a zero byte, which no text does.
fn looks_binary(bytes: &[u8]) -> bool {
    bytes.iter().take(4096).any(|&b| b == 0)
}

/// IGES shows itself by the section letter in column 73 and a number behind it.
fn iges_kind(bytes: &[u8]) -> Option<Format> {
    let line = bytes.split(|&b| b == b'\n').next()?;
    let (letter, number) = (line.get(72)?, line.get(73..80.min(line.len()))?);
    let numbered = number.trim_ascii().iter().all(u8::is_ascii_digit) && !number.trim_ascii().is_empty();
    match letter {
        b'S' | b'G' if numbered => Some(Format::Iges),
        b'B' | b'C' if numbered => Some(Format::IgesPacked),
        _ => None,
    }
}

/// Whether the file is a binary STL that ends early or late: not text, and the first triangles are plausible.
fn is_cut_or_padded_stl(bytes: &[u8]) -> bool {
    // Corners beyond this are no lengths in any unit; random bytes go beyond within a few numbers.
    const FARTHEST: f64 = 1e12;
    let Some(stated) = stl::stated_count(bytes) else { return false };
    let records = bytes[stl::HEADER..].chunks_exact(stl::RECORD).take(stated.min(8));
    let plausible = |record: &[u8]| stl::corners(record).iter().all(|p| p.abs().max_element() < FARTHEST);
    stated > 0 && looks_binary(bytes) && records.len() > 0 && records.into_iter().all(plausible)
}

/// The kind of a text by its first lines that say something.
fn text_kind(start: &[u8]) -> Option<Format> {
    const OBJ_WORDS: [&str; 16] = [
        "v", "vt", "vn", "vp", "f", "o", "g", "s", "l", "p", "mtllib", "usemtl", "cstype", "deg", "call",
        "curv",
    ];
    let lines = start.split(|&b| b == b'\n').map(|line| String::from_utf8_lossy(line));
    let mut lines = lines.filter(|line| !line.trim().is_empty() && !line.trim_start().starts_with('#'));
    let first = lines.next()?;
    let first = first.trim();
    if OBJ_WORDS.contains(&first.split_ascii_whitespace().next()?) {
        return Some(Format::Obj);
    }
    if is_acis(first) {
        return Some(Format::Acis);
    }
    if text::is_net_row(first) {
        return Some(Format::ControlNet);
    }
    // The first row of a table may be words; one of the first two has numbers.
    let delimiter = text::Delimiter::of(first);
    let second = lines.next().unwrap_or_default();
    let wide = delimiter.split(first).count() >= 2;
    let numbers =
        delimiter.split(first).chain(delimiter.split(&second)).any(|cell| cell.parse::<f64>().is_ok());
    (wide && numbers).then_some(Format::Table)
}

/// A SAT file begins with four whole numbers, the first its version.
fn is_acis(line: &str) -> bool {
    let numbers: Vec<u32> = line.split_ascii_whitespace().map_while(|w| w.parse().ok()).collect();
    matches!(numbers.as_slice(), [200..=40_000, _, 0..=100, 0 | 1] if line.split_ascii_whitespace().count() == 4)
}
