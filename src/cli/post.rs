//! `stepover post`.

use super::plan::load;
use super::progress::Terminal;
use super::{Failure, print, read_text, workers};
use crate::job::machines::{self, Cutting, Dialect, Kept, Layout, Machine, PostOptions, Posted};
use crate::job::{JobError, Verified};
use crate::monitor::Stage;
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
    /// The table that was written with the cutter locations (path.csv): where the cutter touches. The feed is then that of the contact,
    /// and cutting speeds are known.
    #[arg(long)]
    contacts: Option<PathBuf>,
    /// Settings, JSON, as `stepover schema --machine` lists them; what stands on the command line goes before them.
    #[arg(long)]
    settings: Option<PathBuf>,
    /// The job that the path was planned for: its shape is cut as planned and as posted, and the difference told.
    #[arg(long)]
    spec: Option<PathBuf>,
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
    /// How far the contact may be from its way across the surface at feed, mm, or without contacts the tip from its line; 0.00005 if not
    /// given, which leaves excess and gouge as they are to 0.1 µm.
    #[arg(long)]
    chord: Option<f64>,
    /// How far the tool's axis may be from its own at feed, degrees; 0.002 if not given.
    #[arg(long)]
    axis: Option<f64>,
    /// Decimals of lengths (mm) and angles (degrees), 3 to 6; 4 if not given.
    #[arg(long, value_parser = clap::value_parser!(u8).range(3..=6))]
    decimals: Option<u8>,
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
        let dialect = dialect(&self.dialect)?;
        let machine = machine(&self.machine)?;
        let options = self.options(dialect)?;
        let table = self.contacts.as_ref().map(|path| read_text(path)).transpose()?;
        let terminal = Terminal::new();
        let stage = Stage::whole(&terminal, workers());
        let posting = stage.part("Writing the program", 0.0, if self.spec.is_some() { 0.3 } else { 1.0 });
        let posted = machines::post(&read_text(&self.apt)?, table.as_deref(), &machine, &options, &posting)
            .map_err(|e| in_file(&self.apt, &e))?;
        let kept = match &self.spec {
            Some(path) => {
                let (spec, bytes) = load(path)?;
                Some(machines::prove(&posted, &spec, bytes.as_deref(), &stage.part("Proving", 0.3, 1.0))?)
            }
            None => None,
        };
        terminal.clear();
        let read_back = self.read_back.as_ref().map(|path| (path.as_path(), posted.read_back()));
        let mut files: Vec<(&Path, &str)> =
            read_back.iter().map(|(path, text)| (*path, text.as_str())).collect();
        files.extend(self.out.as_ref().map(|path| (path.as_path(), posted.text.as_str())));
        write_whole(&files)?;
        if self.out.is_none() {
            return print(posted.text.trim_end());
        }
        summary(&posted)?;
        kept.map_or(Ok(()), |kept| proof(&kept))
    }

    /// The settings of the file, and over them those of the command line.
    fn options(&self, dialect: Dialect) -> Result<PostOptions, Failure> {
        let options = match &self.settings {
            Some(path) => PostOptions::from_json(&read_text(path)?).map_err(|e| in_file(path, &e))?,
            None => PostOptions::new(dialect),
        };
        let layout = options.layout;
        let decimals = self.decimals.map(usize::from);
        Ok(PostOptions {
            dialect,
            tool_length_mm: self.tool_length.or(options.tool_length_mm),
            chord_mm: self.chord.unwrap_or(options.chord_mm),
            axis_deg: self.axis.unwrap_or(options.axis_deg),
            coolant: options.coolant && !self.dry,
            layout: Layout {
                linear: decimals.unwrap_or(layout.linear),
                rotary: decimals.unwrap_or(layout.rotary),
                numbered: layout.numbered || self.numbered,
                carriage_return: layout.carriage_return || self.carriage_return,
                most_blocks: self.most_blocks,
                ..layout
            },
            ..options
        })
    }
}

/// The dialect of this name.
pub(super) fn dialect(name: &str) -> Result<Dialect, Failure> {
    Dialect::named(name).ok_or_else(|| {
        let known = Dialect::ALL.map(Dialect::name).join(", ");
        Failure::Call(format!("--dialect {name}: must be one of {known}"))
    })
}

/// The machine that a file describes.
pub(super) fn machine(path: &Path) -> Result<Machine, Failure> {
    machines::machine(&read_text(path)?).map_err(|e| in_file(path, &e))
}

fn in_file(path: &Path, error: &JobError) -> Failure {
    Failure::Job(format!("{}: {error}", path.display()))
}

/// Writes files at once: all of them beside their places first, so that whatever goes wrong leaves what was there before.
fn write_whole(files: &[(&Path, &str)]) -> Result<(), Failure> {
    let beside = |path: &Path| {
        let mut name = path.as_os_str().to_owned();
        name.push(".part");
        PathBuf::from(name)
    };
    let failed = |path: &Path, e: std::io::Error| {
        for (path, _) in files {
            // It may not even have come to be.
            let _ = std::fs::remove_file(beside(path));
        }
        Failure::Job(format!("{}: {e}", path.display()))
    };
    for (path, text) in files {
        std::fs::write(beside(path), text).map_err(|e| failed(path, e))?;
    }
    for (path, _) in files {
        std::fs::rename(beside(path), path).map_err(|e| failed(path, e))?;
    }
    Ok(())
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
        let ([low, high], unit) = (posted.path.span(k).map(|x| axis.shown(x)), axis.unit());
        print(&format!("{}            {low:.3} to {high:.3}{unit} in machine coordinates", axis.letter))?;
    }
    if let Some(cutting) = &posted.cutting {
        cut(cutting)?;
    }
    for note in machines::notes(posted) {
        let moves = if note.first == note.last {
            format!("move {}", note.first)
        } else {
            format!("moves {} to {}", note.first, note.last)
        };
        print(&format!("note         {moves}: {}", note.text()))?;
    }
    Ok(())
}

fn cut(cutting: &Cutting) -> Result<(), Failure> {
    let [least, most] = cutting.at_contact;
    let speeds = format!("{:.0} to {:.0} m/min", cutting.speed(least), cutting.speed(most));
    print(&format!(
        "cutting      {:.0} 1/min: {speeds} at the contact (effective diameter {least:.3} to {most:.3} mm)",
        cutting.rpm
    ))?;
    print(&format!(
        "             {:.0} m/min at the least, on {:.3} mm, with a lead of {:.2}°",
        cutting.speed(cutting.least),
        cutting.least,
        cutting.least_lead.to_degrees()
    ))?;
    match cutting.feed.zip(cutting.feed_per_tooth) {
        Some((feed, tooth)) => print(&format!("feed         {feed:.0} mm/min, {tooth:.4} mm a tooth")),
        None => Ok(()),
    }
}

fn proof(kept: &Kept) -> Result<(), Failure> {
    let um = |x: Option<f64>| x.map_or("none".into(), |x| format!("{:.3} µm", 1e3 * x));
    let told =
        |of: &Verified| format!("excess {}, gouge {}", um(of.largest_excess_mm), um(of.largest_gouge_mm));
    print(&format!("planned      {}", told(&kept.planned)))?;
    print(&format!("posted       {}", told(&kept.posted)))?;
    print(&format!("change       at most {:.4} µm at {} samples", 1e3 * kept.largest_change, kept.samples))
}
