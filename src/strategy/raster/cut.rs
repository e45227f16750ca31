//! What lines of lowered cutters have cut away.

use super::line::Drop;
use crate::contact::Underside;
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;
use std::ops::Bound::{Excluded, Included, Unbounded};

/// Lines along x at places across, each cut over some stretches.
///
/// Places are whole numbers of a fine grid, so that halving the distance of two lines always names the same place.
#[derive(Debug)]
pub(super) struct Lines {
    /// The y of place 0.
    origin: f64,
    /// Distance of places, mm.
    pitch: f64,
    /// Place one beyond the last.
    end: u32,
    stretches: BTreeMap<u32, Vec<Vec<Drop>>>,
}

impl Lines {
    pub(super) fn new(origin: f64, pitch: f64, end: u32) -> Self {
        Self { origin, pitch, end, stretches: BTreeMap::new() }
    }

    /// No lines, at the same places.
    pub(super) fn like(&self) -> Self {
        Self::new(self.origin, self.pitch, self.end)
    }

    /// The places of lines within `reach` of `y`.
    pub(super) fn places_near(&self, y: f64, reach: f64) -> std::ops::RangeInclusive<u32> {
        let place = |y: f64| ((y - self.origin) / self.pitch).clamp(0.0, f64::from(self.end));
        let from = place(y - reach).ceil() as u32;
        from..=(place(y + reach).floor() as u32).max(from)
    }

    pub(super) fn y(&self, place: u32) -> f64 {
        self.origin + self.pitch * f64::from(place)
    }

    /// Adds a stretch, its drops by rising x.
    pub(super) fn add(&mut self, place: u32, stretch: Vec<Drop>) {
        if stretch.len() >= 2 {
            self.stretches.entry(place).or_default().push(stretch);
        }
    }

    /// All stretches with their places, in order.
    pub(super) fn iter(&self) -> impl Iterator<Item = (u32, &Vec<Drop>)> {
        self.stretches.iter().flat_map(|(&place, list)| list.iter().map(move |s| (place, s)))
    }

    /// The place halfway between the two lines around `at` that are cut there; `None` where no place is left between.
    pub(super) fn between(&self, at: DVec2) -> Option<u32> {
        let place = ((at.y - self.origin) / self.pitch).clamp(0.0, f64::from(self.end));
        let here = |(_, list): &(&u32, &Vec<Vec<Drop>>)| {
            list.iter().any(|s| s[0].x <= at.x && at.x <= s[s.len() - 1].x)
        };
        let floor = place.floor() as u32;
        let below = self.stretches.range(..=floor).rev().find(here).map_or(0, |(&p, _)| p);
        let above = self.stretches.range((Excluded(floor), Unbounded)).find(here);
        let above = above.map_or(self.end, |(&p, _)| p);
        let middle = below + (above - below) / 2;
        (middle > below).then_some(middle)
    }

    /// The place nearest to `y`.
    pub(super) fn nearest(&self, y: f64) -> u32 {
        ((y - self.origin) / self.pitch).round().clamp(0.0, f64::from(self.end)) as u32
    }

    /// Whether the point `p` is cut away; `expected` is where the axis of the cutter that does it most likely stands.
    pub(super) fn cuts(&self, under: &Underside, p: DVec3, expected: DVec2) -> bool {
        let place = |y: f64| ((y - self.origin) / self.pitch).clamp(0.0, f64::from(self.end));
        let reach = under.reach();
        let (lo, hi) = (place(p.y - reach).ceil() as u32, place(p.y + reach).floor() as u32);
        let split = (place(expected.y) as u32).clamp(lo.min(hi), hi);
        let near = |(&line, list): (&u32, &Vec<Vec<Drop>>)| {
            let across = self.y(line) - p.y;
            let width = (reach * reach - across * across).max(0.0).sqrt();
            list.iter().any(|s| cut_by(under, s, p, across, width, expected.x))
        };
        // Outwards from the expected line, the nearer of the two sides first.
        let mut down = self.stretches.range((Included(lo.min(split)), Included(split))).rev().peekable();
        let mut up = self.stretches.range((Excluded(split), Included(hi.max(split + 1)))).peekable();
        loop {
            let take_up = match (down.peek(), up.peek()) {
                (None, None) => return false,
                (Some((d, _)), Some((u, _))) => **u - split < split - **d,
                (down, _) => down.is_none(),
            };
            let next = if take_up { up.next() } else { down.next() };
            if next.is_some_and(near) {
                return true;
            }
        }
    }
}

/// Whether one of the drops within `width` of `p` along the line has `p` inside the cutter.
pub(super) fn cut_by(
    under: &Underside,
    stretch: &[Drop],
    p: DVec3,
    across: f64,
    width: f64,
    expected: f64,
) -> bool {
    let from = stretch.partition_point(|d| d.x < p.x - width);
    let to = stretch.partition_point(|d| d.x <= p.x + width);
    let start = stretch.partition_point(|d| d.x < expected).clamp(from, to);
    let cuts = |d: &Drop| {
        let room = p.z - d.tip;
        let radius = ((d.x - p.x) * (d.x - p.x) + across * across).sqrt();
        room >= 0.0 && radius <= under.reach() && under.height(radius) <= room
    };
    let (mut left, mut right) = (start, start);
    while left > from || right < to {
        if right < to {
            if cuts(&stretch[right]) {
                return true;
            }
            right += 1;
        }
        if left > from {
            left -= 1;
            if cuts(&stretch[left]) {
                return true;
            }
        }
    }
    false
}
