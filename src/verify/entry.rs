//! Where a line is first entered by the body during a piece of its motion.

use super::body::Body;
use super::motion::{Piece, Probe};
use glam::DVec3;

/// Distances this small count as touching, millimetres: a tenth of the rounding that the layer promises.
pub(super) const TOUCH: f64 = 1e-10;
/// Certainty asked of a closest approach, millimetres.
const CLOSE: f64 = 1e-11;
/// More rounds than any search met needs (12).
const MOST_ROUNDS: usize = 100;

/// A line `point + t·direction` (unit) and the stretch of it that matters, both ends in millimetres.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    pub(super) point: DVec3,
    pub(super) direction: DVec3,
    pub(super) from: f64,
    pub(super) to: f64,
}

impl Line {
    pub(super) fn at(&self, t: f64) -> DVec3 {
        self.point + self.direction * t
    }
}

/// A line's first entry into the moving body.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry {
    /// Where on the line; its lower end if the body is already there.
    pub(super) t: f64,
    /// Centre of a ball of the corner radius that lies in the body and touches the entry from inside.
    pub(super) ball: DVec3,
    /// When: the part's parameter at which the body is there.
    pub(super) time: f64,
}

/// What the search for the closest approach within a turning piece may miss, millimetres: the aim of 0.05 µm. A local
/// minimum of a function whose second derivative is nowhere below `−κ` is within `κ/2` of the lowest value over a unit
/// interval, and `κ/2` is four times [`Piece::sag`].
const MISS: f64 = 5e-5;
/// Halvings of a part at most; reached only by moves that turn by a right angle over metres.
const MOST_HALVINGS: u32 = 14;

/// The first entry, going up, of `line` into `body` during `part`, which is cut in time where it turns so much that the
/// search could miss the closest approach; `None` if there is none below the line's upper end.
pub(super) fn enter(body: &Body, part: &Piece, line: &Line) -> Option<Entry> {
    halved(body, part, line, MOST_HALVINGS)
}

fn halved(body: &Body, piece: &Piece, line: &Line, left: u32) -> Option<Entry> {
    let middle = piece.probe(body, 0.5, line.at(line.to), line.direction);
    let span = line.to - line.from;
    // Nearly every line misses, and most by so much that the tangents at one pose prove it.
    let down = (middle.by_line + piece.half_turn()).max(0.0) * span;
    let nearer = 0.5 * middle.by_time.abs() + piece.sag(middle.lever) + down;
    if middle.distance - nearer >= -TOUCH {
        return None;
    }
    let (line, depth) = &above_unless_inside(body, piece, line);
    if line.from >= line.to {
        return None;
    }
    if left == 0 || 4.0 * piece.sag(middle.lever + span + 0.5 * piece.length()) <= MISS {
        // Along the normal a wall is as deep as it is thick, and its crest no less.
        return first_entry(body, piece, line, &middle)
            .map(|entry| Entry { t: entry.t.max(*depth), ..entry })
            .filter(|entry| entry.t < line.to);
    }
    let mut found = None;
    let mut line = *line;
    // The half that comes nearer first: it may save the other.
    let first = u32::from(middle.by_time < 0.0);
    for half in [first, 1 - first] {
        if let Some(entry) = halved(body, &piece.part(half, 2), &line, left - 1) {
            line.to = entry.t;
            found = Some(Entry { time: 0.5 * (f64::from(half) + entry.time), ..entry });
        }
    }
    found
}

/// The line from its own point upwards, unless the body holds that point at some time of the piece; and the distance of
/// the point to the body then, at its least: a gouge is never deeper than that.
///
/// A body that lies wholly below the point cuts nothing of the surface there: it stands behind a wall, or beyond an edge.
/// If it went there through the part, it cut the surface where it went in.
fn above_unless_inside(body: &Body, piece: &Piece, line: &Line) -> (Line, f64) {
    if line.from >= 0.0 {
        return (*line, f64::NEG_INFINITY);
    }
    let start = (0.5, piece.probe(body, 0.5, line.at(0.0), line.direction));
    let (_, here) = closest(body, piece, line, 0.0, start, -TOUCH);
    // A turning body may hold the point between the times looked at, by as much as the search may miss.
    let miss = if piece.half_turn() > 0.0 { MISS } else { 0.0 };
    if here.distance < miss {
        (*line, here.distance - miss)
    } else {
        (Line { from: 0.0, ..*line }, f64::NEG_INFINITY)
    }
}

/// The first entry during `piece`, which looks like `middle` from the upper end at half time.
///
/// With the closest approach `m(t)` over the piece's time, which is convex along the line, Newton's method from below
/// rises to the first zero; one step from inside lands below it. A turning body is convex along the line only nearly, so
/// a step may go too far by the turn times its length: such a step is taken back until the distance itself vanishes.
fn first_entry(body: &Body, piece: &Piece, line: &Line, middle: &Probe) -> Option<Entry> {
    let rises = middle.by_line + piece.half_turn() > 0.0;
    let (mut s, top) =
        closest(body, piece, line, line.to, (0.5, *middle), if rises { f64::INFINITY } else { -TOUCH });
    let inside_at_top = top.distance < -TOUCH;
    // Far below the top another time may be closest: by the turn times the length, at most.
    if !inside_at_top && top.by_line + 2.0 * piece.half_turn() <= 0.0 {
        return None;
    }
    let dives = inside_at_top && top.by_line < 0.0;
    let mut t = if dives { (line.to - top.distance / top.by_line).max(line.from) } else { line.from };
    // The highest place known to be outside and below the entry.
    let mut below = None;
    for _ in 0..MOST_ROUNDS {
        let guess = (s, piece.probe(body, s, line.at(t), line.direction));
        let (at, probe) = closest(body, piece, line, t, guess, f64::INFINITY);
        s = at;
        let (distance, slope) = (probe.distance, probe.by_line);
        if distance.abs() <= TOUCH || (distance < 0.0 && t <= line.from) {
            let ball = line.at(t) - probe.gradient * (distance + body.inscribed()).max(0.0);
            return (t <= line.to - TOUCH).then_some(Entry { t, ball, time: s });
        }
        let newton = t - distance / slope;
        t = if distance > 0.0 {
            below = Some(t);
            let passes = slope >= 0.0 || newton > line.to - TOUCH;
            match (passes, inside_at_top) {
                (false, _) => newton,
                (true, true) => 0.5 * (t + line.to),
                (true, false) => return None,
            }
        } else {
            let lowest = below.unwrap_or(line.from);
            match below {
                _ if slope < 0.0 && newton > lowest => newton,
                Some(_) => 0.5 * (t + lowest),
                None => lowest,
            }
        };
    }
    // Not met in practice. The line does enter, so the worst that is consistent with what was seen is reported.
    let t = below.unwrap_or(line.from);
    inside_at_top.then_some(Entry { t, ball: DVec3::NAN, time: s })
}

/// The piece's parameter at which the body is closest to `line.at(t)` and the probe there, whose derivative along the line
/// is that of the closest approach; searched from `start`, a guess and its probe. Stops early once the distance is
/// proved not to fall below `enough`.
///
/// Treats the distance as convex in the parameter; [`Piece`]s are cut so that it is, within their sag.
fn closest(
    body: &Body,
    piece: &Piece,
    line: &Line,
    t: f64,
    start: (f64, Probe),
    enough: f64,
) -> (f64, Probe) {
    let x = line.at(t);
    let look = |s: f64| piece.probe(body, s, x, line.direction);
    let mut best = start;
    let mut ends: [Option<(f64, Probe)>; 2] = [None, None];
    let mut here = best;
    for round in 0..MOST_ROUNDS {
        let (s, probe) = here;
        if probe.distance < best.1.distance {
            best = here;
        }
        let slope = probe.by_time;
        // Downhill out of the piece, or level: nothing lower.
        if slope == 0.0 || (slope > 0.0 && s <= 0.0) || (slope < 0.0 && s >= 1.0) {
            return here;
        }
        ends[usize::from(slope > 0.0)] = Some(here);
        let next = match ends {
            [Some((a, pa)), Some((b, pb))] => {
                let (fa, da, fb, db) = (pa.distance, pa.by_time, pb.distance, pb.by_time);
                // Where the tangents at the two ends meet nothing can be lower.
                let meet = ((fb - db * b) - (fa - da * a)) / (da - db);
                let least = fa + da * (meet - a);
                if best.1.distance - least <= CLOSE || least >= enough || b - a <= f64::EPSILON {
                    // The mix of the two tangent planes that is level in time is below the distance everywhere; at a
                    // sharp edge neither plane alone is.
                    let share = db / (db - da);
                    best.1.by_line = share * pa.by_line + (1.0 - share) * pb.by_line;
                    return best;
                }
                let next = match round % 4 {
                    3 => 0.5 * (a + b),
                    1 => meet,
                    _ => a - da * (b - a) / (db - da),
                };
                if next > a && next < b { next } else { 0.5 * (a + b) }
            }
            [Some((a, p)), None] if p.distance + p.by_time * (1.0 - a) < enough => 1.0,
            [None, Some((b, p))] if p.distance - p.by_time * b < enough => 0.0,
            _ => return here,
        };
        here = (next, look(next));
    }
    best
}
