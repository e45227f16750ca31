//! What a map of residues says as a whole.

use super::verification::Residue;

/// The share of the area within a tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Band {
    /// ± mm.
    pub limit: f64,
    /// Share of the area within it, 0 to 1.
    pub within: f64,
    /// Share with more left.
    pub over: f64,
    /// Share that is cut deeper.
    pub under: f64,
}

/// The error of form: residues over the aperture, weighted by area in the plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Form {
    /// The least residue, refined between the samples: negative where the tool digs in. Nothing if nothing was cut.
    pub lowest: Option<Residue>,
    /// The largest residue, refined likewise.
    pub highest: Option<Residue>,
    /// Peak to valley, mm: the difference of these two.
    pub peak_to_valley: f64,
    /// Mean, mm.
    pub mean: f64,
    /// Root mean square about the mean, mm: what a shift along z leaves to see.
    pub rms: f64,
    /// The tolerances asked for.
    pub bands: Vec<Band>,
    /// Share of the area that the tool never came near.
    pub uncut: f64,
    /// Samples in the aperture.
    pub samples: usize,
}

/// The sagitta that the cut part has over a chord, beside what it should be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sagitta {
    /// Direction of the chord on the workpiece, radians.
    pub angle: f64,
    /// Length of the chord, mm.
    pub chord: f64,
    /// Of the surface, mm: positive where it is a dome.
    pub nominal: f64,
    /// As cut, mm.
    pub cut: f64,
}

/// `residues` with their weights, as numbers; the extremes come with it, already refined.
pub(super) fn form(
    residues: &[(f64, f64)],
    limits: &[f64],
    lowest: Option<Residue>,
    highest: Option<Residue>,
) -> Form {
    let total: f64 = residues.iter().map(|(_, w)| w).sum();
    let cut = || residues.iter().filter(|(h, _)| h.is_finite());
    let area: f64 = cut().map(|(_, w)| w).sum();
    // A sum of nothing is −0.
    let share = |w: f64, of: f64| if of > 0.0 { w / of + 0.0 } else { 0.0 };
    let mean = share(cut().map(|(h, w)| h * w).sum(), area);
    let square = share(cut().map(|(h, w)| (h - mean) * (h - mean) * w).sum(), area);
    let bands = limits
        .iter()
        .map(|&limit| {
            let over: f64 = residues.iter().filter(|(h, _)| *h > limit).map(|(_, w)| w).sum();
            let under: f64 = residues.iter().filter(|(h, _)| *h < -limit).map(|(_, w)| w).sum();
            let (over, under) = (share(over, total), share(under, total));
            Band { limit, within: (1.0 - over - under).max(0.0), over, under }
        })
        .collect();
    let ends = lowest.zip(highest).map_or(0.0, |(a, b)| b.value - a.value);
    Form {
        lowest,
        highest,
        peak_to_valley: ends,
        mean,
        rms: square.sqrt(),
        bands,
        uncut: share(total - area, total),
        samples: residues.len(),
    }
}
