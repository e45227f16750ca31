//! Samples' lines gathered by where they are and where they point, to be judged together.

use super::entry::Line;
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
    pub(super) fn around<'a>(lines: impl ExactSizeIterator<Item = &'a Line> + Clone) -> Self {
        let (points, directions) =
            lines.clone().fold((DVec3::ZERO, DVec3::ZERO), |(p, d), l| (p + l.point, d + l.direction));
        let centre = points / lines.len().max(1) as f64;
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

    /// From where bodies are looked at: the middle of the lines' upper ends.
    pub(super) fn place(&self) -> DVec3 {
        self.centre + self.direction * self.top
    }

    /// How far the lines' upper ends are from [`Cell::place`], at most.
    pub(super) fn size(&self) -> f64 {
        self.radius + self.height + self.top.abs() * self.spread
    }

    /// A lower bound of the distance between a body and all lines.
    ///
    /// The distance is convex in space, so the tangent at one point bounds it.
    pub(super) fn least(&self, seen: &Seen) -> f64 {
        let along = seen.by_line;
        let across = (1.0 - along * along).max(0.0).sqrt();
        // Lines also run down from the top; that brings them closer only where the body is not above.
        let down = (along + self.spread + seen.turn).max(0.0) * (self.top - self.from);
        let lateral = across * self.radius + along.abs() * self.height + self.top.abs() * self.spread;
        seen.distance - lateral - down - seen.nearer - seen.turn * self.size()
    }
}

/// Reorders `items`, each given by two `ends`, so that the halves are each as compact as one cut can make them, and
/// returns where the second begins. Both ends count, so that what diverges comes apart too. Equal places are told
/// apart by `number`, so that the result depends on nothing else.
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
    let middle = items.len() / 2;
    items.select_nth_unstable_by(middle, |a, b| {
        ends(a)[k][axis].total_cmp(&ends(b)[k][axis]).then(number(a).cmp(&number(b)))
    });
    middle
}
