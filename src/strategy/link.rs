//! From passes to one motion: lifting, crossing and coming down between them.

use crate::cutter::{Cutter, Holder};
use crate::math::angle::angle_between;
use crate::monitor::{Cancelled, Stage};
use crate::toolpath::{ClPoint, Move, Pass, Rate, Role, Station, Toolpath, Touch};
use glam::DVec3;

/// How passes are joined.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Linking {
    /// Feed along passes, mm/min.
    pub cut_feed: f64,
    /// Feed of the last stretch down to a pass, mm/min.
    pub plunge_feed: f64,
    /// How fast the machine goes in rapid, mm/min, by which orders are compared.
    pub rapid: f64,
    /// How far the cutter lifts along its axis before it crosses to the next pass, mm.
    pub lift: f64,
    /// How far above its tip the cutter may meet the part, mm: what counts when the axis swings.
    pub lever: f64,
    /// How far beyond everything it stays when it crosses in rapid, mm.
    pub clearance: f64,
    /// Height of what the part stands on, mm, if it stands on anything: links stay above it.
    pub fixture: Option<f64>,
}

impl Linking {
    /// The way across from above one location to above another, mm, if it is short enough for that lift, mm, and the axis swings little.
    fn across(&self, from: &ClPoint, to: &ClPoint, lift: f64) -> Option<f64> {
        let across = raised(*from, lift).tip.distance(raised(*to, lift).tip);
        // A long way is faster in rapid around the part than at feed over it.
        (from.axis.dot(to.axis) >= LEAST_COSINE && across <= 10.0 * lift).then_some(across)
    }

    /// Time of a link near the part with nothing in its way, up to the last stretch down, min, if there is one.
    pub(super) fn near(&self, from: &ClPoint, to: &ClPoint) -> Option<f64> {
        let time = |times: f64| {
            let across = self.across(from, to, times * self.lift)?;
            Some(((2.0 * times - 1.0) * self.lift + across) / self.cut_feed)
        };
        LIFTS.into_iter().find_map(time)
    }
}

/// Time of the links of `path`, min.
pub fn link_time(path: &Toolpath, how: &Linking) -> f64 {
    let time = |pair: &[Move]| {
        let feed = if let Rate::Feed(feed) = pair[1].rate { feed } else { how.rapid };
        if pair[1].role == Role::Link { pair[0].to.tip.distance(pair[1].to.tip) / feed } else { 0.0 }
    };
    path.moves.windows(2).map(time).sum()
}

/// Cutter and holder as cylinders around the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outline {
    /// Of the cutter and of the holder, from how far above the tip, how far up, and of which radius, mm; twice the cutter's without a
    /// holder.
    cylinders: [[f64; 3]; 2],
}

impl Outline {
    /// Of `cutter` and its `holder`.
    pub fn new(cutter: &Cutter, holder: Option<&Holder>) -> Self {
        let cut = [0.0, cutter.height, cutter.largest_radius()];
        let held = holder.map(|h| [h.stickout, h.stickout + h.height, 0.5 * h.diameter]);
        Self { cylinders: [cut, held.unwrap_or(cut)] }
    }

    /// The largest radius, mm.
    fn widest(&self) -> f64 {
        self.cylinders[0][2].max(self.cylinders[1][2])
    }

    /// The least height that any of it comes to at a location, mm.
    pub fn lowest(&self, cl: &ClPoint) -> f64 {
        let sine = (1.0 - cl.axis.z * cl.axis.z).max(0.0).sqrt();
        let low = |[low, high, radius]: [f64; 3]| (low * cl.axis.z).min(high * cl.axis.z) - radius * sine;
        cl.tip.z + low(self.cylinders[0]).min(low(self.cylinders[1]))
    }
}

/// The part as an obstacle for links: whether the cutter at a location stays clear of it.
pub type IsClear<'a> = dyn Fn(&ClPoint) -> bool + Sync + 'a;

/// Lifts tried for a crossing near the part, as multiples of the one asked for.
const LIFTS: [f64; 4] = [1.0, 2.0, 4.0, 8.0];
/// Cosine of the most that the axis may swing in a crossing near the part, 45°: its far end would sweep a wide arc.
const LEAST_COSINE: f64 = 0.707;
/// How far the cutter may move between two looks at a crossing near the part, mm. What is asked whether it is clear
/// should keep half of it in hand.
pub const LOOK: f64 = 0.2;
/// Most moves of a crossing around the part.
const ARC: usize = 24;

/// A motion with what each of its moves meets at its end.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Linked {
    /// The motion.
    pub toolpath: Toolpath,
    /// What every move meets at its end; for people to see.
    pub touches: Vec<Touch>,
}

/// The motion along `passes` in their order.
///
/// Between two passes the cutter lifts along its axis, crosses straight to above the next pass and comes down, the last
/// bit at plunge feed, if `is_clear` holds all along for one of a few lifts; otherwise it retracts along its axis into
/// the refuge, crosses there in rapid, and comes back in along the axis.
pub fn link(
    passes: &[Pass],
    how: &Linking,
    refuge: &Refuge,
    is_clear: &IsClear,
    stage: &Stage,
) -> Result<Linked, Cancelled> {
    let mut linker = Linker { how, refuge, linked: Linked::default() };
    for (i, pass) in passes.iter().enumerate() {
        stage.at(i as f64 / passes.len() as f64)?;
        let (Some(first), Some(_)) = (pass.stations.first(), pass.stations.last()) else { continue };
        match linker.last() {
            None => linker.approach(first.cl),
            Some(from) => linker.cross(from, first.cl, is_clear),
        }
        linker.touch(first);
        for station in &pass.stations[1..] {
            linker.push(station.cl, Rate::Feed(how.cut_feed), Role::Cut);
            linker.touch(station);
        }
    }
    if let Some(last) = linker.last() {
        let out = linker.refuge.exit(last);
        linker.push(out, Rate::Rapid, Role::Link);
    }
    Ok(linker.linked)
}

/// Where the cutter meets nothing, whatever it does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Refuge {
    /// Outside a ball that holds the part and the cutter beside it.
    Outside {
        /// Centre of the ball.
        center: DVec3,
        /// Its radius, mm.
        radius: f64,
        /// What must stay above a height there, mm, if anything must.
        above: Option<(Outline, f64)>,
    },
    /// Above a height, for a cutter that stays upright.
    Above(f64),
}

impl Refuge {
    /// Outside a ball around the part between `bounds`, as far away from it as `how` asks for.
    pub fn around(bounds: (DVec3, DVec3), outline: &Outline, how: &Linking) -> Self {
        // With its tip outside this ball all of the tool is off the part: it hangs at most a radius below the tip.
        let radius = 0.5 * bounds.0.distance(bounds.1) + 2.0 * outline.widest() + how.clearance;
        let above = how.fixture.map(|height| (*outline, height));
        Self::Outside { center: 0.5 * (bounds.0 + bounds.1), radius, above }
    }

    /// Where the cutter enters the refuge, retracting from `cl` along its axis.
    pub(super) fn exit(&self, cl: ClPoint) -> ClPoint {
        match *self {
            Self::Outside { center, radius, .. } => {
                let v = cl.tip - center;
                let along = v.dot(cl.axis);
                let beyond = radius * radius - v.length_squared();
                raised(cl, (-along + (along * along + beyond).max(0.0).sqrt()).max(0.0))
            }
            Self::Above(height) => raised(cl, ((height - cl.tip.z) / cl.axis.z).max(0.0)),
        }
    }

    /// How long the way is between two places where the refuge begins, mm, where it does not go over the top.
    pub(super) fn around_by(&self, a: DVec3, b: DVec3) -> f64 {
        match *self {
            Self::Outside { center, radius, .. } => radius * angle_between(a - center, b - center),
            Self::Above(_) => a.distance(b),
        }
    }

    /// Locations on the way from `a` to `b`, both in the refuge, `b` included: over the top where the shortest way would go below
    /// what it must stay above of.
    fn way(&self, a: ClPoint, b: ClPoint) -> Vec<ClPoint> {
        let Self::Outside { center, radius, above } = *self else { return vec![b] };
        let direct = Self::arc(center, a, b);
        let dips = |(outline, height): (Outline, f64)| {
            // What the ends themselves do is not the way's fault.
            let lowest = |cl: &ClPoint| outline.lowest(cl);
            let ends = lowest(&a).min(lowest(&b));
            direct.iter().map(lowest).fold(f64::INFINITY, f64::min) < height.min(ends)
        };
        if !above.is_some_and(dips) {
            return direct;
        }
        let top = ClPoint { tip: center + DVec3::Z * radius, axis: DVec3::Z };
        let mut way = Self::arc(center, a, top);
        way.extend(Self::arc(center, top, b));
        way
    }

    /// Around `center` from `a` to `b`.
    fn arc(center: DVec3, a: ClPoint, b: ClPoint) -> Vec<ClPoint> {
        let (from, to) = (a.tip - center, b.tip - center);
        let angle = angle_between(from, to);
        let square = (to - from * (to.dot(from) / from.length_squared()))
            .try_normalize()
            .unwrap_or_else(|| from.normalize_or(DVec3::Z).any_orthonormal_vector());
        // Small enough steps that neither the place nor the axis swings far in one of them.
        let turn = angle_between(a.axis, b.axis);
        let steps = ((angle / 0.2).max(turn / 0.4).ceil() as usize).clamp(1, ARC);
        // Chords of the arc dip below it; its radius is raised so that they do not.
        let raise = 1.0 / libm::cos(0.5 * angle / steps as f64);
        let mut way: Vec<ClPoint> = (1..steps)
            .map(|k| {
                let t = k as f64 / steps as f64;
                let (s, c) = libm::sincos(angle * t);
                let out = from * c + square * (from.length() * s);
                // Turned outwards on the way, so that the spindle never crosses the part: the outward share grows faster
                // from both ends than the way round can turn the axes at the ends inwards.
                let outward = out.normalize_or(DVec3::Z) * (4.0 * t * (1.0 - t));
                let axis = (a.axis.lerp(b.axis, t) + outward).try_normalize().unwrap_or(a.axis);
                ClPoint { tip: center + out * raise, axis }
            })
            .collect();
        way.push(b);
        way
    }
}

struct Linker<'a> {
    how: &'a Linking,
    refuge: &'a Refuge,
    linked: Linked,
}

impl Linker<'_> {
    fn push(&mut self, to: ClPoint, rate: Rate, role: Role) {
        if self.last().is_none_or(|last| last != to) {
            self.linked.toolpath.moves.push(Move { to, rate, role });
            self.linked.touches.push(Touch { point: to.tip, contact: None });
        }
    }

    fn last(&self) -> Option<ClPoint> {
        self.linked.toolpath.moves.last().map(|m| m.to)
    }

    /// Says that the last move ended at `station`.
    fn touch(&mut self, Station { cc, work, .. }: &Station) {
        if let Some(last) = self.linked.touches.last_mut() {
            *last = Touch { point: cc.point, contact: Some((cc.posture, *work)) };
        }
    }

    /// Comes in from the refuge.
    fn approach(&mut self, to: ClPoint) {
        self.push(self.refuge.exit(to), Rate::Rapid, Role::Link);
        self.push(raised(to, self.how.lift), Rate::Rapid, Role::Link);
        self.push(to, Rate::Feed(self.how.plunge_feed), Role::Link);
    }

    fn cross(&mut self, from: ClPoint, to: ClPoint, is_clear: &IsClear) {
        for lift in LIFTS.map(|times| times * self.how.lift) {
            let (above, over) = (raised(from, lift), raised(to, lift));
            let Some(across) = self.how.across(&from, &to, lift) else { continue };
            let swing = angle_between(above.axis, over.axis) * self.how.lever;
            let looks = ((across + swing) / LOOK).ceil().max(1.0);
            let clear = |k: usize| is_clear(&between(above, over, k as f64 / looks));
            if (0..=looks as usize).all(clear) {
                self.push(above, Rate::Feed(self.how.cut_feed), Role::Link);
                self.push(over, Rate::Feed(self.how.cut_feed), Role::Link);
                self.push(raised(to, self.how.lift), Rate::Feed(self.how.cut_feed), Role::Link);
                self.push(to, Rate::Feed(self.how.plunge_feed), Role::Link);
                return;
            }
        }
        let over = raised(to, self.how.lift);
        let (out, back) = (self.refuge.exit(from), self.refuge.exit(to));
        self.push(out, Rate::Rapid, Role::Link);
        for location in self.refuge.way(out, back) {
            self.push(location, Rate::Rapid, Role::Link);
        }
        self.push(over, Rate::Rapid, Role::Link);
        self.push(to, Rate::Feed(self.how.plunge_feed), Role::Link);
    }
}

fn raised(cl: ClPoint, by: f64) -> ClPoint {
    ClPoint { tip: cl.tip + cl.axis * by, axis: cl.axis }
}

fn between(a: ClPoint, b: ClPoint, t: f64) -> ClPoint {
    ClPoint { tip: a.tip.lerp(b.tip, t), axis: a.axis.lerp(b.axis, t).try_normalize().unwrap_or(a.axis) }
}
