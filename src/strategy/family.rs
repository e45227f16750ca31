//! Passes along the level lines of a field, each as far from the last as its strips allow.

use super::fill;
use super::follow::Part;
use super::laid::Laid;
use super::placing::too_many;
use super::probe::{Probe, Reach, Setup};
use super::spacing::{Front, Toward};
use super::{Finish, Order, Planned, StrategyError};
use crate::cutter::Tool;
use crate::geometry::{Domain, Face, FaceGrid, Field, FieldGrid, IsoLine, Range};
use crate::monitor::{Cancelled, Stage};
use crate::posture::Rule;

/// What a person reads meanwhile.
const FILL: &str = "Filling gaps";

/// A family of level lines and the strips on them.
pub(super) struct Family<'a> {
    pub(super) setup: Setup<'a>,
    pub(super) lines: FieldGrid,
    /// The courses that passes follow forwards and backwards, where those are not the level lines.
    courses: Option<[FieldGrid; 2]>,
    /// Levels run in here; periodic where the last pass meets the first again.
    pub(super) levels: Range,
    /// A step that is right on flat ground.
    pub(super) nominal: f64,
    pub(super) column_period: Option<f64>,
    order: Order,
}

/// The lines of one level, or pieces of them, with what the cutter does at their nodes.
#[derive(Clone)]
pub(super) struct Candidate {
    pub(super) level: f64,
    pub(super) lines: Vec<IsoLine>,
    pub(super) probes: Vec<Vec<Probe>>,
    pub(super) reversed: bool,
}

impl<'a> Family<'a> {
    /// The level lines of `field` on `face`, for a tool that leans by `rule`.
    pub(super) fn new(
        face: &'a Face,
        tool: &'a Tool,
        rule: &Rule,
        finish: Finish,
        (field, column): (Field, Field),
        order: Order,
        stage: &Stage,
    ) -> Result<Self, Cancelled> {
        let setup = Setup::new(face, tool, rule, finish, (field, column), order, stage)?;
        Ok(Self::of_setup(setup, order))
    }

    /// The level lines of the field of `setup`.
    pub(super) fn of_setup(setup: Setup<'a>, order: Order) -> Self {
        let face = setup.face;
        let cell = 0.5 * setup.strip;
        let grid = FaceGrid::new(face, cell, 24, 1200);
        Self::on_grid(setup, order, grid)
    }

    /// The level lines of the field of `setup`, looked for on `grid`.
    pub(super) fn on_grid(setup: Setup<'a>, order: Order, grid: FaceGrid) -> Self {
        let (face, cell) = (setup.face, 0.5 * setup.strip);
        let (nu, nv) = grid.size();
        let courses = setup.courses.as_ref().map(|courses| {
            courses.each_ref().map(|course| FieldGrid::new(face, course.clone(), grid.clone()))
        });
        let lines = FieldGrid::new(face, setup.field.clone(), grid);
        let domain = face.domain();
        let (low, high) = lines.range();
        let levels = parameter_range(&domain, &setup.field).unwrap_or(Range::open(low, high));
        // A cell of the grid is half a strip.
        let nominal = match &setup.field {
            Field::U => 2.0 * levels.length() / (nu - 1) as f64,
            Field::V => 2.0 * levels.length() / (nv - 1) as f64,
            Field::Along(_) => 2.0 * cell,
            // Counts passes.
            Field::Given(_) => 1.0,
        };
        let column_period =
            parameter_range(&domain, &setup.column).filter(|r| r.periodic).map(|r| r.length());
        Self { setup, lines, courses, levels, nominal, column_period, order }
    }

    /// Takes another field, given on the grid of its lines with these values.
    #[cfg(feature = "flow")]
    pub(super) fn set_table(&mut self, field: Field, values: &[f64]) {
        self.setup.field = field.clone();
        self.lines.set(field, values);
        let (low, high) = self.lines.range();
        self.levels = Range::open(low, high);
    }

    /// `candidate` as its strips reach in levels of the field that is set now.
    #[cfg(feature = "flow")]
    pub(super) fn relevelled(&self, candidate: &Candidate) -> Candidate {
        let mut changed = candidate.clone();
        for probe in changed.probes.iter_mut().flatten() {
            self.setup.relevel(probe);
        }
        changed
    }

    /// The passes along the level lines of `field` on `face`, for a tool that leans by `rule`.
    pub(super) fn of_rule(
        face: &'a Face,
        tool: &'a Tool,
        rule: &Rule,
        finish: Finish,
        fields: (Field, Field),
        order: Order,
        stage: &Stage,
    ) -> Result<Planned, StrategyError> {
        Ok(Self::shortest((face, tool), rule, finish, fields, order, stage)?.planned)
    }

    /// The passes along the level lines of `fields`, by whichever of the [`Rule::versions`] makes them shortest.
    pub(super) fn shortest(
        part: (&'a Face, &'a Tool),
        rule: &Rule,
        finish: Finish,
        fields: (Field, Field),
        order: Order,
        stage: &Stage,
    ) -> Result<Laid<'a>, StrategyError> {
        Self::improved(part, rule, finish, fields, order, None, stage)?.ok_or_else(too_many)
    }

    /// Those passes where they are better than `best`: shorter, or they leave nothing and those do.
    pub(super) fn improved(
        (face, tool): (&'a Face, &'a Tool),
        rule: &Rule,
        finish: Finish,
        fields: (Field, Field),
        order: Order,
        best: Option<&Laid<'a>>,
        stage: &Stage,
    ) -> Result<Option<Laid<'a>>, StrategyError> {
        let (finish, versions) = (finish.with_fine_chords(), rule.versions());
        let mut found: Option<Laid<'a>> = None;
        let choosing = if matches!(rule, Rule::Fixed(_)) { 0.0 } else { 0.15 };
        for (k, &rule) in versions.iter().enumerate() {
            let part = |name, a: f64, b: f64| {
                let at = |t: f64| (k as f64 + t) / versions.len() as f64;
                stage.part(name, at(a), at(b))
            };
            let first = part("Choosing postures", 0.0, choosing);
            let family = Self::new(face, tool, &rule, finish, fields.clone(), order, &first)?;
            let placed = family.place(&part("Spacing passes", choosing, 0.6))?;
            let tracks = fill::tracks(&family, placed, &part(FILL, 0.6, 0.7))?;
            // Passes run out beyond their lines, and hardly any is cut back to less: where these are longer already, nothing more is
            // asked.
            let length = family.length(&tracks);
            let best = found.as_ref().or(best);
            if best.is_some_and(|best| length >= best.most()) {
                continue;
            }
            let following = part("Following the surface", 0.7, 1.0);
            let laid = Laid::of(
                #[cfg(feature = "flow")]
                rule,
                Part::whole(family, tracks),
                Vec::new(),
                &following,
            )?;
            if best.is_none_or(|best| laid.is_better(best)) {
                found = Some(laid);
            }
        }
        Ok(found)
    }

    /// How long the lines of `tracks` are, mm.
    pub(super) fn length(&self, tracks: &[Candidate]) -> f64 {
        tracks.iter().flat_map(|track| &track.lines).map(|line| line.length(self.setup.face)).sum()
    }

    pub(super) fn front(&self, candidate: &Candidate, toward: Toward) -> Front {
        let beyond: Vec<[f64; 2]> =
            candidate.lines.iter().map(|line| self.setup.run_outs(line, candidate.reversed)).collect();
        let front = Front::new(&candidate.probes, &beyond, toward, self.column_period);
        if matches!(self.setup.field, Field::Given(_)) {
            front.bending(toward, self.setup.strip)
        } else {
            front
        }
    }

    /// Whether passes follow courses beside the level lines.
    pub(super) fn has_courses(&self) -> bool {
        self.courses.is_some()
    }

    /// The lines that passes of this level and way of feed follow.
    pub(super) fn lines_of(&self, level: f64, reversed: bool) -> Vec<IsoLine> {
        self.course(reversed).lines(level)
    }

    /// What passes of this way of feed follow the lines of.
    pub(super) fn course(&self, reversed: bool) -> &FieldGrid {
        self.courses.as_ref().map_or(&self.lines, |courses| &courses[usize::from(reversed)])
    }

    fn reversed(&self, index: usize) -> bool {
        self.order == Order::ZigZag && index % 2 == 1
    }

    pub(super) fn candidate(
        &self,
        level: f64,
        index: usize,
        detail: Detail,
        stage: &Stage,
    ) -> Result<Candidate, Cancelled> {
        // At the very ends a section may be a single point.
        let level = if self.levels.periodic {
            level
        } else {
            level.clamp(self.levels.lo + self.margin(), self.levels.hi - self.margin())
        };
        let mut lines = self.lines_of(level, self.reversed(index));
        if detail == Detail::Sketch {
            lines.iter_mut().for_each(thin);
        }
        self.probed(level, lines, self.reversed(index), stage)
    }

    /// `lines`, all of `level`, with what the cutter does at their nodes.
    pub(super) fn probed(
        &self,
        level: f64,
        lines: Vec<IsoLine>,
        reversed: bool,
        stage: &Stage,
    ) -> Result<Candidate, Cancelled> {
        let nodes: Vec<_> = lines.iter().flat_map(|line| &line.nodes).collect();
        let mut flat = stage.quiet().map(nodes.len(), |i| self.setup.probe(*nodes[i], reversed))?.into_iter();
        let probes = lines.iter().map(|line| flat.by_ref().take(line.nodes.len()).collect()).collect();
        Ok(Candidate { level, lines, probes, reversed })
    }

    /// How far inside its ends the levels stay, since a section through the very corner of a face is a point.
    pub(super) fn margin(&self) -> f64 {
        1e-9 * self.levels.length()
    }
}

/// How many of a line's nodes are looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Detail {
    /// A few, to find a step.
    Sketch,
    /// All.
    Full,
}

/// Keeps every sixth node and the ends, but at least a dozen.
fn thin(line: &mut IsoLine) {
    let last = line.nodes.len() - 1;
    let stride = (line.nodes.len() / 12).clamp(1, 6);
    let mut i = 0;
    line.nodes.retain(|_| {
        i += 1;
        (i - 1) % stride == 0 || i - 1 == last
    });
}

impl Candidate {
    /// Whether the cutter can go everywhere on the lines and its strips run over the border everywhere.
    pub(super) fn runs_over_border(&self, toward: Toward) -> bool {
        let runs_over = |p: &Probe| matches!(p.reach(toward), Some(Reach::Border { .. } | Reach::Aside));
        self.probes.iter().flatten().all(runs_over)
    }
}

/// The interval of the parameter that `field` is, if it is one.
fn parameter_range(domain: &Domain, field: &Field) -> Option<Range> {
    match field {
        Field::U => Some(domain.u),
        Field::V => Some(domain.v),
        Field::Along(_) | Field::Given(_) => None,
    }
}
