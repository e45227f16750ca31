//! `stepover post`.

use super::{Failure, print, read_text};
use crate::job::machines::{self, Dialect, Layout, PostOptions, Posted};
use clap::Args;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(super) struct Post {
    /// The cutter locations, APT text.
    apt: PathBuf,
    /// The machine, JSON.
    #[arg(long)]
    machine: PathBuf,
    /// The control's language: linuxcnc, fanuc, fanuc_tip (G43.4), haas (G234), siemens, siemens_vector (TRAORI), heidenhain (M128, LN)
    /// or grbl.
    #[arg(long)]
    dialect: String,
    /// The program; printed if not given.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Also write the path that the program reads back as, APT text, for `stepover verify`.
    #[arg(long)]
    read_back: Option<PathBuf>,
    /// Length of the tool from the spindle's nose to the tip, mm; if not given, half of the longest that the machine takes, or the
    /// cutter's height if that is more.
    #[arg(long)]
    tool_length: Option<f64>,
    /// How far the tip may be from its line at feed, mm.
    #[arg(long, default_value_t = 0.001)]
    chord: f64,
    /// How far the tool's axis may be from its own at feed, degrees.
    #[arg(long, default_value_t = 0.005)]
    axis: f64,
    /// Decimals of lengths (mm) and angles (degrees), 3 to 6.
    #[arg(long, default_value_t = 4, value_parser = clap::value_parser!(u8).range(3..=6))]
    decimals: u8,
    /// Number the blocks.
    #[arg(long)]
    numbered: bool,
    /// End lines with a carriage return and a line feed.
    #[arg(long)]
    carriage_return: bool,
    /// Leave the coolant off.
    #[arg(long)]
    dry: bool,
    /// The most blocks that the control takes.
    #[arg(long)]
    most_blocks: Option<usize>,
}

impl Post {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let dialect = Dialect::named(&self.dialect).ok_or_else(|| {
            let known = Dialect::ALL.map(Dialect::name).join(", ");
            Failure::Call(format!("--dialect {}: must be one of {known}", self.dialect))
        })?;
        let in_file =
            |path: &Path, e: &dyn std::fmt::Display| Failure::Job(format!("{}: {e}", path.display()));
        let machine =
            machines::machine(&read_text(&self.machine)?).map_err(|e| in_file(&self.machine, &e))?;
        let decimals = usize::from(self.decimals);
        let options = PostOptions {
            tool_length_mm: self.tool_length,
            chord_mm: self.chord,
            axis_deg: self.axis,
            coolant: !self.dry,
            layout: Layout {
                linear: decimals,
                rotary: decimals,
                numbered: self.numbered,
                carriage_return: self.carriage_return,
                most_blocks: self.most_blocks,
                ..Layout::default()
            },
            ..PostOptions::new(dialect)
        };
        let posted =
            machines::post(&read_text(&self.apt)?, &machine, &options).map_err(|e| in_file(&self.apt, &e))?;
        if let Some(read_back) = &self.read_back {
            write_whole(read_back, &posted.read_back())?;
        }
        let Some(out) = &self.out else { return print(posted.text.trim_end()) };
        write_whole(out, &posted.text)?;
        summary(&posted)
    }
}

/// Writes a file at once: beside it first, so that whatever goes wrong leaves what was there before.
fn write_whole(path: &Path, text: &str) -> Result<(), Failure> {
    let mut beside = path.as_os_str().to_owned();
    beside.push(".part");
    let written = std::fs::write(&beside, text).and_then(|()| std::fs::rename(&beside, path));
    written.map_err(|e| {
        // It may not even have come to be.
        let _ = std::fs::remove_file(&beside);
        Failure::Job(format!("{}: {e}", path.display()))
    })
}

fn summary(posted: &Posted) -> Result<(), Failure> {
    let minutes = |seconds: f64| seconds / 60.0;
    let (times, deviation) = (&posted.times, &posted.deviation);
    print(&format!("blocks       {}", posted.text.lines().count()))?;
    print(&format!("tool         {:.3} mm long", posted.kinematics.tool_length()))?;
    print(&format!(
        "time         {:.2} min: {:.2} cut, {:.2} links, {:.2} rapid",
        minutes(times.total()),
        minutes(times.cut),
        minutes(times.link),
        minutes(times.rapid)
    ))?;
    print(&format!(
        "read back    tip within {:.3} µm, axis within {:.5}° of the cutter locations",
        1e3 * deviation.tip_mm,
        deviation.axis_deg
    ))?;
    if posted.path.turn_overs > 0 {
        print(&format!("turned over  {} times, on links", posted.path.turn_overs))?;
    }
    for (k, axis) in posted.kinematics.axes().iter().enumerate() {
        let at = || posted.path.moves.iter().map(|step| step.at.all()[k]);
        let shown = |x: f64| if axis.is_rotary() { x.to_degrees() } else { x };
        let low = shown(at().fold(f64::INFINITY, f64::min));
        let high = shown(at().fold(f64::NEG_INFINITY, f64::max));
        let unit = if axis.is_rotary() { "°" } else { " mm" };
        print(&format!("{}            {low:.3} to {high:.3}{unit} in machine coordinates", axis.letter))?;
    }
    Ok(())
}
