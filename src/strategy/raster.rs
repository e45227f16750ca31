//! Straight parallel lines over a mesh, cut by an upright cutter, with partial lines where the cusps would grow too high.
//!
//! Lines start out at the distance that is right on level ground, and run on beyond the border as long as the cutter
//! meets the mesh. What they leave is measured on the mesh itself, along its normals; wherever that is too much, the
//! distance of the two lines around is halved over the stretch in question, again and again. What no position of the
//! cutter can finish is told first, and kept apart. In the end what is not needed is left out.

mod across;
mod cut;
mod facet;
mod fill;
mod ground;
mod line;
mod need;
mod pass;
mod reach;
mod rest;
mod turn;

use crate::contact::{DropMesh, Underside};
use crate::cutter::Cutter;
use crate::geometry::{TriMesh, Zone};
use crate::monitor::{Cancelled, Stage};
use crate::toolpath::Pass;
use across::{survey, survey_closely, survey_pieces};
use cut::Lines;
use fill::{Stretch, fill};
use ground::{Grain, Ground, Limits};
use line::Lowering;
use reach::Closing;
use turn::Turn;

/// How to lay the lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RasterOptions {
    /// Direction of the lines, radians from x towards y.
    pub angle: f64,
    /// Highest cusp that may be left, along the mesh's normal, mm.
    pub scallop: f64,
    /// How far straight moves may pass above the tip's true path, mm.
    pub chord: f64,
    /// Gaps between passes on the same line are cut through where the way is no longer than this, mm: about as long as
    /// cutting takes as much time as lifting and coming down again.
    pub bridge: f64,
}

/// Passes and what they cannot finish.
#[derive(Debug, Clone, PartialEq)]
pub struct Raster {
    /// Passes in feed direction, all the same way, by their place across and then along. The axis is +z.
    pub passes: Vec<Pass>,
    /// What is seen from above and yet no position of an upright cutter brings it below eight tenths of the scallop limit
    /// (the rest is needed for cusps).
    pub unreached: Zone,
    /// What is not seen from above: walls (a normal's z of at most 0.02), undersides, and what lies below other facets.
    pub unseen: Zone,
}

/// Why there is no raster.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum RasterError {
    /// Told to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// An option out of range.
    #[error("{field}: {message}")]
    Option {
        /// The option: `scallop`, `chord`, `angle` or `bridge`.
        field: &'static str,
        /// What would be right.
        message: &'static str,
    },
    /// The scallop limit asks for more than memory and patience hold.
    #[error("too fine for a mesh of this area; {least} mm or more would do")]
    TooFine {
        /// The least scallop limit for this mesh and cutter, mm.
        least: f64,
    },
}

/// Of the scallop limit, what the lines may leave where the mesh is closely looked at; the rest is for what lies between.
const LINES: f64 = 0.9;
/// Of the scallop limit, what a single position of the cutter must stay below for a spot to be within reach.
const SINGLE: f64 = 0.8;
/// Places across between two of the first lines: distances can be halved twelve times.
const HALVINGS: u32 = 1 << 12;

/// Straight passes at `options.angle` over `mesh`, which lies under an upright cutter, such that no cusp outside the
/// returned zones exceeds the scallop limit and no move gouges by more than a micrometre.
///
/// Where it is needed for ground beside the border, the axis goes beyond the mesh by up to the cutter's radius; there as
/// everywhere the tip is never lower than where the cutter touches the mesh. Cost grows with the area over the scallop
/// limit, hardly with the number of triangles.
pub fn raster(
    mesh: &TriMesh,
    cutter: &Cutter,
    options: &RasterOptions,
    stage: &Stage<'_>,
) -> Result<Raster, RasterError> {
    check(options)?;
    stage.part("Preparing the mesh", 0.0, 0.01).at(0.0)?;
    let turn = Turn::new(options.angle);
    let mesh = TriMesh {
        vertices: mesh.vertices.iter().map(|&v| turn.to_lines(v)).collect(),
        triangles: mesh.triangles.clone(),
    };
    let Some((lo, hi)) = mesh.bounds().filter(|_| !mesh.triangles.is_empty()) else {
        let (unreached, unseen) = (Zone::empty(), Zone::empty());
        return Ok(Raster { passes: Vec::new(), unreached, unseen });
    };
    let measure = Measure::new(cutter.corner_radius, options);
    measure.check(&mesh, options.scallop)?;
    let (drop_mesh, under) = (DropMesh::new(&mesh), Underside::new(cutter));
    let lowering =
        Lowering { mesh: &drop_mesh, under: &under, corner: cutter.corner_radius, chord: options.chord };
    let best = Closing::new(&lowering, (lo, hi), &stage.part("Looking for all positions", 0.01, 0.12))?;
    let Measure { grain, limits, cusp } = measure;
    let ground = Ground { mesh: &mesh, lowering: &lowering, best: &best, grain, limits, bounds: (lo, hi) };

    let level = 2.0 * cutter.radius_at(limits.lines).unwrap_or_else(|| under.reach());
    let (mut lines, first) = first_lines(&ground, level);
    fill::cut(&first, &ground, &mut lines, &stage.part("Lowering lines", 0.12, 0.2))?;
    let seen = survey(&ground, &lines, &stage.part("Looking for cusps", 0.2, 0.4))?;
    fill(seen.wanting, &ground, &mut lines, cusp, &stage.part("Filling in", 0.4, 0.6))?;

    let hidden = rest::hidden_area(&mesh);
    let cubes = rest::cubes(seen.beyond.max(hidden), CELL * grain.along);
    let closer = stage.part("Looking closely", 0.6, 0.72);
    let (wanting, mut unreached) = survey_closely(&ground, &lines, &seen.out, &cubes, &turn, &closer)?;
    let pieces =
        facet::pieces(&ground, &unreached.clone().zone(), &turn, &stage.part("Looking closely", 0.72, 0.73))?;
    let (more, spots) = survey_pieces(
        &ground,
        &lines,
        &pieces,
        &mut unreached,
        &turn,
        &stage.part("Looking closely", 0.73, 0.75),
    )?;
    let wanting = [wanting, more].concat();
    let hopeless = fill(wanting, &ground, &mut lines, cusp, &stage.part("Filling in", 0.75, 0.8))?;
    hopeless.iter().for_each(|w| rest::add_spot(&mut unreached, &w.spot, grain, &turn));

    let is_first = |place: u32| place % HALVINGS == HALVINGS / 2;
    let size = (PIECE * cusp, options.bridge);
    let needless = stage.part("Leaving out the needless", 0.8, 0.93);
    let lines = need::needed(&lines, is_first, &ground, (&seen.out, &spots), size, &needless)?;
    let list = lines.iter().map(|(place, drops)| (lines.y(place), drops)).collect::<Vec<_>>();
    let passes = stage.part("Thinning", 0.93, 0.97).map(list.len(), |i| {
        let (y, drops) = list[i];
        pass::pass(&lowering.thin(drops), y, &turn)
    })?;
    let unseen = stage.part("Mapping what is not seen", 0.97, 1.0);
    let unseen = rest::unseen(&mesh, &lowering, &cubes, &turn, &unseen)?;
    Ok(Raster { passes, unreached: unreached.zone(), unseen })
}

/// Whole lines, `level` apart or a little less, over the mesh and beyond it as far as the cutter still meets it.
fn first_lines(ground: &Ground<'_>, level: f64) -> (Lines, Vec<Stretch>) {
    let (lo, hi) = (ground.bounds.0.y, ground.bounds.1.y);
    let count = ((hi - lo) / level).ceil().max(1.0);
    let distance = ((hi - lo) / count).max(f64::MIN_POSITIVE);
    let beyond = (ground.lowering.under.reach() / distance).ceil().min(MOST_LINES);
    let count = count as u32 + 2 * beyond as u32;
    let lines = Lines::new(lo - beyond * distance, distance / f64::from(HALVINGS), count * HALVINGS);
    let stretches = (0..count).flat_map(|i| {
        let place = i * HALVINGS + HALVINGS / 2;
        ground.lowering.covered(lines.y(place)).into_iter().map(move |(from, to)| (place, from, to))
    });
    let stretches = stretches.collect();
    (lines, stretches)
}

/// Places across are counted in 32 bits.
const MOST_LINES: f64 = 2e5;

/// How finely the ground is looked at, and what may be left there.
struct Measure {
    grain: Grain,
    limits: Limits,
    /// Width of a cusp as high as the limit on level ground, mm; the corner's share of it.
    cusp: f64,
}

impl Measure {
    /// A cusp between two strips of a corner is pointed like two parabolas: with its peak halfway between spots an eighth
    /// of its width apart it is a quarter of its height lower there; an eighth of that with closer spots. Of a sharp corner
    /// the flanks are straight, on the worst of slopes at 45° to the ground.
    fn new(corner: f64, options: &RasterOptions) -> Self {
        let scallop = options.scallop;
        let cusp = (8.0 * corner.max(scallop) * scallop).sqrt();
        let across = (cusp / 8.0).max(SHARP * scallop);
        let blunt = corner > scallop;
        let across = if blunt { across } else { across.min(SHARP * scallop) };
        let slack = if blunt { 0.25 } else { 0.5 * SHARP };
        let lines = LINES * scallop - options.chord;
        let limits = Limits { lines, strict: lines - slack * scallop, single: SINGLE * scallop };
        Self { grain: Grain { along: cusp / 6.0, across }, limits, cusp }
    }

    /// Refuses what would take gigabytes.
    fn check(&self, mesh: &TriMesh, scallop: f64) -> Result<(), RasterError> {
        let up = |i: usize| mesh.normal(i).is_some_and(|n| n.z > ground::WALL);
        let area: f64 = (0..mesh.triangles.len()).filter(|&i| up(i)).map(|i| mesh.area(i)).sum();
        let spots = area / (self.grain.along * self.grain.across);
        if spots <= MOST_SPOTS {
            return Ok(());
        }
        // The grain's area grows with the limit, or with its square.
        let digits = |x: f64| (x * 1e4).ceil() / 1e4;
        Err(RasterError::TooFine { least: digits(scallop * spots / MOST_SPOTS) })
    }
}

/// Spots of the grain: about a hundred bytes each, and minutes for all.
const MOST_SPOTS: f64 = 2e7;
/// Spots' distance on a sharp cutter's cusps, in scallop limits.
const SHARP: f64 = 0.5;
/// Edge of the zone's cubes in distances of slices: larger ones would blur its rim, smaller ones cost memory.
const CELL: f64 = 1.0;
/// Length of the parts in which lines are looked at for need, in widths of a level cusp.
const PIECE: f64 = 0.5;

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
    if !(options.bridge >= 0.0 && options.bridge.is_finite()) {
        return wrong("bridge", "must be 0 mm or more");
    }
    Ok(())
}
