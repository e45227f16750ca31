//! What the names in a dialect's lines stand for.

use super::format::Format;
use super::words::Words;
use super::{Layout, MachineProgram};
use crate::machine::AxisMove;
use crate::post::number::{fixed, trimmed};
use crate::post::program::plain_line;
use glam::DVec3;

/// Names and what they stand for, if for anything.
pub(super) struct Names(Vec<(&'static str, Option<String>)>);

impl Names {
    /// Those of [`Format`], for a path that begins with `first`.
    pub(super) fn new(
        program: &MachineProgram,
        format: &Format,
        layout: &Layout,
        words: &Words,
        first: &AxisMove,
    ) -> Self {
        let kinematics = program.kinematics;
        let sign = |x: f64| if format.plus && x >= 0.0 { "+" } else { "" };
        let number = |x: f64, decimals: usize| format!("{}{}", sign(x), fixed(x, decimals));
        let lengths = |at: DVec3| {
            let [x, y, z] = at.to_array().map(|x| number(x, layout.linear));
            [format!("X{x}"), format!("Y{y}"), format!("Z{z}")]
        };
        let [x, y, _] = lengths(first.at.linear - kinematics.program_zero());
        let axes = kinematics.axes()[3..].iter().zip(first.at.rotary);
        let mut rotary: Vec<String> = axes
            .map(|(axis, angle)| format!("{}{}", axis.letter, number(angle.to_degrees(), layout.rotary)))
            .collect();
        rotary.sort();
        let mut all = String::new();
        words.push(&mut all, &words.numbers(first.to.tip, first), None);
        let top = kinematics.axes()[2].limits.map_or(0.0, |[_, high]| high);
        let part = plain_line(program.part);
        let file: String = part.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
        let [d, r, ..] = program.cutter.apt_parameters();
        let rpm = program.spindle_rpm.map(|rpm| trimmed(rpm, 3));
        Self(vec![
            ("{file}", Some(file)),
            ("{d}", Some(trimmed(d, 4))),
            ("{r}", Some(trimmed(r, 4))),
            ("{length}", Some(trimmed(kinematics.tool_length(), 4))),
            ("{tool}", Some(program.tool.to_string())),
            ("{speed}", Some(rpm.as_ref().map_or(String::new(), |rpm| format!(" S{rpm}")))),
            ("{rpm}", rpm),
            ("{coolant}", Some(if program.coolant { "M8".into() } else { String::new() })),
            ("{offset}", Some(lengths(kinematics.work_offset()).join(" "))),
            ("{top}", Some(number(top, layout.linear))),
            ("{rotary}", (!rotary.is_empty()).then(|| rotary.join(" "))),
            ("{xy}", Some(format!("{x} {y}"))),
            ("{first}", Some(all)),
            // Last: what others have named may hold anything.
            ("{machine}", Some(plain_line(program.machine))),
            ("{part}", Some(part)),
        ])
    }

    /// `template` with what its names stand for; nothing if one of them stands for nothing.
    pub(super) fn fill(&self, template: &str) -> Option<String> {
        let mut line = template.to_owned();
        for (name, value) in &self.0 {
            if line.contains(name) {
                line = line.replace(name, value.as_ref()?);
            }
        }
        Some(line)
    }
}
