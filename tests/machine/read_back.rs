//! What programs state is what was planned: the gallery's jobs on every machine that can hold them, in every dialect.

use crate::examples::{TEXTS, example, post_program};
use glam::DVec3;
use std::num::NonZeroUsize;
use std::sync::OnceLock;
use stepover::job::machines::{self, Contact, Dialect, PostOptions, Posted, contacts};
use stepover::job::{self, JobError};
use stepover::monitor::{Silent, Stage};
use stepover::post::Program;
use stepover::toolpath::{ClPoint, Move, Rate, Role, Toolpath};
use stepover::verify::{Options, Samples, Verification, verify};

/// A job of the gallery, planned.
struct Job {
    id: &'static str,
    program: Program,
    contacts: Vec<Option<Contact>>,
    samples: Samples,
    scallop: f64,
}

/// The gallery's jobs.
fn jobs() -> &'static [Job] {
    static JOBS: OnceLock<Vec<Job>> = OnceLock::new();
    JOBS.get_or_init(|| {
        let stage = Stage::whole(&Silent, NonZeroUsize::MIN);
        let plan = |example: job::Example| {
            let plan = job::plan(&example.spec, None, &stage).unwrap();
            let (shape, _) = example.spec.source.shape(None).unwrap();
            let job::Shape::Face(face) = shape else { panic!("a surface") };
            let samples = Samples::of_face(&face, 1.5).unwrap();
            let scallop = example.spec.tolerance.scallop_mm;
            let contacts = contacts(&plan.csv, &plan.emitted.toolpath).unwrap();
            Job { id: example.id, program: plan.emitted, contacts, samples, scallop }
        };
        job::gallery().into_iter().map(plan).collect()
    })
}

fn proof(job: &Job, path: &Toolpath) -> Verification {
    let options = Options { most_refined: 0, ..Options::for_height(job.scallop, &job.program.cutter) };
    verify(&job.program.cutter, path, &job.samples, &options, &Stage::whole(&Silent, NonZeroUsize::MIN))
        .unwrap()
}

fn posted(job: &Job, machine: &str, dialect: Dialect) -> Result<Posted, JobError> {
    let options = PostOptions::new(dialect);
    machines::post_program(job.program.clone(), &job.contacts, &example(machine), &options, &Stage::silent())
}

#[test]
fn every_job_reads_back_from_every_dialect_on_every_machine() {
    for job in jobs() {
        for (machine, _) in TEXTS.iter().filter(|(name, _)| *name != "three_axis") {
            for dialect in Dialect::ALL.into_iter().filter(|d| *d != Dialect::Grbl) {
                let name = format!("{} on {machine} in {}", job.id, dialect.name());
                let posted = posted(job, machine, dialect).unwrap_or_else(|e| panic!("{name}: {e}"));
                let off = posted.deviation;
                assert!(off.tip_mm < 1e-3 && off.axis_deg < 1e-3, "{name}: {off:?}");
                assert!(!has_exponent(&posted.text), "{name}");
            }
        }
    }
}

#[test]
fn a_slow_swing_in_the_pole_is_no_deviation() {
    // Rows so close to the pole that C swings round within a hundredth of a millimetre.
    let step = |k: i32| {
        let axis = DVec3::new(3e-3 * (f64::from(k) - 0.34), 2.4e-4, 1.0).normalize();
        let to = ClPoint { tip: DVec3::new(31.4 - 0.1 * f64::from(k), -29.9, 4.0), axis };
        Move { to, rate: Rate::Feed(3000.0), role: Role::Cut }
    };
    let toolpath = Toolpath { moves: (-40..=40).map(step).collect() };
    let program = Program { toolpath, ..jobs()[0].program.clone() };
    for dialect in [Dialect::LinuxCnc, Dialect::FanucTip] {
        let posted = post_program(&program, &example("table_table_ac"), &PostOptions::new(dialect)).unwrap();
        assert!(posted.deviation.tip_mm < 1e-4, "{:?}", posted.deviation);
    }
}

/// Whether a number is stated with an exponent.
fn has_exponent(text: &str) -> bool {
    text.as_bytes().windows(3).any(|w| {
        w[0].is_ascii_digit() && matches!(w[1], b'e' | b'E') && (w[2].is_ascii_digit() || w[2] == b'-')
    })
}

#[test]
fn what_is_cut_is_what_was_planned() {
    // Every machine once with its axes' own motion, and every way of stating it once on one machine.
    let axes = ["table_table_ac", "table_table_bc", "head_table_bc", "head_head_ab", "head_head_ac"]
        .map(|machine| (machine, Dialect::LinuxCnc));
    let others = [Dialect::FanucTip, Dialect::SiemensVector].map(|dialect| ("table_table_ac", dialect));
    for job in jobs() {
        let planned = proof(job, &job.program.toolpath);
        for (machine, dialect) in axes.into_iter().chain(others) {
            let posted = posted(job, machine, dialect).unwrap();
            let cut = proof(job, &posted.read.toolpath);
            let name = format!("{} on {machine} in {}", job.id, dialect.name());
            for (a, b) in planned.excess.iter().zip(&cut.excess) {
                assert!(a == b || (a - b).abs() < 1e-4, "{name}: {a} became {b}");
            }
            // Three times what it is for a control that knows the tool's direction, and no more than what is stated.
            let blocks = posted.text.lines().count() as f64 / job.program.toolpath.moves.len() as f64;
            assert!(blocks < if dialect == Dialect::LinuxCnc { 15.0 } else { 3.5 }, "{name}: {blocks}");
        }
    }
}

#[test]
fn times_of_blocks_are_what_the_axes_need() {
    let job = &jobs()[0];
    // Without contacts the feed is that of the tip.
    let options = PostOptions::new(Dialect::LinuxCnc);
    let posted = post_program(&job.program, &example("table_table_ac"), &options).unwrap();
    for pair in posted.path.moves.windows(2) {
        let [a, b] = pair else { unreachable!() };
        for (axis, (from, to)) in posted.kinematics.axes().iter().zip(a.at.all().into_iter().zip(b.at.all()))
        {
            assert!((to - from).abs() <= axis.speed * b.seconds * (1.0 + 1e-9), "{}", axis.letter);
        }
        if let Rate::Feed(feed) = b.rate {
            let length = a.to.tip.distance(b.to.tip);
            // The feed counts the path's own way, beside which places stand by less than its tolerance.
            assert!(60.0 * (length - 1e-4) <= feed * b.seconds * (1.0 + 1e-6));
        }
    }
    // Accelerating takes longer than not to, and no kind of move takes less than at constant speed.
    let nominal: f64 = posted.path.moves.iter().map(|m| m.seconds).sum();
    assert!(posted.times.total() > nominal);
}
