//! What is left of a surface while a path is being run, not only at its end.

use super::body::Body;
use super::cut::Scene;
use super::samples::Samples;
use super::verification::{Options, VerifyError, check_path};
use crate::cutter::Cutter;
use crate::monitor::Stage;
use crate::toolpath::{Move, Role, Toolpath};

/// A sample is cut down to here.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Removal {
    /// During this move, counted from 0.
    pub step: u32,
    /// The sample.
    pub sample: u32,
    /// What is left above it from then on, mm; negative for a gouge.
    pub excess: f64,
}

/// Stretches that a path is run in: at least so many, so that one long pass is not one moment, and at most so many, since all samples
/// are looked at for each.
const STRETCHES: [usize; 2] = [48, 256];

/// When `path` run by `cutter` cuts which of `samples` down to what, in the order of the moves. The last removal of a sample leaves what
/// [`verify`](super::verify) finds there; one that nothing comes nearer to than the search height is not in the list.
///
/// The path is run in stretches, a pass each where that is neither too many nor too few; what one stretch cuts twice counts once, when it
/// is cut deepest. Errors: as [`verify`](super::verify).
pub fn removal(
    cutter: &Cutter,
    path: &Toolpath,
    samples: &Samples,
    options: &Options,
    stage: &Stage,
) -> Result<Vec<Removal>, VerifyError> {
    options.check()?;
    check_path(path)?;
    let starts = stretches(&path.moves);
    let mut left = vec![options.search; samples.samples.len()];
    let mut removals: Vec<Removal> = Vec::new();
    for (k, pair) in starts.windows(2).enumerate() {
        stage.at(k as f64 / starts.len() as f64)?;
        // The first move of a stretch leads on from where the one before ended.
        let begin = pair[0].saturating_sub(1);
        let stretch = Toolpath { moves: path.moves[begin..pair[1]].to_vec() };
        let scene = Scene::new(Body::new(cutter, options.shank), &stretch, -options.depth, options.search);
        let hits = scene.cut(left.len(), |i| scene.line(&samples.samples[i]), &stage.quiet())?;
        let first = removals.len();
        for (sample, hit) in hits.iter().enumerate() {
            if hit.t < left[sample] {
                left[sample] = hit.t;
                let step = begin as u32 + scene.sweeps.part(hit.part).step();
                removals.push(Removal { step, sample: sample as u32, excess: hit.t });
            }
        }
        removals[first..].sort_by_key(|removal| (removal.step, removal.sample));
    }
    stage.at(1.0)?;
    Ok(removals)
}

/// Where stretches begin, and the number of moves.
fn stretches(moves: &[Move]) -> Vec<usize> {
    let begins = |k: usize| moves[k].role == Role::Cut && (k == 0 || moves[k - 1].role != Role::Cut);
    let passes: Vec<usize> = (1..moves.len()).filter(|&k| begins(k)).collect();
    let every = passes.len().div_ceil(STRETCHES[1]).max(1);
    let longest = moves.len().div_ceil(STRETCHES[0]).max(1);
    let mut starts = vec![0];
    for next in passes.into_iter().step_by(every).chain([moves.len()]) {
        let from = starts[starts.len() - 1];
        let parts = (next - from).div_ceil(longest);
        starts.extend((1..=parts).map(|part| from + (next - from) * part / parts));
    }
    starts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Face, Plane, Range, Side};
    use crate::math::frame::Frame;
    use crate::toolpath::{ClPoint, Rate};
    use crate::verify::verify;
    use glam::DVec3;

    #[test]
    fn what_is_left_last_is_what_the_proof_finds() {
        let frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
        let plane = Plane { origin: DVec3::ZERO, frame, u: Range::open(0.0, 20.0), v: Range::open(0.0, 9.0) };
        let samples = Samples::of_face(&Face::new(plane, Side::Front), 0.4).unwrap();
        let to = |x: f64, y: f64, z: f64, role| Move {
            to: ClPoint { tip: DVec3::new(x, y, z), axis: DVec3::Z },
            rate: Rate::Feed(1000.0),
            role,
        };
        let mut moves = Vec::new();
        for pass in 0..8 {
            let y = f64::from(pass) * 1.2;
            moves.extend([to(-4.0, y, 3.0, Role::Link), to(-4.0, y, 0.0, Role::Link)]);
            moves.extend(
                (1..=20).map(|k| to(f64::from(k) * 1.4 - 4.0, y, 0.002 * f64::from(pass), Role::Cut)),
            );
            moves.push(to(24.0, y, 3.0, Role::Link));
        }
        let path = Toolpath { moves };
        let ball = Cutter::ball(6.0, 20.0).unwrap();
        let options = Options { most_refined: 0, ..Options::for_height(0.1, &ball) };
        let whole = verify(&ball, &path, &samples, &options, &Stage::silent()).unwrap();
        let removals = removal(&ball, &path, &samples, &options, &Stage::silent()).unwrap();
        let mut left = vec![f64::INFINITY; samples.samples.len()];
        for removal in &removals {
            let here = &mut left[removal.sample as usize];
            assert!(removal.excess < *here && path.moves[removal.step as usize].role != Role::Link);
            *here = removal.excess;
        }
        assert!(removals.is_sorted_by_key(|removal| removal.step));
        assert!(removals.len() > samples.samples.len(), "neighbouring passes overlap");
        for (left, whole) in left.iter().zip(&whole.excess) {
            assert!((left - whole).abs() < 1e-6 || left == whole, "{left} {whole}");
        }
    }
}
