//! What the part looks like: heights over the plane, with derivatives, in all forms that lenses and mirrors are stated in.
//!
//! Every sag goes on smoothly beyond where its formula ends or its data stop, so that a tool may run out over the rim; what
//! is there is no part of the part, and [`Sag::reaches`] says where that begins.

mod biconic;
mod conic;
mod grid;
mod polynomial;
mod root;
mod toric;
mod zernike;

pub use biconic::Biconic;
pub use conic::Conic;
pub use grid::{GridError, GridMap, Stated};
pub use polynomial::{Freeform, Term};
pub use toric::{Toric, ToricKind};
pub use zernike::{ZernikeTerm, zernike};

use super::height_jet::HeightJet;

/// A height over the plane. Lengths in millimetres; z points out of the material.
pub trait Sag: Send + Sync {
    /// Height and derivatives at `(x, y)`: finite everywhere, and continuous with the first derivatives.
    fn at(&self, x: f64, y: f64) -> HeightJet;

    /// Whether the surface is there at all, and less steep than 80°; beyond, [`Sag::at`] tells how it is carried on.
    fn reaches(&self, x: f64, y: f64) -> bool;

    /// How far it reaches, in words for a person.
    fn reach(&self) -> String;
}
