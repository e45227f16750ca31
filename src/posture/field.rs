//! The posture at any place of a face.

#[cfg(feature = "flow")]
use super::Limits;
use super::spline::Axis;
use crate::geometry::{Jet, Uv};
use crate::math::frame::Frame;
use crate::toolpath::{Bound, Posture};

/// The posture at any place of a face, for one way of feed through every place and, where it was asked for, for the other.
#[derive(Debug, Clone)]
pub struct PostureField {
    typical: Posture,
    /// Forwards and backwards; empty where the posture is the same everywhere.
    ways: Vec<Way>,
    misfits: Vec<Uv>,
    largest_fit: Option<f64>,
    #[cfg(feature = "flow")]
    limits: Option<Limits>,
}

/// How fast a posture changes along the feed, radians per mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turning {
    /// Of the lead.
    pub lead: f64,
    /// Of the yaw.
    pub yaw: f64,
}

/// Postures for one way of feed.
#[derive(Debug, Clone)]
pub(super) struct Way {
    pub(super) axes: [Axis; 2],
    /// Lead and yaw at the nodes, u running fastest.
    pub(super) postures: Vec<Posture>,
    /// What keeps each lead from being less; empty where nobody asks.
    pub(super) bounds: Vec<Bound>,
    /// How far the cutter is lifted there, mm; empty where it is nowhere.
    pub(super) lifts: Vec<f64>,
}

impl PostureField {
    /// The same posture everywhere.
    pub fn fixed(posture: Posture) -> Self {
        Self {
            typical: posture,
            ways: Vec::new(),
            misfits: Vec::new(),
            largest_fit: None,
            #[cfg(feature = "flow")]
            limits: None,
        }
    }

    /// At least one way; `typical` is the mean posture, and what was chosen for the widest strips within `limits` may lean more.
    pub(super) fn chosen(
        typical: Posture,
        ways: Vec<Way>,
        misfits: Vec<Uv>,
        largest_fit: Option<f64>,
        #[cfg(feature = "flow")] limits: Option<Limits>,
    ) -> Self {
        Self {
            typical,
            ways,
            misfits,
            largest_fit,
            #[cfg(feature = "flow")]
            limits,
        }
    }

    /// The posture at `uv`, for feed the one way or `reversed`, each in its own contact frame.
    pub fn at(&self, uv: Uv, reversed: bool) -> Posture {
        self.way(reversed).map_or(self.typical, |way| way.at(uv).0)
    }

    /// The posture at `uv`, where the face's jet and the contact frame are these, and how it changes along the frame's
    /// `f`: nothing where it is the same everywhere or the jet is a pole's.
    pub fn moving(&self, uv: Uv, reversed: bool, jet: &Jet, frame: &Frame) -> (Posture, Option<Turning>) {
        let Some(way) = self.way(reversed) else { return (self.typical, None) };
        let (posture, [along_u, along_v]) = way.at(uv);
        let turning = jet.pull_back(frame.f).map(|(u, v)| Turning {
            lead: along_u.lead * u + along_v.lead * v,
            yaw: along_u.yaw * u + along_v.yaw * v,
        });
        (posture, turning)
    }

    /// How far the cutter stands off the surface at `uv`, mm: above 0 where both its sides touch a hollow.
    pub fn lift(&self, uv: Uv, reversed: bool) -> f64 {
        self.way(reversed).map_or(0.0, |way| way.lift(uv))
    }

    /// What keeps the lead at `uv` from being less.
    pub fn bound(&self, uv: Uv, reversed: bool) -> Bound {
        self.way(reversed).map_or(Bound::Given, |way| {
            let [i, j] = [way.axes[0].nearest(uv.u), way.axes[1].nearest(uv.v)];
            way.bounds[j * way.axes[0].len() + i]
        })
    }

    /// Whether the posture is the same everywhere.
    pub fn is_fixed(&self) -> bool {
        self.ways.is_empty()
    }

    /// The mean posture over the face: what strips are mostly cut with.
    pub fn typical(&self) -> Posture {
        self.typical
    }

    /// The limits within which postures were chosen for the widest strips; nothing where another rule tells them.
    #[cfg(feature = "flow")]
    pub fn limits(&self) -> Option<Limits> {
        self.limits
    }

    /// Nodes at which the cutter fits in no posture within the limits, on its first way of feed.
    pub fn misfits(&self) -> &[Uv] {
        &self.misfits
    }

    /// How much smaller than the cutter, as a share of it, the largest cutter of its shape is that would fit at all of
    /// [`PostureField::misfits`]; nothing where there are none, or where none of a fiftieth fits.
    pub fn largest_fit(&self) -> Option<f64> {
        self.largest_fit
    }

    fn way(&self, reversed: bool) -> Option<&Way> {
        self.ways.get(usize::from(reversed)).or(self.ways.first())
    }
}

impl Way {
    /// The posture at `uv`, and its derivatives by u and by v.
    pub(super) fn at(&self, uv: Uv) -> (Posture, [Posture; 2]) {
        let [wu, wv] = [self.axes[0].weights(uv.u), self.axes[1].weights(uv.v)];
        let count = self.axes[0].len();
        let mut sums = [Posture::default(); 3];
        for (b, &j) in wv.nodes.iter().enumerate() {
            for (a, &i) in wu.nodes.iter().enumerate() {
                let node = self.postures[j * count + i];
                let weights =
                    [wu.value[a] * wv.value[b], wu.slope[a] * wv.value[b], wu.value[a] * wv.slope[b]];
                for (sum, weight) in sums.iter_mut().zip(weights) {
                    sum.lead += weight * node.lead;
                    sum.yaw += weight * node.yaw;
                }
            }
        }
        let [value, along_u, along_v] = sums;
        (value, [along_u, along_v])
    }

    /// The lift at `uv`, mm.
    pub(super) fn lift(&self, uv: Uv) -> f64 {
        if self.lifts.is_empty() {
            return 0.0;
        }
        let [wu, wv] = [self.axes[0].weights(uv.u), self.axes[1].weights(uv.v)];
        let row = |j: usize| -> f64 {
            wu.nodes
                .iter()
                .zip(wu.value)
                .map(|(i, weight)| weight * self.lifts[j * self.axes[0].len() + i])
                .sum()
        };
        wv.nodes.iter().zip(wv.value).map(|(&j, weight)| weight * row(j)).sum()
    }
}
