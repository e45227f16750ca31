//! A conic with a polynomial in x and y on top.

use super::{Conic, Sag};
use crate::turning::height_jet::HeightJet;

/// Highest power of x or y.
pub(super) const MOST_POWER: usize = 20;

/// One term `height · (x/N)^i (y/N)^j`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Term {
    /// Powers of x and y, each at most 20; higher ones count as 20.
    pub powers: [usize; 2],
    /// mm.
    pub height: f64,
}

/// A conic with a polynomial on top: XY freeforms, and Zernike ones written out in powers.
#[derive(Debug, Clone, PartialEq)]
pub struct Freeform {
    base: Conic,
    terms: Vec<Term>,
    /// N, mm.
    norm: f64,
    /// Highest power used.
    degree: usize,
    /// Beyond this |x| or |y|, mm, each power goes on linearly.
    extent: f64,
}

impl Freeform {
    /// `base` with `terms` whose coordinates are divided by `norm` (mm, above 0); beyond |x| or |y| = `extent` mm powers go on
    /// linearly, so that the polynomial does not run away where the tool leaves the part.
    pub fn new(base: Conic, terms: Vec<Term>, norm: f64, extent: f64) -> Self {
        let clamp = |t: &Term| Term { powers: t.powers.map(|p| p.min(MOST_POWER)), ..*t };
        let terms: Vec<Term> = terms.iter().map(clamp).filter(|t| t.height != 0.0).collect();
        let degree = terms.iter().flat_map(|t| t.powers).max().unwrap_or(0);
        Self { base, terms, norm, degree, extent }
    }

    /// Powers of `x/N` with first and second derivatives along x.
    fn powers(&self, x: f64) -> [[f64; 3]; MOST_POWER + 1] {
        let k = 1.0 / self.norm;
        let inside = x.clamp(-self.extent, self.extent);
        let (u, beyond) = (inside * k, x - inside);
        let mut all = [[0.0; 3]; MOST_POWER + 1];
        all[0][0] = 1.0;
        for n in 1..=self.degree {
            let [p, p1, p2] = all[n - 1];
            all[n] = [p * u, p1 * u + p * k, p2 * u + 2.0 * p1 * k];
        }
        if beyond != 0.0 {
            for [p, p1, p2] in &mut all {
                *p += *p1 * beyond;
                *p2 = 0.0;
            }
        }
        all
    }
}

impl Sag for Freeform {
    fn at(&self, x: f64, y: f64) -> HeightJet {
        let (px, py) = (self.powers(x), self.powers(y));
        let mut sum = self.base.at(x, y);
        for Term { powers: [i, j], height } in &self.terms {
            let ([a, a1, a2], [b, b1, b2]) = (px[*i], py[*j]);
            sum.z += height * a * b;
            sum.g[0] += height * a1 * b;
            sum.g[1] += height * a * b1;
            sum.h[0] += height * a2 * b;
            sum.h[1] += height * a1 * b1;
            sum.h[2] += height * a * b2;
        }
        sum
    }

    fn reaches(&self, x: f64, y: f64) -> bool {
        self.base.reaches(x, y)
    }

    fn reach(&self) -> String {
        self.base.reach()
    }
}
