//! Finer samples where the extreme may hide between the coarse ones.

use super::bound::{Sense, bound, bow};
use super::cut::{Hit, Scene, TASK};
use super::samples::{Sample, Samples};
use crate::geometry::{Uv, Zone};
use crate::math::order::{rank, sort_by_key};
use crate::monitor::{Cancelled, Stage};
use glam::DVec3;
use std::collections::BTreeMap;

/// Samples, old and new, with what they met.
pub(super) struct Field<'a> {
    source: &'a Samples,
    pub(super) samples: Vec<Sample>,
    pub(super) hits: Vec<Hit>,
    parameters: Option<Vec<Uv>>,
    /// What is not judged.
    excluded: Option<&'a Zone>,
    /// Whether a sample's excess is judged.
    judged: Vec<bool>,
    /// The samples in the middles of edges: neighbours are seldom split at the same time.
    middles: BTreeMap<(u32, u32), u32>,
}

/// How a search ended.
#[derive(Debug, Clone, Copy)]
pub(super) struct Searched {
    /// The largest value met and the sample where; `None` if no sample counts.
    pub(super) best: Option<(f64, usize)>,
    /// How much larger the true extreme can be.
    pub(super) error: f64,
}

/// How a search goes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Search {
    /// The error to reach, millimetres.
    pub(super) tolerance: f64,
    /// Samples that may be added.
    pub(super) most: usize,
}

/// What a search still has to look at.
#[derive(Debug, Default)]
struct Pending {
    /// Triangles worth splitting, with their bounds.
    open: Vec<(f64, [u32; 3])>,
    /// The most that the extreme may be in all others: what is not worth splitting still limits the promise.
    rest: f64,
    /// Whether the motion is asked before a triangle is suspected: as dear as the samples themselves.
    asks: bool,
}

/// Triangles split in the first round; twice as many in each round after it.
const FIRST_BATCH: usize = 64;
/// Halvings of one triangle in a climb: a 1 mm edge becomes a nanometre.
const CLIMB: usize = 20;

impl<'a> Field<'a> {
    pub(super) fn new(
        source: &'a Samples,
        hits: Vec<Hit>,
        judged: Vec<bool>,
        excluded: Option<&'a Zone>,
    ) -> Self {
        Self {
            source,
            samples: source.samples.clone(),
            excluded,
            judged,
            hits,
            parameters: source.parameters(),
            middles: BTreeMap::new(),
        }
    }

    /// The extreme of the excess over all triangles whose corners count, by branch and bound: while some triangle could
    /// exceed what was met by more than the tolerance, the most promising ones are split in four.
    ///
    /// Each round first climbs: it splits the most promising triangle, the best of its children, and so on. Scallops of one
    /// height along many passes differ little from one another, but all lie above what coarse samples meet; only once
    /// their height is known can most of them be left alone.
    pub(super) fn search(
        &mut self,
        sense: Sense,
        scene: &Scene,
        search: Search,
        stage: &Stage,
    ) -> Result<Searched, Cancelled> {
        let Some(mut best) = self.best(sense, 0, None) else {
            return Ok(Searched { best: None, error: 0.0 });
        };
        let sharp = scene.body.inscribed() <= 0.0;
        // No room for an edge's hull is known while it turns.
        let turns = |hit: &Hit| hit.t.is_finite() && scene.sweeps.part(hit.part).turns();
        if sharp && sense == Sense::Excess && self.hits.iter().any(turns) {
            return Ok(Searched { best: Some(best), error: f64::INFINITY });
        }
        let mut pending = Pending { open: Vec::new(), rest: best.0, asks: search.most > 0 };
        let all = self.source.triangles.iter().copied();
        // Same monitor and workers below, but no progress of their own.
        let part = |at: f64| stage.part("looking between the samples", at, at);
        self.file(sense, scene, all, best.0 + search.tolerance, &mut pending, &part(0.0))?;
        // Splitting does not make an edge any blunter.
        let mut room = if sharp && sense == Sense::Gouge { 0 } else { search.most };
        let mut batch = FIRST_BATCH;
        let mut waiting = 1.0;
        loop {
            let (open, done): (Vec<_>, Vec<_>) = std::mem::take(&mut pending.open)
                .into_iter()
                .partition(|(b, _)| *b > best.0 + search.tolerance);
            pending.rest = highest(&done).max(pending.rest);
            pending.open = open;
            let open = &mut pending.open;
            if open.is_empty() || room < 3 {
                break;
            }
            // Where the surface is too wild for any bound, splitting seldom helps: such triangles come last.
            let key = |bound: f64| if bound.is_finite() { bound } else { f64::NEG_INFINITY };
            sort_by_key(open, |(_, [a, b, c])| (u64::from(*a) << 32 | u64::from(*b), *c));
            sort_by_key(open, |(bound, _)| (!rank(key(*bound)), 0));
            // Nobody knows how many rounds there will be: each takes half of what is left of the stage.
            let quiet = part(1.0 - waiting);
            waiting *= 0.5;
            let begin = self.samples.len();
            let mut children = Vec::new();
            let mut top = open.remove(0);
            for _ in 0..CLIMB {
                let four = self.split(&[top.1], scene, &quiet)?;
                best = self.best(sense, begin, Some(best)).unwrap_or(best);
                let enough = best.0 + 0.25 * search.tolerance;
                let bounds: Vec<f64> = four.iter().map(|t| self.bound(sense, scene, *t, enough)).collect();
                let first = (0..4).fold(0, |a, b| if bounds[b] > bounds[a] { b } else { a });
                children.extend((0..4).filter(|i| *i != first).map(|i| four[i]));
                top = (bounds[first], four[first]);
                if top.0 <= enough {
                    break;
                }
            }
            children.push(top.1);
            let room_left = room.saturating_sub(self.samples.len() - begin);
            let split: Vec<_> =
                open.drain(..batch.min(room_left / 3).min(open.len())).map(|(_, t)| t).collect();
            children.extend(self.split(&split, scene, &quiet)?);
            room = room.saturating_sub(self.samples.len() - begin);
            best = self.best(sense, begin, Some(best)).unwrap_or(best);
            let worth = best.0 + search.tolerance;
            self.file(sense, scene, children.into_iter(), worth, &mut pending, &quiet)?;
            batch *= 2;
        }
        stage.at(1.0)?;
        let rest = highest(&pending.open).max(pending.rest);
        let error = (rest - best.0).max(0.0);
        // Rounding alone must not exceed what was asked.
        let reached = error <= search.tolerance * (1.0 + 1e-9);
        Ok(Searched { best: Some(best), error: if reached { error.min(search.tolerance) } else { error } })
    }

    /// Whether the sample was reached, and is judged.
    fn counts(&self, i: usize) -> bool {
        self.hits[i].t.is_finite() && self.judged[i]
    }

    fn best(&self, sense: Sense, from: usize, before: Option<(f64, usize)>) -> Option<(f64, usize)> {
        (from..self.samples.len()).filter(|&i| self.counts(i)).fold(before, |best, i| {
            let value = sense.value(self.hits[i].t);
            if best.is_some_and(|(most, _)| most >= value) { best } else { Some((value, i)) }
        })
    }

    /// The bound over a triangle, made sharper where it is above `enough`; minus infinite if a corner was never reached or is
    /// excluded: such are not judged.
    fn bound(&self, sense: Sense, scene: &Scene, triangle: [u32; 3], enough: f64) -> f64 {
        let corners = triangle.map(|i| i as usize);
        if !corners.iter().all(|&i| self.counts(i)) {
            return f64::NEG_INFINITY;
        }
        let samples = corners.map(|i| &self.samples[i]);
        let hits = corners.map(|i| &self.hits[i]);
        let most = bound(sense, samples, hits, scene.body.inscribed());
        match sense {
            Sense::Excess if most > enough => most.min(scene.excess_bound(samples, hits)),
            Sense::Excess => most,
            // Deeper is not looked for. Without any bound that would be no promise worth telling.
            Sense::Gouge if scene.body.inscribed() <= 0.0 => most,
            Sense::Gouge => most.min(-scene.from),
        }
    }

    /// Puts those of `triangles` whose bound is above `worth` among the open ones, the others into the rest. Before a gouge
    /// is suspected between samples, the whole motion is asked whether it can be there at all.
    fn file(
        &self,
        sense: Sense,
        scene: &Scene,
        triangles: impl Iterator<Item = [u32; 3]>,
        worth: f64,
        pending: &mut Pending,
        stage: &Stage,
    ) -> Result<(), Cancelled> {
        let triangles: Vec<_> = triangles.collect();
        let enough = if pending.asks { worth } else { f64::INFINITY };
        let bound_task = |task: usize| -> Vec<_> {
            let some = &triangles[task * TASK..triangles.len().min((task + 1) * TASK)];
            some.iter().map(|triangle| (self.bound(sense, scene, *triangle, enough), *triangle)).collect()
        };
        let bounded = stage.map(triangles.len().div_ceil(TASK), bound_task)?.into_iter().flatten();
        let (suspect, done): (Vec<_>, Vec<_>) = bounded.partition(|(bound, _)| *bound > worth);
        pending.rest = highest(&done).max(pending.rest);
        if sense == Sense::Excess || !pending.asks {
            pending.open.extend(suspect);
            return Ok(());
        }
        let patch = |triangle: [u32; 3]| {
            let samples = triangle.map(|i| &self.samples[i as usize]);
            (samples, bow(sense, samples))
        };
        let patches: Vec<_> = suspect.iter().map(|(_, triangle)| patch(*triangle)).collect();
        let spared = scene.spares(&patches, worth, stage)?;
        if spared.contains(&true) {
            pending.rest = pending.rest.max(worth);
        }
        pending.open.extend(suspect.into_iter().zip(spared).filter(|(_, spared)| !spared).map(|(s, _)| s));
        Ok(())
    }

    /// Four triangles for each one, with new samples, cut at once, in the middles of their edges.
    fn split(
        &mut self,
        triangles: &[[u32; 3]],
        scene: &Scene,
        stage: &Stage,
    ) -> Result<Vec<[u32; 3]>, Cancelled> {
        let begin = self.samples.len();
        let mut middles = std::mem::take(&mut self.middles);
        let mut children = Vec::with_capacity(4 * triangles.len());
        for &[a, b, c] in triangles {
            let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(i, j)| {
                *middles
                    .entry((i.min(j), i.max(j)))
                    .or_insert_with(|| self.add_between(i as usize, j as usize))
            });
            children.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        self.middles = middles;
        let added = &self.samples[begin..];
        let hits = scene.cut(added.len(), |i| scene.line(&added[i]), stage)?;
        self.judged.extend(added.iter().map(|sample| is_judged(sample, self.excluded)));
        self.hits.extend(hits);
        Ok(children)
    }

    fn add_between(&mut self, i: usize, j: usize) -> u32 {
        let (a, b) = (self.samples[i], self.samples[j]);
        let flat = Sample { point: 0.5 * (a.point + b.point), normal: a.normal };
        let sample = match (&self.source.face, &mut self.parameters) {
            (Some(face), Some(parameters)) => {
                let (p, q) = (parameters[i], parameters[j]);
                let uv = Uv::new(0.5 * (p.u + q.u), 0.5 * (p.v + q.v));
                parameters.push(uv);
                face.at(uv).map_or(flat, |(jet, normal)| Sample { point: jet.p, normal })
            }
            _ => flat,
        };
        self.samples.push(sample);
        (self.samples.len() - 1) as u32
    }
}

/// Whether a sample's excess says something of the path: it has a normal, and lies outside of what is `excluded`.
pub(super) fn is_judged(sample: &Sample, excluded: Option<&Zone>) -> bool {
    sample.normal != DVec3::ZERO && excluded.is_none_or(|zone| !zone.contains(sample.point))
}

/// The highest bound; minus infinite of nothing.
fn highest(bounded: &[(f64, [u32; 3])]) -> f64 {
    bounded.iter().map(|(bound, _)| *bound).fold(f64::NEG_INFINITY, f64::max)
}
