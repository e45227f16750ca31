//! Programs out.

use super::format::{Feed, Format, Motion, Rapid};
use super::names::Names;
use super::words::{Numbers, Words};
use super::{Dialect, Layout, MachineProgram, PostError};
use crate::machine::{AxisMove, Control};
use crate::math::angle::angle_between;
use crate::post::digits::{power, push, scaled};
use crate::post::mark::Marker;
use crate::toolpath::{ClPoint, Rate};

/// Decimals of feeds; no feed is stated as less than one of the last.
const FEED_DECIMALS: usize = 4;
/// Numbers of blocks begin anew beyond this.
const LAST_NUMBER: usize = 99_999;

/// `program` in `dialect`. The path must have been made for [`Dialect::control`], with the step of rotary angles of
/// [`Layout::rotary_step`].
///
/// The tool comes from the upper end of Z: first the rotary axes turn, then X and Y move, then the tool goes down to where the path
/// begins. Words that do not change are left out. Feeds are those of the path's times, so that no axis is asked to go faster than it
/// can.
///
/// Errors: no moves; a number that is not finite; a dialect that cannot state the machine's motion; more blocks than the control takes.
pub fn write(program: &MachineProgram, dialect: Dialect, layout: &Layout) -> Result<String, PostError> {
    let format = dialect.format();
    let moves = &program.path.moves;
    let first = moves.first().ok_or(PostError::Empty)?;
    let turns = program.kinematics.axes().len() > 3;
    let refuse = |message| Err(PostError::Dialect { dialect: format.name, message });
    if dialect == Dialect::Grbl && turns {
        return refuse("has three axes: take a machine without rotary axes");
    }
    if format.control != Control::Axes && !turns {
        return refuse(
            "controls rotary axes, and this machine has none: take linuxcnc, fanuc, siemens or grbl",
        );
    }
    let finite = |step: &AxisMove| {
        step.at.all().iter().all(|x| x.is_finite()) && step.seconds.is_finite() && step.to.axis.is_finite()
    };
    if let Some(step) = moves.iter().find(|step| !finite(step)) {
        return Err(PostError::NotFinite { index: step.source });
    }

    let mut blocks = Blocks::new(program, format, layout);
    let names = Names::new(program, format, layout, &blocks.words, first);
    blocks.lines(format.opening, &names);
    let mut marker = Marker::default();
    blocks.lines(format.approach, &names);
    blocks.at = blocks.words.numbers(first.to.tip, first);
    blocks.motion = "G0";
    blocks.remark(marker.before(first.role));
    for pair in moves.windows(2) {
        blocks.remark(marker.before(pair[1].role));
        blocks.go(&pair[0], &pair[1]);
    }
    blocks.lines(format.closing, &names);
    match layout.most_blocks {
        Some(most) if blocks.count > most => Err(PostError::TooLong { blocks: blocks.count, most }),
        _ => Ok(blocks.text),
    }
}

struct Blocks<'a> {
    format: &'static Format,
    layout: &'a Layout,
    words: Words<'a>,
    text: String,
    count: usize,
    motion: &'static str,
    at: Numbers,
    feed: i64,
}

impl<'a> Blocks<'a> {
    fn new(program: &MachineProgram<'a>, format: &'static Format, layout: &'a Layout) -> Self {
        Self {
            format,
            layout,
            words: Words::new(program, format, layout),
            text: String::with_capacity(program.path.moves.len() * 56 + 2000),
            count: 0,
            motion: "",
            at: [i64::MIN; 6],
            feed: i64::MIN,
        }
    }

    fn begin(&mut self) {
        if self.format.counted {
            push(&mut self.text, self.count as i64, 0);
            self.text.push(' ');
        } else if self.layout.numbered {
            self.text.push('N');
            push(&mut self.text, (self.count % LAST_NUMBER) as i64 + 1, 0);
            self.text.push(' ');
        }
        self.count += 1;
    }

    fn end(&mut self) {
        self.text.push_str(if self.layout.carriage_return { "\r\n" } else { "\n" });
    }

    fn remark(&mut self, remark: Option<String>) {
        if let Some(remark) = remark {
            let [before, after] = self.format.remark;
            self.line(&format!("{before}{remark}{after}"));
        }
    }

    fn line(&mut self, line: &str) {
        // The program's name and the sign of its beginning and end have no number.
        if self.format.counted || !self.format.passed.iter().any(|passed| line.starts_with(passed)) {
            self.begin();
        }
        self.text.push_str(line);
        self.end();
    }

    fn lines(&mut self, templates: &[&str], names: &Names) {
        for template in templates {
            if let Some(line) = names.fill(template).filter(|line| !line.is_empty()) {
                self.line(&line);
            }
        }
    }

    /// A block to the end of a move.
    fn go(&mut self, from: &AxisMove, to: &AxisMove) {
        let numbers = self.words.numbers(from.to.tip, to);
        if self.format.control == Control::Vector && numbers == self.at && !to.is_end {
            // The rotary axes turn over without a motion of the tool on the workpiece; the control does so by itself.
            return;
        }
        let (motion, is_fed) = match (to.rate, self.format.rapid) {
            (Rate::Rapid, Rapid::Straight(motion)) => (motion, false),
            (Rate::Rapid, Rapid::AtFeed) | (Rate::Feed(_), _) => (self.format.straight, true),
        };
        self.begin();
        self.code(motion);
        self.words.push(&mut self.text, &numbers, Some(&self.at));
        self.at = numbers;
        if is_fed {
            self.feed(from, to);
        }
        self.text.push_str(motion.end);
        self.end();
    }

    fn code(&mut self, motion: Motion) {
        if !(motion.modal && motion.code == self.motion) {
            self.text.push_str(motion.code);
            self.motion = motion.code;
        }
    }

    fn feed(&mut self, from: &AxisMove, to: &AxisMove) {
        let seconds = to.seconds.max(SHORTEST);
        let feed = match self.format.feed {
            Feed::InverseTime => 60.0 / seconds,
            Feed::PerMinute => 60.0 * way(&from.to, &to.to, self.layout) / seconds,
        };
        if feed == 0.0 {
            // Nothing moves, and the feed before it holds on.
            return;
        }
        let feed = scaled(feed, FEED_DECIMALS).max(1);
        if self.format.feed == Feed::InverseTime || feed != self.feed {
            self.text.push_str(" F");
            push(&mut self.text, feed, FEED_DECIMALS);
            self.feed = feed;
        }
    }
}

/// The shortest time of a block, s: far below any control's cycle.
const SHORTEST: f64 = 1e-5;

/// What a feed a minute counts: mm of the tip, or degrees of the tool where the tip stays.
fn way(from: &ClPoint, to: &ClPoint, layout: &Layout) -> f64 {
    let length = from.tip.distance(to.tip);
    if length * power(layout.linear) >= 1.0 { length } else { angle_between(from.axis, to.axis).to_degrees() }
}
