//! What a ball leaves.

use super::curve::Move;
use super::ray::{Ray, Sweep, Target};
use crate::math::bvh::{Aabb, Bvh};
use crate::toolpath::TurningPath;
use glam::DVec3;

/// Moves in a leaf: a bound for a move takes half of the time that one for a node takes.
const LEAF: usize = 8;

/// A ball along a path: its moves, in a tree of boxes with a plane under the centres of each.
pub(super) struct BallSweep {
    radius: f64,
    /// What is left higher than this counts as uncut, mm.
    search: f64,
    moves: Vec<Move>,
    /// Where the nose centre is at the ends of each.
    ends: Vec<[DVec3; 2]>,
    /// How far it is at most from the straight line between them.
    bulges: Vec<f64>,
    tree: Bvh,
    /// Of the children of each node, the pair that begins with node 2 k + 1 at k.
    sisters: Vec<Sisters>,
}

/// Where the nose centres of a node are: in a ball, and above a plane.
#[derive(Debug, Clone, Copy)]
struct Plane {
    /// Unit normal, pointing up.
    normal: DVec3,
    /// The middle of the ball.
    middle: DVec3,
    /// Its radius.
    around: f64,
    /// How far the plane is below the middle.
    below: f64,
}

/// What is kept from one search to the next.
#[derive(Default)]
struct Seeker {
    last: Option<usize>,
    /// Nodes to be opened, with what they leave at least.
    open: Vec<(f64, usize)>,
}

/// Sums over points, from which a plane is fitted: Σ1, Σx, Σy, Σz, Σxx, Σxy, Σyy, Σxz, Σyz.
type Moments = [f64; 9];

impl BallSweep {
    pub(super) fn new(path: &TurningPath, radius: f64, search: f64) -> Self {
        let moves: Vec<Move> =
            path.points.windows(2).map(|p| Move::new(&p[0], &p[1], path.interpolation)).collect();
        let ends = |m: &Move| [m.place(0.0)[0], m.place(1.0)[0]].map(DVec3::from_array);
        let ends: Vec<[DVec3; 2]> = moves.iter().map(ends).collect();
        let bulges: Vec<f64> = moves.iter().map(Move::bulge).collect();
        let boxes: Vec<Aabb> = ends.iter().map(|e| Aabb::around(*e)).collect();
        let tree = Bvh::new(&boxes, LEAF);
        let planes = planes(&tree, &ends, &bulges);
        // The tree numbers children in pairs after the root.
        let sisters = planes[1..].chunks_exact(2).map(|two| Sisters::new(&two[0], &two[1])).collect();
        Self { radius, search, moves, ends, bulges, tree, sisters }
    }

    /// The residue over `p` along the unit vector `n`. `seeker` remembers the move that left the least at a place nearby: looked
    /// at first, it tells what need not be looked at.
    fn residue(&self, p: DVec3, n: DVec3, seeker: &mut Seeker) -> f64 {
        let r = self.radius;
        // Where the centre would be if the ball just touched at p.
        let q = p + r * n;
        let mut best = seeker.last.map_or(self.search, |i| self.closest(i, q, n).min(self.search));
        // Depth first, the nearer child first: with a good start nothing is gained by keeping all that is open in order.
        let open = &mut seeker.open;
        open.clear();
        open.push((f64::NEG_INFINITY, 0));
        while let Some((least, node)) = open.pop() {
            if least >= best {
                continue;
            }
            let Some(children) = self.tree.children(node) else {
                for &i in self.tree.leaf(node).map_or(&[][..], |places| &self.tree.order()[places]) {
                    let i = i as usize;
                    if self.least(i, q, n) < best {
                        let left = self.closest(i, q, n);
                        if left < best {
                            (best, seeker.last) = (left, Some(i));
                        }
                    }
                }
                continue;
            };
            let [first, second] = self.sisters[children[0] / 2].least(q, n, r);
            let (a, b) = ((first, children[0]), (second, children[1]));
            let (near, far) = if a.0 <= b.0 { (a, b) } else { (b, a) };
            for child in [far, near] {
                if child.0 < best {
                    open.push(child);
                }
            }
        }
        if best < self.search { best } else { f64::INFINITY }
    }

    /// The move `i` leaves no less than this: the least of `d·n + t²/2r`, which is below every residue, along its chord, less
    /// √2 times what the move bulges, since within the ball's reach (t up to r) that grows by no more for each mm of way.
    fn least(&self, i: usize, q: DVec3, n: DVec3) -> f64 {
        let r = self.radius;
        let [a, b] = self.ends[i];
        let (d, v) = (a - q, b - a);
        let (dn, vn) = (d.dot(n), v.dot(n));
        let (dd, dv, vv) =
            (d.length_squared() - dn * dn, d.dot(v) - dn * vn, (v.length_squared() - vn * vn).max(0.0));
        let slope = vn + dv / r;
        let u = if vv > 0.0 {
            (-slope * r / vv).clamp(0.0, 1.0)
        } else if slope < 0.0 {
            1.0
        } else {
            0.0
        };
        dn + 0.5 * dd / r + u * (slope + 0.5 * u * vv / r) - std::f64::consts::SQRT_2 * self.bulges[i]
    }

    /// The least residue that the move `i` leaves.
    fn closest(&self, i: usize, q: DVec3, n: DVec3) -> f64 {
        let motion = &self.moves[i];
        let r = self.radius;
        let [a, b] = self.ends[i];
        let along = b - a;
        let length = along.length_squared();
        let mut u = if length > 0.0 { ((q - a).dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
        // Residue h = d·n + r − √(r² − t²), with d = c − q and t its part square to n.
        let at = |u: f64| {
            let [c, c1, c2] = motion.place(u).map(DVec3::from_array);
            let d = c - q;
            let (dn, vn, an) = (d.dot(n), c1.dot(n), c2.dot(n));
            let under = r * r - (d.length_squared() - dn * dn);
            if under <= 0.0 {
                return None;
            }
            let root = under.sqrt();
            let first = d.dot(c1) - dn * vn;
            let second = c1.length_squared() + d.dot(c2) - vn * vn - dn * an;
            let h2 = an + second / root + first * first / (root * root * root);
            Some([dn + r - root, vn + first / root, h2])
        };
        let mut least = f64::INFINITY;
        // The residue is nearly a parabola in u: Newton from the foot on the chord is done in two or three steps.
        for _ in 0..8 {
            let Some([h, h1, h2]) = at(u) else { break };
            least = least.min(h);
            let next = if h2 > 0.0 {
                (u - h1 / h2).clamp(0.0, 1.0)
            } else if h1 > 0.0 {
                0.0
            } else {
                1.0
            };
            // What is still to be gained is half of slope times step.
            if ((next - u) * h1).abs() < 1e-10 {
                break;
            }
            u = next;
        }
        least
    }
}

impl Sweep for BallSweep {
    fn residues(&self, ray: &Ray, targets: &[Target]) -> Vec<f64> {
        let mut seeker = Seeker::default();
        targets
            .iter()
            .map(|t| {
                let p = DVec3::new(t.rho * ray.cos, t.rho * ray.sin, t.z);
                self.residue(p, DVec3::from_array(t.normal), &mut seeker)
            })
            .collect()
    }
}

/// The planes of two sisters, number beside number, so that the processor bounds both at once.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
struct Sisters {
    normal: [[f64; 2]; 3],
    middle: [[f64; 2]; 3],
    around: [f64; 2],
    below: [f64; 2],
}

impl Sisters {
    fn new(a: &Plane, b: &Plane) -> Self {
        let both = |v: DVec3, w: DVec3| [[v.x, w.x], [v.y, w.y], [v.z, w.z]];
        Self {
            normal: both(a.normal, b.normal),
            middle: both(a.middle, b.middle),
            around: [a.around, b.around],
            below: [a.below, b.below],
        }
    }

    /// No residue of a centre under either node is below this. `q` is where the centre would be if the ball touched, `n` the
    /// normal there, `r` the ball's radius.
    ///
    /// A centre `t` aside of the normal leaves at least its height over q along n, plus t²/2r. Above the plane, whose slope
    /// there is −s, that sum is a bowl around t = r s: the node's least is at the place of its ball nearest to that.
    #[inline(always)]
    fn least(&self, q: DVec3, n: DVec3, r: f64) -> [f64; 2] {
        let mut least = [0.0; 2];
        for k in 0..2 {
            let [x, y, z] = [self.middle[0][k] - q.x, self.middle[1][k] - q.y, self.middle[2][k] - q.z];
            let [nx, ny, nz] = self.normal.map(|axis| axis[k]);
            let along = x * n.x + y * n.y + z * n.z;
            let cos = nx * n.x + ny * n.y + nz * n.z;
            let flat = 1.0 / cos;
            let aside = x * x + y * y + z * z - along * along;
            let (st, ss) = ((x * nx + y * ny + z * nz) * flat - along, flat * flat - 1.0);
            let gap = positive(aside - 2.0 * r * st + r * r * ss).sqrt();
            let near = positive(gap - self.around[k]);
            let bowl = along + st - 0.5 * r * ss - self.below[k] * flat + 0.5 * near * near / r;
            // A plane seen from its edge or from behind says nothing.
            least[k] = if cos > 0.1 { bowl } else { along - self.around[k] };
        }
        least
    }
}

/// `x`, or 0 where it is below: unlike `max`, which looks for what is not a number, one instruction for two.
#[inline(always)]
fn positive(x: f64) -> f64 {
    if x > 0.0 { x } else { 0.0 }
}

/// The plane of each node of `tree`.
fn planes(tree: &Bvh, ends: &[[DVec3; 2]], bulges: &[f64]) -> Vec<Plane> {
    let count = tree.boxes().len();
    let mut sums: Vec<Moments> = vec![[0.0; 9]; count];
    // The places in the tree's order that lie below each node: they are one run.
    let mut runs = vec![0..0; count];
    for node in (0..count).rev() {
        if let Some(places) = tree.leaf(node) {
            for &i in &tree.order()[places.clone()] {
                for p in ends[i as usize] {
                    let more = [1.0, p.x, p.y, p.z, p.x * p.x, p.x * p.y, p.y * p.y, p.x * p.z, p.y * p.z];
                    for (sum, more) in sums[node].iter_mut().zip(more) {
                        *sum += more;
                    }
                }
            }
            runs[node] = places;
        } else if let Some([a, b]) = tree.children(node) {
            sums[node] = std::array::from_fn(|k| sums[a][k] + sums[b][k]);
            runs[node] = runs[a].start.min(runs[b].start)..runs[a].end.max(runs[b].end);
        }
    }
    let mut normals = vec![DVec3::Z; count];
    for node in 0..count {
        // Points of one turn lie in a line, which no plane fits: theirs is that of the node above.
        normals[node] = fitted(&sums[node]).unwrap_or(normals[node]);
        for child in tree.children(node).into_iter().flatten() {
            normals[child] = normals[node];
        }
    }
    (0..count)
        .map(|node| {
            let normal = normals[node];
            let bounds = &tree.boxes()[node];
            let middle = 0.5 * (bounds.lo + bounds.hi);
            let (mut height, mut around): (f64, f64) = (f64::INFINITY, 0.0);
            for &i in &tree.order()[runs[node].clone()] {
                let bulge = bulges[i as usize];
                for p in ends[i as usize] {
                    height = height.min(p.dot(normal) - bulge);
                    around = around.max(p.distance(middle) + bulge);
                }
            }
            Plane { normal, middle, around, below: middle.dot(normal) - height }
        })
        .collect()
}

/// The unit normal, pointing up, of the plane `z = a + b x + c y` that fits the points best; `None` where they lie nearly in a
/// line seen from above: narrower than a fifth of their length.
fn fitted(&[n, x, y, z, xx, xy, yy, xz, yz]: &Moments) -> Option<DVec3> {
    let (sxx, sxy, syy) = (xx - x * x / n, xy - x * y / n, yy - y * y / n);
    let (sxz, syz) = (xz - x * z / n, yz - y * z / n);
    let det = sxx * syy - sxy * sxy;
    if det.is_nan() || det <= 0.04 * (sxx + syy) * (sxx + syy) {
        return None;
    }
    let (b, c) = ((sxz * syy - syz * sxy) / det, (syz * sxx - sxz * sxy) / det);
    DVec3::new(-b, -c, 1.0).try_normalize()
}
