//! What two straight neighbouring passes leave between them, by simulated cutting.

use super::error::JobError;
use crate::contact::{Lean, cl_of};
use crate::cutter::Cutter;
use crate::geometry::{Cylinder, Face, Plane, Range, Side, Uv};
use crate::math::frame::Frame;
use crate::monitor::Stage;
use crate::post;
use crate::toolpath::{CcPoint, Move, Rate, Role, Toolpath};
use crate::verify::{Options, Samples, verify};
use glam::DVec3;

/// What is left between two passes, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoPasses {
    /// The largest excess: the scallop.
    pub scallop: f64,
    /// The deepest gouge, 0 or negative.
    pub gouge: f64,
    /// By how much the scallop may be higher between the samples.
    pub error: f64,
}

/// Share of the expected scallop to which the found one is bounded.
const ACCURACY: f64 = 1e-3;
/// Samples across the stepover before any are added.
const SAMPLES: f64 = 60.0;

/// Cuts a face of this `curvature` across the feed (1/mm, above 0 where concave, 0 for a plane) with two straight passes
/// `stepover` mm apart (the chord) that stand `lift` mm off it, and measures what they leave between them.
///
/// The passes are written as APT text and read back; `expected` (mm, above 0) sets how closely is looked: to a thousandth
/// of it. Errors: a stepover that does not fit onto the face, or one so wide that more than the cutter's radius is left.
pub fn cut_two_passes(
    cutter: &Cutter,
    lean: Lean,
    curvature: f64,
    stepover: f64,
    lift: f64,
    expected: f64,
) -> Result<TwoPasses, JobError> {
    let strip = Patch::new(curvature, stepover)?;
    let program = post::Program {
        part: "two passes".into(),
        unit: post::Unit::Mm,
        cutter: *cutter,
        tool: 1,
        spindle_rpm: None,
        toolpath: strip.passes(cutter, lean, lift),
    };
    let text = post::apt::write(&program);
    let program =
        post::apt::read(&text).map_err(|e| JobError::Post(format!("the program does not read back: {e}")))?;
    let samples =
        Samples::of_face(&strip.face, stepover / SAMPLES).map_err(|e| JobError::Post(e.to_string()))?;
    let options = Options {
        sampling_tolerance: ACCURACY * expected,
        search: cutter.largest_radius().max(expected),
        ..Options::for_height(expected, &program.cutter)
    };
    let found = verify(&program.cutter, &program.toolpath, &samples, &options, &Stage::silent())?.statistics;
    match (found.max, found.min) {
        (Some(max), Some(min)) if max.excess.is_finite() => {
            Ok(TwoPasses { scallop: max.excess, gouge: min.excess.min(0.0), error: found.excess_error })
        }
        _ => Err(JobError::Post(format!("more than {} mm is left between the passes", options.search))),
    }
}

/// A face just as wide as the stepover and a little long, fed along x.
struct Patch {
    face: Face,
    /// Where the two passes' contacts cross x = 0, with the normals there.
    contacts: [(DVec3, DVec3); 2],
    /// Half its length, mm.
    half: f64,
}

impl Patch {
    fn new(curvature: f64, stepover: f64) -> Result<Self, JobError> {
        let wrong =
            || JobError::field("stepover", "must be above 0 mm and less than the face is wide".into());
        if stepover.is_nan() || stepover <= 0.0 {
            return Err(wrong());
        }
        let half = 0.05 * stepover;
        if curvature == 0.0 {
            let frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
            let (u, v) = (Range::open(-half, half), Range::open(0.0, stepover));
            let face = Face::new(Plane { origin: DVec3::ZERO, frame, u, v }, Side::Front);
            return Self::of(face, [Uv::new(0.0, 0.0), Uv::new(0.0, stepover)], half).ok_or_else(wrong);
        }
        let radius = 1.0 / curvature.abs();
        let turn = 2.0 * libm::asin(0.5 * stepover / radius);
        // Angles count from the lowest line of a hollow and the highest of a ridge, towards y.
        let up = DVec3::Z * curvature.signum();
        let frame = Frame { f: -up, b: DVec3::Y, n: DVec3::X * curvature.signum() };
        let side = if curvature > 0.0 { Side::Back } else { Side::Front };
        Cylinder::new(up * radius, frame, radius, [0.0, turn], [-half, half])
            .and_then(|c| Self::of(Face::new(c, side), [Uv::new(0.0, 0.0), Uv::new(turn, 0.0)], half))
            .ok_or_else(wrong)
    }

    fn of(face: Face, at: [Uv; 2], half: f64) -> Option<Self> {
        let [first, second] = at.map(|uv| face.at(uv).map(|(jet, n)| (jet.p, n)));
        Some(Self { contacts: [first?, second?], face, half })
    }

    /// There along the first contact line and back along the second, each so long that nothing of the cutter's shape at a
    /// pass's end, nor the link, is over the patch.
    fn passes(&self, cutter: &Cutter, lean: Lean, lift: f64) -> Toolpath {
        let reach = self.half + 3.0 * cutter.largest_radius();
        let [first, second] = self.contacts;
        let clear = lift + 2.0 * cutter.largest_radius();
        let stops = [
            (first, -reach, lift, Role::Cut),
            (first, reach, lift, Role::Cut),
            (first, reach, clear, Role::Link),
            (second, reach, clear, Role::Link),
            (second, reach, lift, Role::Link),
            (second, -reach, lift, Role::Cut),
        ];
        let moves = stops.into_iter().filter_map(|((point, n), along, lift, role)| {
            let frame = Frame::from_normal(n, DVec3::X)?;
            let cc = CcPoint { point: point + DVec3::X * along + n * lift, frame, posture: lean.posture() };
            Some(Move { to: cl_of(cutter, &cc), rate: Rate::Feed(1000.0), role })
        });
        Toolpath { moves: moves.collect() }
    }
}
