//! Samples' lines gathered by where they are and where they point, to be judged together.

use super::entry::Line;
use crate::math::order::{rank, sort_by_key};
use glam::DVec3;

/// Bounds that hold for some lines together, between the heights `from` and `top`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    centre: DVec3,
    /// Mean direction, unit.
    pub(super) direction: DVec3,
    /// How far any line's direction is from the mean.
    spread: f64,
    /// How far any point is from the centre, square to the mean direction.
    radius: f64,
    /// How far any point is from the centre along the mean direction.
    height: f64,
    from: f64,
    top: f64,
}

/// A part with less than one in so many counts as nearly empty: trees stay less than ten times deeper than balanced ones.
const LOPSIDED: usize = 8;

/// How a body looks from [`Cell::place`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    /// Its distance there at some pose.
    pub(super) distance: f64,
    /// The derivative of the distance along [`Cell::direction`].
    pub(super) by_line: f64,
    /// How much nearer another pose can be at the place itself.
    pub(super) nearer: f64,
    /// How far another pose is turned, at most, radians.
    pub(super) turn: f64,
}

impl Cell {
    pub(super) fn around<'a>(lines: impl Iterator<Item = &'a Line> + Clone) -> Self {
        let (mut points, mut directions, mut count) = (DVec3::ZERO, DVec3::ZERO, 0.0_f64);
        for line in lines.clone() {
            points += line.point;
            directions += line.direction;
            count += 1.0;
        }
        let centre = points / count.max(1.0);
        let direction = directions.normalize_or(DVec3::Z);
        let mut cell = Self {
            centre,
            direction,
            spread: 0.0,
            radius: 0.0,
            height: 0.0,
            from: f64::INFINITY,
            top: f64::NEG_INFINITY,
        };
        let (mut spread, mut radius) = (0.0_f64, 0.0_f64);
        for line in lines {
            let off = line.point - centre;
            let along = off.dot(direction);
            spread = spread.max(line.direction.distance_squared(direction));
            cell.height = cell.height.max(along.abs());
            radius = radius.max((off - direction * along).length_squared());
            cell.from = cell.from.min(line.from);
            cell.top = cell.top.max(line.to);
        }
        Self { spread: spread.sqrt(), radius: radius.sqrt(), ..cell }
    }

    /// The cell with the lines of a surface between the given ones too, whose points are up to `bow` beside what those span
    /// and whose directions spread twice as far.
    #[must_use]
    pub(super) fn between(self, bow: f64) -> Self {
        Self { radius: self.radius + bow, height: self.height + bow, spread: 2.0 * self.spread, ..self }
    }

    /// From where bodies are looked at: the middle of the lines' upper ends.
    pub(super) fn place(&self) -> DVec3 {
        self.centre + self.direction * self.top
    }

    /// How far the lines' upper ends are from [`Cell::place`], at most.
    pub(super) fn size(&self) -> f64 {
        self.radius + self.height + self.top.abs() * self.spread
    }

    /// How far it is from `aside`, a place beside the middle, along the unit vector `way` to the cell's rim.
    pub(super) fn reach(&self, aside: DVec3, way: DVec3) -> f64 {
        let along = aside.dot(way);
        let beyond = along * along + self.radius * self.radius - aside.length_squared();
        (beyond.max(0.0).sqrt() - along).max(0.0)
    }

    /// A lower bound of the distance between a body and all lines.
    ///
    /// The distance is convex in space, so the tangent at one point bounds it.
    pub(super) fn least(&self, seen: &Seen) -> f64 {
        let across = (1.0 - seen.by_line * seen.by_line).max(0.0).sqrt();
        self.below(seen, across * self.radius, 0.0)
    }

    /// The same for a body seen from `aside` of [`Cell::place`], square to the mean direction, where `lateral` is the
    /// gradient's part square to that direction.
    pub(super) fn least_aside(&self, seen: &Seen, aside: DVec3, lateral: DVec3) -> f64 {
        // The lowest value of a linear function on a disc.
        self.below(seen, lateral.length() * self.radius + lateral.dot(aside), aside.length())
    }

    /// What is left of the distance with `lateral` taken off for the lines beside the place looked from.
    fn below(&self, seen: &Seen, lateral: f64, aside: f64) -> f64 {
        // Lines also run down from the top; that brings them closer only where the body is not above.
        let down = (seen.by_line + self.spread + seen.turn).max(0.0) * (self.top - self.from);
        let other = seen.by_line.abs() * self.height + self.top.abs() * self.spread;
        seen.distance - lateral - other - down - seen.nearer - seen.turn * (self.size() + aside)
    }
}

/// Reorders `items`, each given by two `ends`, so that what one plane parts comes apart, and returns where the second
/// part begins. Both ends count, so that what diverges is parted too. The plane lies midway, or where it would leave one
/// side nearly empty, at the median; equal places are told apart by `number` then, so that the result depends on nothing else.
pub(super) fn halve<T>(
    items: &mut [T],
    ends: impl Fn(&T) -> [DVec3; 2],
    number: impl Fn(&T) -> u32,
) -> usize {
    let mut lo = [DVec3::INFINITY; 2];
    let mut hi = [DVec3::NEG_INFINITY; 2];
    for item in items.iter() {
        for (k, end) in ends(item).into_iter().enumerate() {
            lo[k] = lo[k].min(end);
            hi[k] = hi[k].max(end);
        }
    }
    let widest = [0, 1].map(|k| (hi[k] - lo[k]).max_element());
    let k = usize::from(widest[1] > widest[0]);
    let axis = (hi[k] - lo[k]).max_position();
    let middle = 0.5 * (lo[k][axis] + hi[k][axis]);
    let mut second = 0;
    for i in 0..items.len() {
        if ends(&items[i])[k][axis] < middle {
            items.swap(i, second);
            second += 1;
        }
    }
    if second.min(items.len() - second) > items.len() / LOPSIDED {
        return second;
    }
    let median = items.len() / 2;
    sort_by_key(items, |item| (rank(ends(item)[k][axis]), number(item)));
    median
}

/// `items` in lists of at most `most`, each compact.
pub(super) fn share_out<T>(
    items: &mut [T],
    most: usize,
    ends: impl Fn(&T) -> [DVec3; 2],
    number: impl Fn(&T) -> u32,
) -> Vec<&[T]> {
    let mut lists: Vec<&[T]> = Vec::new();
    let mut open = vec![items];
    while let Some(items) = open.pop() {
        if items.len() <= most {
            lists.push(items);
        } else {
            let middle = halve(items, &ends, &number);
            let (left, right) = items.split_at_mut(middle);
            open.extend([right, left]);
        }
    }
    lists
}
