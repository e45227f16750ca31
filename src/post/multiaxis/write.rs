//! Programs out.

use super::format::{Feed, Format, Motion, Rapid};
use super::{Dialect, Layout, MachineProgram, PostError};
use crate::machine::{AxisMove, Control};

use crate::post::digits::{power, push, scaled};
use crate::post::mark::Marker;
use crate::post::number::{fixed, trimmed};
use crate::post::program::plain_line;
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
    let names = Names::new(program, &blocks, first);
    blocks.lines(format.opening, &names);
    let mut marker = Marker::default();
    blocks.lines(format.approach, &names);
    blocks.at = blocks.numbers(first);
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

/// The numbers of a block in their last decimals: three of length and two angles, or three of length and three of direction.
type Numbers = [i64; 6];

struct Blocks<'a> {
    program: &'a MachineProgram<'a>,
    format: &'static Format,
    layout: &'a Layout,
    /// What stands before each number, in the order of writing, its place in [`Numbers`], and its decimals.
    words: Vec<(String, usize, usize)>,
    text: String,
    count: usize,
    motion: &'static str,
    at: Numbers,
    feed: i64,
}

impl<'a> Blocks<'a> {
    fn new(program: &'a MachineProgram<'a>, format: &'static Format, layout: &'a Layout) -> Self {
        let word = |k: usize, name: &str, decimals: usize| (name.to_owned(), k, decimals);
        let mut words: Vec<_> =
            ["X", "Y", "Z"].iter().enumerate().map(|(k, name)| word(k, name, layout.linear)).collect();
        if format.control == Control::Vector {
            words.extend(format.vector.iter().enumerate().map(|(k, name)| word(3 + k, name, layout.vector)));
        } else {
            let rotary = program.kinematics.axes()[3..].iter().enumerate();
            words.extend(rotary.map(|(k, axis)| word(3 + k, &axis.letter.to_string(), layout.rotary)));
            // A before B before C, wherever they stand in the machine.
            words[3..].sort();
        }
        Self {
            program,
            format,
            layout,
            words,
            text: String::with_capacity(program.path.moves.len() * 56 + 2000),
            count: 0,
            motion: "",
            at: [i64::MIN; 6],
            feed: i64::MIN,
        }
    }

    fn numbers(&self, step: &AxisMove) -> Numbers {
        let layout = self.layout;
        let lengths = match self.format.control {
            Control::Axes => step.at.linear - self.program.kinematics.program_zero(),
            Control::Tip | Control::Vector => step.to.tip,
        };
        let [x, y, z] = lengths.to_array().map(|x| scaled(x, layout.linear));
        match self.format.control {
            Control::Vector => {
                let [i, j, k] = step.to.axis.to_array().map(|x| scaled(x, layout.vector));
                [x, y, z, i, j, k]
            }
            Control::Axes | Control::Tip => {
                let [first, second] = step.at.rotary.map(|angle| scaled(angle.to_degrees(), layout.rotary));
                [x, y, z, first, second, 0]
            }
        }
    }

    /// One word: its name, its sign, and its number.
    fn word(&mut self, which: usize, number: i64) {
        let (name, _, decimals) = &self.words[which];
        if !self.text.ends_with(['\n', ' ']) {
            self.text.push(' ');
        }
        self.text.push_str(name);
        if self.format.plus && number >= 0 {
            self.text.push('+');
        }
        push(&mut self.text, number, *decimals);
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

    /// A block with the words that change; one that changes none repeats the first, so that the move is not lost.
    fn go(&mut self, from: &AxisMove, to: &AxisMove) {
        let numbers = self.numbers(to);
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
        let all = self.format.control == Control::Vector;
        let mut stated = false;
        for which in 0..self.words.len() {
            let place = self.words[which].1;
            if all || numbers[place] != self.at[place] {
                self.word(which, numbers[place]);
                stated = true;
            }
        }
        if !stated {
            self.word(0, numbers[0]);
        }
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
    if length * power(layout.linear) >= 1.0 { length } else { from.axis.angle_between(to.axis).to_degrees() }
}

/// What the names in templates stand for.
struct Names(Vec<(&'static str, Option<String>)>);

impl Names {
    fn new(program: &MachineProgram, blocks: &Blocks, first: &AxisMove) -> Self {
        let kinematics = program.kinematics;
        let layout = blocks.layout;
        let sign = |x: f64| if blocks.format.plus && x >= 0.0 { "+" } else { "" };
        let word = |name: char, x: f64, decimals: usize| format!("{name}{}{}", sign(x), fixed(x, decimals));
        let lengths = |at: glam::DVec3| {
            let [x, y, z] = at.to_array();
            [word('X', x, layout.linear), word('Y', y, layout.linear), word('Z', z, layout.linear)]
        };
        let [x, y, _] = lengths(first.at.linear - kinematics.program_zero());
        let mut rotary: Vec<String> = kinematics.axes()[3..]
            .iter()
            .zip(first.at.rotary)
            .map(|(axis, angle)| word(axis.letter, angle.to_degrees(), layout.rotary))
            .collect();
        rotary.sort();
        let mut start = Blocks::new(program, blocks.format, layout);
        let numbers = start.numbers(first);
        for which in 0..start.words.len() {
            let place = start.words[which].1;
            start.word(which, numbers[place]);
        }
        let top = kinematics.axes()[2].limits.map_or(0.0, |[_, high]| high);
        let part = plain_line(program.part);
        let file: String = part.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
        let [d, r, ..] = program.cutter.apt_parameters();
        let rpm = program.spindle_rpm.map(|rpm| trimmed(rpm, 3));
        Self(vec![
            ("{part}", Some(part)),
            ("{file}", Some(file)),
            ("{machine}", Some(plain_line(program.machine))),
            ("{d}", Some(trimmed(d, 4))),
            ("{r}", Some(trimmed(r, 4))),
            ("{length}", Some(trimmed(kinematics.tool_length(), 4))),
            ("{tool}", Some(program.tool.to_string())),
            ("{speed}", Some(rpm.as_ref().map_or(String::new(), |rpm| format!(" S{rpm}")))),
            ("{rpm}", rpm),
            ("{coolant}", Some(if program.coolant { "M8".into() } else { String::new() })),
            ("{offset}", Some(lengths(kinematics.work_offset()).join(" "))),
            ("{top}", Some(word('Z', top, layout.linear)[1..].to_owned())),
            ("{rotary}", (!rotary.is_empty()).then(|| rotary.join(" "))),
            ("{xy}", Some(format!("{x} {y}"))),
            ("{first}", Some(start.text.trim_start().to_owned())),
        ])
    }

    /// `template` with what its names stand for; nothing if one of them stands for nothing.
    fn fill(&self, template: &str) -> Option<String> {
        let mut line = template.to_owned();
        for (name, value) in &self.0 {
            if line.contains(name) {
                line = line.replace(name, value.as_ref()?);
            }
        }
        Some(line)
    }
}
