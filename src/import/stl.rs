//! STL, binary and ASCII.
//!
//! Source: 3D Systems, StereoLithography Interface Specification, 1989. Real files differ from it: headers of binary files start with
//! `solid`, text has capitals, several solids or carriage returns, and both end early or late.

use super::mesh_builder::MeshBuilder;
use super::{Format, ImportError, Item, MAX_TRIANGLES, Part, Place, Shape, Warning};
use glam::DVec3;
use std::sync::Arc;

/// Bytes before the first triangle of a binary file: a free header and the number of triangles.
pub(super) const HEADER: usize = 84;
/// Bytes of a triangle: normal and three corners as 32-bit floats, and two bytes of anything.
pub(super) const RECORD: usize = 50;

/// The number of triangles that a binary file states; `None` where it is shorter than its header.
pub(super) fn stated_count(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEADER - 4..HEADER)?;
    Some(u32::from_le_bytes(count.try_into().ok()?) as usize)
}

/// The corners of one record of a binary file.
pub(super) fn corners(record: &[u8]) -> [DVec3; 3] {
    let number = |k: usize| {
        let at = 12 + 4 * k;
        f64::from(f32::from_le_bytes([record[at], record[at + 1], record[at + 2], record[at + 3]]))
    };
    [0, 3, 6].map(|k| DVec3::new(number(k), number(k + 1), number(k + 2)))
}

pub(super) fn read_binary(name: &str, bytes: &[u8]) -> Result<Part, ImportError> {
    let format = Format::StlBinary;
    let stated = stated_count(bytes).unwrap_or(0);
    let body = bytes.get(HEADER..).unwrap_or_default();
    let found = stated.min(body.len() / RECORD);
    if found > MAX_TRIANGLES {
        return Err(ImportError::at(format, Place::Byte(80), too_many(found)));
    }
    if found == 0 {
        let message = if stated == 0 { "the file states 0 triangles" } else { "no triangle is there whole" };
        return Err(ImportError::at(
            format,
            Place::Byte(80),
            format!("{message}; a mesh needs at least one"),
        ));
    }
    let mut builder = MeshBuilder::default();
    for (k, record) in body.chunks_exact(RECORD).take(found).enumerate() {
        builder.add(corners(record), || Place::Byte(HEADER + RECORD * k));
    }
    let mut warnings = Vec::new();
    if found < stated {
        warnings.push(Warning::Truncated { stated, found });
    } else if body.len() > found * RECORD {
        warnings.push(Warning::Trailing { count: body.len() - found * RECORD });
    }
    part(format, name, builder, warnings)
}

fn too_many(found: usize) -> String {
    format!("{found} triangles, at most {MAX_TRIANGLES} are read: export it coarser")
}

fn part(
    format: Format,
    name: &str,
    builder: MeshBuilder,
    mut warnings: Vec<Warning>,
) -> Result<Part, ImportError> {
    let (mesh, about) = builder.finish().ok_or_else(|| {
        ImportError::at(
            format,
            Place::Whole,
            "no triangle is left that has an area; a mesh needs at least one",
        )
    })?;
    warnings.extend(about);
    let item = Item { name: name.to_owned(), shape: Shape::Mesh(Arc::new(mesh)) };
    Ok(Part { format, unit: None, items: vec![item], warnings })
}

pub(super) fn read_ascii(name: &str, bytes: &[u8]) -> Result<Part, ImportError> {
    let mut text = Text::default();
    let mut lines = bytes.split(|&b| b == b'\n').peekable();
    while let Some(raw) = lines.next() {
        text.line += 1;
        let read = text.read_line(&String::from_utf8_lossy(raw));
        // A file cut off within a word ends in nonsense that is not worth refusing the rest for.
        if let (Err(message), true) = (read, lines.peek().is_some()) {
            return Err(text.error(message));
        }
    }
    if text.builder.seen() == 0 {
        return Err(text.error("the file ends without a whole facet; a mesh needs at least one".into()));
    }
    let mut warnings = Vec::new();
    if text.facet.is_some() {
        warnings.push(Warning::EndsInFacet { place: Place::Line(text.line) });
    }
    if text.solids > 1 {
        warnings.push(Warning::Joined { count: text.solids });
    }
    part(Format::StlAscii, text.name.as_deref().unwrap_or(name), text.builder, warnings)
}

/// An ASCII file as far as it was read.
#[derive(Default)]
struct Text {
    line: usize,
    builder: MeshBuilder,
    /// Corners of the facet that is open.
    facet: Option<Vec<DVec3>>,
    solids: usize,
    name: Option<String>,
}

impl Text {
    fn error(&self, message: String) -> ImportError {
        ImportError::at(Format::StlAscii, Place::Line(self.line), message)
    }

    /// Reads the words of one line, whatever stands together in it; the error is a message about this line.
    fn read_line(&mut self, text: &str) -> Result<(), String> {
        let mut words = text.split_ascii_whitespace();
        while let Some(word) = words.next() {
            match (word.to_ascii_lowercase().as_str(), &mut self.facet) {
                ("solid", None) => {
                    self.solids += 1;
                    let rest = words.by_ref().collect::<Vec<_>>().join(" ");
                    if self.name.is_none() && !rest.is_empty() {
                        self.name = Some(rest);
                    }
                }
                // The name may follow here too.
                ("endsolid", None) => words.by_ref().for_each(drop),
                ("facet", None) => self.facet = Some(Vec::with_capacity(3)),
                (other, None) => {
                    return Err(format!("expected `facet` or `endsolid`, found `{}`", clipped(other)));
                }
                // Normals are computed from corners, so that a wrong one does no harm.
                ("normal", Some(_)) => words.by_ref().take(3).for_each(drop),
                ("outer" | "loop" | "endloop", Some(_)) => {}
                ("vertex", Some(corners)) => {
                    let mut number = || words.next().and_then(|w| w.parse::<f64>().ok());
                    let point = number().zip(number()).zip(number());
                    let ((x, y), z) = point.ok_or("`vertex` must be followed by three numbers")?;
                    corners.push(DVec3::new(x, y, z));
                }
                ("endfacet", Some(corners)) => {
                    let &[a, b, c] = corners.as_slice() else {
                        return Err(format!("a facet has three vertices, found {}", corners.len()));
                    };
                    self.facet = None;
                    let line = self.line;
                    self.builder.add([a, b, c], || Place::Line(line));
                    if self.builder.seen() > MAX_TRIANGLES {
                        return Err(too_many(self.builder.seen()));
                    }
                }
                (other, Some(_)) => return Err(format!("`{}` has no place in a facet", clipped(other))),
            }
        }
        Ok(())
    }
}

/// At most 20 characters of a word, for messages.
pub(super) fn clipped(word: &str) -> &str {
    word.char_indices().nth(20).map_or(word, |(end, _)| &word[..end])
}
