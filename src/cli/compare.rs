//! `stepover compare`.

use super::plan::load;
use super::progress::Terminal;
use super::{Failure, post, print, workers};
use crate::job::machines::{self, Machine, PostOptions};
use crate::job::{self, Contender, Floor, Report};
use crate::monitor::Stage;
use clap::Args;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Instant;

#[derive(Debug, Args)]
pub(super) struct Compare {
    /// The specification, JSON; its strategy says how the axis leans and in which order passes run.
    spec: PathBuf,
    /// The folder for the results; made if it is not there.
    #[arg(long)]
    out: PathBuf,
    /// A machine, JSON: the time of each program on it is told too, with the acceleration and jerk of its axes.
    #[arg(long)]
    machine: Option<PathBuf>,
    /// The language of its control, which decides how it moves between points.
    #[arg(long, default_value = "fanuc_tip", requires = "machine")]
    dialect: String,
    /// Threads; the result does not depend on it.
    #[arg(long)]
    workers: Option<NonZeroUsize>,
}

/// Head of the table.
const HEAD: &str = "strategy,passes,cut_mm,link_mm,rapid_mm,time_min,share_of_floor,average_strip_mm,largest_excess_um,\
                    limit_um,sampling_error_um,largest_gouge_um,holds,plan_s,machine_min";

impl Compare {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let (spec, bytes) = load(&self.spec)?;
        let terminal = Terminal::new();
        let stage = Stage::whole(&terminal, self.workers.unwrap_or_else(workers));
        let floor =
            job::least_length(&spec, bytes.as_deref(), &stage.part("Measuring the floor", 0.0, 0.05))?;
        let contenders = job::contenders(&spec, bytes.as_deref())?;
        let shop = self.machine.as_ref().map(|path| Shop::new(path, &self.dialect)).transpose()?;
        let mut least = Least::default();
        let write = |name: &str, text: &str| {
            let path = self.out.join(name);
            std::fs::write(&path, text).map_err(|e| Failure::Job(format!("{}: {e}", path.display())))
        };
        std::fs::create_dir_all(&self.out)
            .map_err(|e| Failure::Job(format!("{}: {e}", self.out.display())))?;
        let mut table = format!("{HEAD}\n");
        terminal.clear();
        if let Some(floor) = &floor {
            print(&format!(
                "floor  {:.1} mm for {:.1} mm², one contact at a time",
                floor.length, floor.area
            ))?;
        }
        print(
            "strategy                 passes    cut mm   link mm  time min  of floor  excess µm  gouge µm",
        )?;
        let count = contenders.len() as f64;
        for (k, Contender { name, spec }) in contenders.iter().enumerate() {
            let at = |t: f64| 0.05 + 0.95 * (k as f64 + t) / count;
            let began = Instant::now();
            let plan = match job::plan(spec, bytes.as_deref(), &stage.part("Planning", at(0.0), at(0.7))) {
                Ok(plan) => plan,
                Err(why) => {
                    terminal.clear();
                    print(&format!("{name:24} {why}"))?;
                    continue;
                }
            };
            let seconds = began.elapsed().as_secs_f64();
            let proof = plan.prove(&stage.part("Proving", at(0.7), at(1.0)))?;
            let report = plan.report(proof.as_ref());
            terminal.clear();
            let minutes = shop.as_ref().map(|shop| shop.minutes(&plan));
            let told = minutes.as_ref().map_or(String::new(), |minutes| match minutes {
                Ok(minutes) => format!("  {minutes:10.2}"),
                Err(why) => format!("  {why}"),
            });
            let minutes = minutes.and_then(Result::ok);
            print(&format!("{}{told}", line(name, &report, floor.as_ref())))?;
            table.push_str(&row(name, &report, floor.as_ref(), [Some(seconds), minutes]));
            if report.verified.as_ref().is_none_or(|v| job::holds(v, report.scallop_mm)) {
                least.take(name, [Some(report.length.cut_mm), Some(report.time_min), minutes]);
            }
            write(&format!("{name}.apt"), &plan.apt)?;
            write(&format!("{name}.svg"), &plan.drawing())?;
        }
        least.tell()?;
        write("compare.csv", &table)
    }
}

/// A machine that the programs might run on.
struct Shop {
    machine: Machine,
    options: PostOptions,
}

impl Shop {
    fn new(path: &Path, dialect: &str) -> Result<Self, Failure> {
        let options = PostOptions::new(post::dialect(dialect)?);
        Ok(Self { machine: post::machine(path)?, options })
    }

    /// How long the machine takes for a plan, min.
    fn minutes(&self, plan: &job::Plan) -> Result<f64, String> {
        // The program as its text reads.
        let program = plan.emitted.clone();
        let posted = machines::contacts(&plan.csv, &program.toolpath).and_then(|contacts| {
            machines::post_program(program, &contacts, &self.machine, &self.options, &Stage::silent())
        });
        posted.map(|posted| posted.times.total() / 60.0).map_err(|e| e.to_string())
    }
}

/// The least of what holds: length, time at the feeds, time on the machine.
#[derive(Default)]
struct Least([Option<(f64, String)>; 3]);

impl Least {
    fn take(&mut self, name: &str, values: [Option<f64>; 3]) {
        for (least, value) in self.0.iter_mut().zip(values) {
            let Some(value) = value else { continue };
            if least.as_ref().is_none_or(|(before, _)| value < *before) {
                *least = Some((value, name.to_owned()));
            }
        }
    }

    fn tell(&self) -> Result<(), Failure> {
        let words = ["shortest cuts", "quickest at its feeds", "quickest on the machine"];
        for (word, least) in words.iter().zip(&self.0) {
            let Some((value, name)) = least else { continue };
            let unit = if *word == "shortest cuts" { "mm" } else { "min" };
            print(&format!("{word}: {name}, {value:.2} {unit}"))?;
        }
        Ok(())
    }
}

fn share(report: &Report, floor: Option<&Floor>) -> Option<f64> {
    floor.map(|floor| report.length.cut_mm / floor.length)
}

fn line(name: &str, report: &Report, floor: Option<&Floor>) -> String {
    let length = &report.length;
    let of_floor = share(report, floor).map_or("–".into(), |share| format!("{share:.3}"));
    let proven = report.verified.as_ref();
    let micrometres = |x: Option<f64>| x.map_or("–".to_owned(), |x| format!("{:.2}", 1e3 * x));
    format!(
        "{name:24} {:6} {:9.1} {:9.1} {:9.2}  {of_floor:>8}  {:>9}  {:>8}",
        report.passes,
        length.cut_mm,
        length.link_mm,
        report.time_min,
        micrometres(proven.and_then(|v| v.largest_excess_mm)),
        micrometres(proven.and_then(|v| v.largest_gouge_mm)),
    )
}

fn row(name: &str, report: &Report, floor: Option<&Floor>, [plan, machine]: [Option<f64>; 2]) -> String {
    let told = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:.2}"));
    let (length, proven) = (&report.length, report.verified.as_ref());
    let micrometres = |x: Option<f64>| x.map_or(String::new(), |x| format!("{:.3}", 1e3 * x));
    let holds = proven.map_or("", |v| if job::holds(v, report.scallop_mm) { "yes" } else { "no" });
    format!(
        "{name},{},{:.3},{:.3},{:.3},{:.3},{},{:.4},{},{:.3},{},{},{holds},{},{}\n",
        report.passes,
        length.cut_mm,
        length.link_mm,
        length.rapid_mm,
        report.time_min,
        share(report, floor).map_or(String::new(), |share| format!("{share:.4}")),
        (report.area_mm2 - report.unreachable.area_mm2) / length.cut_mm,
        micrometres(proven.and_then(|v| v.largest_excess_mm)),
        1e3 * report.scallop_mm,
        micrometres(proven.and_then(|v| v.sampling_error_mm)),
        micrometres(proven.and_then(|v| v.largest_gouge_mm)),
        told(plan),
        told(machine),
    )
}
