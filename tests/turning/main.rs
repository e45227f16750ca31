//! Optics on X, Z and C: the lens of paper 004 and everything else that is turned.

mod bad;
mod cut;
mod jobs;
mod lens;
mod machine;
mod nose;
mod sags;
mod support;
mod text;
