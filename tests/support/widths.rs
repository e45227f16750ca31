//! How much shorter passes are with one plan than with another, beside what the widths of their strips allow.

use glam::DVec3;
use stepover::geometry::{Domain, Face, Range, Uv, Zone};
use stepover::job::Plan;
use stepover::toolpath::Role;
use stepover::verify::Samples;

/// Two plans over the ground that both reach.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Saving {
    /// Length of the emitted cutting moves of each, mm.
    pub(crate) lengths: [f64; 2],
    /// `∬ dA/w` of each, mm, with the widths of the strips nearest to each place.
    pub(crate) allowed: [f64; 2],
}

impl Saving {
    /// The second plan's saving against the first over `face`, on whose area places `spacing` mm apart are looked at.
    pub(crate) fn of(plans: [&Plan; 2], face: &Face, spacing: f64) -> Self {
        let samples = Samples::of_face(face, spacing).unwrap();
        let (beyond, border) = (plans.map(Plan::unreached), border(face));
        Self {
            lengths: plans.map(|plan| length(plan, beyond)),
            allowed: plans.map(|plan| allowed(plan, &samples, beyond, &border)),
        }
    }

    /// What the second plan saves, as a share of the first.
    pub(crate) fn made(&self) -> f64 {
        1.0 - self.lengths[1] / self.lengths[0]
    }

    /// What the widths of its strips allow it to save.
    pub(crate) fn possible(&self) -> f64 {
        1.0 - self.allowed[1] / self.allowed[0]
    }
}

/// Length of the cutting moves that end outside of both of `beyond`, mm: what a plan cuts on ground that it does not finish saves the
/// other nothing.
fn length(plan: &Plan, beyond: [&Zone; 2]) -> f64 {
    let moves = plan.emitted.toolpath.moves.windows(2).zip(&plan.touches[1..]);
    let is_common = |point: DVec3| !beyond.iter().any(|zone| zone.contains(point));
    let counts = moves.filter(|(w, touch)| w[1].role == Role::Cut && is_common(touch.point));
    counts.map(|(w, _)| w[0].to.tip.distance(w[1].to.tip)).sum()
}

fn allowed(plan: &Plan, samples: &Samples, beyond: [&Zone; 2], border: &[DVec3]) -> f64 {
    let strips: Vec<(DVec3, f64)> =
        plan.touches.iter().filter_map(|touch| Some((touch.point, touch.contact?.1.strip?))).collect();
    // A strip that a border ends counts as twice its other half, which is no width that a cutter cuts where it lies aslant.
    let is_whole = |(point, width): &&(DVec3, f64)| border.iter().all(|b| b.distance(*point) > 0.5 * width);
    let whole: Vec<(DVec3, f64)> = strips.iter().filter(is_whole).copied().collect();
    let strips = if whole.is_empty() { strips } else { whole };
    let counts = samples.samples.iter().zip(&samples.areas);
    let counts = counts.filter(|(sample, _)| !beyond.iter().any(|zone| zone.contains(sample.point)));
    counts.map(|(sample, area)| area / nearest(&strips, sample.point)).sum()
}

/// Points on the borders of `face`.
fn border(face: &Face) -> Vec<DVec3> {
    const PARTS: usize = 400;
    let Domain { u, v } = face.domain();
    let at = |range: Range, k: usize| range.lo + range.length() * k as f64 / PARTS as f64;
    let along_u = (!v.periodic).then_some([v.lo, v.hi]).into_iter().flatten();
    let along_u = along_u.flat_map(|v| (0..=PARTS).map(move |k| Uv::new(at(u, k), v)));
    let along_v = (!u.periodic).then_some([u.lo, u.hi]).into_iter().flatten();
    let along_v = along_v.flat_map(|u| (0..=PARTS).map(move |k| Uv::new(u, at(v, k))));
    along_u.chain(along_v).map(|uv| face.surface.point(uv)).collect()
}

fn nearest(strips: &[(DVec3, f64)], point: DVec3) -> f64 {
    let away = |strip: &&(DVec3, f64)| strip.0.distance_squared(point);
    strips.iter().min_by(|a, b| away(a).total_cmp(&away(b))).map_or(f64::INFINITY, |strip| strip.1)
}
