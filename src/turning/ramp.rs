//! How the spindle gets going and comes to rest.

use std::f64::consts::TAU;

/// The angle in which the spindle gets going, and that in which it comes to rest, radians. A guide has more than twice as much,
/// and there the nose is on or beyond the rim, or stays on the axis.
pub(super) const RAMP: f64 = TAU;

/// From rest to rest over the angles 0 to `length`: the speed is a share of what it is on the way, `3τ² − 2τ³` over the time `τ` from 0
/// to 1 of either end, so that the acceleration of C begins and ends at 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ramp {
    length: f64,
}

/// Where a ramp is at an angle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ramped {
    /// The time that has gone at a speed on the way of 1 rad/s.
    pub(super) time: f64,
    /// The share of the speed on the way.
    pub(super) share: f64,
    /// Its change with `time`.
    pub(super) change: f64,
}

impl Ramp {
    /// `length` must be at least twice [`RAMP`].
    pub(super) fn new(length: f64) -> Self {
        Self { length }
    }

    /// Whether the speed is that on the way.
    pub(super) fn is_done(&self, c: f64) -> bool {
        (RAMP..=self.length - RAMP).contains(&c)
    }

    pub(super) fn at(&self, c: f64) -> Ramped {
        if self.is_done(c) {
            return Ramped { time: c + RAMP, share: 1.0, change: 0.0 };
        }
        let from_end = self.length - c;
        if c < RAMP {
            let t = gone(c / RAMP);
            return Ramped { time: 2.0 * RAMP * t, ..speed(t) };
        }
        let t = gone(from_end / RAMP);
        let Ramped { share, change, .. } = speed(t);
        Ramped { time: self.length + 2.0 * RAMP * (1.0 - t), share, change: -change }
    }

    /// The angle at which [`Ramped::time`] is `time`.
    pub(super) fn angle(&self, time: f64) -> f64 {
        if time < 2.0 * RAMP {
            return RAMP * way(time / (2.0 * RAMP));
        }
        let over = time - self.length;
        if over > 0.0 { self.length - RAMP * way(1.0 - over / (2.0 * RAMP)) } else { time - RAMP }
    }
}

fn speed(t: f64) -> Ramped {
    Ramped { time: 0.0, share: t * t * (3.0 - 2.0 * t), change: 3.0 * t * (1.0 - t) / RAMP }
}

/// The share of the ramp's angle that is gone at the share `t` of its time.
fn way(t: f64) -> f64 {
    t * t * t * (2.0 - t)
}

/// The other way: [`way`] rises, and bends up only, so that Newton's steps from 1 go down to the place and not beyond.
fn gone(w: f64) -> f64 {
    let mut t: f64 = 1.0;
    // At the very start it is a cube root, where each step takes a third: 1e-18 of the angle takes 40.
    for _ in 0..60 {
        let next = t - (way(t) - w) / (t * t * (6.0 - 4.0 * t)).max(f64::MIN_POSITIVE);
        if next >= t || next <= 0.0 {
            break;
        }
        t = next;
    }
    if w <= 0.0 { 0.0 } else { t }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_and_angles_undo_each_other_and_speeds_are_theirs() {
        let ramp = Ramp::new(30.0);
        let mut before = ramp.at(0.0);
        assert!(before.time == 0.0 && before.share == 0.0);
        for i in 1..=3000 {
            let c = 0.01 * f64::from(i);
            let now = ramp.at(c);
            assert!((ramp.angle(now.time) - c).abs() < 1e-12, "{c}");
            let dt = now.time - before.time;
            let middle = 0.5 * (now.share + before.share);
            // From rest a step takes long, and the mean of its ends tells less of it.
            assert!((0.01 - middle * dt).abs() < 5e-3 * dt, "{c}");
            let bend = 0.5 * (now.change + before.change);
            assert!((now.share - before.share - bend * dt).abs() < 3e-2 * dt, "{c}");
            before = now;
        }
        assert!((before.time - 30.0 - 2.0 * RAMP).abs() < 1e-12 && before.share == 0.0);
    }
}
