//! Toric surfaces: a circle swept about an axis in its plane.

use super::Sag;
use super::root::{END, root_line};
use crate::turning::height_jet::HeightJet;

/// Which way the two sections bend, seen from the tool.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ToricKind {
    /// Both sections bend away from the tool.
    Convex,
    /// Both bend towards it.
    Concave,
    /// The base circle bends away, the sweep towards the tool.
    SaddleConvexBase,
    /// The base circle bends towards the tool, the sweep away from it.
    SaddleConcaveBase,
}

/// A piece of a torus about an axis parallel to y, its vertex at the origin. The base circle lies in x = 0.
///
/// For the convex kind `z = −(R + a) + √((R + √(a² − y²))² − x²)`; `a` is the base circle's radius and `R` the distance from
/// the axis of the sweep to the circle's centre: negative where the section along x bends more than the base circle.
///
/// Source: paper 004, eqs. 4 and 9 (X. Qiu, Y. Zhang, H. Wang, tool path planning for toric surfaces by slow tool
/// servo), there for the convex kind with R > 0; the other kinds follow from the sign of either bend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Toric {
    kind: ToricKind,
    base: f64,
    rotation: f64,
    /// How far the tool's centre is above: the radius of a ball, or 0 for the surface itself.
    lift: f64,
}

impl Toric {
    /// The torus of this kind; `base` is a, `rotation` is R, in mm. `None` unless a > 0 and the section along x has a radius
    /// above 0: `R + a` for two like bends, `R − a` for a saddle.
    pub fn new(kind: ToricKind, base: f64, rotation: f64) -> Option<Self> {
        let made = Self { kind, base, rotation, lift: 0.0 };
        (base > 0.0 && base.is_finite() && rotation.is_finite() && made.sweep() > 0.0).then_some(made)
    }

    /// The surface on which the centre of a ball of `radius` lies that touches this one: a becomes `a + radius`
    /// under the roots, or `a − radius` where the base circle bends towards the tool, and the constants stay.
    ///
    /// `None` where the ball is larger than a hollow.
    pub fn offset(&self, radius: f64) -> Option<Self> {
        let made = Self { lift: self.lift + radius, ..*self };
        (made.tube() > 0.0 && made.sweep() + made.sweep_sign() * made.lift > 0.0).then_some(made)
    }

    /// Radius of the section along x at the vertex, mm: of the surface itself, not of its offset.
    pub fn sweep(&self) -> f64 {
        self.rotation + self.base * self.like()
    }

    /// Whether both sections bend one way: 1 if they do, −1 if not.
    fn like(&self) -> f64 {
        self.base_sign() * self.sweep_sign()
    }

    fn base_sign(&self) -> f64 {
        match self.kind {
            ToricKind::Convex | ToricKind::SaddleConvexBase => 1.0,
            ToricKind::Concave | ToricKind::SaddleConcaveBase => -1.0,
        }
    }

    fn sweep_sign(&self) -> f64 {
        match self.kind {
            ToricKind::Convex | ToricKind::SaddleConcaveBase => 1.0,
            ToricKind::Concave | ToricKind::SaddleConvexBase => -1.0,
        }
    }

    /// Radius of the circle that is swept.
    fn tube(&self) -> f64 {
        self.base + self.base_sign() * self.lift
    }

    /// Below these the two roots are carried on in a line.
    fn ends(&self) -> [f64; 2] {
        let (a, s) = (self.tube(), self.sweep() + self.sweep_sign() * self.lift);
        [END * a * a, END * s * s]
    }

    /// What stands under the inner root, the distance of the circle from the axis of the sweep, and what stands under the outer.
    fn roots(&self, x: f64, y: f64) -> [HeightJet; 3] {
        let a = self.tube();
        let inner = HeightJet { z: a * a - y * y, g: [0.0, -2.0 * y], h: [0.0, 0.0, -2.0] };
        let p = inner.map(root_line(inner.z, self.ends()[0]));
        let d = HeightJet::constant(self.rotation) + p * self.like();
        let outer = d * d - HeightJet { z: x * x, g: [2.0 * x, 0.0], h: [2.0, 0.0, 0.0] };
        [inner, d, outer]
    }
}

impl Sag for Toric {
    fn at(&self, x: f64, y: f64) -> HeightJet {
        let [_, _, outer] = self.roots(x, y);
        let w = outer.map(root_line(outer.z, self.ends()[1]));
        (w - HeightJet::constant(self.sweep())) * self.sweep_sign()
    }

    fn reaches(&self, x: f64, y: f64) -> bool {
        let [inner, d, outer] = self.roots(x, y);
        let [a, s] = self.ends();
        inner.z >= a && outer.z >= s && d.z > 0.0
    }

    fn reach(&self) -> String {
        let share = (1.0 - END).sqrt();
        format!(
            "a toric with base circle {} mm and section {} mm reaches to |y| = {:.3} mm along the base circle and |x| = {:.3} mm across",
            self.base,
            self.sweep(),
            share * self.base,
            share * self.sweep()
        )
    }
}
