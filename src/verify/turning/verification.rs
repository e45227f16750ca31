//! The whole judgement of one turned part.

use super::ball::BallSweep;
use super::form::{Form, Sagitta, form};
use super::insert::InsertSweep;
use super::ray::{Ray, Sweep, Target};
use super::refine::{Samples, extreme};
use crate::monitor::{Cancelled, Stage};
use crate::toolpath::{Nose, TurningPath};
use std::f64::consts::TAU;

/// A place of the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// Height, mm.
    pub z: f64,
    /// Unit outward normal on the workpiece.
    pub normal: [f64; 3],
}

/// The part as it should be.
pub struct TurnedPart<'a> {
    /// Its surface at a place on the workpiece (x, y, mm), nothing outside of the aperture.
    pub surface: &'a (dyn Fn(f64, f64) -> Option<Surface> + Sync),
    /// No place of the aperture is farther from the axis, mm.
    pub farthest: f64,
    /// Vertex (x, y, mm) and directions (radians) of the chords over which the sagitta is checked.
    pub meridians: ([f64; 2], Vec<f64>),
}

/// What is asked of a verification. Lengths in mm.
#[derive(Debug, Clone, PartialEq)]
pub struct TurnedOptions {
    /// Distance of the samples along rays, and of the rays at the rim.
    pub spacing: f64,
    /// What is left higher than this counts as uncut.
    pub search: f64,
    /// Tolerances to report, ±.
    pub bands: Vec<f64>,
    /// Length of the chord of the sagitta check.
    pub chord: f64,
}

/// A residue and where it is, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Residue {
    /// Along the normal; below 0 where the tool digs in.
    pub value: f64,
    /// On the workpiece.
    pub x: f64,
    /// On the workpiece.
    pub y: f64,
}

/// What a verification found.
#[derive(Debug, Clone, PartialEq)]
pub struct TurnedProof {
    /// Number of rays: the first at the angle 0, evenly around.
    pub rays: usize,
    /// Places on a ray, the first on the axis, evenly out to [`TurnedPart::farthest`].
    pub rings: usize,
    /// Residues, ray by ray, mm: not a number outside of the aperture, infinite where uncut.
    pub residues: Vec<f32>,
    /// Distance of neighbouring places on a ray, mm.
    pub ring_step: f64,
    /// In numbers.
    pub form: Form,
    /// The sagittas; those whose chord leaves the aperture are left out.
    pub sagittas: Vec<Sagitta>,
}

impl TurnedProof {
    /// Distance from the axis of the places of a ring, mm.
    pub fn radius(&self, ring: usize) -> f64 {
        self.ring_step * ring as f64
    }

    /// Angle of a ray, radians.
    pub fn angle(&self, ray: usize) -> f64 {
        TAU * ray as f64 / self.rays as f64
    }
}

/// Why a path cannot be judged.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TurnedError {
    /// Fewer than two points.
    #[error("the path has no moves")]
    Empty,
    /// C goes back.
    #[error("point {index}: C goes back by {degrees:.6}°; it must run one way")]
    Backwards {
        /// The point, from 0.
        index: usize,
        /// By how much.
        degrees: f64,
    },
    /// A number is not finite, or time does not rise where it counts.
    #[error("point {index}: all numbers must be finite, and time must rise")]
    NotFinite {
        /// The point, from 0.
        index: usize,
    },
    /// More samples than fit.
    #[error("{samples:.2e} samples are too many: at most {limit}")]
    TooMany {
        /// About how many.
        samples: f64,
        /// How many would do.
        limit: usize,
    },
    /// Told to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// 400 MB of residues.
const MOST_SAMPLES: usize = 100_000_000;

/// What `path` leaves of `part` with this nose.
///
/// `path` is what its text states: C in radians, rising; nothing else is known of how it came about.
pub fn verify_turned(
    part: &TurnedPart,
    nose: Nose,
    path: &TurningPath,
    options: &TurnedOptions,
    stage: &Stage,
) -> Result<TurnedProof, TurnedError> {
    check(path)?;
    let rings = (part.farthest / options.spacing).ceil().max(1.0);
    let rays = (TAU * part.farthest / options.spacing).ceil().max(8.0);
    let count = rings * rays;
    if count.is_nan() || count >= MOST_SAMPLES as f64 {
        return Err(TurnedError::TooMany { samples: count, limit: MOST_SAMPLES });
    }
    // An odd count does not fall in step with the points of a turn, so that their gaps are seen at many places.
    let (rings, rays) = (rings as usize + 1, rays as usize | 1);
    stage.at(0.0)?;
    let sweep: Box<dyn Sweep + '_> = match nose {
        Nose::Ball(radius) => Box::new(BallSweep::new(path, radius, options.search)),
        Nose::Insert(radius) => Box::new(InsertSweep::new(path, radius, options.search)),
    };
    let sweep = sweep.as_ref();
    let steps = [part.farthest / (rings - 1) as f64, TAU / rays as f64];
    let measure = |i: usize| {
        let ray = Ray::new(steps[1] * i as f64);
        let found: Vec<Option<Target>> =
            (0..rings).map(|j| target(part, &ray, steps[0] * j as f64)).collect();
        let targets: Vec<Target> = found.iter().flatten().copied().collect();
        let mut residues = sweep.residues(&ray, &targets).into_iter();
        found.iter().map(|t| t.and_then(|_| residues.next()).unwrap_or(f64::NAN)).collect::<Vec<f64>>()
    };
    let all: Vec<f64> =
        stage.part("Cutting in simulation", 0.05, 0.95).map(rays, measure)?.into_iter().flatten().collect();
    stage.at(0.95)?;
    let weight = |j: usize| if j == 0 { 0.125 } else { j as f64 };
    let weighted: Vec<(f64, f64)> =
        all.iter().enumerate().filter(|(_, h)| !h.is_nan()).map(|(k, h)| (*h, weight(k % rings))).collect();
    let samples = Samples { all: &all, rings, steps };
    let [lowest, highest] = [-1.0, 1.0].map(|sense| extreme(part, sweep, &samples, sense));
    let form = form(&weighted, &options.bands, lowest, highest);
    let sagittas = part.meridians.1.iter().filter_map(|a| sagitta(part, sweep, *a, options.chord)).collect();
    stage.at(1.0)?;
    let residues = all.iter().map(|h| *h as f32).collect();
    Ok(TurnedProof { rays, rings, residues, ring_step: steps[0], form, sagittas })
}

fn check(path: &TurningPath) -> Result<(), TurnedError> {
    let points = &path.points;
    if points.len() < 2 {
        return Err(TurnedError::Empty);
    }
    for (index, p) in points.iter().enumerate() {
        let finite = [p.x, p.z, p.c, p.time].iter().chain(&p.rates).all(|x| x.is_finite());
        let before = index.checked_sub(1).map(|before| &points[before]);
        if !finite || before.is_some_and(|b| b.time > p.time) {
            return Err(TurnedError::NotFinite { index });
        }
        if let Some(b) = before.filter(|b| b.c > p.c) {
            return Err(TurnedError::Backwards { index, degrees: (b.c - p.c).to_degrees() });
        }
    }
    Ok(())
}

/// The place on `ray` at the distance `rho`, if the part is there.
pub(super) fn target(part: &TurnedPart, ray: &Ray, rho: f64) -> Option<Target> {
    let Surface { z, normal } = (part.surface)(rho * ray.cos, rho * ray.sin)?;
    Some(Target { rho, z, normal })
}

/// The sagitta over the chord through the vertex in the direction `angle`.
fn sagitta(part: &TurnedPart, sweep: &dyn Sweep, angle: f64, chord: f64) -> Option<Sagitta> {
    let [x, y] = part.meridians.0;
    let (sin, cos) = libm::sincos(angle);
    let height = |k: f64| {
        let (px, py) = (x + k * chord * cos, y + k * chord * sin);
        let z = (part.surface)(px, py)?.z;
        let ray = Ray::new(libm::atan2(py, px));
        let up = Target { rho: libm::hypot(px, py), z, normal: [0.0, 0.0, 1.0] };
        let gap = sweep.residues(&ray, &[up]).into_iter().next().filter(|h| h.is_finite())?;
        Some([z, z + gap])
    };
    let ([a, b], [m, n], [c, d]) = (height(-0.5)?, height(0.0)?, height(0.5)?);
    Some(Sagitta { angle, chord, nominal: m - 0.5 * (a + c), cut: n - 0.5 * (b + d) })
}
