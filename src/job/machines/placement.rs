//! How a part is clamped.

use super::contacts::Contact;
use crate::toolpath::{ClPoint, Toolpath};
use glam::{DMat3, DVec3};
use std::borrow::Cow;

/// Where the part's own frame lies in the workpiece frame of the machine: turned about x, then y, then z, and shifted.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Placement {
    /// Turns about x, y and z, degrees.
    pub turn_deg: [f64; 3],
    /// The part's origin in the workpiece frame, mm.
    pub shift_mm: [f64; 3],
}

impl Placement {
    /// Whether it leaves the part as it is.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    fn turn(&self) -> DMat3 {
        // Not glam's own turns: right angles shall be exact.
        let about = |axis: usize| {
            let (s, c) = match self.turn_deg[axis].rem_euclid(360.0) {
                0.0 => (0.0, 1.0),
                90.0 => (1.0, 0.0),
                180.0 => (0.0, -1.0),
                270.0 => (-1.0, 0.0),
                degrees => libm::sincos(degrees.to_radians()),
            };
            let (mut first, mut second, mut third) = (DVec3::X, DVec3::Y, DVec3::Z);
            match axis {
                0 => (second, third) = (DVec3::new(0.0, c, s), DVec3::new(0.0, -s, c)),
                1 => (first, third) = (DVec3::new(c, 0.0, -s), DVec3::new(s, 0.0, c)),
                _ => (first, second) = (DVec3::new(c, s, 0.0), DVec3::new(-s, c, 0.0)),
            }
            DMat3::from_cols(first, second, third)
        };
        about(2) * about(1) * about(0)
    }

    /// Contacts on the part in the workpiece frame.
    pub(super) fn contacts<'c>(&self, contacts: &'c [Option<Contact>]) -> Cow<'c, [Option<Contact>]> {
        if self.is_none() {
            return contacts.into();
        }
        let (turn, shift) = (self.turn(), DVec3::from(self.shift_mm));
        let placed = |contact: &Contact| Contact { point: turn * contact.point + shift, ..*contact };
        contacts.iter().map(|contact| contact.as_ref().map(placed)).collect()
    }

    /// A path over the part in the workpiece frame.
    pub fn path(&self, path: &Toolpath) -> Toolpath {
        let (turn, shift) = (self.turn(), DVec3::from(self.shift_mm));
        moved(path, |to| ClPoint { tip: turn * to.tip + shift, axis: turn * to.axis })
    }

    /// A path in the workpiece frame over the part.
    pub fn path_back(&self, path: &Toolpath) -> Toolpath {
        let (back, shift) = (self.turn().transpose(), DVec3::from(self.shift_mm));
        moved(path, |to| ClPoint { tip: back * (to.tip - shift), axis: back * to.axis })
    }
}

fn moved(path: &Toolpath, to: impl Fn(&ClPoint) -> ClPoint) -> Toolpath {
    let moves = path.moves.iter().map(|step| crate::toolpath::Move { to: to(&step.to), ..*step });
    Toolpath { moves: moves.collect() }
}
