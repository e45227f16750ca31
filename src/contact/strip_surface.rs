//! Exact strip over the real surface.
