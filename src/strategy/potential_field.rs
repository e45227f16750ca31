//! The planner of the machining potential field: passes offset from the path with the widest mean strip as long as they are efficient,
//! and a new initial path in what is left, until the face is covered.
//!
//! Source: H. Liu and M. Liu, Tool path planning for high speed milling of sculpture surface with toroidal cutter, 2013, section 3 and
//! Fig. 5. There neighbours are interpolated between discrete points; here they lie edge to edge by their exact strips, and what the
//! families leave where they meet is cut by short passes.

use super::constant_scallop::{Start, offset_lines, seed};
use super::family::{Candidate, Family};
use super::follow::Part;
use super::laid::Laid;
use super::potential::Potential;
use super::streamlines::{Streamlines, Swept};
use super::{Finish, Order, Planned, StrategyError};
use crate::cutter::Tool;
use crate::geometry::{Face, FaceGrid, Uv};
use crate::monitor::Stage;
use crate::posture::Rule;

/// Families at most: the last goes on however efficient it is.
const FAMILIES: usize = 8;
/// The share of the nodes of the potential's grid that may be left to short passes.
const LEFT: f64 = 0.004;
/// A path over less fresh ground than this, in strips, says nothing about its efficiency.
const STUB: f64 = 3.0;

/// Passes of `face` in families, the axis leaning by `rule`: a family goes on as long as the efficiency of its passes, eq. (11), is at
/// least the share `least_efficiency` (0 to 1) of its initial path's; the eighth goes on over all that is left.
///
/// An error where no line along the widest strips divides the face, as on a tube whose strips are widest along it.
pub fn potential_field(
    face: &Face,
    tool: &Tool,
    least_efficiency: f64,
    rule: Rule,
    finish: Finish,
    order: Order,
    stage: &Stage,
) -> Result<Planned, StrategyError> {
    let looking = stage.part("Measuring the potential", 0.0, 0.05);
    let flat = Potential::flat(&tool.cutter, &rule, &finish);
    let grid = Potential::grid(face, flat);
    let potential = Potential::new((face, &grid), &tool.cutter, &rule, &finish, &looking)?;
    let lines = Streamlines::new(face, &grid, &potential);
    let planner = Planner { face, tool, finish, order, least_efficiency, grid: &grid, lines, flat };
    let (versions, mut best) = (rule.versions(), None);
    for (k, &rule) in versions.iter().enumerate() {
        let at = |k: usize| 0.05 + 0.9 * k as f64 / versions.len() as f64;
        let laid = planner.laid(rule, &stage.part("Spacing passes", at(k), at(k + 1)))?;
        if best.as_ref().is_none_or(|best| laid.is_better(best)) {
            best = Some(laid);
        }
    }
    best.ok_or(StrategyError::NoInitialPath)?.eased(&stage.part("Easing postures", 0.95, 1.0))
}

struct Planner<'a> {
    face: &'a Face,
    tool: &'a Tool,
    finish: Finish,
    order: Order,
    least_efficiency: f64,
    grid: &'a FaceGrid,
    lines: Streamlines<'a>,
    /// About how wide strips are on flat ground, mm.
    flat: f64,
}

impl<'a> Planner<'a> {
    /// The passes of as many families as leave something for another.
    fn laid(&self, rule: Rule, stage: &Stage) -> Result<Laid<'a>, StrategyError> {
        let (mut parts, mut places) = (Vec::new(), Vec::new());
        while parts.len() < FAMILIES && self.left(&parts) > LEFT {
            let at = |k: usize| 0.6 * k as f64 / FAMILIES as f64;
            let part = stage.part("Spacing passes", at(parts.len()), at(parts.len() + 1));
            let Some((part, crests)) = self.next(&parts, &rule, &part)? else { break };
            parts.push(part);
            places.extend(crests);
        }
        if parts.is_empty() {
            return Err(StrategyError::NoInitialPath);
        }
        Laid::of_several(rule, parts, places, &stage.part("Following the surface", 0.6, 1.0))
    }

    /// The share of the nodes that none of `parts` has.
    fn left(&self, parts: &[Part]) -> f64 {
        let (nu, count) = (self.grid.size().0, self.grid.points().len());
        let open = (0..count).filter(|k| !is_done(parts, self.grid.uv(k % nu, k / nu)));
        open.count() as f64 / count as f64
    }

    /// The family that begins with the best initial path in what `parts` leave, and where its lines bend much.
    fn next(
        &self,
        parts: &[Part],
        rule: &Rule,
        stage: &Stage,
    ) -> Result<Option<(Part<'a>, Vec<Uv>)>, StrategyError> {
        let is_done = |uv: Uv| is_done(parts, uv);
        for line in self.lines.initial(&is_done) {
            let start = Start::Curve(line.points.iter().map(|point| point.p).collect());
            // Lines that wind, or run into themselves, are none to begin with.
            let Ok(seed) = seed(self.face, &start, self.flat) else { continue };
            // Where directions of wide strips turn within a strip no path is efficient all along: the initial one is as good as can be.
            let least = self.least_efficiency * Swept::of(&line.points[line.fresh.clone()]).efficiency();
            let is_last = parts.len() + 1 == FAMILIES;
            let goes_on = |family: &Family, pass: &Candidate| {
                if is_last {
                    // Beyond what is done there may be more.
                    return true;
                }
                let swept = self.swept(pass, &is_done);
                let is_stub = swept.length < STUB * family.setup.strip;
                swept.length > 0.0 && (is_stub || swept.efficiency() >= least)
            };
            let whole = (self.face, self.tool);
            let (mut part, crests) =
                offset_lines(whole, &seed, rule, self.finish, self.order, &goes_on, stage)?;
            if !parts.is_empty() {
                part.clip(&|uv| !is_done(uv));
            }
            if !part.tracks.is_empty() {
                return Ok(Some((part, crests)));
            }
        }
        Ok(None)
    }

    /// What a pass sweeps of fresh ground.
    fn swept(&self, pass: &Candidate, is_done: &dyn Fn(Uv) -> bool) -> Swept {
        let mut swept = Swept::default();
        let point = |uv: Uv| self.face.surface.point(uv);
        for pair in pass.lines.iter().flat_map(|line| line.nodes.windows(2)) {
            let feed = point(pair[1]) - point(pair[0]);
            let fresh = |uv: Uv| if is_done(uv) { None } else { self.lines.point(uv, feed) };
            if let (Some(from), Some(to)) = (fresh(pair[0]), fresh(pair[1])) {
                swept.add(&from, &to);
            }
        }
        swept
    }
}

/// Whether one of `parts` has what is at `uv`.
fn is_done(parts: &[Part], uv: Uv) -> bool {
    parts.iter().any(|part| part.has(uv))
}
