//! What was mended, assumed or left out while reading.

use super::Place;

/// Something a person should know about what was read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Warning {
    /// Triangles without area were left out.
    #[error("{count} triangles without area were left out")]
    Degenerate {
        /// How many.
        count: usize,
    },
    /// Triangles with a coordinate that is infinite or no number were left out.
    #[error("{count} triangles with coordinates that are not finite were left out, the first at {first}")]
    NotFinite {
        /// How many.
        count: usize,
        /// Where the first stands.
        first: Place,
    },
    /// The mesh is open.
    #[error("the mesh is open: {count} edges belong to one triangle only")]
    Boundary {
        /// Edges of one triangle.
        count: usize,
    },
    /// Edges with more than two triangles.
    #[error("{count} edges belong to more than two triangles")]
    NonManifold {
        /// How many.
        count: usize,
    },
    /// Triangles were turned to agree with their neighbours.
    #[error("{count} triangles were turned to agree with their neighbours")]
    Turned {
        /// How many.
        count: usize,
    },
    /// Triangles cannot be made to agree.
    #[error("neighbouring triangles face opposite sides over {count} edges, and turning cannot mend it")]
    NotOrientable {
        /// Edges over which they disagree.
        count: usize,
    },
    /// A closed mesh whose triangles face its inside.
    #[error("the mesh is closed and faces its inside: cut its back, or turn it inside out")]
    InsideOut,
    /// The file ends early.
    #[error("the file ends early: {found} of {stated} triangles are there")]
    Truncated {
        /// Triangles stated.
        stated: usize,
        /// Triangles found whole.
        found: usize,
    },
    /// The text of a file ends within a facet.
    #[error("{place}: the file ends within a facet, which was left out")]
    EndsInFacet {
        /// The last line.
        place: Place,
    },
    /// Bytes behind the last triangle.
    #[error("{count} bytes behind the last triangle were left out")]
    Trailing {
        /// How many.
        count: usize,
    },
    /// Several objects became one mesh.
    #[error("{count} objects were joined to one mesh")]
    Joined {
        /// How many.
        count: usize,
    },
    /// A polygon was cut into triangles though it crosses itself or is flat to a line.
    #[error(
        "{count} polygons cross themselves; they were cut into triangles as they stand, the first at {first}"
    )]
    CrossedPolygons {
        /// How many.
        count: usize,
        /// Where the first stands.
        first: Place,
    },
    /// Statements or entities that hold geometry which is not read.
    #[error("{count} × {what} were left out")]
    LeftOut {
        /// What they are.
        what: String,
        /// How many.
        count: usize,
    },
    /// A face that its file trims is read whole.
    #[error("{face}: {why}; the whole surface is read")]
    Trimmed {
        /// The face's name.
        face: String,
        /// How it is trimmed.
        why: String,
    },
    /// Something the file does not say was assumed.
    #[error("{place}: {assumption}")]
    Assumed {
        /// Where it is missing.
        place: Place,
        /// What was assumed.
        assumption: String,
    },
}
