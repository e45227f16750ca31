//! Extremes between the samples.

use super::ray::{Ray, Sweep};
use super::verification::{Residue, TurnedPart, target};
use crate::math::order::{rank, sort_by_key};

/// How many hills are looked at, the highest first: the sample nearest to the extreme need not be the most extreme one, and between
/// turns there is a crest for each two points.
const HILLS: usize = 96;
/// How many of them are then followed to the end.
const FOLLOWED: usize = 6;
/// Rounds to the end: each moves on or halves the distances between rays, and ten halvings leave a thousandth.
const ROUNDS: usize = 16;
/// Looks along a ray: each has nine places, and the next one a quarter of their distances.
const LOOKS: usize = 4;

/// Residues on rays: `all` holds them ray by ray, `rings` on each; `steps` are the distances of neighbours, mm and radians.
pub(super) struct Samples<'a> {
    pub(super) all: &'a [f64],
    pub(super) rings: usize,
    pub(super) steps: [f64; 2],
}

/// A place (distance from the axis and angle), how far around it has not been looked, and the residue there.
#[derive(Clone, Copy)]
struct Hill {
    at: [f64; 2],
    steps: [f64; 2],
    value: f64,
}

/// The most extreme residue by the sign of `sense`: 1 for the largest, −1 for the least. Nothing where nothing is cut.
pub(super) fn extreme(
    part: &TurnedPart,
    sweep: &dyn Sweep,
    samples: &Samples,
    sense: f64,
) -> Option<Residue> {
    let mut hills: Vec<Hill> =
        summits(samples, sense).into_iter().map(|k| climb(part, sweep, samples.hill(k), sense, 1)).collect();
    sort_by_key(&mut hills, |hill| (rank(-sense * hill.value), 0));
    hills
        .into_iter()
        .take(FOLLOWED)
        .map(|hill| climb(part, sweep, hill, sense, ROUNDS))
        .max_by(|a, b| (sense * a.value).total_cmp(&(sense * b.value)))
        .map(|Hill { at: [rho, angle], value, .. }| {
            let ray = Ray::new(angle);
            Residue { value, x: rho * ray.cos, y: rho * ray.sin }
        })
}

impl Samples<'_> {
    fn hill(&self, k: usize) -> Hill {
        let at = [self.steps[0] * (k % self.rings) as f64, self.steps[1] * (k / self.rings) as f64];
        Hill { at, steps: self.steps, value: self.all[k] }
    }
}

/// The numbers of the samples that no neighbour exceeds, the highest first and no more than [`HILLS`].
fn summits(&Samples { all, rings, .. }: &Samples, sense: f64) -> Vec<usize> {
    let rays = all.len() / rings;
    let is_summit = |k: usize| {
        let (ray, ring) = (k / rings, k % rings);
        let around = [
            Some((ray + 1) % rays * rings + ring),
            Some((ray + rays - 1) % rays * rings + ring),
            (ring + 1 < rings).then_some(k + 1),
            (ring > 0).then(|| k - 1),
        ];
        // What is not cut, or not there, exceeds nothing.
        let higher = |j: usize| all[j].is_finite() && sense * all[j] > sense * all[k];
        all[k].is_finite() && !around.into_iter().flatten().any(higher)
    };
    let mut found: Vec<usize> = (0..all.len()).filter(|k| is_summit(*k)).collect();
    sort_by_key(&mut found, |k| (rank(-sense * all[*k]), 0));
    found.truncate(HILLS);
    found
}

/// Looks around `hill` in this many rounds.
///
/// Crests are knife edges along the turns: what is highest on each of five rays is found first, and among these is chosen.
fn climb(part: &TurnedPart, sweep: &dyn Sweep, mut hill: Hill, sense: f64, rounds: usize) -> Hill {
    for _ in 0..rounds {
        let from = hill;
        for i in -2..=2 {
            let ray = Ray::new(from.at[1] + 0.5 * from.steps[1] * f64::from(i));
            let along = on_ray(part, sweep, &ray, &from, sense);
            if let Some((rho, value)) = along.filter(|(_, value)| sense * value > sense * hill.value) {
                hill = Hill { at: [rho, ray.angle], value, ..hill };
            }
        }
        if hill.at[1] == from.at[1] {
            hill.steps[1] *= 0.5;
        }
    }
    hill
}

/// Distance from the axis and value of the most extreme residue on `ray` near that of `hill`.
fn on_ray(part: &TurnedPart, sweep: &dyn Sweep, ray: &Ray, hill: &Hill, sense: f64) -> Option<(f64, f64)> {
    let mut best: Option<(f64, f64)> = None;
    let mut apart = 0.5 * hill.steps[0];
    for _ in 0..LOOKS {
        let middle = best.map_or(hill.at[0], |b| b.0);
        let radii = (-4..=4).map(|j| (middle + apart * f64::from(j)).max(0.0));
        let targets: Vec<_> = radii.filter_map(|rho| target(part, ray, rho)).collect();
        for (t, h) in targets.iter().zip(sweep.residues(ray, &targets)) {
            if h.is_finite() && best.is_none_or(|b| sense * h > sense * b.1) {
                best = Some((t.rho, h));
            }
        }
        apart *= 0.25;
    }
    best
}
