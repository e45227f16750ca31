//! The best of all strategies for a job.

use super::compare::{Contender, contenders, holds};
use super::error::JobError;
use super::run::{Plan, plan};
use super::shape::Shape;
use super::spec::{ObjectiveSpec, Spec, StrategySpec};
use crate::geometry::Face;
use crate::monitor::Stage;
use crate::posture::Rule;
use crate::strategy::Promises;

/// What should come out longer by this share than the quickest that is laid is laid only where that does not hold: at fixed postures; and
/// where they are chosen, since strips keep less to the surface's second order then.
const WORSE: [f64; 2] = [1.1, 1.3];

/// Plans the job with the strategies that apply, and proves the quickest first, until one holds: that one. Where none does, the quickest
/// of all.
///
/// Quick is the whole program at its feeds, links and rapid ways included; or, where length is the objective, what has the shortest cuts.
/// What by the co-area formula should come out much longer than the quickest is laid only where that does not hold.
/// Strategies that cannot be planned are passed over, unless none can.
pub(super) fn auto(spec: &Spec, bytes: Option<&[u8]>, stage: &Stage) -> Result<Plan, JobError> {
    let (all, (shape, _)) = (contenders(spec, bytes)?, spec.source.shape(bytes)?);
    let promised = match &shape {
        Shape::Face(face) => promised(spec, face, all, &stage.part("Comparing directions", 0.0, 0.05))?,
        Shape::Mesh(_) => all.into_iter().map(|contender| (0.0, contender)).collect(),
    };
    let worse = match spec.strategy.rule()? {
        Some(Rule::Fixed(_)) | None => WORSE[0],
        Some(Rule::Matched(_) | Rule::Widest(_)) => WORSE[1],
        // What lifts save no formula tells.
        Some(Rule::TwoContacts(_)) => f64::INFINITY,
    };
    let mut contest = Contest { spec, bytes, laid: Vec::new(), why: None };
    let mut spare = Vec::new();
    let count = promised.len() as f64;
    for (k, (promise, contender)) in promised.into_iter().enumerate() {
        let at = |k: usize| 0.05 + 0.75 * k as f64 / count;
        if promise > worse * contest.length() {
            spare.push((promise, contender));
        } else {
            contest.lay(&contender, &stage.part("Planning", at(k), at(k + 1)))?;
        }
    }
    let last = stage.part("Cutting in simulation", 0.8, 1.0).quiet();
    spare.reverse();
    loop {
        // What the quickest seemed to be worth may not have held.
        let found = contest.quickest_that_holds(&last)?;
        let most = found.as_ref().map_or(f64::INFINITY, |(length, _)| worse * length);
        match (spare.pop_if(|(promise, _)| *promise <= most), found) {
            (Some((_, contender)), _) => contest.lay(&contender, &last)?,
            (None, Some((_, plan))) => return Ok(plan),
            (None, None) => return contest.quickest(),
        }
    }
}

/// The contenders, each after about how long its passes should be, mm, the shortest first.
fn promised(
    spec: &Spec,
    face: &Face,
    contenders: Vec<Contender>,
    stage: &Stage,
) -> Result<Vec<(f64, Contender)>, JobError> {
    let rule = spec.strategy.rule()?.unwrap_or(Rule::Fixed(Default::default()));
    let promises = Promises::new(face, &spec.cutter.cutter()?, &rule, &spec.finish()?, stage)?;
    let promise = |strategy: &StrategySpec| match strategy {
        StrategySpec::IsoParametric { along, .. } => promises.iso_parametric((*along).into()),
        StrategySpec::IsoPlanar { angle_deg, .. } => promises.iso_planar(angle_deg.to_radians()),
        StrategySpec::ConstantScallop { start, start_percent, start_points_mm, angle_deg, .. } => {
            let start = start.start(*start_percent, *angle_deg, start_points_mm);
            promises.constant_scallop(&start).unwrap_or(0.0)
        }
        StrategySpec::PotentialField { .. } => promises.potential_field().unwrap_or(0.0),
        // It is the shortest of what it compares.
        StrategySpec::Flow { .. } | StrategySpec::Raster { .. } | StrategySpec::Auto { .. } => 0.0,
    };
    let mut promised: Vec<(f64, Contender)> =
        contenders.into_iter().map(|contender| (promise(&contender.spec.strategy), contender)).collect();
    promised.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(promised)
}

/// A plan, and how good it is.
struct Laid {
    plan: Plan,
    /// By the objective: the less the better.
    cost: f64,
    /// Of its cuts, mm.
    length: f64,
    /// Whether it was cut in simulation and does not hold.
    is_out: bool,
}

/// What was laid so far, the quickest first, and why what could not be could not.
struct Contest<'a> {
    spec: &'a Spec,
    bytes: Option<&'a [u8]>,
    laid: Vec<Laid>,
    why: Option<JobError>,
}

impl Contest<'_> {
    /// The length of the quickest's cuts, mm; infinite as long as there is none.
    fn length(&self) -> f64 {
        self.laid.first().map_or(f64::INFINITY, |laid| laid.length)
    }

    fn lay(&mut self, contender: &Contender, stage: &Stage) -> Result<(), JobError> {
        let by_length =
            matches!(self.spec.strategy, StrategySpec::Auto { objective: ObjectiveSpec::Length, .. });
        match plan(&contender.spec, self.bytes, stage) {
            Ok(plan) => {
                let report = plan.report(None);
                let length = report.length.cut_mm;
                let cost = if by_length { length } else { report.time_min };
                self.laid.push(Laid { plan, cost, length, is_out: false });
                // Few, and equals keep their order.
                self.laid.sort_by(|a, b| a.cost.total_cmp(&b.cost));
            }
            Err(JobError::Cancelled(cancelled)) => return Err(cancelled.into()),
            Err(other) => self.why = Some(other),
        }
        Ok(())
    }

    /// With the length of its cuts, mm.
    fn quickest_that_holds(&mut self, stage: &Stage) -> Result<Option<(f64, Plan)>, JobError> {
        for laid in self.laid.iter_mut().filter(|laid| !laid.is_out) {
            let proof = laid.plan.proof(stage)?;
            laid.is_out = !holds(&proof.verified, self.spec.tolerance.scallop_mm);
            laid.plan.proven = Some(Box::new(proof));
            if !laid.is_out {
                return Ok(Some((laid.length, laid.plan.clone())));
            }
        }
        Ok(None)
    }

    fn quickest(self) -> Result<Plan, JobError> {
        let first = self.laid.into_iter().next().map(|laid| laid.plan);
        first.ok_or_else(|| self.why.unwrap_or_else(|| JobError::Strategy("no strategy applies".into())))
    }
}
