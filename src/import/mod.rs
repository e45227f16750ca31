//! Files into surfaces and meshes.
//!
//! [`read`] recognises a format by its content, never by its name, and returns a [`Part`]: what the file holds, in the file's own
//! unit, and warnings about everything that was mended, assumed or left out. What cannot be read is refused with an error that
//! says where the trouble is and what would be right.
//!
//! | format | gives | module |
//! |---|---|---|
//! | STL, ASCII and binary | a mesh | `stl` |
//! | Wavefront OBJ | a mesh | `obj` |
//! | IGES (entity 128) | one surface a face | `iges` |
//! | heights or x, y, z as text | a surface through a regular grid | `table` |
//! | control net as text | a surface of assumed degree | `control_net` |
//! | NURBS as JSON | a surface | [`nurbs_json`] |
//!
//! No count that a file states is trusted: memory is taken for what is there.

mod control_net;
mod error;
mod format;
mod iges;
mod mesh_builder;
pub mod nurbs_json;
mod obj;
mod part;
mod stl;
mod table;
mod text;
mod topology;
mod unit;
mod warning;

pub use error::{ImportError, Place};
pub use format::Format;
pub use part::{Item, Part, Shape, Summary};
pub use topology::Topology;
pub use unit::Unit;
pub use warning::Warning;

/// Largest file read, 256 MiB: a binary STL of five million triangles. The mesh made of it takes about as much again, which a
/// page can still hold; finishing needs far less.
pub const MAX_BYTES: usize = 256 << 20;

/// Most triangles read from one file; see [`MAX_BYTES`].
pub const MAX_TRIANGLES: usize = 5_400_000;

/// The part in the file `name` with the content `bytes`. The name serves only to call things by; the content decides the format.
pub fn read(name: &str, bytes: &[u8]) -> Result<Part, ImportError> {
    if bytes.len() > MAX_BYTES {
        return Err(ImportError::TooLarge { found: bytes.len() });
    }
    let format = Format::of(bytes)?;
    let stem = stem(name);
    match format {
        Format::StlBinary => stl::read_binary(stem, bytes),
        Format::StlAscii => stl::read_ascii(stem, bytes),
        Format::Obj => obj::read(stem, bytes),
        Format::Iges => iges::read(bytes),
        Format::Table => table::read(stem, bytes),
        Format::ControlNet => control_net::read(stem, bytes),
        Format::Json => nurbs_json::read(stem, bytes),
        refused => Err(ImportError::Unsupported { format: refused }),
    }
}

/// The file's name without folders and ending; `part` where nothing is left.
fn stem(name: &str) -> &str {
    let file = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
    if stem.is_empty() { "part" } else { stem }
}
