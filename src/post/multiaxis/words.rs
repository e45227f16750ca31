//! The words that state where a block ends.

use super::format::Format;
use super::{Layout, MachineProgram};
use crate::machine::{AxisMove, Control, Kinematics};
use crate::post::digits::{power, push, scaled};
use glam::DVec3;

/// The numbers of a block in their last decimals: three of length, and two angles or three components of a direction.
pub(super) type Numbers = [i64; 6];

/// How much going off sideways counts beside going off across the surface: as much as strips rise where they meet.
const SIDEWAYS: f64 = 0.3;
/// How much going off onwards counts, squared: enough to tell equals apart.
const ONWARDS: f64 = 1e-3;

/// The words of a dialect on a machine, in the order of writing.
#[derive(Debug)]
pub(super) struct Words<'a> {
    format: &'static Format,
    layout: &'a Layout,
    kinematics: &'a Kinematics,
    forms: Vec<Form>,
}

/// A word without its number.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Form {
    /// What stands before the number.
    name: String,
    /// The place of the number in [`Numbers`].
    place: usize,
    decimals: usize,
}

impl<'a> Words<'a> {
    pub(super) fn new(program: &MachineProgram<'a>, format: &'static Format, layout: &'a Layout) -> Self {
        let kinematics = program.kinematics;
        let form = |place: usize, name: &str, decimals| Form { name: name.to_owned(), place, decimals };
        let lengths = ["X", "Y", "Z"].iter().enumerate();
        let mut forms: Vec<Form> = lengths.map(|(k, name)| form(k, name, layout.linear)).collect();
        if format.control == Control::Vector {
            forms.extend(format.vector.iter().enumerate().map(|(k, name)| form(3 + k, name, layout.vector)));
        } else {
            let rotary = kinematics.axes()[3..].iter().enumerate();
            forms.extend(rotary.map(|(k, axis)| form(3 + k, &axis.letter.to_string(), layout.rotary)));
            // A before B before C, wherever they stand in the machine.
            forms[3..].sort();
        }
        Self { format, layout, kinematics, forms }
    }

    /// The numbers that state the end of a move of the tip from a place.
    pub(super) fn numbers(&self, from: DVec3, step: &AxisMove) -> Numbers {
        let lengths = match self.format.control {
            Control::Axes => step.at.linear - self.kinematics.program_zero(),
            Control::Tip | Control::Vector => step.to.tip,
        };
        let [x, y, z] = match step.normal {
            Some(normal) => self.rounded_along(lengths, step, normal, step.to.tip - from),
            None => lengths.to_array().map(|x| scaled(x, self.layout.linear)),
        };
        if self.format.control == Control::Vector {
            let [i, j, k] = step.to.axis.to_array().map(|x| scaled(x, self.layout.vector));
            return [x, y, z, i, j, k];
        }
        let [first, second] = step.at.rotary.map(|angle| scaled(angle.to_degrees(), self.layout.rotary));
        [x, y, z, first, second, 0]
    }

    /// Lengths rounded up or down so that the tool goes off along its way rather than across the surface, or sideways.
    fn rounded_along(&self, lengths: DVec3, step: &AxisMove, normal: DVec3, way: DVec3) -> [i64; 3] {
        // What matters of where the tool goes, and the same for the words.
        let matters = [normal, SIDEWAYS * normal.cross(way.normalize_or_zero())];
        let matters = match self.format.control {
            Control::Axes => {
                let back = self.kinematics.ways_of_linear(step.at.rotary).transpose();
                matters.map(|direction| back * direction)
            }
            Control::Tip | Control::Vector => matters,
        };
        let scaled = lengths * power(self.layout.linear);
        let below = scaled.floor();
        let mut best = (f64::INFINITY, below);
        for corner in 0..8u8 {
            let at = below + DVec3::from_array([1, 2, 4].map(|bit| f64::from(u8::from(corner & bit != 0))));
            let off = at - scaled;
            let [across, side] = matters.map(|direction| off.dot(direction));
            let cost = across * across + side * side + ONWARDS * off.length_squared();
            if cost < best.0 {
                best = (cost, at);
            }
        }
        best.1.to_array().map(|x| x as i64)
    }

    /// Appends the words whose numbers are not those of `before`; all of them if directions are stated, or where there is nothing
    /// before; and the first if none changes, so that the block is not lost.
    pub(super) fn push(&self, text: &mut String, numbers: &Numbers, before: Option<&Numbers>) {
        let all = self.format.control == Control::Vector;
        let mut stated = false;
        for form in &self.forms {
            let number = numbers[form.place];
            if all || before.is_none_or(|before| before[form.place] != number) {
                self.word(text, form, number);
                stated = true;
            }
        }
        if let (false, Some(form)) = (stated, self.forms.first()) {
            self.word(text, form, numbers[form.place]);
        }
    }

    fn word(&self, text: &mut String, form: &Form, number: i64) {
        if !(text.is_empty() || text.ends_with(['\n', ' '])) {
            text.push(' ');
        }
        text.push_str(&form.name);
        if self.format.plus && number >= 0 {
            text.push('+');
        }
        push(text, number, form.decimals);
    }
}
