//! The best that any position of an upright cutter can do for one point of the mesh.

use super::line::Lowering;
use glam::{DVec2, DVec3};

/// A point of the mesh, to be finished.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spot {
    pub point: DVec3,
    pub normal: DVec3,
    /// What it stands for, mm².
    pub area: f64,
}

impl Spot {
    /// Where the axis stands when the cutter touches the spot's plane here.
    pub(super) fn axis(&self, lowering: &Lowering<'_>) -> DVec2 {
        let gradient = -self.normal.truncate() / self.normal.z;
        self.point.truncate() - lowering.under.touch_plane(gradient)
    }
}

/// Newton's steps towards the cutter; it doubles its digits each step once near.
const STEPS: usize = 12;

impl Lowering<'_> {
    /// What a cutter lowered at `axis` leaves on the spot, along its normal, mm; infinite where the normal misses the
    /// cutter or the cutter the mesh.
    ///
    /// Along the normal the room over the underside is concave, so that Newton's steps from the mesh stay short of the
    /// cutter and close in on it.
    fn excess(&self, spot: &Spot, axis: DVec2) -> f64 {
        if self.mesh.top(axis.x, axis.y).is_none() {
            return f64::INFINITY;
        }
        let Some(drop) = self.at(axis.x, axis.y) else { return f64::INFINITY };
        let mut t = 0.0;
        for _ in 0..STEPS {
            let p = spot.point + t * spot.normal;
            let from = p.truncate() - axis;
            let radius = from.length();
            if radius > self.under.reach() {
                return f64::INFINITY;
            }
            let room = p.z - drop.tip - self.under.height(radius);
            if room >= -1e-9 {
                break;
            }
            let outward = if radius > 0.0 { from / radius } else { DVec2::ZERO };
            let gain = spot.normal.z - self.under.slope(radius) * outward.dot(spot.normal.truncate());
            if gain <= 0.0 {
                return f64::INFINITY;
            }
            t -= room / gain;
        }
        t
    }

    /// A place of the axis, over the mesh, from which the lowered cutter leaves at most `limit` on the spot; `None` if
    /// the search finds none. It begins where the cutter would touch the spot and goes by ever shorter steps to
    /// whatever place around leaves less.
    pub(super) fn reach(&self, spot: &Spot, limit: f64) -> Option<DVec2> {
        let contact = spot.axis(self);
        let over = spot.point.truncate();
        let mut best = (f64::INFINITY, contact);
        for start in [contact, 0.5 * (contact + over), over] {
            let excess = self.excess(spot, start);
            if excess <= limit {
                return Some(start);
            }
            if excess < best.0 {
                best = (excess, start);
            }
        }
        let mut step = SEARCH * self.under.reach();
        while step > self.under.reach() * SEARCH_END {
            let around = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y].map(|way| best.1 + way * step);
            let old = best.0;
            for place in around {
                let excess = self.excess(spot, place);
                if excess <= limit {
                    return Some(place);
                }
                if excess < best.0 {
                    best = (excess, place);
                }
            }
            if best.0 >= old {
                step *= 0.5;
            }
        }
        None
    }
}

/// First step of the search for a better place, as a part of the cutter's radius.
const SEARCH: f64 = 0.2;
/// Last step: at the bottom of a groove a hundredth of the radius changes what is left by ten-thousandths of it.
const SEARCH_END: f64 = 0.01;
