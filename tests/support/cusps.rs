//! How high the cusps between passes are, whatever their order and shape.

use stepover::geometry::Face;
use stepover::job::Plan;
use stepover::monitor::Stage;
use stepover::verify::{Options, Samples, verify};

/// Below this share of the limit a sample lies in the valley of a pass.
const VALLEY: f64 = 0.15;

/// The median cusp that `plan` leaves on `face`, as a share of the limit `scallop` (mm).
///
/// Samples `spacing` mm apart are cut in simulation; along every row of them, either way, a cusp is the largest excess
/// between one valley and the next. Samples miss its edge, to which both flanks are followed: the root of the excess over a
/// flank is straight. What runs out over a border has no second valley and does not count.
pub(crate) fn median_cusp(plan: &Plan, face: &Face, scallop: f64, spacing: f64, stage: &Stage) -> f64 {
    let samples = Samples::of_face(face, spacing).unwrap();
    let options = Options { most_refined: 0, ..Options::for_height(scallop, &plan.emitted.cutter) };
    let cut = verify(&plan.emitted.cutter, &plan.emitted.toolpath, &samples, &options, stage).unwrap();
    let grid = samples.grid.as_ref().unwrap();
    let (nu, nv) = (grid.u.len(), grid.v.len());
    assert_eq!(nu * nv, cut.excess.len());
    let mut cusps: Vec<f64> = Vec::new();
    let mut along = |row: Vec<usize>| {
        let roots: Vec<f64> = row.iter().map(|&i| (cut.excess[i] / scallop).max(0.0).sqrt()).collect();
        let valleys: Vec<usize> = (0..roots.len()).filter(|&i| roots[i] < VALLEY.sqrt()).collect();
        let between = valleys.windows(2).filter(|w| w[1] > w[0] + 1);
        cusps.extend(between.map(|w| edge(&roots[w[0]..=w[1]])));
    };
    (0..nv).for_each(|j| along((0..nu).map(|i| j * nu + i).collect()));
    (0..nu).for_each(|i| along((0..nv).map(|j| j * nu + i).collect()));
    cusps.sort_by(f64::total_cmp);
    cusps[cusps.len() / 2]
}

/// The height of a cusp of which these are the roots of the heights at samples.
fn edge(roots: &[f64]) -> f64 {
    let top = (0..roots.len()).fold(0, |best, i| if roots[i] > roots[best] { i } else { best });
    // The flanks meet before the highest sample or after it.
    let meet = [top, top + 1].into_iter().filter_map(|right| {
        let (a, b) = (*roots.get(right.checked_sub(2)?)?, *roots.get(right - 1)?);
        let (c, d) = (*roots.get(right)?, *roots.get(right + 1)?);
        let (up, down) = (b - a, c - d);
        let t = (c + down - b) / (up + down);
        // From the last sample on the way up to the first on the way down.
        ((0.0..=1.0).contains(&t) && up > 0.0 && down > 0.0).then_some(b + up * t)
    });
    let top = meet.fold(roots[top], f64::max);
    top * top
}
