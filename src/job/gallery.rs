//! Surfaces to begin with.

use super::spec::{SideSpec, SourceSpec, Spec};
use serde_json::{Value, json};

/// A job to begin with.
#[derive(Debug, Clone)]
pub struct Example {
    /// A word that stays the same.
    pub id: &'static str,
    /// The whole job.
    pub spec: Spec,
}

/// The jobs to begin with; the first is planned when the page opens.
pub fn gallery() -> Vec<Example> {
    let examples = [
        (
            "wave",
            "Wave",
            wave(),
            json!({
                "cutter": {"kind": "bull_nose", "diameter_mm": 8, "corner_radius_mm": 2, "height_mm": 30},
                "strategy": {"kind": "iso_parametric", "along": "u", "lead_deg": 8},
                "tolerance": {"scallop_mm": 0.02},
            }),
        ),
        (
            "blade",
            "Twisted blade",
            twisted_blade(),
            json!({
                "cutter": {"kind": "bull_nose", "diameter_mm": 10, "corner_radius_mm": 2, "height_mm": 40},
                "strategy": {"kind": "iso_parametric", "along": "v", "lead_deg": 12},
                "tolerance": {"scallop_mm": 0.01},
            }),
        ),
        (
            "lens",
            "Toric lens mould",
            SourceSpec::Torus {
                major_mm: 80.0,
                minor_mm: 60.0,
                angle_deg: [16.0, 40.0],
                side: SideSpec::Back,
            },
            json!({
                "cutter": {"kind": "bull_nose", "diameter_mm": 10, "corner_radius_mm": 1, "height_mm": 30},
                "strategy": {"kind": "iso_planar", "angle_deg": 30, "lead_deg": 10},
                "tolerance": {"scallop_mm": 0.005},
            }),
        ),
    ];
    examples
        .into_iter()
        .filter_map(|(id, name, source, mut settings)| {
            settings["name"] = name.into();
            settings["source"] = serde_json::to_value(&source).ok()?;
            let spec = Spec::from_json(&settings.to_string()).ok()?;
            Some(Example { id, spec })
        })
        .collect()
}

/// The gallery as JSON text: a list of `{id, spec}`.
pub fn gallery_json() -> String {
    let list: Vec<Value> = gallery().iter().map(|e| json!({ "id": e.id, "spec": e.spec })).collect();
    Value::from(list).to_string()
}

/// A bicubic spline through a control net of `counts` points, with ends clamped.
fn cubic(counts: [usize; 2], point: impl Fn(usize, usize) -> [f64; 3]) -> SourceSpec {
    let knots = |count: usize| {
        let inner = count - 3;
        let mut knots = vec![0.0; 3];
        knots.extend((0..=inner).map(|k| k as f64 / inner as f64));
        knots.extend([1.0; 3]);
        knots
    };
    let net = (0..counts[0]).flat_map(|i| (0..counts[1]).map(move |j| (i, j)));
    SourceSpec::Nurbs {
        degrees: [3, 3],
        knots_u: knots(counts[0]),
        knots_v: knots(counts[1]),
        // To a micrometre, so that the numbers stay short in a link.
        points_mm: net.map(|(i, j)| point(i, j).map(|x| (x * 1e3).round() * 1e-3)).collect(),
        weights: None,
        side: SideSpec::Front,
    }
}

/// 60 × 40 mm with hills and hollows of about 4 mm.
fn wave() -> SourceSpec {
    cubic([9, 7], |i, j| {
        let (x, y) = (7.5 * i as f64 - 30.0, 40.0 / 6.0 * j as f64 - 20.0);
        [x, y, 4.5 * libm::sin(0.105 * x) * libm::cos(0.12 * y + 0.4)]
    })
}

/// The pressure side of a blade: 36 mm chord with camber, 80 mm span, twisted by 35°.
fn twisted_blade() -> SourceSpec {
    cubic([7, 8], |i, j| {
        let (s, t) = (i as f64 / 3.0 - 1.0, j as f64 / 7.0);
        let half = 18.0 * (1.0 - 0.25 * t);
        let (chord, camber) = (half * s, -4.0 * (1.0 - 0.4 * t) * (1.0 - s * s));
        let (sine, cosine) = libm::sincos((35.0 * t - 17.5).to_radians());
        [chord * cosine - camber * sine, 80.0 * t - 40.0, chord * sine + camber * cosine]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_example_is_a_valid_job() {
        let gallery = gallery();
        assert_eq!(gallery.iter().map(|e| e.id).collect::<Vec<_>>(), ["wave", "blade", "lens"]);
        for example in gallery {
            assert!(example.spec.source.shape(None).is_ok(), "{}", example.id);
        }
    }
}
