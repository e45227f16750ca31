//! G-code out.

use crate::post::mark::{Marker, is_possible};
use crate::post::number::{fixed, trimmed};
use crate::post::{Program, WriteError};
use crate::toolpath::{Move, Rate};
use glam::DVec3;
use std::fmt::Write;

/// How far an axis may be from upright, radians: the end of a 100 mm lever stays within 0.01 µm.
const UPRIGHT: f64 = 1e-7;

/// `program` for a three-axis machine, in millimetres whatever its unit; the programmed point is the cutter's tip.
///
/// Words that do not change are left out. The first position is reached in two blocks, height first, with the length
/// of the tool switched on (`G43`). `G0` is written for rapid moves; many machines do not run it in a straight line.
///
/// Errors: no moves; a move that is not finite, or fed at 0 or less; an axis that leans.
pub fn write(program: &Program) -> Result<String, WriteError> {
    let moves = &program.toolpath.moves;
    for (index, step) in moves.iter().enumerate() {
        if !is_possible(step) {
            return Err(WriteError::NotFinite { index });
        }
        let lean = libm::atan2(libm::hypot(step.to.axis.x, step.to.axis.y), step.to.axis.z);
        if lean > UPRIGHT {
            return Err(WriteError::Tilted { index, degrees: lean.to_degrees() });
        }
    }
    let first = moves.first().ok_or(WriteError::Empty)?;

    let mut blocks = Blocks::default();
    blocks.line("%");
    blocks.line(&format!("({})", program.part_line()));
    let [d, r, ..] = program.cutter.apt_parameters();
    blocks.line(&format!("(CUTTER D{} R{})", trimmed(d, 4), trimmed(r, 4)));
    blocks.line("G21 G90 G17 G94 G40 G49 G80");
    blocks.line(&format!("T{} M6", program.tool));
    if let Some(rpm) = program.spindle_rpm {
        blocks.line(&format!("S{} M3", trimmed(rpm, 3)));
    }
    let mut marker = Marker::default();
    if let Some(remark) = marker.before(first.role) {
        blocks.line(&format!("({remark})"));
    }
    blocks.place(program.tool, first);
    for step in &moves[1..] {
        if let Some(remark) = marker.before(step.role) {
            blocks.line(&format!("({remark})"));
        }
        blocks.go(step);
    }
    for end in ["M5", "M30", "%"] {
        blocks.line(end);
    }
    Ok(blocks.text)
}

#[derive(Default)]
struct Blocks {
    text: String,
    motion: &'static str,
    at: [String; 3],
    feed: String,
}

fn words(tip: DVec3) -> [String; 3] {
    let [x, y, z] = tip.to_array().map(|x| fixed(x, 4));
    [format!("X{x}"), format!("Y{y}"), format!("Z{z}")]
}

impl Blocks {
    fn line(&mut self, line: &str) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.text, "{line}");
    }

    fn place(&mut self, tool: u32, first: &Move) {
        self.at[2] = words(first.to.tip)[2].clone();
        self.motion = "G0";
        self.line(&format!("G0 G43 H{tool} {}", self.at[2]));
        self.go(first);
    }

    /// A block with the words that change; one that changes none repeats X, so that the move is not lost.
    fn go(&mut self, step: &Move) {
        let mut block: Vec<String> = Vec::new();
        let motion = match step.rate {
            Rate::Rapid => "G0",
            Rate::Feed(_) => "G1",
        };
        if motion != self.motion {
            block.push(motion.to_owned());
            self.motion = motion;
        }
        let to = words(step.to.tip);
        let changed = to.iter().zip(&self.at).filter(|(new, old)| new != old).map(|(new, _)| new.clone());
        let before = block.len();
        block.extend(changed);
        if block.len() == before {
            block.push(to[0].clone());
        }
        self.at = to;
        if let Rate::Feed(feed) = step.rate {
            // Nothing above 0 may come out as F0.
            let feed = format!("F{}", trimmed(feed.max(1e-3), 3));
            if feed != self.feed {
                block.push(feed.clone());
                self.feed = feed;
            }
        }
        self.line(&block.join(" "));
    }
}
