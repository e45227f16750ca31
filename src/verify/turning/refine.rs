//! Extremes between the samples.

use super::ray::{Ray, Sweep};
use super::verification::{Residue, TurnedPart, target};

/// How many samples are looked around for either extreme.
pub(super) const SEEDS: usize = 60;
/// Each round looks at 25 places and halves their distances: 10 leave a thousandth of the spacing.
const ROUNDS: usize = 10;

/// The most extreme residue around `start` (distance from the axis and angle), by the sign of `sense`: 1 for the largest,
/// −1 for the least. `steps` are the distances of the samples, mm and radians.
pub(super) fn climb(
    part: &TurnedPart,
    sweep: &dyn Sweep,
    start: [f64; 2],
    steps: [f64; 2],
    sense: f64,
) -> Option<Residue> {
    let mut best: Option<([f64; 2], f64)> = None;
    let [mut along, mut across] = steps;
    for _ in 0..ROUNDS {
        let [rho, angle] = best.map_or(start, |b| b.0);
        for i in -2..=2 {
            let ray = Ray::new(angle + 0.5 * across * f64::from(i));
            let radii = (-2..=2).map(|j| (rho + 0.5 * along * f64::from(j)).max(0.0));
            let targets: Vec<_> = radii.filter_map(|rho| target(part, &ray, rho)).collect();
            for (t, h) in targets.iter().zip(sweep.residues(&ray, &targets)) {
                if h.is_finite() && best.is_none_or(|b| sense * h > sense * b.1) {
                    best = Some(([t.rho, ray.angle], h));
                }
            }
        }
        along *= 0.5;
        across *= 0.5;
    }
    best.map(|([rho, angle], value)| {
        let ray = Ray::new(angle);
        Residue { value, x: rho * ray.cos, y: rho * ray.sin }
    })
}
