//! What can be done as asked, but somebody should know.

use super::spec::{ToolSpec, TurningSpec};
use crate::post::xzc::{Dialect, XWord};
use crate::toolpath::TurningPath;
use crate::turning::{Order, Planned};

/// Digits of a number that Fanuc controls take.
const FANUC_DIGITS: usize = 9;

/// What is worth to be known about a plan and the text that states it; each begins with the setting that it is about.
pub(super) fn warnings(
    spec: &TurningSpec,
    order: &Order,
    planned: &Planned,
    emitted: &TurningPath,
) -> Vec<String> {
    let mut all = Vec::new();
    let (cusp, asked) = (planned.cusp.height, order.asked.residue);
    if cusp > asked {
        let share = (asked / cusp).sqrt();
        all.push(format!(
            "guide.step_mm: turns {:.4} mm apart leave cusps of {:.2} µm at {}, above the {:.2} µm asked for: at most {:.4} mm would do",
            planned.guide.step(),
            1e3 * cusp,
            planned.cusp.at,
            1e3 * asked,
            0.95 * share * planned.guide.step()
        ));
    }
    if let ToolSpec::Insert { rake_deg, radius_mm, .. } = spec.tool {
        let lost = radius_mm * (1.0 - libm::cos(rake_deg.to_radians()));
        if lost > 1e-4 {
            all.push(format!(
                "tool.rake_deg: with a rake of {rake_deg}° the edge is a circle only as ground for it; one that is round in its own face is up to {:.2} µm flatter",
                1e3 * lost
            ));
        }
    }
    if let Some([clearance, ..]) = planned.fit.effective.filter(|e| e[0] < 2.0_f64.to_radians()) {
        all.push(format!(
            "tool.clearance_deg: only {:.2}° are left over the steepest fall",
            clearance.to_degrees()
        ));
    }
    all.extend(rounded(spec, order));
    all.extend(long(spec, emitted));
    all
}

/// Whether the text rounds by more than what is allowed between points.
fn rounded(spec: &TurningSpec, order: &Order) -> Option<String> {
    let off = |decimals: f64| 0.5 * libm::pow(10.0, -decimals);
    let asked = order.asked.chord;
    let decimals = spec.output.decimals_mm;
    let enough = (decimals as u32..=9).find(|d| off(f64::from(*d)) <= asked).unwrap_or(9);
    (off(decimals) > asked).then(|| {
        format!(
            "output.decimals_mm: {decimals} decimals round by up to {:.3} µm, more than the {:.3} µm allowed between points: {enough} would do",
            1e3 * off(decimals),
            1e3 * asked
        )
    })
}

/// Whether a word has more digits than Fanuc controls take: C runs on over all turns.
fn long(spec: &TurningSpec, emitted: &TurningPath) -> Option<String> {
    if spec.dialect() != Dialect::Fanuc {
        return None;
    }
    let (_, x_word, _, _) = spec.words();
    let diameter = if x_word == XWord::Diameter { 2.0 } else { 1.0 };
    let largest = |value: fn(&crate::toolpath::AxisPoint) -> f64| {
        emitted.points.iter().map(|p| value(p).abs()).fold(0.0, f64::max)
    };
    let o = spec.output;
    let words = [
        ("C", "output.decimals_deg", largest(|p| p.c).to_degrees(), "°", o.decimals_deg),
        ("X", "output.decimals_mm", diameter * largest(|p| p.x), " mm", o.decimals_mm),
    ];
    words.into_iter().find_map(|(letter, field, value, unit, decimals)| {
        let whole = format!("{value:.0}").len();
        let count = whole + decimals as usize;
        (count > FANUC_DIGITS).then(|| {
            format!(
                "{field}: {letter} runs to {value:.0}{unit} with {decimals} decimals: {count} digits, where Fanuc controls take {FANUC_DIGITS}: {} decimals would do",
                FANUC_DIGITS.saturating_sub(whole)
            )
        })
    })
}
