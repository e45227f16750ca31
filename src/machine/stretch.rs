//! Moves as what the axes do in them: stretches at one speed, and how they are gone through from one speed to another.

use super::{Axis, AxisPath};

/// A move as the time that it takes at its own speed, and the axes' speeds then.
#[derive(Debug, Clone, Copy)]
pub(super) struct Block {
    /// Seconds at full speed, above 0.
    pub(super) nominal: f64,
    /// Of the axes at full speed, mm/s and rad/s.
    pub(super) speeds: [f64; 5],
    /// How fast the share of the full speed may change, 1/s.
    pub(super) acceleration: f64,
}

impl Block {
    /// The move from one position to another in a time above 0.
    fn of(axes: &[Axis], from: &[f64; 5], to: &[f64; 5], nominal: f64) -> Self {
        let speeds: [f64; 5] = std::array::from_fn(|k| (to[k] - from[k]) / nominal);
        let least = |least: f64, (axis, speed): (&Axis, &f64)| least.min(axis.acceleration / speed.abs());
        let acceleration = axes.iter().zip(&speeds).fold(f64::INFINITY, least);
        Self { nominal, speeds, acceleration }
    }

    /// The way from a share of the full speed to another, speeding up to the full speed between if there is room.
    pub(super) fn profile(&self, from: f64, to: f64) -> Profile {
        let a = self.acceleration;
        // Up to the peak and down again takes (2 peak² − from² − to²) / 2a of the way.
        let peak = (0.5 * (2.0 * a * self.nominal + from * from + to * to)).sqrt().clamp(from.max(to), 1.0);
        let ramp = |share: f64| if a.is_infinite() { 0.0 } else { (peak * peak - share * share) / (2.0 * a) };
        let level = (self.nominal - ramp(from) - ramp(to)).max(0.0);
        Profile { a, ends: [from, to], peak, up: ramp(from), level, nominal: self.nominal }
    }
}

/// Speeding up, going on, slowing down: ways in nominal time.
pub(super) struct Profile {
    a: f64,
    ends: [f64; 2],
    peak: f64,
    up: f64,
    level: f64,
    nominal: f64,
}

impl Profile {
    /// When so much of the nominal time is gone through, s.
    pub(super) fn seconds(&self, gone: f64) -> f64 {
        let Self { a, ends: [from, to], peak, up, level, nominal } = *self;
        let (rising, flat) = (gone.min(up), (gone - up).clamp(0.0, level));
        let ramp = |change: f64| if a.is_infinite() { 0.0 } else { change / a };
        let faster = ramp((from * from + 2.0 * a * rising).sqrt() - from);
        // By what is left of the way, so that nothing is left over at its end.
        let slower = ramp(peak - (to * to + 2.0 * a * (nominal - gone)).sqrt().min(peak));
        faster + flat / peak + slower
    }
}

/// How far positions may be from those of axes that go at one speed and still count as on it: of linear axes, mm, and of rotary ones,
/// radians (2·10⁻⁴°). The rounding of angles in the fourth decimal, and what it does to the linear axes that hold the tip for it,
/// which controls smooth away; far less than what a corner is.
const STRAIGHT: [f64; 2] = [1e-3, 3.5e-6];

/// That of an axis.
fn slack(axis: &Axis) -> f64 {
    STRAIGHT[usize::from(axis.is_rotary())]
}

/// Moves in which all axes keep their speeds, as one block.
pub(super) struct Stretch {
    pub(super) block: Block,
    first: usize,
    count: usize,
}

impl Stretch {
    pub(super) fn moves(&self) -> std::ops::Range<usize> {
        self.first..self.first + self.count
    }
}

/// The moves of `path` in which something moves, joined as far as all axes keep their speeds, give or take [`STRAIGHT`]. So the time is that of
/// the motion, in however many blocks it is stated.
pub(super) fn stretches(axes: &[Axis], path: &AxisPath) -> Vec<Stretch> {
    let slack: [f64; 5] = std::array::from_fn(|k| axes.get(k).map_or(0.0, slack));
    let mut found: Vec<Stretch> = Vec::new();
    let mut speeds = [[f64::NEG_INFINITY, f64::INFINITY]; 5];
    for (index, pair) in path.moves.windows(2).enumerate() {
        let (to, seconds) = (pair[1].at.all(), pair[1].seconds);
        if seconds <= 0.0 {
            continue;
        }
        if let Some(last) = found.last_mut().filter(|last| last.first + last.count == index + 1) {
            let (from, nominal) = (path.moves[last.first - 1].at.all(), last.block.nominal + seconds);
            let speed = |k: usize| (to[k] - from[k]) / nominal;
            if (0..5).all(|k| speeds[k][0] <= speed(k) && speed(k) <= speeds[k][1]) {
                narrow(&mut speeds, &from, &to, nominal, &slack);
                last.block = Block::of(axes, &from, &to, nominal);
                last.count += 1;
                continue;
            }
        }
        let from = pair[0].at.all();
        speeds = [[f64::NEG_INFINITY, f64::INFINITY]; 5];
        narrow(&mut speeds, &from, &to, seconds, &slack);
        found.push(Stretch { block: Block::of(axes, &from, &to, seconds), first: index + 1, count: 1 });
    }
    found
}

/// Leaves of the speeds those that pass near enough to a position.
fn narrow(speeds: &mut [[f64; 2]; 5], from: &[f64; 5], to: &[f64; 5], nominal: f64, slack: &[f64; 5]) {
    for k in 0..5 {
        let way = to[k] - from[k];
        speeds[k][0] = speeds[k][0].max((way - slack[k]) / nominal);
        speeds[k][1] = speeds[k][1].min((way + slack[k]) / nominal);
    }
}
