//! A tree of axis-aligned boxes.

use super::order::sort_by_key;
use glam::DVec3;
use std::ops::Range;

/// An axis-aligned box; empty where `lo` exceeds `hi`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aabb {
    /// Lowest coordinates.
    pub lo: DVec3,
    /// Highest coordinates.
    pub hi: DVec3,
}

impl Aabb {
    /// The box that holds nothing and grows to whatever is added.
    pub const EMPTY: Self = Self { lo: DVec3::INFINITY, hi: DVec3::NEG_INFINITY };

    /// The smallest box around `points`.
    pub fn around(points: impl IntoIterator<Item = DVec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |b, p| Self { lo: b.lo.min(p), hi: b.hi.max(p) })
    }

    /// The smallest box around both.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// The middle.
    pub fn center(&self) -> DVec3 {
        0.5 * (self.lo + self.hi)
    }

    /// The smallest ball around the box: its middle and half the diagonal.
    pub fn ball(&self) -> (DVec3, f64) {
        (self.center(), 0.5 * self.lo.distance(self.hi))
    }

    /// Distance from `p` to the box, squared; 0 inside.
    pub fn distance_squared(&self, p: DVec3) -> f64 {
        (p.clamp(self.lo, self.hi) - p).length_squared()
    }

    /// Whether the boxes share a point.
    pub fn meets(&self, other: &Self) -> bool {
        self.lo.cmple(other.hi).all() && other.lo.cmple(self.hi).all()
    }
}

/// A node's children or items.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Link {
    /// A leaf's first place in the order; an inner node's first child, the second follows it.
    first: u32,
    /// Number of items; 0 for an inner node.
    count: u32,
}

/// A balanced tree over boxes, in flat arrays. Nodes are numbered so that a child comes after its parent; node 0 is the
/// root. Callers keep what else they know of a node in an array of their own, beside [`Bvh::boxes`].
///
/// Equal input gives an equal tree.
#[derive(Debug, Clone, PartialEq)]
pub struct Bvh {
    links: Vec<Link>,
    boxes: Vec<Aabb>,
    order: Vec<u32>,
}

/// Room for the nodes that wait in a usual search; more are allowed.
const USUAL_OPEN: usize = 128;

impl Bvh {
    /// The tree over `items` with at most `leaf` (at least 1) of them a leaf, split at the median of the centres along
    /// the longest side.
    pub fn new(items: &[Aabb], leaf: usize) -> Self {
        let centers: Vec<DVec3> = items.iter().map(Aabb::center).collect();
        let mut order: Vec<u32> = (0..items.len() as u32).collect();
        let mut tree = Self { links: Vec::new(), boxes: Vec::new(), order: Vec::new() };
        let mut open = vec![(0, 0..items.len())];
        tree.push_nodes(1);
        while let Some((node, range)) = open.pop() {
            let mine = &mut order[range.clone()];
            let around =
                |pick: &dyn Fn(u32) -> Aabb| mine.iter().fold(Aabb::EMPTY, |b, &i| b.union(&pick(i)));
            tree.boxes[node] = around(&|i| items[i as usize]);
            if mine.len() <= leaf.max(1) {
                sort_by_key(mine, |&i| (u64::from(i), 0));
                tree.links[node] = Link { first: range.start as u32, count: mine.len() as u32 };
                continue;
            }
            let spread = around(&|i| Aabb { lo: centers[i as usize], hi: centers[i as usize] });
            let axis = (spread.hi - spread.lo).max_position();
            let half = mine.len() / 2;
            // Ties go by number: without that, equal centres could fall on either side.
            mine.select_nth_unstable_by(half, |&i, &j| {
                centers[i as usize][axis].total_cmp(&centers[j as usize][axis]).then(i.cmp(&j))
            });
            let child = tree.push_nodes(2);
            tree.links[node] = Link { first: child as u32, count: 0 };
            open.push((child + 1, range.start + half..range.end));
            open.push((child, range.start..range.start + half));
        }
        tree.order = order;
        tree
    }

    fn push_nodes(&mut self, count: usize) -> usize {
        let first = self.links.len();
        self.links.resize(first + count, Link { first: 0, count: 0 });
        self.boxes.resize(first + count, Aabb::EMPTY);
        first
    }

    /// The box of each node.
    pub fn boxes(&self) -> &[Aabb] {
        &self.boxes
    }

    /// The items' numbers in the order of the leaves; the leaf ranges below count in it.
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// The places in [`Bvh::order`] of a leaf's items; `None` for an inner node.
    pub fn leaf(&self, node: usize) -> Option<Range<usize>> {
        let Link { first, count } = self.links[node];
        (count > 0 || self.order.is_empty()).then(|| first as usize..(first + count) as usize)
    }

    /// The two children of an inner node; `None` for a leaf.
    pub fn children(&self, node: usize) -> Option<[usize; 2]> {
        let Link { first, count } = self.links[node];
        (count == 0 && !self.order.is_empty()).then_some([first as usize, first as usize + 1])
    }

    /// The highest value that `leaf` reports, or `floor` if none is higher.
    ///
    /// `bound(node)` must be at least the value of everything below the node. `leaf(places, best)` returns the larger
    /// of `best` and the values of the items at `places` of [`Bvh::order`]. Nodes come in the order of their bounds, so
    /// that none is opened that could not hold the highest.
    pub fn highest(
        &self,
        floor: f64,
        bound: impl Fn(usize) -> f64,
        mut leaf: impl FnMut(Range<usize>, f64) -> f64,
    ) -> f64 {
        let mut best = floor;
        if self.order.is_empty() {
            return best;
        }
        // Sorted, the most promising last: a child's bound is little below its parent's, so it settles near the end.
        // A node waits with its link, so that its children need not be waited for twice.
        let mut open: Vec<(f64, Link)> = Vec::with_capacity(USUAL_OPEN);
        open.push((bound(0), self.links[0]));
        while let Some((limit, Link { first, count })) = open.pop() {
            if limit <= best {
                break;
            }
            let first = first as usize;
            if count > 0 {
                best = leaf(first..first + count as usize, best);
                continue;
            }
            // Both before either is put in its place: neither waits for the other.
            for (limit, child) in [(bound(first + 1), first + 1), (bound(first), first)] {
                if limit > best {
                    let entry = (limit, self.links[child]);
                    let mut at = open.len();
                    open.push(entry);
                    while at > 0 && open[at - 1].0 > limit {
                        open[at] = open[at - 1];
                        at -= 1;
                    }
                    open[at] = entry;
                }
            }
        }
        best
    }

    /// Calls `item` with the place in [`Bvh::order`] of every item in a leaf whose box, and all boxes above it, `enter`
    /// accepts.
    pub fn visit_places(&self, enter: impl Fn(&Aabb) -> bool, mut item: impl FnMut(usize)) {
        self.visit_leaves(enter, |_, places| places.for_each(&mut item));
    }

    /// Calls `leaf` with the node and the places in [`Bvh::order`] of every leaf whose box, and all boxes above it, `enter`
    /// accepts.
    pub fn visit_leaves(&self, enter: impl Fn(&Aabb) -> bool, mut leaf: impl FnMut(usize, Range<usize>)) {
        let mut open = vec![0];
        while let Some(node) = open.pop() {
            if !enter(&self.boxes[node]) {
                continue;
            }
            match self.leaf(node) {
                Some(places) => leaf(node, places),
                // The first child comes first.
                None => open.extend(self.children(node).into_iter().flatten().rev()),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn boxes() -> impl Strategy<Value = Vec<Aabb>> {
        let side = || (0.0..10.0f64).prop_map(|x| x.floor());
        let point = move || (side(), side(), side()).prop_map(|(x, y, z)| DVec3::new(x, y, z));
        proptest::collection::vec((point(), point()).prop_map(|(a, b)| Aabb::around([a, a + 0.1 * b])), 0..60)
    }

    proptest! {
        #[test]
        fn nearest_is_that_of_brute_force(items in boxes(), x in 0.0..10.0f64, y in 0.0..10.0f64, leaf in 1..6usize) {
            let p = DVec3::new(x, y, 5.0);
            let tree = Bvh::new(&items, leaf);
            let value = |b: &Aabb| -b.distance_squared(p);
            let found = tree.highest(f64::NEG_INFINITY, |node| value(&tree.boxes()[node]), |places, best| {
                places.fold(best, |best, at| best.max(value(&items[tree.order()[at] as usize])))
            });
            let wanted = items.iter().map(value).fold(f64::NEG_INFINITY, f64::max);
            prop_assert_eq!(found, wanted);
        }

        #[test]
        fn visit_finds_what_meets_a_box(items in boxes(), x in 0.0..10.0f64, leaf in 1..6usize) {
            let window = Aabb { lo: DVec3::new(x, 2.0, 2.0), hi: DVec3::new(x + 2.0, 7.0, 7.0) };
            let tree = Bvh::new(&items, leaf);
            let mut found = Vec::new();
            tree.visit_places(|b| b.meets(&window), |at| {
                let i = tree.order()[at];
                if items[i as usize].meets(&window) {
                    found.push(i);
                }
            });
            found.sort_unstable();
            let wanted: Vec<u32> =
                (0..items.len() as u32).filter(|&i| items[i as usize].meets(&window)).collect();
            prop_assert_eq!(found, wanted);
        }
    }
}
