//! Passes cut back at their ends, as far as nothing is left where they were.
//!
//! How far a pass must run out over a border, or on beside one that ends, no formula for a single strip tells exactly: what lies
//! at its end may be cut by its neighbours too. Here places all around the ends are asked which moves cut them, and what no place
//! needs is taken away.

use super::family::Family;
use super::left::{Moves, Near, Part};
use super::places;
use crate::geometry::Uv;
use crate::math::bvh::{Aabb, Bvh};
use crate::math::order::{rank, sort_by_key};
use crate::monitor::{Cancelled, Stage};
use crate::toolpath::{Pass, Station};
use glam::DVec3;
use std::ops::Range;

mod give_back;

/// How much of an end is looked at in a round, and how far from it places may need it, in strips.
const WINDOW: f64 = 2.0;
const AROUND: f64 = 1.0;
/// Rounds: an end of which a whole window went is looked at again.
const ROUNDS: usize = 12;
/// Parts that a side of a cell of the family's grid has, and one that lies on a border: strips that lie aslant leave their
/// smallest spots right there.
const PARTS: [usize; 2] = [4, 24];
/// Parts of the piece of an edge between neighbouring probes: where strips meet cusps are highest.
const EDGE: usize = 24;
/// The share of the limit that is asked for at the places, so that those between them stay within it; where more was left before,
/// the whole limit is.
const SHARE: f64 = 0.9;
/// What an end keeps beyond what the places need, in strips on flat ground.
const SAFE: f64 = 0.04;
/// Halvings of the last move that is needed.
const HALVINGS: usize = 6;
/// The widest strip that counts, in strips on flat ground.
const WIDE: f64 = 4.0;
/// Places that are asked at once what cuts them.
const GROUP: usize = 32;
/// Items in a leaf of a tree.
const LEAF: usize = 8;

/// An end of a pass.
#[derive(Debug, Clone, Copy)]
struct End {
    pass: usize,
    side: Side,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    First,
    Last,
}

/// A place on the face, its normal, and the share of the limit that may be left there.
#[derive(Debug, Clone, Copy)]
struct Place {
    point: DVec3,
    normal: DVec3,
    share: f64,
}

/// A place that nothing but moves at ends cuts.
struct Open {
    place: Place,
    /// The numbers of those moves.
    cutters: Vec<usize>,
}

/// `passes` cut back at their ends as far as no more than the limit is left for it; a pass that nothing needs is gone. Of the strips
/// on the passes these are pieces of the `edges`.
pub(super) fn trimmed(
    family: &Family,
    passes: &[Vec<Pass>],
    edges: &[[Uv; 2]],
    stage: &Stage,
) -> Result<Vec<Vec<Pass>>, Cancelled> {
    let part = |from, to| stage.part("Cutting passes back", from, to);
    let mut trim = Trim::new(family, passes);
    trim.cut_back_all(edges, &part(0.0, 0.7))?;
    let lost = trim.lost(&part(0.7, 1.0))?;
    trim.give_back(&lost, &part(1.0, 1.0))?;
    let mut runs = 0..trim.runs.len();
    let kept = passes.iter().map(|track| {
        let own = runs.by_ref().take(track.len());
        own.filter_map(|pass| trim.pass(pass)).collect()
    });
    Ok(kept.collect())
}

struct Trim<'a> {
    family: &'a Family<'a>,
    moves: Moves<'a>,
    /// What is left of each move.
    left: Vec<Option<Part>>,
    /// The moves of each pass.
    runs: Vec<Range<usize>>,
    /// How far moves cut from where they touch, mm.
    wide: f64,
    /// The cells of the family's grid.
    cells: Bvh,
}

impl<'a> Trim<'a> {
    fn new(family: &'a Family, passes: &[Vec<Pass>]) -> Self {
        let moves = Moves::new(&family.setup, passes.iter().flatten());
        let mut from = 0;
        let runs = passes.iter().flatten().map(|pass| {
            let to = from + pass.stations.len() - 1;
            std::mem::replace(&mut from, to)..to
        });
        let runs = runs.collect();
        let grid = family.lines.grid();
        let across = grid.size().0 - 1;
        let cell = |k: usize| {
            let (i, j) = (k % across, k / across);
            Aabb::around([(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)].map(|(i, j)| grid.point(i, j)))
        };
        let cells: Vec<Aabb> = (0..across * (grid.size().1 - 1)).map(cell).collect();
        let left = moves.all().iter().copied().map(Some).collect();
        let mut trim = Self { family, moves, left, runs, wide: 0.0, cells: Bvh::new(&cells, LEAF) };
        trim.wide = AROUND * trim.strip(&(0..trim.moves.all().len()));
        trim
    }

    /// Cuts back all ends.
    fn cut_back_all(&mut self, edges: &[[Uv; 2]], stage: &Stage) -> Result<(), Cancelled> {
        let both = |pass| [Side::First, Side::Last].map(|side| End { pass, side });
        let mut ends: Vec<End> = (0..self.runs.len()).flat_map(both).collect();
        // What is short may go altogether.
        sort_by_key(&mut ends, |end| (rank(self.length(end.pass)), end.pass as u32));
        for round in 0..ROUNDS {
            stage.at(round as f64 / ROUNDS as f64)?;
            if ends.is_empty() {
                break;
            }
            ends = self.round(&ends, edges, &stage.quiet())?;
        }
        Ok(())
    }

    /// The moves of a pass of which something is left.
    fn run(&self, pass: usize) -> Range<usize> {
        let mut run = self.runs[pass].clone();
        while !run.is_empty() && self.left[run.start].is_none() {
            run.start += 1;
        }
        while !run.is_empty() && self.left[run.end - 1].is_none() {
            run.end -= 1;
        }
        run
    }

    /// Length of what is left of a pass, mm.
    fn length(&self, pass: usize) -> f64 {
        self.left[self.run(pass)].iter().flatten().map(Part::way).sum()
    }

    /// What is left of a pass.
    fn pass(&self, pass: usize) -> Option<Pass> {
        let mut moves = self.left[self.run(pass)].iter().flatten().map(|part| part.ends).peekable();
        let first = moves.peek()?[0];
        Some(Pass { stations: std::iter::once(first).chain(moves.map(|[_, b]| b)).collect() })
    }

    /// Cuts back each of `ends` within a window; those of which the whole window went, and something is left.
    fn round(&mut self, ends: &[End], edges: &[[Uv; 2]], stage: &Stage) -> Result<Vec<End>, Cancelled> {
        let windows: Vec<Range<usize>> = ends.iter().map(|end| self.window(end)).collect();
        let near: Vec<Aabb> = windows.iter().map(|window| self.around(window)).collect();
        let mut stays: Vec<bool> = self.left.iter().map(Option::is_some).collect();
        windows.iter().for_each(|window| stays[window.clone()].fill(false));
        let places = self.places(&near, edges);
        let open = stage.map(places.len(), |k| self.open(&places[k], &stays))?;
        let open: Vec<Open> = open.into_iter().flatten().collect();
        let of_ends = self.sorted_by_end(&open, ends, &windows);
        let mut gone = Vec::new();
        for ((end, window), mine) in ends.iter().zip(windows).zip(of_ends) {
            stage.at(0.0)?;
            // The pass's other end may have gone farther than this one's window.
            let run = self.run(end.pass);
            let window = window.start.max(run.start)..window.end.min(run.end);
            if window.is_empty() {
                gone.extend((!run.is_empty()).then_some(*end));
                continue;
            }
            let needed = stage.map(mine.len(), |k| self.needed(end, &window, &open[mine[k]]))?;
            let last = needed.into_iter().flatten().reduce(|a, b| if b > a { b } else { a });
            self.cut_back(end, window, last);
            if last.is_none() && !self.run(end.pass).is_empty() {
                gone.push(*end);
            }
        }
        Ok(gone)
    }

    /// Those of `places`, which lie near one another, that moves cut of which none stays, with those.
    fn open(&self, places: &[Place], stays: &[bool]) -> Vec<Open> {
        let around = self.around_places(places);
        let near = self.moves.near(around, self.wide, |k| self.left[k].as_ref());
        places.iter().filter_map(|place| self.open_place(*place, &near, stays)).collect()
    }

    /// `place` with the moves that cut it, if none of those does that stay; with the whole limit where none cuts lower.
    fn open_place(&self, place: Place, near: &Near, stays: &[bool]) -> Option<Open> {
        for share in [place.share, 1.0] {
            let (place, mut cutters) = (Place { share, ..place }, Vec::new());
            let stays_cut = near.find(
                self.asked(&place),
                |k| self.left[k].as_ref(),
                |k| {
                    cutters.push(k);
                    stays[k]
                },
            );
            if stays_cut {
                return None;
            }
            if !cutters.is_empty() {
                return Some(Open { place, cutters });
            }
        }
        None
    }

    /// For each of `ends` the numbers of the places that moves in its window cut.
    fn sorted_by_end(&self, open: &[Open], ends: &[End], windows: &[Range<usize>]) -> Vec<Vec<usize>> {
        // A move may lie at both ends of a short pass.
        let mut holders = [(); 2].map(|()| vec![None; self.left.len()]);
        for (i, (end, window)) in ends.iter().zip(windows).enumerate() {
            holders[usize::from(end.side == Side::Last)][window.clone()].fill(Some(i));
        }
        let mut sorted = vec![Vec::new(); ends.len()];
        for (place, open) in open.iter().enumerate() {
            for &k in &open.cutters {
                for end in holders.iter().filter_map(|holder| holder[k]) {
                    if sorted[end].last() != Some(&place) {
                        sorted[end].push(place);
                    }
                }
            }
        }
        sorted
    }

    /// Whether what is left of the moves leaves no more at a place than may be.
    fn cut(&self, place: &Place) -> bool {
        self.moves.cut(self.asked(place), self.wide, |k| self.left[k].as_ref())
    }

    /// A place, and what above it must be taken away.
    fn asked(&self, place: &Place) -> (DVec3, DVec3) {
        let Place { point, normal, share } = *place;
        (point, point + normal * (share * self.family.setup.finish.scallop))
    }

    /// The middle of some places and of what lies above them by up to the limit, and how far from it that reaches, mm.
    fn around_places(&self, places: &[Place]) -> (DVec3, f64) {
        let ends = |place: &Place| <[DVec3; 2]>::from(self.asked(&Place { share: 1.0, ..*place }));
        Aabb::around(places.iter().flat_map(ends)).ball()
    }

    /// The moves at an end that are looked at.
    fn window(&self, end: &End) -> Range<usize> {
        let run = self.run(end.pass);
        let mut window = match end.side {
            Side::First => run.start..run.start,
            Side::Last => run.end..run.end,
        };
        let mut open = WINDOW * self.strip(&run);
        while open > 0.0 && window.len() < run.len() {
            let next = match end.side {
                Side::First => {
                    window.end += 1;
                    window.end - 1
                }
                Side::Last => {
                    window.start -= 1;
                    window.start
                }
            };
            open -= self.left[next].as_ref().map_or(0.0, Part::way);
        }
        window
    }

    /// The widest strip on some moves, mm.
    fn strip(&self, moves: &Range<usize>) -> f64 {
        let flat = self.family.setup.strip;
        let strips = self.moves.all()[moves.clone()].iter().filter_map(|part| part.ends[0].work.strip);
        strips.fold(flat, f64::max).min(WIDE * flat)
    }

    /// A box around what some moves may cut.
    fn around(&self, window: &Range<usize>) -> Aabb {
        let moves = self.left[window.clone()].iter().flatten();
        let tight = Aabb::around(moves.flat_map(|part| part.ends).map(|station| station.cc.point));
        let margin = DVec3::splat(AROUND * self.strip(window));
        Aabb { lo: tight.lo - margin, hi: tight.hi + margin }
    }

    /// Places in the cells and on the edges that meet one of `boxes`, in groups that lie near one another.
    fn places(&self, boxes: &[Aabb], edges: &[[Uv; 2]]) -> Vec<Vec<Place>> {
        let tree = Bvh::new(boxes, LEAF);
        let face = self.family.setup.face;
        let is_in_reach = |edge: &&[Uv; 2]| {
            let around = Aabb::around(edge.map(|uv| face.surface.point(uv)));
            let meets = |boxes: &Aabb| if boxes.meets(&around) { 1.0 } else { 0.0 };
            let any = |at: Range<usize>, best| {
                at.map(|at| meets(&boxes[tree.order()[at] as usize])).fold(best, f64::max)
            };
            tree.highest(0.0, |node| meets(&tree.boxes()[node]), any) > 0.0
        };
        let cells = self.cells_near(boxes);
        let inside = cells.iter().flat_map(|&cell| {
            let places = self.family.places_in(cell, PARTS);
            places.chunks(GROUP).map(<[Uv]>::to_vec).collect::<Vec<_>>()
        });
        let edges = edges.iter().filter(is_in_reach);
        let edges = edges.map(|&[a, b]| (0..EDGE).map(|k| places::between(a, b, k, EDGE)).collect());
        let places = |group: Vec<Uv>| group.into_iter().filter_map(|uv| self.place(uv, SHARE)).collect();
        inside.chain(edges).map(places).collect()
    }

    /// The cells that meet one of `boxes`.
    fn cells_near(&self, boxes: &[Aabb]) -> Vec<(usize, usize)> {
        let mut is_near = vec![false; self.cells.order().len()];
        for near in boxes {
            let mark = |at| is_near[self.cells.order()[at] as usize] = true;
            self.cells.visit_places(|cell| cell.meets(near), mark);
        }
        let across = self.family.lines.grid().size().0 - 1;
        (0..is_near.len()).filter(|&k| is_near[k]).map(|k| (k % across, k / across)).collect()
    }

    fn place(&self, uv: Uv, share: f64) -> Option<Place> {
        self.family.setup.face.at(uv).map(|(jet, normal)| Place { point: jet.p, normal, share })
    }

    /// The last move of a window, counted from inside, that a place needs, and the share of it; nothing if something else still cuts
    /// it, or nothing does.
    fn needed(&self, end: &End, window: &Range<usize>, open: &Open) -> Option<(usize, f64)> {
        let (_, top) = self.asked(&open.place);
        let (mine, others) = open.cutters.iter().partition::<Vec<usize>, _>(|k| window.contains(k));
        let cuts = |part: &Part| self.moves.cuts(part, top);
        if others.iter().any(|&k| self.left[k].as_ref().is_some_and(cuts)) {
            return None;
        }
        let place = |k: usize| match end.side {
            Side::First => window.end - 1 - k,
            Side::Last => k - window.start,
        };
        let mine = mine.into_iter().filter(|&k| self.left[k].as_ref().is_some_and(cuts));
        let at = mine.map(place).min()?;
        Some((at, self.enough(&self.outward(end, window, at)?, top)))
    }

    /// The share of a move, which cuts `top`, that is enough for it.
    fn enough(&self, [a, b]: &[Station; 2], top: DVec3) -> f64 {
        let (mut short, mut enough) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (short + enough);
            let cuts = self.moves.cuts(&self.moves.part([*a, between(a, b, middle)]), top);
            *(if cuts { &mut enough } else { &mut short }) = middle;
        }
        enough
    }

    /// What is left of the move of a window with the number `at`, counted from inside, as it leads outwards.
    fn outward(&self, end: &End, window: &Range<usize>, at: usize) -> Option<[Station; 2]> {
        match end.side {
            Side::First => self.left[window.end - 1 - at].map(|Part { ends: [a, b], .. }| [b, a]),
            Side::Last => self.left[window.start + at].map(|part| part.ends),
        }
    }

    /// Takes away what lies beyond the share of the move `last`, and a little more, of a window; all of it if nothing is needed.
    fn cut_back(&mut self, end: &End, window: Range<usize>, last: Option<(usize, f64)>) {
        let mut keep = 0;
        let mut more = SAFE * self.family.setup.strip;
        let (first, mut from) = last.unwrap_or((window.len(), 0.0));
        for at in first..window.len() {
            let Some([a, b]) = self.outward(end, &window, at) else { break };
            keep = at + 1;
            let length = way(&[a, b]);
            if length * (1.0 - from) > more {
                let station = between(&a, &b, from + more / length);
                match end.side {
                    Side::First => self.left[window.end - 1 - at] = Some(self.moves.part([station, a])),
                    Side::Last => self.left[window.start + at] = Some(self.moves.part([a, station])),
                }
                break;
            }
            more -= length * (1.0 - from);
            from = 0.0;
        }
        let beyond = match end.side {
            Side::First => window.start..window.end - keep,
            Side::Last => window.start + keep..window.end,
        };
        self.left[beyond].fill(None);
    }
}

/// Way of the tip, mm.
fn way([a, b]: &[Station; 2]) -> f64 {
    a.cl.tip.distance(b.cl.tip)
}

/// The station a share of the straight move from `a` to `b` on.
fn between(a: &Station, b: &Station, share: f64) -> Station {
    let mut station = *b;
    station.cl.tip = a.cl.tip.lerp(b.cl.tip, share);
    station.cl.axis = a.cl.axis.lerp(b.cl.axis, share).normalize_or(a.cl.axis);
    station.cc.point = a.cc.point.lerp(b.cc.point, share);
    station
}
