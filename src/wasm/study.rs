//! Looking closely, comparing, and figures to learn from. Names begin with `study`, so that all modules may be compiled together.

use super::{thrown, watched};
use crate::job::study::{self, Removed, Subject};
use crate::job::{self, Contender, JobError, Spec};
use js_sys::{Float32Array, Float64Array, Function, Uint32Array};
use wasm_bindgen::prelude::*;

/// A surface that places are looked up on.
#[wasm_bindgen]
pub struct StudySurface(Subject);

/// The surface of a specification; nothing for a mesh.
#[wasm_bindgen]
pub fn study_surface(spec: &str, bytes: Option<Vec<u8>>) -> Result<Option<StudySurface>, JsValue> {
    let subject = Spec::from_json(spec).and_then(|spec| Subject::new(&spec, bytes.as_deref()));
    subject.map(|subject| subject.map(StudySurface)).map_err(thrown)
}

#[wasm_bindgen]
impl StudySurface {
    /// The place nearest to a point (mm), as JSON.
    pub fn place(&self, x: f64, y: f64, z: f64) -> String {
        study::json(&self.0.place([x, y, z].into()))
    }

    /// The ends of the parameters: of u, then of v.
    pub fn domain(&self) -> Float64Array {
        Float64Array::from(&self.0.domain()[..])
    }

    /// u, v of each point x, y, z (mm).
    pub fn parameters(&self, points: &[f32]) -> Float32Array {
        Float32Array::from(&self.0.parameters(points)[..])
    }

    /// Six numbers a place of the machining potential: u, v, the direction of the widest strip as a step of these, the widest and the
    /// narrowest strip (mm).
    pub fn potential(&self, count: usize, progress: Function) -> Result<Float32Array, JsValue> {
        let flat = watched(progress, |stage| self.0.potential(count, stage))?;
        Ok(Float32Array::from(&flat[..]))
    }
}

/// What a program cuts, move by move.
#[wasm_bindgen]
pub struct StudyRemoved(Removed);

#[wasm_bindgen]
impl StudyRemoved {
    /// Moves, rising.
    pub fn steps(&self) -> Uint32Array {
        Uint32Array::from(&self.0.steps[..])
    }
    /// The vertex of the proof's picture that each cuts.
    pub fn vertices(&self) -> Uint32Array {
        Uint32Array::from(&self.0.vertices[..])
    }
    /// What is left there from then on, mm.
    pub fn excess(&self) -> Float32Array {
        Float32Array::from(&self.0.excess[..])
    }
}

/// When the program `apt` cuts what.
#[wasm_bindgen]
pub fn study_removed(
    spec: &str,
    bytes: Option<Vec<u8>>,
    apt: &str,
    progress: Function,
) -> Result<StudyRemoved, JsValue> {
    watched(progress, |stage| study::removed(&Spec::from_json(spec)?, bytes.as_deref(), apt, stage))
        .map(StudyRemoved)
}

/// The path of the program `apt` as an SVG picture.
#[wasm_bindgen]
pub fn study_drawing(apt: &str) -> Result<String, JsValue> {
    study::drawing(apt).map_err(thrown)
}

/// The jobs that a comparison runs, as a JSON list of `{name, spec}`.
#[wasm_bindgen]
pub fn study_contenders(spec: &str, bytes: Option<Vec<u8>>) -> Result<String, JsValue> {
    let found = Spec::from_json(spec).and_then(|spec| job::contenders(&spec, bytes.as_deref()));
    let text = |list: Vec<Contender>| {
        let one = |c: &Contender| format!(r#"{{"name":"{}","spec":{}}}"#, c.name, c.spec.to_json());
        format!("[{}]", list.iter().map(one).collect::<Vec<_>>().join(","))
    };
    found.map(text).map_err(thrown)
}

/// The length that no path of the postures of a specification stays below, mm; nothing for a mesh.
#[wasm_bindgen]
pub fn study_floor(spec: &str, bytes: Option<Vec<u8>>, progress: Function) -> Result<Option<f64>, JsValue> {
    watched(progress, |stage| job::least_length(&Spec::from_json(spec)?, bytes.as_deref(), stage))
        .map(|floor| floor.map(|floor| floor.length))
}

/// A section square to the feed, as JSON: lead and yaw in degrees; curvatures of the surface along the feed, its torsion and across
/// (1/mm, above 0 where hollow); how far to look (mm).
#[wasm_bindgen]
pub fn study_section(spec: &str, posture: &[f64], surface: &[f64], reach: f64) -> Result<String, JsValue> {
    lesson(spec, |spec| {
        study::studied_section(spec, list(posture)?, list(surface)?, reach).map(|found| study::json(&found))
    })
}

/// Widths of strips by yaw at a lead (degrees), as JSON.
#[wasm_bindgen]
pub fn study_widths(spec: &str, lead: f64, surface: &[f64]) -> Result<String, JsValue> {
    lesson(spec, |spec| study::studied_widths(spec, lead, list(surface)?).map(|found| study::json(&found)))
}

/// Two passes cut in simulation at a tilt (degrees) over a surface of a radius (mm, above 0 where hollow, 0 for a plane), as JSON.
#[wasm_bindgen]
pub fn study_passes(spec: &str, tilt: f64, radius: f64) -> Result<String, JsValue> {
    lesson(spec, |spec| study::studied_passes(spec, tilt, radius).map(|found| study::json(&found)))
}

/// The initial paths and their neighbours of the paper of 2013, as JSON.
#[wasm_bindgen]
pub fn study_restarts(spec: &str, threshold: f64, progress: Function) -> Result<String, JsValue> {
    let found = watched(progress, |stage| study::restarts(&Spec::from_json(spec)?, threshold, stage))?;
    Ok(study::json(&found))
}

fn lesson(spec: &str, learn: impl FnOnce(&Spec) -> Result<String, JobError>) -> Result<String, JsValue> {
    Spec::from_json(spec).and_then(|spec| learn(&spec)).map_err(thrown)
}

fn list<const N: usize>(numbers: &[f64]) -> Result<[f64; N], JobError> {
    numbers.try_into().map_err(|_| JobError::field("numbers", format!("must be {N}")))
}
