//! Everything that decides what the cutter does along a family of level lines, put together.

use super::probe::{GOUGE, Setup, contact_frame};
#[cfg(feature = "flow")]
use super::probe::{Probe, Reach};
use super::{Finish, Order};
use crate::contact::FaceObstacle;
use crate::cutter::{Cutter, Tool};
use crate::geometry::{Face, Field};
use crate::monitor::{Cancelled, Stage};
use crate::posture::{Ground, PostureField, Rule, choose};
use crate::toolpath::Posture;

impl<'a> Setup<'a> {
    /// For the level lines of `field` on `face`, for a tool that leans by `rule`.
    pub(super) fn new(
        face: &'a Face,
        tool: &'a Tool,
        rule: &Rule,
        finish: Finish,
        (field, column): (Field, Field),
        order: Order,
        stage: &Stage,
    ) -> Result<Self, Cancelled> {
        let Tool { cutter, holder } = tool;
        let obstacle = FaceObstacle::for_cutter(face, cutter);
        let postures = PostureField::fixed(Posture::default());
        let mut setup = Self {
            face,
            obstacle,
            cutter,
            holder: *holder,
            postures,
            finish,
            field,
            courses: None,
            column,
            strip: 0.0,
        };
        setup.choose(rule, order, stage)?;
        Ok(setup)
    }

    /// Chooses postures for the field that it has now.
    pub(super) fn choose(&mut self, rule: &Rule, order: Order, stage: &Stage) -> Result<(), Cancelled> {
        let (face, cutter, holder, finish) = (self.face, self.cutter, self.holder, &self.finish);
        let feed = |uv, reversed| contact_frame(face, self.course(reversed), uv, reversed);
        let obstacle = &self.obstacle;
        let (scallop, most_lift) = (finish.scallop, rule.most_lift(finish.scallop, finish.chord));
        let ground = Ground { face, obstacle, cutter, holder, feed: &feed, scallop, gouge: GOUGE, most_lift };
        self.postures = choose(rule, &ground, order == Order::ZigZag, stage)?;
        self.strip = 2.0 * probe_spacing(cutter, self.postures.typical(), finish);
        Ok(())
    }

    /// Takes the levels that a strip reaches to from the field that it has now.
    #[cfg(feature = "flow")]
    pub(super) fn relevel(&self, probe: &mut Probe) {
        let Probe::Strip { up, down } = probe else { return };
        for reach in [up, down] {
            if let Reach::To { level, uv, point, .. } = reach {
                *level = self.field.value(*uv, *point);
            }
        }
    }
}

/// Distance between probes along a line, mm: half the strip on flat ground, since strips change about as fast across
/// as along.
fn probe_spacing(cutter: &Cutter, posture: Posture, finish: &Finish) -> f64 {
    let flat = crate::geometry::Curvature::default();
    let strip = crate::contact::second_order_strip_width(cutter, posture, &flat, finish.scallop);
    (0.5 * strip).clamp(0.1, 2.0)
}
