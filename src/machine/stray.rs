//! How far a tool that strays from its way matters to what it leaves.

use crate::toolpath::ClPoint;
use glam::DVec3;

/// Where the cutter touches the part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touching {
    /// The point of the part, mm.
    pub point: DVec3,
    /// Its unit normal, out of the material.
    pub normal: DVec3,
}

/// How far a piece strays half-way.
pub(super) struct Stray {
    /// What matters of the way that the tip, or the contact, is off, mm.
    pub(super) off: DVec3,
    /// How many times as much as is allowed.
    pub(super) over: f64,
    /// Likewise what of it is due to the axis.
    pub(super) lean: f64,
}

/// How far the contact goes off its own way where the tip is `off` its own and the axis `leaning` from its own.
///
/// What the cutter leaves is changed by what goes along the normal, and where strips meet by a share of what goes across them, as the
/// cutter's sides rise there. The tip itself may be off by more, since the contact is what matters.
pub(super) fn at_contact(
    touching: &[Touching; 2],
    middle: &ClPoint,
    share: f64,
    way: DVec3,
    [off, leaning]: [DVec3; 2],
    chord: f64,
) -> Stray {
    let lever = touching[0].point.lerp(touching[1].point, share) - middle.tip;
    let normal = touching[0].normal.lerp(touching[1].normal, share);
    let split = |at_contact: DVec3| {
        let up = at_contact.dot(normal);
        let side = across(at_contact - normal * up, way);
        (normal * up + side, (up.abs() + RISE * side.length()) / chord)
    };
    let swung = middle.axis.cross(leaning).cross(lever);
    let (all, over) = split(off + swung);
    Stray { off: all, over: over.max(off.length() / (TIP * chord)), lean: split(swung).1 }
}

/// How steep the cutter's sides may be where strips meet: a ball leaves a cusp of a ninth of its radius there.
const RISE: f64 = 0.5;
/// How many times as much the tip may be off where its contact is known.
pub(super) const TIP: f64 = 4.0;

/// What of a bow `d` matters, half-way on a piece.
///
/// It carries the tip to `a + t (b − a) + 4 t (1 − t) d`. What of `d` lies along the piece does no harm while it is no more than a quarter of
/// the piece; beyond that the tip overshoots the ends, and all of `d` counts.
pub(super) fn across(d: DVec3, way: DVec3) -> DVec3 {
    let along = d.dot(way);
    if along.abs() <= 0.25 * way.length_squared() {
        d - way * (along / way.length_squared().max(f64::MIN_POSITIVE))
    } else {
        d
    }
}
