//! The same surface described anew, and the surface moved.

use super::{Along, NurbsError, NurbsSurface, error, span};
use glam::{DAffine3, DVec4};

impl NurbsSurface {
    /// The surface with every point moved by `map`: exact, since control points follow affine maps.
    #[must_use]
    pub fn transformed(&self, map: &DAffine3) -> Self {
        let moved = |p: &DVec4| (map.matrix3 * p.truncate() + map.translation * p.w).extend(p.w);
        let net = self.net.iter().map(moved).collect();
        Self::from_net(self.degrees, self.counts, self.knots.clone(), net)
    }

    /// The surface grown about the origin by `factor`; the parameters stay what they were.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        self.transformed(&DAffine3::from_scale(glam::DVec3::splat(factor)))
    }

    /// The surface with u and v exchanged, which exchanges front and back.
    #[must_use]
    pub fn swapped(&self) -> Self {
        let [nu, nv] = self.counts;
        let net =
            (0..nv).flat_map(|j| (0..nu).map(move |i| (i, j))).map(|(i, j)| self.net[i * nv + j]).collect();
        let [ku, kv] = self.knots.clone();
        Self::from_net([self.degrees[1], self.degrees[0]], [nv, nu], [kv, ku], net)
    }

    /// The same surface with one more knot at `x` in `along`, which must lie inside the domain and stand there less often than
    /// the degree.
    ///
    /// Source: Piegl, Tiller, The NURBS Book, eq. 5.15.
    pub fn with_knot(&self, along: Along, x: f64) -> Result<Self, NurbsError> {
        if along == Along::U {
            return self.swapped().with_knot(Along::V, x).map(|surface| surface.swapped()).map_err(
                |e| match e {
                    NurbsError::Outside { value, .. } => NurbsError::Outside { along, value },
                    NurbsError::Multiplicity { value, found, most, .. } => {
                        NurbsError::Multiplicity { along, value, found, most }
                    }
                    other => other,
                },
            );
        }
        let ([nu, nv], p) = (self.counts, self.degrees[1]);
        let knots = &self.knots[1];
        if !(knots[p] < x && x < knots[nv]) {
            return Err(NurbsError::Outside { along, value: x });
        }
        let k = span(knots, p, nv, x);
        let mut refined = knots.clone();
        refined.insert(k + 1, x);
        error::check_knots(along, p, &refined)?;
        let mut net = Vec::with_capacity(nu * (nv + 1));
        for row in self.net.chunks_exact(nv) {
            for j in 0..=nv {
                // Points before the knot's reach stay, points after it move up by one, those between are blended.
                net.push(if j + p <= k {
                    row[j]
                } else if j > k {
                    row[j - 1]
                } else {
                    let t = (x - knots[j]) / (knots[j + p] - knots[j]);
                    row[j - 1] * (1.0 - t) + row[j] * t
                });
            }
        }
        Ok(Self::from_net(self.degrees, [nu, nv + 1], [self.knots[0].clone(), refined], net))
    }
}
