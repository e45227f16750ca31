//! The corners of a face beyond the first and the last pass of a family of planes.

use super::family::{Candidate, Family};
use super::probe::Setup;
use super::spacing::Toward;
use super::walk;
use crate::contact::Body;
use crate::geometry::{Field, Uv};
use crate::toolpath::ClPoint;

/// Places looked at between two nodes of a pass, which are half a strip apart.
const BETWEEN: usize = 8;

impl Family<'_> {
    /// Whether the cutter on the lines of `candidate` leaves at most the scallop limit on all that lies beyond them
    /// on that side.
    pub(super) fn cuts_beyond(&self, candidate: &Candidate, toward: Toward) -> bool {
        let bodies = self.bodies(candidate);
        // Chords over a hollow run above the line.
        let limit = self.setup.finish.scallop - self.setup.finish.chord;
        self.lines.nodes_beyond(candidate.level, toward == Toward::Higher).all(|uv| {
            // Where there is no normal nothing can be measured.
            let Some((jet, n)) = self.setup.face.at(uv) else { return true };
            let top = jet.p + n * limit;
            bodies.iter().any(|body| body.distance(top) <= 0.0)
        })
    }

    /// The cutter at its places along the lines of `candidate`, and as it begins before them and goes on beyond.
    fn bodies(&self, candidate: &Candidate) -> Vec<Body> {
        let Setup { face, cutter, .. } = &self.setup;
        let course = self.setup.course(candidate.reversed);
        let body = |uv: Uv| {
            let on_line = course.onto_level(face, candidate.level, uv)?;
            Some(Body::new(cutter, &self.setup.station(on_line, candidate.reversed)?.cl))
        };
        let between = |pair: &[Uv], k: usize| {
            let s = k as f64 / BETWEEN as f64;
            Uv::new(pair[0].u + (pair[1].u - pair[0].u) * s, pair[0].v + (pair[1].v - pair[0].v) * s)
        };
        let pairs = candidate.lines.iter().flat_map(|line| line.nodes.windows(2));
        let along = pairs.flat_map(|pair| (0..=BETWEEN).filter_map(move |k| body(between(pair, k))));
        // Planes cut borders more aslant than the run-out makes up for: on a lens corners stayed a quarter above the limit.
        let counts = matches!(self.setup.field, Field::Given(_));
        let ends = candidate
            .lines
            .iter()
            .filter(|_| counts)
            .flat_map(|line| walk::ends(&self.setup, line, candidate.reversed));
        let moved = |[a, b]: [ClPoint; 2], k: usize| {
            let s = k as f64 / BETWEEN as f64;
            let axis = a.axis.lerp(b.axis, s).try_normalize()?;
            Some(Body::new(cutter, &ClPoint { tip: a.tip.lerp(b.tip, s), axis }))
        };
        let beyond = ends.flat_map(|ends| (1..=BETWEEN).filter_map(move |k| moved(ends, k)));
        along.chain(beyond).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cutter::{Cutter, Tool};
    use crate::geometry::{Face, FaceGrid, Plane, Range, Side, Table};
    use crate::math::frame::Frame;
    use crate::monitor::Stage;
    use crate::posture::Rule;
    use crate::strategy::probe::{Probe, Reach};
    use crate::strategy::{Finish, Order};
    use crate::toolpath::Posture;
    use glam::DVec3;
    use std::sync::Arc;

    /// A yawed cutter's strip lies aslant, and in the corner where a pass begins or ends only its run-out cuts.
    #[test]
    fn the_first_pass_of_a_yawed_cutter_lies_half_its_strip_inside() {
        let frame = Frame { f: DVec3::X, b: DVec3::Y, n: DVec3::Z };
        let (u, v) = (Range::open(0.0, 40.0), Range::open(0.0, 30.0));
        let face = Face::new(Plane { origin: DVec3::ZERO, frame, u, v }, Side::Front);
        let tool = Tool { cutter: Cutter::bull_nose(10.0, 2.0, 40.0).unwrap(), holder: None };
        let rule = Rule::Fixed(Posture { lead: 0.1, yaw: 0.5 });
        let grid = FaceGrid::new(&face, 0.5, 24, 100);
        let levels = Field::Given(Arc::new(Table::new(face.domain(), &grid, &Field::V.at_nodes(&grid))));
        let (finish, fields) = (Finish { scallop: 0.01, chord: 0.0001 }, (levels, Field::U));
        let stage = Stage::silent();
        let family = Family::new(&face, &tool, &rule, finish, fields, Order::ZigZag, &stage).unwrap();
        let Probe::Strip { down: Reach::To { level, .. }, .. } =
            family.setup.probe(Uv::new(20.0, 15.0), false)
        else {
            panic!("no strip")
        };
        let (half, first) = (15.0 - level, family.first(&stage).unwrap().level);
        assert!((0.97..=1.0).contains(&(first / half)), "{first} of {half}");
    }
}
