//! APT out.

use crate::cutter::Cutter;
use crate::post::mark::Marker;
use crate::post::number::{fixed, parse, trimmed};
use crate::post::{Program, Unit};
use crate::toolpath::{ClPoint, Rate};
use glam::DVec3;
use std::fmt::Write;

/// `program` as cutter-location text, in its unit. `RAPID` holds for one `GOTO`, `FEDRAT` until the next one.
///
/// A move that is not finite comes out as `NaN` or `inf`, which no reader takes.
pub fn write(program: &Program) -> String {
    let mut lines = Lines(String::new());
    let unit = program.unit;
    let (name, per_minute) = match unit {
        Unit::Mm => ("MM", "MMPM"),
        Unit::Inch => ("INCH", "IPM"),
    };
    lines.add(&format!("PARTNO/{}", program.part_line()));
    lines.add(&format!("UNITS/{name}"));
    lines.add(&format!("CUTTER/{}", cutter_values(&program.cutter, unit).join(",")));
    lines.add(&format!("LOADTL/{}", program.tool));
    lines.add("MULTAX/ON");
    if let Some(rpm) = program.spindle_rpm {
        lines.add(&format!("SPINDL/{},CLW", trimmed(rpm, 3)));
    }
    let mut marker = Marker::default();
    let mut stated_feed = String::new();
    for step in &program.toolpath.moves {
        if let Some(remark) = marker.before(step.role) {
            lines.add(&format!("PPRINT/{remark}"));
        }
        match step.rate {
            Rate::Rapid => lines.add("RAPID"),
            Rate::Feed(feed) => {
                let feed = feed_value(feed, unit);
                if feed != stated_feed {
                    lines.add(&format!("FEDRAT/{feed},{per_minute}"));
                    stated_feed = feed;
                }
            }
        }
        lines.add(&goto(&step.to, unit));
    }
    lines.add("FINI");
    lines.0
}

struct Lines(String);

impl Lines {
    fn add(&mut self, line: &str) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.0, "{line}");
    }
}

fn feed_value(feed: f64, unit: Unit) -> String {
    let decimals = match unit {
        Unit::Mm => 4,
        Unit::Inch => 5,
    };
    trimmed(feed / unit.millimetres(), decimals)
}

fn goto(at: &ClPoint, unit: Unit) -> String {
    let decimals = match unit {
        Unit::Mm => 5,
        Unit::Inch => 6,
    };
    let [x, y, z] = (at.tip / unit.millimetres()).to_array().map(|x| fixed(x, decimals));
    let [i, j, k] = settled(at.axis).to_array().map(|x| fixed(x, AXIS_DECIMALS));
    format!("GOTO/{x},{y},{z},{i},{j},{k}")
}

const AXIS_DECIMALS: usize = 7;

/// The axis that the text shall state: rounding it, normalising that and rounding again changes nothing, so that a
/// reader may normalise and still write the same text.
///
/// Projecting to and fro between the grid and the sphere never takes the two further apart and so settles on a
/// finite grid; within 6 rounds in any case met.
fn settled(axis: DVec3) -> DVec3 {
    let step = 1e7;
    let mut grid = (axis * step).round();
    for _ in 0..20 {
        let next = (grid.normalize_or(axis) * step).round();
        if next == grid {
            break;
        }
        grid = next;
    }
    grid / step
}

/// Decimals of cutter values: far beyond any drawing, so that `r = d/2` of a ball survives the change to inches and back.
const CUTTER_DECIMALS: usize = 12;

/// `d, r, e, f, α, β, h` in the text's unit and degrees. `e` and `f` are those that follow from the other values as
/// written, not as they were before rounding: a reader computes the same.
fn cutter_values(cutter: &Cutter, unit: Unit) -> [String; 7] {
    let length = |x: f64| trimmed(x / unit.millimetres(), CUTTER_DECIMALS);
    let angle = |x: f64| trimmed(x.to_degrees(), CUTTER_DECIMALS);
    let read_length = |text: &str| parse(text).map(|x| x * unit.millimetres());
    let read_angle = |text: &str| parse(text).map(f64::to_radians);
    let (d, r, h) = (length(cutter.diameter), length(cutter.corner_radius), length(cutter.height));
    let (alpha, beta) = (angle(cutter.bottom_angle), angle(cutter.taper));
    let as_written = || {
        let [d, r, h] = [&d, &r, &h].map(|x| read_length(x));
        let [alpha, beta] = [&alpha, &beta].map(|x| read_angle(x));
        Cutter::new(d?, r?, alpha?, beta?, h?).ok()
    };
    let stated = as_written().unwrap_or(*cutter);
    [d, r, length(stated.center_radius), length(stated.center_height), alpha, beta, h]
}
