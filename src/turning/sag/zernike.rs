//! Zernike polynomials, written out in powers of x and y.

use super::polynomial::{MOST_POWER, Term};

/// One Zernike term: `height · R_n^|m|(ρ) · cos mθ`, or `sin |m|θ` where m < 0, with ρ counted in the normalising radius and
/// each polynomial 1 at the rim of its own maximum direction (no factor for unit mean square).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ZernikeTerm {
    /// Radial order n, at most 20.
    pub order: usize,
    /// Azimuthal frequency m, with n − |m| even and not negative.
    pub frequency: i64,
    /// mm.
    pub height: f64,
}

/// The powers of x and y that `terms` add up to, in coordinates divided by the normalising radius. `Err` holds the number of
/// a term, counted from 0, whose n and m do not go together or whose n is above 20.
///
/// Source: M. Born, E. Wolf, Principles of Optics, section 9.2.
pub fn zernike(terms: &[ZernikeTerm]) -> Result<Vec<Term>, usize> {
    let mut sum = vec![[0.0; MOST_POWER + 1]; MOST_POWER + 1];
    for (index, term) in terms.iter().enumerate() {
        let (n, m) = (term.order, term.frequency.unsigned_abs() as usize);
        if n > MOST_POWER || m > n || (n - m) % 2 == 1 {
            return Err(index);
        }
        for k in 0..=(n - m) / 2 {
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            let radial = sign * choose(n - k, k) * choose(n - 2 * k, (n - m) / 2 - k) * term.height;
            // ρ^(n−2k) cos mθ = (x² + y²)^q Re (x + iy)^m.
            let q = (n - 2 * k - m) / 2;
            for i in 0..=q {
                let even = radial * choose(q, i);
                for j in (usize::from(term.frequency < 0)..=m).step_by(2) {
                    // i^j is real for even j, imaginary for odd j.
                    let turn = if (j / 2) % 2 == 0 { 1.0 } else { -1.0 };
                    sum[2 * (q - i) + m - j][2 * i + j] += even * turn * choose(m, j);
                }
            }
        }
    }
    let mut all = Vec::new();
    for (i, row) in sum.iter().enumerate() {
        for (j, &height) in row.iter().enumerate() {
            if height != 0.0 {
                all.push(Term { powers: [i, j], height });
            }
        }
    }
    Ok(all)
}

/// Binomial coefficient; exact for n ≤ 20.
fn choose(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |c, i| c * (n - i) as f64 / (i + 1) as f64).round()
}
