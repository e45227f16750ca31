//! A cutter against a surface at one point.
