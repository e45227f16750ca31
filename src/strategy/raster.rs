//! Straight parallel lines over a mesh, cut by an upright cutter, with partial lines where the cusps would grow too high.
//!
//! Lines start out at the distance that is right on level ground. What they leave is measured on the mesh itself, along
//! its normals; wherever that is too much, the distance of the two lines around is halved over the stretch in question,
//! again and again. What no position of the cutter can finish is told first, and kept apart.

mod across;
mod cut;
mod line;
mod reach;
mod rest;

use crate::contact::{DropMesh, Underside};
use crate::cutter::Cutter;
use crate::geometry::{TriMesh, Zone};
use crate::math::frame::Frame;
use crate::monitor::{Cancelled, Stage};
use crate::toolpath::{CcPoint, ClPoint, Pass, Posture, Station};
use across::{Grain, Ground, Limits, Wanting, still_wanting, survey};
use cut::Lines;
use glam::{DVec2, DVec3};
use line::{Drop, Lowering};
use reach::{Closing, Spot};
use std::collections::BTreeMap;

/// How to lay the lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RasterOptions {
    /// Direction of the lines, radians from x towards y.
    pub angle: f64,
    /// Highest cusp that may be left, along the mesh's normal, mm.
    pub scallop: f64,
    /// How far straight moves may pass above the tip's true path, mm.
    pub chord: f64,
}

/// Passes and what they cannot finish.
#[derive(Debug, Clone, PartialEq)]
pub struct Raster {
    /// Passes in feed direction, all the same way, by their place across and then along. The axis is +z.
    pub passes: Vec<Pass>,
    /// What an upright cutter over the mesh cannot bring below eight tenths of the scallop limit at any single position
    /// (the rest is needed for cusps), and what it cannot see: walls, undersides, covered facets.
    pub unreached: Zone,
}

/// Why there is no raster.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum RasterError {
    /// Told to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// An option out of range.
    #[error("{field}: {message}")]
    Option {
        /// The option: `scallop`, `chord` or `angle`.
        field: &'static str,
        /// What would be right.
        message: &'static str,
    },
}

/// Of the scallop limit, what the lines may leave where the mesh is looked at; the rest is for what lies between.
const LINES: f64 = 0.9;
/// Of the scallop limit, what a single position of the cutter must stay below for a spot to be within reach.
const SINGLE: f64 = 0.8;
/// Places across between two of the first lines: distances can be halved twelve times.
const HALVINGS: u32 = 1 << 12;

/// Straight passes at `options.angle` over `mesh`, which lies under an upright cutter, such that no cusp outside the
/// returned zone exceeds the scallop limit and no move gouges by more than a micrometre.
///
/// The axis stays over the mesh: beyond its border nothing is known of the part. Cost grows with the area over the
/// scallop limit, hardly with the number of triangles.
pub fn raster(
    mesh: &TriMesh,
    cutter: &Cutter,
    options: &RasterOptions,
    stage: &Stage<'_>,
) -> Result<Raster, RasterError> {
    check(options)?;
    // Turned so that the lines run along x.
    let turn = Turn::new(options.angle);
    let mesh = TriMesh {
        vertices: mesh.vertices.iter().map(|&v| turn.to_lines(v)).collect(),
        triangles: mesh.triangles.clone(),
    };
    let Some((lo, hi)) = mesh.bounds().filter(|_| !mesh.triangles.is_empty()) else {
        return Ok(Raster { passes: Vec::new(), unreached: Zone::empty() });
    };
    let (drop_mesh, under) = (DropMesh::new(&mesh), Underside::new(cutter));
    let corner = cutter.corner_radius;
    let lowering = Lowering { mesh: &drop_mesh, under: &under, corner, chord: options.chord };
    let limits = Limits { lines: LINES * options.scallop - options.chord, single: SINGLE * options.scallop };

    let level = 2.0 * cutter.radius_at(limits.lines).unwrap_or_else(|| under.reach());
    let count = ((hi.y - lo.y) / level).ceil().clamp(1.0, MOST_LINES);
    let distance = (hi.y - lo.y) / count;
    let count = count as u32;
    let mut lines = Lines::new(lo.y, distance / f64::from(HALVINGS), count * HALVINGS);
    let first = (0..count).flat_map(|i| {
        let place = i * HALVINGS + HALVINGS / 2;
        drop_mesh.covered(lines.y(place)).into_iter().map(move |(from, to)| (place, from, to))
    });
    let first: Vec<_> = first.collect();
    cut(&first, &lowering, &mut lines, &stage.part("lines", 0.0, 0.1))?;

    // The tip of a cusp is as wide as the limit allows on level ground; the corner's own share of that.
    let cusp = (8.0 * corner.max(options.scallop) * options.scallop).sqrt();
    let grain = Grain { along: cusp * GRAIN_ALONG, across: cusp * GRAIN_ACROSS };
    let best = Closing::new(&lowering, (lo, hi), &stage.part("best of all positions", 0.1, 0.2))?;
    let ground = Ground { mesh: &mesh, lowering: &lowering, best: &best };
    let seen = survey(&ground, &lines, grain, limits, &stage.part("looking for cusps", 0.2, 0.7))?;
    let mut unreached = seen.unreached;
    fill(
        seen.wanting,
        &lowering,
        &mut lines,
        limits,
        cusp,
        &stage.part("partial lines", 0.7, 0.95),
        &mut unreached,
    )?;

    let passes = lines.iter().map(|(place, drops)| (lines.y(place), drops)).collect::<Vec<_>>();
    let passes = stage.part("thinning", 0.95, 1.0).map(passes.len(), |i| {
        let (y, drops) = passes[i];
        pass(&lowering.thin(drops), y, &turn)
    })?;
    let unreached = rest::zone(&mesh, &lowering, &unreached, (grain.along, CELL * grain.along), &turn);
    Ok(Raster { passes, unreached })
}

/// Distance of the spots looked at, along and across the lines, as parts of a level cusp's width: halfway between two
/// spots a cusp's tip is higher than at them by at most 2 × 1/64 of its height on either flank.
const GRAIN_ACROSS: f64 = 1.0 / 32.0;
/// Cusps run along the lines and change slowly there.
const GRAIN_ALONG: f64 = 1.0 / 6.0;
/// Edge of the zone's cubes in distances of slices: larger ones would blur its rim, smaller ones cost memory.
const CELL: f64 = 1.5;
/// More first lines than this have no use at any scallop, and would overflow the places.
const MOST_LINES: f64 = 1e5;

fn check(options: &RasterOptions) -> Result<(), RasterError> {
    let wrong = |field, message| Err(RasterError::Option { field, message });
    if !options.angle.is_finite() {
        return wrong("angle", "must be a number");
    }
    if !(options.scallop > 0.0 && options.scallop.is_finite()) {
        return wrong("scallop", "must be above 0 mm");
    }
    if !(options.chord > 0.0 && options.chord <= 0.5 * options.scallop) {
        return wrong("chord", "must be above 0 mm and at most half of the scallop limit");
    }
    Ok(())
}

/// Lowers the cutter over stretches, each a place and its ends.
fn cut(
    stretches: &[(u32, f64, f64)],
    lowering: &Lowering<'_>,
    lines: &mut Lines,
    stage: &Stage<'_>,
) -> Result<(), Cancelled> {
    let drops = stage.map(stretches.len(), |i| {
        let (place, from, to) = stretches[i];
        lowering.along(lines.y(place), from, to)
    })?;
    for ((place, ..), drops) in stretches.iter().zip(drops) {
        lines.add(*place, drops);
    }
    Ok(())
}

/// Inserts partial lines until no spot is wanting.
fn fill(
    mut wanting: Vec<Wanting>,
    lowering: &Lowering<'_>,
    lines: &mut Lines,
    limits: Limits,
    cusp: f64,
    stage: &Stage<'_>,
    unreached: &mut Vec<Spot>,
) -> Result<(), Cancelled> {
    let mut done = 0.0;
    while !wanting.is_empty() {
        let mut places: BTreeMap<u32, Vec<f64>> = BTreeMap::new();
        let mut left = Vec::new();
        for w in wanting {
            // Halfway there may be no mesh below, near an oblique border: then the line goes where the axis must.
            let nearest = Some(lines.nearest(w.axis.y));
            let halfway = lines.between(w.axis).filter(|p| Some(*p) != w.asked);
            match halfway.or(nearest.filter(|_| w.asked != nearest)) {
                Some(place) => {
                    places.entry(place).or_default().push(w.axis.x);
                    left.push(Wanting { asked: Some(place), ..w });
                }
                // A line runs where the axis must go and yet it was not enough.
                None => unreached.push(w.spot),
            }
        }
        let stretches: Vec<_> = places
            .into_iter()
            .flat_map(|(place, at)| {
                let covered = lowering.mesh.covered(lines.y(place));
                joined(at, cusp, &covered).into_iter().map(move |(from, to)| (place, from, to))
            })
            .collect();
        let next = 0.5 * (1.0 + done);
        cut(&stretches, lowering, lines, &stage.part("partial lines", done, 0.5 * (done + next)))?;
        let check = stage.part("partial lines", 0.5 * (done + next), next);
        wanting = still_wanting(&left, lowering, lines, limits, &check)?;
        done = next;
    }
    Ok(())
}

/// Stretches around the places `at`, within the stretches `covered`: each place with a little on either side, and
/// joined where the gap is so short that lifting over it costs more.
fn joined(mut at: Vec<f64>, cusp: f64, covered: &[(f64, f64)]) -> Vec<(f64, f64)> {
    at.sort_by(f64::total_cmp);
    let (margin, gap) = (MARGIN * cusp, JOINED * cusp);
    let mut stretches: Vec<(f64, f64)> = Vec::new();
    for x in at {
        match stretches.last_mut() {
            Some(last) if x - margin <= last.1 + gap => last.1 = x + margin,
            _ => stretches.push((x - margin, x + margin)),
        }
    }
    let clip = |&(from, to): &(f64, f64)| {
        covered.iter().map(move |c| (from.max(c.0), to.min(c.1))).filter(|(from, to)| from < to)
    };
    stretches.iter().flat_map(clip).collect()
}

/// What a partial line extends beyond the spots it is for, in widths of a level cusp: more than the distance of spots.
const MARGIN: f64 = 0.25;
/// Gaps up to so many widths are cut through.
const JOINED: f64 = 2.0;

/// The pass over these drops on the line at `y`.
fn pass(drops: &[Drop], y: f64, turn: &Turn) -> Pass {
    let tip = |d: &Drop| DVec3::new(d.x, y, d.tip);
    let last = drops.len() - 1;
    let station = |(i, d): (usize, &Drop)| {
        let toward = tip(&drops[(i + 1).min(last)]) - tip(&drops[i.saturating_sub(1)]);
        let n = d.touch.normal;
        let frame = Frame::from_normal(n, toward).or_else(|| Frame::from_normal(n, DVec3::X));
        let frame = frame.unwrap_or_else(|| Frame::any(n));
        let lean = frame.to_local(DVec3::Z);
        let posture = Posture {
            lead: libm::acos(lean.z.clamp(-1.0, 1.0)),
            yaw: if lean.truncate().length() > 1e-12 { libm::atan2(lean.y, lean.x) } else { 0.0 },
        };
        let frame = Frame { f: turn.to_world(frame.f), b: turn.to_world(frame.b), n: turn.to_world(frame.n) };
        Station {
            cc: CcPoint { point: turn.to_world(d.touch.point), frame, posture },
            cl: ClPoint { tip: turn.to_world(tip(d)), axis: DVec3::Z },
        }
    };
    Pass { stations: drops.iter().enumerate().map(station).collect() }
}

/// A turn about z between the world and a frame whose x runs along the lines.
struct Turn {
    along: DVec2,
}

impl Turn {
    fn new(angle: f64) -> Self {
        let (s, c) = libm::sincos(angle);
        Self { along: DVec2::new(c, s) }
    }

    fn to_lines(&self, v: DVec3) -> DVec3 {
        let flat = v.truncate();
        DVec3::new(self.along.dot(flat), self.along.perp_dot(flat), v.z)
    }

    fn to_world(&self, v: DVec3) -> DVec3 {
        (self.along * v.x + self.along.perp() * v.y).extend(v.z)
    }
}
