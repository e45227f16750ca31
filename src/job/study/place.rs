//! Places on the surface of a job.

use crate::geometry::{Curvature, Face, FaceGrid, Uv};
use crate::job::error::JobError;
use crate::job::{Shape, Spec};
use crate::math::frame::Frame;
use crate::monitor::Stage;
use crate::posture::Rule;
use crate::strategy::Potential;
use glam::DVec3;
use serde::Serialize;

/// Cells a side of the grid on which the place nearest to a point is looked for.
const CELLS: [usize; 2] = [8, 96];

/// A surface that places are looked up on.
pub struct Subject {
    spec: Spec,
    face: Face,
    grid: FaceGrid,
}

/// What a surface is like at a place.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Place {
    /// Parameters.
    pub u: f64,
    /// See `u`.
    pub v: f64,
    /// Principal curvatures, 1/mm, above 0 where hollow; none at a pole.
    pub least_curvature: Option<f64>,
    /// See `least_curvature`.
    pub most_curvature: Option<f64>,
}

impl Subject {
    /// The surface of `spec`; `None` for a mesh, which has no parameters. `bytes` is the content of its file.
    pub fn new(spec: &Spec, bytes: Option<&[u8]>) -> Result<Option<Self>, JobError> {
        let (Shape::Face(face), _) = spec.source.shape(bytes)? else { return Ok(None) };
        let grid = FaceGrid::new(&face, 1.0, CELLS[0], CELLS[1]);
        Ok(Some(Self { spec: spec.clone(), face, grid }))
    }

    /// The place nearest to `point` (mm).
    pub fn place(&self, point: DVec3) -> Place {
        let uv = self.face.nearest(&self.grid, point);
        let curvature = self.face.at(uv).and_then(|(jet, n)| Curvature::of(&jet, &Frame::any(n)));
        let principal = curvature.map(|curvature| curvature.principal());
        Place {
            u: uv.u,
            v: uv.v,
            least_curvature: principal.map(|principal| principal.min),
            most_curvature: principal.map(|principal| principal.max),
        }
    }

    /// The ends of the parameters: of u, then of v.
    pub fn domain(&self) -> [f64; 4] {
        let domain = self.face.domain();
        [domain.u.lo, domain.u.hi, domain.v.lo, domain.v.hi]
    }

    /// Parameters `u, v` of each of the points `x, y, z` (mm) in `flat`, in their order.
    pub fn parameters(&self, flat: &[f32]) -> Vec<f32> {
        let point = |p: &[f32]| DVec3::new(p[0].into(), p[1].into(), p[2].into());
        let found = flat.chunks_exact(3).map(|p| self.face.nearest(&self.grid, point(p)));
        found.flat_map(|uv| [uv.u as f32, uv.v as f32]).collect()
    }

    /// The machining potential on about `count` by `count` places: `u, v` of each, the direction of the widest strip as a step of
    /// the parameters as long as the strip is wide, and the widths of the widest and the narrowest strip (mm). Poles are left out.
    pub fn potential(&self, count: usize, stage: &Stage) -> Result<Vec<f32>, JobError> {
        let (grid, potential) = potential(&self.spec, &self.face, count, stage)?;
        let nu = grid.size().0;
        let row = |k: usize| {
            let uv: Uv = grid.uv(k % nu, k / nu);
            let (along, [widest, narrowest]) = potential.best(k)?;
            let (du, dv) = self.face.jet(uv).pull_back(along * widest)?;
            Some([uv.u, uv.v, du, dv, widest, narrowest])
        };
        Ok((0..grid.points().len()).filter_map(row).flatten().map(|x| x as f32).collect())
    }
}

/// The potential of `face` at the nodes of a grid of about `count` by `count` cells, for the cutter and the rule of `spec`; for the widest
/// strips where it has none.
pub(super) fn potential(
    spec: &Spec,
    face: &Face,
    count: usize,
    stage: &Stage,
) -> Result<(FaceGrid, Potential), JobError> {
    let grid = FaceGrid::new(face, f64::INFINITY, count, count);
    let rule = spec.strategy.rule()?.unwrap_or(Rule::Widest(Default::default()));
    let potential = Potential::new((face, &grid), &spec.cutter.cutter()?, &rule, &spec.finish()?, stage)?;
    Ok((grid, potential))
}
