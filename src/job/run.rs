//! From a specification to a program that was proven.

use super::error::JobError;
use super::joining::Joining;
use super::picture::Picture;
use super::report::{Lengths, Report, Unreachable, Verified, minutes};
use super::shape::Shape;
use super::spec::{OrderSpec, Spec, StrategySpec, VERSION};
use crate::contact::{DropMesh, FaceObstacle, Underside, is_in_mesh};
use crate::cutter::{Holder, Tool};
use crate::geometry::{Face, TriMesh, Zone};
use crate::monitor::Stage;
use crate::post::{self, Program};
use crate::posture::Rule;
use crate::strategy::{self, LOOK, Linked, Outline, Planned, RasterError, RasterOptions, Refuge};
use crate::toolpath::{ClPoint, Pass, Posture, Touch};
use crate::verify::{self, Histogram, Options, Samples, Verification};
use glam::DVec3;

/// A planned path and the program that states it, not yet proven.
#[derive(Debug, Clone)]
pub struct Plan {
    spec: Spec,
    shape: Shape,
    planned: Planned,
    /// Of the shape, mm².
    area: f64,
    warnings: Vec<String>,
    /// The program as APT cutter-location text.
    pub apt: String,
    /// The program as G-code, for a three-axis path.
    pub nc: Option<String>,
    /// The path as a table.
    pub csv: String,
    /// The program as its own text states it.
    pub emitted: Program,
    /// What every move of the program meets at its end.
    pub touches: Vec<Touch>,
    /// Its proof, where it was chosen by it.
    pub(super) proven: Option<Box<Proof>>,
}

/// What the simulation gives.
#[derive(Debug, Clone)]
pub struct Proof {
    /// In numbers.
    pub verified: Verified,
    /// The shape with its excess, to draw.
    pub picture: Picture,
    /// How the area is spread over the excess.
    pub histogram: Histogram,
}

/// Plans the job of `spec` and writes its program; `bytes` is the content of its file, if its source is one.
///
/// The same specification and bytes give the same program on every target and for any number of workers.
pub fn plan(spec: &Spec, bytes: Option<&[u8]>, stage: &Stage) -> Result<Plan, JobError> {
    #[cfg(feature = "flow")]
    if let StrategySpec::Auto { .. } = spec.strategy {
        return super::auto::auto(spec, bytes, stage);
    }
    stage.part("Reading the shape", 0.0, 0.02).at(0.0)?;
    let cutter = spec.cutter.cutter()?;
    let tool = Tool { cutter, holder: spec.holder(&cutter)? };
    let (shape, mut warnings) = spec.source.shape(bytes)?;
    let planning = stage.part("Planning", 0.02, 0.95);
    let (planned, linked) = match &shape {
        Shape::Face(face) => on_face(spec, face, &tool, &mut warnings, &planning)?,
        Shape::Mesh(mesh) => on_mesh(spec, mesh, &tool, &mut warnings, &planning)?,
    };
    let program = Program {
        part: spec.name.clone(),
        unit: post::Unit::Mm,
        cutter,
        tool: 1,
        spindle_rpm: Some(spec.feeds.spindle_rpm),
        toolpath: linked.toolpath,
    };
    stage.part("Writing the program", 0.95, 1.0).at(0.0)?;
    let apt = post::apt::write(&program);
    let emitted =
        post::apt::read(&apt).map_err(|e| JobError::Post(format!("the program does not read back: {e}")))?;
    if planned.unreached.area() > 0.0 {
        let may = match planned.largest_fit {
            Some(share) => format!(
                "in any posture within the limits; one of the same shape would have to be of at most {:.2} mm diameter",
                share * cutter.diameter
            ),
            None if tool.holder.is_some() => {
                "in this posture with this holder; a smaller cutter, more stick-out or another lead may"
                    .into()
            }
            None => "in this posture; a smaller cutter or another lead may".into(),
        };
        warnings.push(format!("the cutter cannot reach {:.2} mm² {may}", planned.unreached.area()));
    }
    if planned.unseen.area() > 0.0 {
        warnings.push(format!(
            "{:.2} mm² are not seen from above (walls, undersides, what lies below other facets) and left as they are",
            planned.unseen.area()
        ));
    }
    let area = shape.preview_samples()?.area();
    stage.at(1.0)?;
    Ok(Plan {
        spec: spec.clone(),
        area,
        shape,
        planned,
        warnings,
        nc: post::gcode::write(&program).ok(),
        csv: post::csv::write(&emitted.toolpath, &linked.touches),
        apt,
        emitted,
        touches: linked.touches,
        proven: None,
    })
}

impl Plan {
    /// What the cutter cannot reach.
    pub fn unreached(&self) -> &Zone {
        &self.planned.unreached
    }

    /// The path as an SVG picture, seen against the mean of its axes.
    #[cfg(feature = "flow")]
    pub fn drawing(&self) -> String {
        post::svg::write(&self.emitted.toolpath)
    }

    /// Cuts the shape with the motion that was read back from the text; `None` if the specification does not ask for it.
    pub fn prove(&self, stage: &Stage) -> Result<Option<Proof>, JobError> {
        if self.spec.verify.enabled { self.proof(stage).map(Some) } else { Ok(None) }
    }

    /// The proof, asked for or not.
    pub(super) fn proof(&self, stage: &Stage) -> Result<Proof, JobError> {
        if let Some(proof) = &self.proven {
            return Ok(Proof::clone(proof));
        }
        let unreached = self.planned.unreached.joined(&self.planned.unseen);
        let picture = self.shape.picture_samples()?;
        let samples = self.shape.samples(self.spec.verify.spacing_mm)?;
        let scallop = self.spec.tolerance.scallop_mm;
        let options = Options {
            excluded: (!unreached.is_empty()).then_some(&unreached),
            ..Options::for_height(scallop, &self.emitted.cutter)
        };
        let drawn = Options { most_refined: 0, ..options };
        let shown = self.cut(&picture, &drawn, &stage.part("Cutting the picture", 0.0, 0.15))?;
        let proof = self.cut(&samples, &options, &stage.part("Cutting in simulation", 0.15, 1.0))?;
        Ok(Proof {
            verified: Verified::from(&proof.statistics),
            picture: Picture::new(&picture, &shown.excess),
            histogram: proof.statistics.histogram,
        })
    }

    fn cut(&self, samples: &Samples, options: &Options, stage: &Stage) -> Result<Verification, JobError> {
        Ok(verify::verify(&self.emitted.cutter, &self.emitted.toolpath, samples, options, stage)?)
    }

    /// The plan in numbers, with those of `proof` if there is one.
    pub fn report(&self, proof: Option<&Proof>) -> Report {
        let Self { spec, planned, emitted, .. } = self;
        Report {
            version: VERSION,
            name: spec.name.clone(),
            strategy: spec.strategy.kind().into(),
            scallop_mm: spec.tolerance.scallop_mm,
            length: Lengths::of(&emitted.toolpath),
            passes: planned.passes.len(),
            points: emitted.toolpath.moves.len(),
            time_min: minutes(emitted, spec.feeds.rapid_mm_per_min),
            area_mm2: self.area,
            unreachable: Unreachable {
                area_mm2: planned.unreached.area(),
                cell_mm: planned.unreached.cell(),
                unseen_mm2: planned.unseen.area(),
            },
            verified: proof.map(|p| p.verified.clone()),
            warnings: self.warnings.clone(),
        }
    }
}

fn on_face(
    spec: &Spec,
    face: &Face,
    tool: &Tool,
    warnings: &mut Vec<String>,
    stage: &Stage,
) -> Result<(Planned, Linked), JobError> {
    let Tool { cutter, holder } = tool;
    let finish = spec.finish()?;
    let passing = stage.part("Planning", 0.0, 0.95);
    let rule = spec.strategy.rule()?.unwrap_or(Rule::Fixed(Posture::default()));
    let planned = match &spec.strategy {
        &StrategySpec::IsoParametric { along, order, .. } => {
            strategy::iso_parametric(face, tool, along.into(), rule, finish, order.into(), &passing)?
        }
        &StrategySpec::IsoPlanar { angle_deg, order, .. } => {
            let angle = angle_deg.to_radians();
            strategy::iso_planar(face, tool, angle, rule, finish, order.into(), &passing)?
        }
        #[cfg(feature = "flow")]
        StrategySpec::ConstantScallop { start, start_percent, start_points_mm, angle_deg, order, .. } => {
            let start = start.start(*start_percent, *angle_deg, start_points_mm);
            strategy::constant_scallop(face, tool, &start, rule, finish, (*order).into(), &passing)?
        }
        #[cfg(feature = "flow")]
        &StrategySpec::Flow { families, order, .. } => {
            strategy::flow(face, tool, families.into(), rule, finish, order.into(), &passing)?
        }
        #[cfg(feature = "flow")]
        &StrategySpec::PotentialField { least_efficiency_percent, order, .. } => {
            let least = 0.01 * least_efficiency_percent;
            strategy::potential_field(face, tool, least, rule, finish, order.into(), &passing)?
        }
        #[cfg(feature = "flow")]
        StrategySpec::Auto { .. } => {
            return Err(JobError::field("strategy.kind", "auto is planned as one of the others".into()));
        }
        StrategySpec::Raster { .. } => {
            return Err(JobError::field(
                "strategy.kind",
                "raster is for meshes; this shape is a surface".into(),
            ));
        }
    };
    let order = spec.strategy.order();
    let mut passes = ordered(planned.passes, order, false);
    let obstacle = FaceObstacle::for_cutter(face, cutter);
    // Each larger by `more`, to either side of it.
    let clears = |cl: &ClPoint, more: f64| obstacle.clears(cutter, cl, more);
    let holder_clears =
        |cl: &ClPoint, more: f64| holder.is_none_or(|holder| obstacle.clears_holder(&holder, cl, more));
    let joining = Joining {
        how: spec.linking(cutter, holder.as_ref()),
        outline: Outline::new(cutter, holder.as_ref()),
        clears: &clears,
        holder_clears: &holder_clears,
        // What the cutter moves between two looks, to either side.
        more: 0.5 * LOOK,
    };
    let refuge = Refuge::around(obstacle.bounds(), &joining.outline, &joining.how);
    // What is uncut shall stay on one side where that was asked for.
    let may = (order.side().is_none(), false);
    let joined = stage.part("Joining passes", 0.95, 1.0);
    let linked = joining.joined(&mut passes, may, &refuge, warnings, &joined)?;
    Ok((Planned { passes, ..planned }, linked))
}

fn on_mesh(
    spec: &Spec,
    mesh: &TriMesh,
    tool: &Tool,
    warnings: &mut Vec<String>,
    stage: &Stage,
) -> Result<(Planned, Linked), JobError> {
    let Tool { cutter, holder } = tool;
    let StrategySpec::Raster { angle_deg, order } = spec.strategy else {
        let message = "must be raster: this shape is a mesh, which has no parameters".into();
        return Err(JobError::field("strategy.kind", message));
    };
    let finish = spec.finish()?;
    let options = RasterOptions {
        angle: angle_deg.to_radians(),
        scallop: finish.scallop,
        chord: finish.chord,
        // Up at feed, across, and down at plunge feed.
        bridge: spec.links.lift_mm * (2.0 + spec.feeds.cut_mm_per_min / spec.feeds.plunge_mm_per_min),
    };
    let raster = strategy::raster(mesh, cutter, &options, &stage.part("Planning", 0.0, 0.95)).map_err(
        |e| match e {
            RasterError::Cancelled(cancelled) => JobError::Cancelled(cancelled),
            RasterError::Option { field, message } => {
                let field = if field == "angle" {
                    "strategy.angle_deg".into()
                } else {
                    format!("tolerance.{field}_mm")
                };
                JobError::Field { field, message: message.into() }
            }
            RasterError::TooFine { least } => {
                let least = least / spec.tolerance.safety;
                JobError::field("tolerance.scallop_mm", RasterError::TooFine { least }.to_string())
            }
        },
    )?;
    if raster.passes.is_empty() {
        let why = "the cutter fits nowhere on this mesh from above: a smaller cutter, or the other side, may";
        return Err(JobError::Strategy(why.into()));
    }
    let turned = order == OrderSpec::Zigzag;
    let mut passes = ordered(raster.passes, order, turned);
    let top = mesh.bounds().map_or(0.0, |(_, high)| high.z);
    let (lowered, under) = (DropMesh::new(mesh), Underside::new(cutter));
    let held = holder.as_ref().map(Holder::solid).map(|(solid, up)| (Underside::new(&solid), up));
    let clears = |cl: &ClPoint, less: f64| mesh_clears(&lowered, &under, cl, -less);
    let holder_clears =
        |cl: &ClPoint, less: f64| held.is_none_or(|(under, up)| mesh_clears(&lowered, &under, cl, up - less));
    let joining = Joining {
        how: spec.linking(cutter, holder.as_ref()),
        outline: Outline::new(cutter, holder.as_ref()),
        clears: &clears,
        holder_clears: &holder_clears,
        more: LOOK,
    };
    let refuge = Refuge::Above(top + joining.how.clearance);
    let (may, joined) = ((order.side().is_none(), turned), stage.part("Joining passes", 0.95, 1.0));
    let linked = joining.joined(&mut passes, may, &refuge, warnings, &joined)?;
    let (unreached, unseen) = (raster.unreached, raster.unseen);
    Ok((Planned { passes, unreached, unseen, largest_fit: None }, linked))
}

/// Whether what is under an upright cutter, `up` mm above its tip, clears a mesh. Asked in many places, and large where it is inlined.
#[inline(never)]
fn mesh_clears(mesh: &DropMesh, under: &Underside, cl: &ClPoint, up: f64) -> bool {
    !is_in_mesh(mesh, under, cl.tip + DVec3::Z * up)
}

/// Passes in the order in which they are cut, turned where that may be.
fn ordered(passes: Vec<Pass>, order: OrderSpec, turned: bool) -> Vec<Pass> {
    match order.side() {
        Some(side) => strategy::one_sided(passes, side),
        None => strategy::nearest_next(passes, turned),
    }
}

/// The shape of `spec` to draw before anything is planned.
pub fn preview(spec: &Spec, bytes: Option<&[u8]>) -> Result<Picture, JobError> {
    let (shape, _) = spec.source.shape(bytes)?;
    Ok(Picture::new(&shape.preview_samples()?, &[]))
}

impl StrategySpec {
    /// In which order passes are cut.
    fn order(&self) -> OrderSpec {
        match *self {
            Self::IsoParametric { order, .. }
            | Self::IsoPlanar { order, .. }
            | Self::Raster { order, .. } => order,
            #[cfg(feature = "flow")]
            Self::ConstantScallop { order, .. }
            | Self::Flow { order, .. }
            | Self::PotentialField { order, .. }
            | Self::Auto { order, .. } => order,
        }
    }

    /// The value of its `kind`.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::IsoParametric { .. } => "iso_parametric",
            Self::IsoPlanar { .. } => "iso_planar",
            #[cfg(feature = "flow")]
            Self::ConstantScallop { .. } => "constant_scallop",
            #[cfg(feature = "flow")]
            Self::Flow { .. } => "flow",
            #[cfg(feature = "flow")]
            Self::PotentialField { .. } => "potential_field",
            #[cfg(feature = "flow")]
            Self::Auto { .. } => "auto",
            Self::Raster { .. } => "raster",
        }
    }
}
