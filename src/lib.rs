//! Stepover plans finishing paths for mills with a rounded corner, proves them by cutting them in
//! simulation, and writes them as programs for real machines.
//!
//! # Conventions
//!
//! - Millimetres and radians inside; degrees, and other units, only where a person or a file reads them.
//! - `n` is the unit surface normal pointing **out of the material**, towards the cutter.
//! - Curvature is **positive where the surface is concave**, that is, where it bends towards the cutter.
//! - Contact frame at a cutter-contact point (CC): `f` the unit feed tangent, `b = n × f`, `n`.
//!   The left of a pass is the `+b` side.
//! - Posture: lead `λ` and yaw `ω` tilt the axis to `a = cos λ · n + sin λ · (cos ω · f + sin ω · b)`.
//! - Cutter location (CL): the tip of the cutter on its axis, and the unit axis `a` pointing from the tip
//!   to the spindle. A bull-nose mill is the disc of radius `R1` (the centre circle of its corner torus)
//!   grown by the corner radius `r`; with `u = unit((n·a) a − n)` its centre is `p + r n − R1 u`.
//! - Excess is material left above the surface along `n`; a negative excess is a gouge.
//!
//! # Layers
//!
//! A layer may use what stands to its left; nothing points back, and siblings do not import each other
//! (`tests/tidy.rs` holds it so).
//!
//! ```text
//! math ─► geometry ─► import ─────────────────────────────┐
//!   ├───► cutter ──┬► contact ─► posture ─► strategy ─────┤
//!   └───► toolpath ┼► turning ────────────────────────────┼► job ─► wasm, cli
//!                  ├► verify ─────────────────────────────┤
//!                  ├► machine ─┐                          │
//!                  └───────────┴► post (text out, in) ────┘
//! geometry also ─► contact, verify; toolpath also ─► contact, posture, strategy; monitor ─► all
//! ```
//!
//! Read in this order: [`toolpath`] for the vocabulary, [`geometry`] for what a surface is, [`contact`] for
//! the strip that one contact point finishes, [`posture`] for how the cutter leans there, [`strategy`] for how
//! strips become passes, [`verify`] for the proof, [`job`] for how a specification becomes a result. [`turning`] stands
//! beside [`strategy`]: optics on a lathe whose spindle is a servo axis, from a sag to axis motions; and `machine` before
//! [`post`]: mills with rotary axes, from cutter locations to axis motions.

#[cfg(not(target_arch = "wasm32"))]
pub mod cli;
pub mod contact;
pub mod cutter;
pub mod geometry;
pub mod import;
pub mod job;
#[cfg(feature = "kinematics")]
pub mod machine;
pub mod math;
pub mod monitor;
pub mod post;
pub mod posture;
pub mod strategy;
pub mod toolpath;
pub mod turning;
pub mod verify;
#[cfg(target_arch = "wasm32")]
pub mod wasm;
