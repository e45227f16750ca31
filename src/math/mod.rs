//! Numbers and space, without a word of machining.

pub mod angle;
pub mod bvh;
pub mod frame;
pub mod order;
pub mod parabola;
pub mod root;
