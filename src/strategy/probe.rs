//! Contact and strip at the points of a level line.

use super::Finish;
use crate::contact::{Body, Edge, FaceObstacle, FaceStrip, StripLimits, Sweep, cl_of};
use crate::cutter::{Cutter, Holder};
use crate::geometry::{Curvature, Face, Field, IsoLine, Jet, Uv};
use crate::math::frame::Frame;
use crate::posture::{PostureField, moving_strip};
use crate::toolpath::{Bound, CcPoint, ClPoint, Station, Work};
use glam::DVec3;

/// Everything that decides what the cutter does at a point of a family of level lines.
#[derive(Debug, Clone)]
pub(super) struct Setup<'a> {
    pub(super) face: &'a Face,
    pub(super) obstacle: FaceObstacle,
    pub(super) cutter: &'a Cutter,
    pub(super) holder: Option<Holder>,
    pub(super) postures: PostureField,
    pub(super) finish: Finish,
    /// Counts passes, which are its level lines or lie beside those.
    pub(super) field: Field,
    /// Whose level lines passes follow, forwards and backwards, where those are not the ones of `field`: they lie beside them, so that
    /// strips lie about them.
    pub(super) courses: Option<[Field; 2]>,
    /// Tells which points of neighbouring passes lie abreast.
    pub(super) column: Field,
    /// Width of the strip on flat ground, mm.
    pub(super) strip: f64,
}

/// How deep the cutter may reach into the face before a contact counts as blocked, mm: half of the micrometre that a
/// path may gouge, so that the chords between stations have the other half.
pub(super) const GOUGE: f64 = 0.0005;

/// Lean of a strip up to which the run-out of its pass surely cuts what the strip leaves before the border.
const RUN_OUT_LEAN: f64 = 0.25;

/// Share of the limit that strips reach to: what spacing and the places that are looked at afterwards miss has the rest. It
/// costs half as much of the width.
const AIM: f64 = 0.998;

/// An edge nearer to the contact than this part of a strip is at the contact.
const AT_CONTACT: f64 = 1e-3;
/// An angle on the centre circle over which the envelope is straight, radians.
const LITTLE: f64 = 1e-5;

/// How far a strip reaches to one side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Reach {
    /// To this level and column of the family, at this point.
    To { level: f64, column: f64, point: DVec3, uv: Uv },
    /// Over the border of the face; column and point of the contact itself.
    Border { column: f64, point: DVec3 },
    /// Over the border at an end of the line, ahead of the contact or behind it: the pass runs out there and cuts what the
    /// strip leaves.
    Aside,
}

/// What the cutter does at one point of a level line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Probe {
    /// It finishes a strip: how far towards higher and lower levels.
    Strip { up: Reach, down: Reach },
    /// It cannot go there.
    Blocked,
}

/// Jet and frame at `uv` with feed along the level line of `field`, higher levels to the left, or to the right if
/// `reversed`; `None` where the field stands still or the face has no normal.
pub(super) fn contact_frame(face: &Face, field: &Field, uv: Uv, reversed: bool) -> Option<(Jet, Frame)> {
    let (jet, n) = face.at(uv)?;
    let rise = field.surface_gradient(uv, &jet);
    let feed = rise.cross(n) * if reversed { -1.0 } else { 1.0 };
    let frame = Frame::from_normal(n, feed)?;
    (frame.f.is_finite() && frame.b.is_finite()).then_some((jet, frame))
}

impl Setup<'_> {
    /// Whose level lines passes of this way of feed follow.
    pub(super) fn course(&self, reversed: bool) -> &Field {
        self.courses.as_ref().map_or(&self.field, |courses| &courses[usize::from(reversed)])
    }

    /// The [`contact_frame`] at `uv`.
    pub(super) fn frame(&self, uv: Uv, reversed: bool) -> Option<(Jet, Frame)> {
        contact_frame(self.face, self.course(reversed), uv, reversed)
    }

    /// The station at `uv`, clear or not.
    pub(super) fn station(&self, uv: Uv, reversed: bool) -> Option<Station> {
        let (jet, frame) = self.frame(uv, reversed)?;
        let point = jet.p + frame.n * self.postures.lift(uv, reversed);
        let cc = CcPoint { point, frame, posture: self.postures.at(uv, reversed) };
        let work = Work { strip: None, bound: self.postures.bound(uv, reversed) };
        Some(Station { cc, cl: cl_of(self.cutter, &cc), work })
    }

    /// The `station` with so much more lead, radians, which its holder or its body then needs.
    pub(super) fn leaning(&self, station: &Station, more: f64) -> Station {
        let Station { mut cc, mut work, .. } = *station;
        cc.posture.lead += more;
        if more > 0.0 {
            work.bound = if self.holder_clears(&station.cl) { Bound::Body } else { Bound::Holder };
        }
        Station { cc, cl: cl_of(self.cutter, &cc), work }
    }

    /// Whether the cutter at `station`, which stands at `uv`, reaches into the face nowhere: neither beside its contact
    /// nor anywhere else.
    pub(super) fn fits(&self, station: &Station, uv: Uv) -> bool {
        let (cl, cc) = (&station.cl, &station.cc);
        !self.obstacle.digs_beside(self.cutter, cl, uv, &cc.frame, -GOUGE)
            && !self.obstacle.digs(self.cutter, cl, cc.point, -GOUGE)
            && self.holder_clears(cl)
    }

    /// Whether the cutter at `cl`, which touches nothing, reaches into the face nowhere at all.
    pub(super) fn is_off(&self, cl: &ClPoint) -> bool {
        !self.obstacle.digs(self.cutter, cl, DVec3::INFINITY, -GOUGE) && self.holder_clears(cl)
    }

    fn holder_clears(&self, cl: &ClPoint) -> bool {
        self.holder.is_none_or(|holder| self.obstacle.clears_holder(&holder, cl, 0.0))
    }

    /// The strip at `uv` on a level line; `None` where the cutter cannot go.
    pub(super) fn strip(&self, uv: Uv, reversed: bool) -> Option<FaceStrip> {
        if !self.fits(&self.station(uv, reversed)?, uv) {
            return None;
        }
        let strip = self.moving_strip(uv, reversed, 0.0)?;
        let gouges = matches!(strip.left, Edge::Gouge(_)) || matches!(strip.right, Edge::Gouge(_));
        (!gouges).then_some(strip)
    }

    /// Whether the envelope at `uv` of the cutter with so much more lead (radians), which stands at `station`, digs in nowhere
    /// beside its contact, nor where it leaves over a border.
    pub(super) fn slides_clear(&self, uv: Uv, reversed: bool, more: f64, station: &Station) -> bool {
        let Some(strip) = self.moving_strip(uv, reversed, more) else { return false };
        let body = Body::new(self.cutter, &station.cl);
        let clears = |edge: Edge| match edge {
            Edge::Reached(_) => true,
            Edge::Border(foot) => body.distance(self.face.surface.point(foot)) >= -GOUGE,
            Edge::Gouge(_) => false,
        };
        clears(strip.left) && clears(strip.right)
    }

    /// The strip at `uv` with so much more lead (radians), whether the cutter can go there or not; `None` at a pole.
    fn moving_strip(&self, uv: Uv, reversed: bool, more: f64) -> Option<FaceStrip> {
        let (jet, frame) = self.frame(uv, reversed)?;
        let (mut posture, turning) = self.postures.moving(uv, reversed, &jet, &frame);
        posture.lead += more;
        let point = jet.p + frame.n * self.postures.lift(uv, reversed);
        let cc = CcPoint { point, frame, posture };
        let k = Curvature::of(&jet, &frame)?;
        let geodesic = self.course(reversed).geodesic_curvature(uv, &jet, &frame, k.ff);
        let geodesic = if geodesic.is_finite() { geodesic } else { 0.0 };
        let spin = frame.f * k.fb - frame.b * k.ff + frame.n * geodesic;
        // Chords over a hollow run above the path by up to the chord tolerance, and the cusps with them.
        let lift = if k.ff > 0.0 { self.finish.chord } else { 0.0 };
        let limits = StripLimits { scallop: AIM * self.finish.scallop - lift, gouge: GOUGE };
        moving_strip(self.face, self.cutter, &cc, uv, (spin, turning), limits)
    }

    /// About how wide the strip at `uv` is, mm: the one on flat ground, or where postures are chosen and strips may be much
    /// wider, its own.
    pub(super) fn breadth(&self, uv: Uv, reversed: bool) -> f64 {
        if self.postures.is_fixed() {
            return self.strip;
        }
        let (Some((jet, frame)), Some(strip)) =
            (self.frame(uv, reversed), self.moving_strip(uv, reversed, 0.0))
        else {
            return self.strip;
        };
        let half = |edge| self.half(&frame, jet.p, edge).unwrap_or(0.0);
        (2.0 * half(strip.left).max(half(strip.right))).max(self.strip)
    }

    /// Width of the strip at `uv` of the cutter at `station`, mm; a half that ends at a border counts as much as the other. `None`
    /// where both do, where the cutter digs in, and at a pole.
    pub(super) fn width(&self, uv: Uv, reversed: bool, station: &Station) -> Option<f64> {
        let more = station.cc.posture.lead - self.postures.at(uv, reversed).lead;
        let strip = self.moving_strip(uv, reversed, more)?;
        let [left, right] = [
            self.half(&station.cc.frame, station.cc.point, strip.left)?,
            self.half(&station.cc.frame, station.cc.point, strip.right)?,
        ];
        match (strip.left, strip.right) {
            (Edge::Border(_), Edge::Reached(_)) => Some(2.0 * right),
            (Edge::Reached(_), Edge::Border(_)) => Some(2.0 * left),
            (Edge::Border(_), Edge::Border(_)) => None,
            _ => Some(left + right),
        }
    }

    /// How far the middle of the strip at `uv` lies beside the contact, mm, above 0 towards higher levels; `None` where not both of its
    /// edges lie on the face.
    #[cfg(feature = "flow")]
    pub(super) fn middle(&self, uv: Uv, reversed: bool) -> Option<f64> {
        let (jet, frame) = self.frame(uv, reversed)?;
        let strip = self.moving_strip(uv, reversed, 0.0)?;
        let (Edge::Reached(left), Edge::Reached(right)) = (strip.left, strip.right) else { return None };
        let beside = |foot: Uv| (self.face.surface.point(foot) - jet.p).dot(frame.b);
        let middle = 0.5 * (beside(left) + beside(right));
        Some(if reversed { -middle } else { middle })
    }

    /// How far `edge` lies beside the `contact` with this frame, mm; `None` where the cutter digs in.
    fn half(&self, frame: &Frame, contact: DVec3, edge: Edge) -> Option<f64> {
        match edge {
            Edge::Reached(foot) | Edge::Border(foot) => {
                Some((self.face.surface.point(foot) - contact).dot(frame.b).abs())
            }
            Edge::Gouge(_) => None,
        }
    }

    /// What the cutter does at `uv`.
    pub(super) fn probe(&self, uv: Uv, reversed: bool) -> Probe {
        let Some(strip) = self.strip(uv, reversed) else { return Probe::Blocked };
        let (up, down) = if reversed { (strip.right, strip.left) } else { (strip.left, strip.right) };
        match (self.reach(up, uv), self.reach(down, uv)) {
            (Some(up), Some(down)) => Probe::Strip { up, down },
            _ => Probe::Blocked,
        }
    }

    fn reach(&self, edge: Edge, contact: Uv) -> Option<Reach> {
        match edge {
            // A strip that lies far aslant leaves over the ends of its line: there it still ends at a level. Where it leans
            // less, what it leaves there is cut as the pass runs out.
            Edge::Border(uv) if self.ends_levels(uv) || self.leans_little(contact, uv) => {
                let point = self.face.surface.point(contact);
                Some(Reach::Border { column: self.column.value(contact, point), point })
            }
            Edge::Border(uv) if self.runs_out(uv) => Some(Reach::Aside),
            Edge::Reached(uv) | Edge::Border(uv) => {
                let point = self.face.surface.point(uv);
                let (level, column) = (self.field.value(uv, point), self.column.value(uv, point));
                Some(Reach::To { level, column, point, uv })
            }
            Edge::Gouge(_) => None,
        }
    }

    fn leans_little(&self, contact: Uv, edge: Uv) -> bool {
        let Some((jet, frame)) = self.frame(contact, false) else { return false };
        if self.face.surface.point(edge).distance(jet.p) >= AT_CONTACT * self.strip {
            return self.lean(&frame, jet.p, edge) < RUN_OUT_LEAN;
        }
        // A border right at the contact gives no direction, but how the strip leaves the contact does.
        let Some(k) = Curvature::of(&jet, &frame) else { return false };
        let (posture, _) = self.postures.moving(contact, false, &jet, &frame);
        let cc = CcPoint { point: jet.p, frame, posture };
        let sweep = Sweep::new(self.cutter, &cc, frame.f, frame.f * k.fb - frame.b * k.ff);
        let away = sweep.point(LITTLE * sweep.left(frame.b)) - jet.p;
        away.dot(frame.f).abs() < RUN_OUT_LEAN * away.dot(frame.b).abs()
    }

    /// How far `edge` lies ahead of the `contact` with this frame or behind it, as a share of how far beside it; not a
    /// number where it lies right there.
    pub(super) fn lean(&self, frame: &Frame, contact: DVec3, edge: Uv) -> f64 {
        let away = self.face.surface.point(edge) - contact;
        (away.dot(frame.f) / away.dot(frame.b)).abs()
    }

    /// Whether the border at `uv` is one that the levels end at. Where planes cut a face aslant, any border is.
    fn ends_levels(&self, uv: Uv) -> bool {
        let domain = self.face.domain();
        match self.field {
            Field::U => domain.u.is_near_end(uv.u),
            Field::V => domain.v.is_near_end(uv.v),
            Field::Along(_) | Field::Given(_) => true,
        }
    }

    /// The nodes of `line` in the order of feed.
    pub(super) fn in_feed_order(&self, line: &IsoLine, reversed: bool) -> Vec<Uv> {
        let mut nodes = line.nodes.clone();
        let point = |uv: Uv| self.face.surface.point(uv);
        let middle = nodes.len() / 2;
        let along = point(nodes[middle]) - point(nodes[middle - 1]);
        let against = self.frame(nodes[middle], reversed).is_some_and(|(_, frame)| frame.f.dot(along) < 0.0);
        if against {
            nodes.reverse();
        }
        nodes
    }
}
