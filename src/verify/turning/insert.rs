//! What a round-nose insert leaves.

use super::curve::Move;
use super::ray::{Ray, Sweep, Target};
use crate::toolpath::TurningPath;
use std::f64::consts::{PI, TAU};

/// An insert along a path whose C only rises.
pub(super) struct InsertSweep<'a> {
    path: &'a TurningPath,
    radius: f64,
    /// What is left higher than this counts as uncut, mm.
    search: f64,
}

/// The centre of the nose in the plane of a ray, and from where on along the ray it is the lowest.
#[derive(Debug, Clone, Copy)]
struct Arc {
    rho: f64,
    z: f64,
    from: f64,
}

impl<'a> InsertSweep<'a> {
    pub(super) fn new(path: &'a TurningPath, radius: f64, search: f64) -> Self {
        Self { path, radius, search }
    }

    /// X and Z whenever C is at `angle` or whole turns from it.
    fn passes(&self, angle: f64) -> Vec<[f64; 2]> {
        let points = &self.path.points;
        let (Some(first), Some(last)) = (points.first(), points.last()) else { return Vec::new() };
        let lowest = ((first.c - angle) / TAU).ceil() as i64;
        let highest = ((last.c - angle) / TAU).floor() as i64;
        let mut all = Vec::new();
        for turn in lowest..=highest {
            let c = angle + TAU * turn as f64;
            let after = points.partition_point(|p| p.c < c).clamp(1, points.len() - 1);
            let motion = Move::new(&points[after - 1], &points[after], self.path.interpolation);
            all.push(motion.at_angle(c));
        }
        all
    }

    /// The lower envelope of the nose over the ray: arcs of equal circles, in order.
    fn envelope(&self, ray: &Ray) -> Vec<Arc> {
        let mut centers = self.passes(ray.angle);
        // The nose reaches over the axis to the ray opposite.
        let opposite = self.passes(ray.angle + PI);
        centers.extend(opposite.into_iter().filter(|p| p[0] < self.radius).map(|[x, z]| [-x, z]));
        centers.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        let mut kept: Vec<Arc> = Vec::new();
        for [rho, z] in centers {
            let mut from = f64::NEG_INFINITY;
            let mut lost = false;
            while let Some(last) = kept.last() {
                match crossing(self.radius, [last.rho, last.z], [rho, z]) {
                    Crossing::At(at) => {
                        if at > last.from {
                            from = at;
                            break;
                        }
                        kept.pop();
                    }
                    Crossing::LeftLower => {
                        lost = true;
                        break;
                    }
                    Crossing::RightLower => {
                        kept.pop();
                    }
                }
            }
            if !lost {
                kept.push(Arc { rho, z, from });
            }
        }
        kept
    }
}

impl Sweep for InsertSweep<'_> {
    fn residues(&self, ray: &Ray, targets: &[Target]) -> Vec<f64> {
        let arcs = self.envelope(ray);
        let r = self.radius;
        targets
            .iter()
            .map(|t| {
                let at = arcs.partition_point(|arc| arc.from <= t.rho);
                let Some(arc) = at.checked_sub(1).and_then(|at| arcs.get(at)) else { return f64::INFINITY };
                let aside = t.rho - arc.rho;
                let under = r * r - aside * aside;
                if under <= 0.0 {
                    return f64::INFINITY;
                }
                let residue = (arc.z - under.sqrt() - t.z) * t.normal[2];
                if residue < self.search { residue } else { f64::INFINITY }
            })
            .collect()
    }
}

/// Where the lower halves of two equal circles cross.
enum Crossing {
    At(f64),
    LeftLower,
    RightLower,
}

/// The crossing of the lower halves of circles of radius `r` about `a` and `b`, where `a` is not right of `b`. They cross at most
/// once: on the line that halves the way between the centres.
fn crossing(r: f64, a: [f64; 2], b: [f64; 2]) -> Crossing {
    let (dx, dz) = (b[0] - a[0], b[1] - a[1]);
    let square = dx * dx + dz * dz;
    if dx <= 0.0 {
        return if dz >= 0.0 { Crossing::LeftLower } else { Crossing::RightLower };
    }
    let under = r * r - 0.25 * square;
    if under < 0.0 {
        // Apart: each is the lowest where it is.
        return Crossing::At(0.5 * (a[0] + b[0]));
    }
    let down = (under / square).sqrt();
    // From the middle square to the way between the centres, downwards.
    let at = [0.5 * (a[0] + b[0]) + dz * down, 0.5 * (a[1] + b[1]) - dx * down];
    // On the lower half of both circles; otherwise one lies above the other wherever both are.
    if at[1] > a[1] {
        Crossing::LeftLower
    } else if at[1] > b[1] {
        Crossing::RightLower
    } else {
        Crossing::At(at[0])
    }
}
