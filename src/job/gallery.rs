//! Surfaces to begin with.
//!
//! Written as the JSON that a person would write: the page asks for just that, and needs no code to write a [`Spec`].

use super::fields::GROUPS;
use super::schema;
use super::spec::{Spec, VERSION};
use serde_json::{Value, json};

/// A job to begin with.
#[derive(Debug, Clone)]
pub struct Example {
    /// A word that stays the same.
    pub id: &'static str,
    /// The whole job.
    pub spec: Spec,
}

/// Identifier, name, source and settings of each example; the first is planned when the page opens.
fn examples() -> [(&'static str, &'static str, String, &'static str); 3] {
    [
        (
            "wave",
            "Wave",
            wave(),
            r#"{
                "cutter": {"kind": "bull_nose", "diameter_mm": 8, "corner_radius_mm": 2, "height_mm": 30},
                "strategy": {"kind": "iso_parametric", "along": "u", "lead_deg": 8},
                "tolerance": {"scallop_mm": 0.05}
            }"#,
        ),
        (
            "blade",
            "Twisted blade",
            twisted_blade(),
            r#"{
                "cutter": {"kind": "bull_nose", "diameter_mm": 10, "corner_radius_mm": 2, "height_mm": 40},
                "strategy": {"kind": "iso_parametric", "along": "v", "lead_deg": 5},
                "tolerance": {"scallop_mm": 0.01}
            }"#,
        ),
        (
            "lens",
            "Toric lens mould",
            toric_hollow(),
            r#"{
                "cutter": {"kind": "bull_nose", "diameter_mm": 10, "corner_radius_mm": 1, "height_mm": 30},
                "strategy": {"kind": "iso_planar", "angle_deg": 30, "lead_deg": 10},
                "tolerance": {"scallop_mm": 0.005}
            }"#,
        ),
    ]
}

/// The specification with every setting spelled out; nothing if the texts above are wrong, which a test rules out.
fn complete(name: &str, source: &str, settings: &str) -> Option<Value> {
    let Value::Object(mut spec) = read(settings)? else { return None };
    spec.insert("version".into(), VERSION.into());
    spec.insert("name".into(), name.into());
    spec.insert("source".into(), read(source)?);
    schema::complete(&mut spec, GROUPS).ok()?;
    Some(Value::Object(spec))
}

fn read(text: &str) -> Option<Value> {
    serde_json::from_slice(text.as_bytes()).ok()
}

fn complete_all() -> impl Iterator<Item = (&'static str, Value)> {
    examples()
        .into_iter()
        .filter_map(|(id, name, source, settings)| Some((id, complete(name, &source, settings)?)))
}

/// The jobs to begin with; the first is planned when the page opens.
pub fn gallery() -> Vec<Example> {
    let example = |(id, spec): (&'static str, Value)| {
        Some(Example { id, spec: Spec::from_json(&spec.to_string()).ok()? })
    };
    complete_all().filter_map(example).collect()
}

/// The gallery as JSON text: a list of `{id, spec}`.
pub fn gallery_json() -> String {
    Value::from_iter(complete_all().map(|(id, spec)| json!({ "id": id, "spec": spec }))).to_string()
}

/// A spline surface as JSON. Lists of numbers look the same in JSON as in Rust.
fn nurbs(degree: usize, knots: [&[f64]; 2], points: &[[f64; 3]], weights: &[f64]) -> String {
    let weights = if weights.is_empty() { String::new() } else { format!(r#""weights": {weights:?}, "#) };
    let [u, v] = knots;
    format!(
        r#"{{"kind": "nurbs", "degrees": [{degree}, {degree}], "knots_u": {u:?}, "knots_v": {v:?}, {weights}"points_mm": {points:?}, "side": "front"}}"#
    )
}

/// A bicubic spline through a control net of `counts` points, with ends clamped.
fn cubic(counts: [usize; 2], point: impl Fn(usize, usize) -> [f64; 3]) -> String {
    let knots = |count: usize| {
        let inner = count - 3;
        let mut knots = vec![0.0; 3];
        knots.extend((0..=inner).map(|k| k as f64 / inner as f64));
        knots.extend([1.0; 3]);
        knots
    };
    let net = (0..counts[0]).flat_map(|i| (0..counts[1]).map(move |j| (i, j)));
    // To a micrometre, so that the numbers stay short in a link.
    let points: Vec<_> = net.map(|(i, j)| point(i, j).map(|x| (x * 1e3).round() * 1e-3)).collect();
    nurbs(3, [&knots(counts[0]), &knots(counts[1])], &points, &[])
}

/// 60 × 40 mm with hills and hollows of about 4 mm.
fn wave() -> String {
    cubic([9, 7], |i, j| {
        let (x, y) = (7.5 * i as f64 - 30.0, 40.0 / 6.0 * j as f64 - 20.0);
        [x, y, 4.5 * libm::sin(0.105 * x) * libm::cos(0.12 * y + 0.4)]
    })
}

/// The pressure side of a compressor blade: 36 mm chord, hollow by 1.2 mm, 80 mm span, twisted by 35°. A mill with 5° of lead
/// fits into it, one with 2° nearly everywhere.
fn twisted_blade() -> String {
    // Where control points of a cubic stand for the curve, so that the section is a parabola up to its ends.
    const ACROSS: [f64; 7] = [-1.0, -5.0 / 6.0, -0.5, 0.0, 0.5, 5.0 / 6.0, 1.0];
    cubic([7, 8], |i, j| {
        let (s, t) = (ACROSS[i], j as f64 / 7.0);
        let half = 18.0 * (1.0 - 0.25 * t);
        let (chord, camber) = (half * s, -1.2 * (1.0 - 0.4 * t) * (1.0 - s * s));
        let (sine, cosine) = libm::sincos((35.0 * t - 17.5).to_radians());
        [chord * cosine - camber * sine, 80.0 * t - 40.0, chord * sine + camber * cosine]
    })
}

/// The mould of a toric lens, lying open to +z: 40 × 42 mm, of radius 140 mm along x and 60 mm along y. Exact, as a
/// rational patch: the arc along y turned about an axis along y.
fn toric_hollow() -> String {
    let (across, along) = (arc(8.0), arc(20.0));
    let (tube, centre) = (60.0, 80.0);
    let net = across.iter().flat_map(|a| along.iter().map(move |b| (a, b)));
    let points = net.clone().map(|(a, b)| {
        let from_axis = centre + tube * b.up;
        [from_axis * a.side, tube * b.side, centre + tube - from_axis * a.up]
    });
    let points: Vec<_> = points.collect();
    let weights: Vec<_> = net.map(|(a, b)| a.weight * b.weight).collect();
    const KNOTS: &[f64] = &[0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
    nurbs(2, [KNOTS; 2], &points, &weights)
}

/// A control point of an arc of radius 1 about the origin.
struct ArcPoint {
    side: f64,
    up: f64,
    weight: f64,
}

/// The control points of the arc from `-half` to `half` degrees, measured from upright.
fn arc(half: f64) -> [ArcPoint; 3] {
    let (sine, cosine) = libm::sincos(half.to_radians());
    let end = |side| ArcPoint { side, up: cosine, weight: 1.0 };
    [end(-sine), ArcPoint { side: 0.0, up: 1.0 / cosine, weight: cosine }, end(sine)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Uv;
    use crate::job::Shape;

    #[test]
    fn toric_hollow_keeps_its_distance_from_its_circle() {
        let Ok((Shape::Face(face), _)) = gallery()[2].spec.source.shape(None) else { panic!("a face") };
        for (u, v) in [(0.0, 0.0), (0.31, 0.77), (0.5, 0.5), (1.0, 0.2)] {
            let (jet, n) = face.at(Uv::new(u, v)).expect("a normal");
            // The centre circle of the tube has radius 80 about an axis along y at z = 140.
            let off = libm::hypot(jet.p.x, jet.p.z - 140.0) - 80.0;
            assert!((libm::hypot(off, jet.p.y) - 60.0).abs() < 1e-12 * 60.0, "{off} at {u} {v}");
            assert!(n.z > 0.9, "{n} looks up");
        }
    }

    #[test]
    fn every_example_is_a_valid_job() {
        let gallery = gallery();
        assert_eq!(gallery.iter().map(|e| e.id).collect::<Vec<_>>(), ["wave", "blade", "lens"]);
        for example in gallery {
            assert!(example.spec.source.shape(None).is_ok(), "{}", example.id);
        }
    }
}
