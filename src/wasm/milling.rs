//! Planning for mills.

use super::{thrown, watched};
use crate::job::{self, Cubes, Picture, Plan, Proof, Spec};
use crate::toolpath::{Rate, Role};
use js_sys::{Float32Array, Function, Uint32Array};
use wasm_bindgen::prelude::*;

fn positions(picture: &Picture) -> Float32Array {
    Float32Array::from(&picture.positions[..])
}

/// The schema that forms are made from, as JSON.
#[wasm_bindgen]
pub fn schema() -> String {
    job::schema()
}

/// The gallery, as a JSON list of `{id, spec}`.
#[wasm_bindgen]
pub fn gallery() -> String {
    job::gallery_json()
}

/// What is inside a file, as JSON.
#[wasm_bindgen]
pub fn inspect(name: &str, bytes: &[u8]) -> Result<String, JsValue> {
    job::inspect(name, bytes).map(|found| found.to_json()).map_err(thrown)
}

/// The outline of the cutter of a specification, as `radius, height` pairs in mm from the tip outwards and up.
#[wasm_bindgen]
pub fn outline(spec: &str) -> Result<Float32Array, JsValue> {
    let outline = Spec::from_json(spec).and_then(|spec| job::outline(&spec)).map_err(thrown)?;
    Ok(Float32Array::from(&outline[..]))
}

/// Curves of stepover against tilt for the cutter and scallop height of a specification, as JSON: one set for each radius
/// of the surface across the feed (mm, above 0 where concave, 0 for a plane).
#[wasm_bindgen]
pub fn stepover(spec: &str, radii: &[f64]) -> Result<String, JsValue> {
    let chart = Spec::from_json(spec).and_then(|spec| job::stepover_chart(&spec, radii));
    chart.map(|chart| chart.to_json()).map_err(thrown)
}

/// A shape to draw.
#[wasm_bindgen]
pub struct Preview(Picture);

#[wasm_bindgen]
impl Preview {
    /// x, y, z a vertex, mm.
    pub fn positions(&self) -> Float32Array {
        positions(&self.0)
    }
    /// Unit outward normal a vertex.
    pub fn normals(&self) -> Float32Array {
        Float32Array::from(&self.0.normals[..])
    }
    /// Three vertex numbers a triangle.
    pub fn indices(&self) -> Uint32Array {
        Uint32Array::from(&self.0.indices[..])
    }
    /// Excess a vertex, mm, not a number where uncut; empty before the proof.
    pub fn excess(&self) -> Float32Array {
        Float32Array::from(&self.0.excess[..])
    }
}

/// A zone to draw.
#[wasm_bindgen]
pub struct Blocks(Cubes);

#[wasm_bindgen]
impl Blocks {
    /// x, y, z of each cube's middle, mm.
    pub fn centers(&self) -> Float32Array {
        Float32Array::from(&self.0.centers[..])
    }
    /// Edge of the cubes, mm.
    pub fn edge(&self) -> f64 {
        self.0.edge
    }
}

/// The shape of a specification, before anything is planned.
#[wasm_bindgen]
pub fn preview(spec: &str, bytes: Option<Vec<u8>>) -> Result<Preview, JsValue> {
    let picture = Spec::from_json(spec).and_then(|spec| job::preview(&spec, bytes.as_deref()));
    picture.map(Preview).map_err(thrown)
}

/// A planned path, and its proof once [`Outcome::prove`] was called.
#[wasm_bindgen]
pub struct Outcome {
    plan: Plan,
    proof: Option<Proof>,
}

/// Plans a specification and writes its program; `progress(phase, fraction)` is told how far it is.
#[wasm_bindgen]
pub fn plan(spec: &str, bytes: Option<Vec<u8>>, progress: Function) -> Result<Outcome, JsValue> {
    watched(progress, |stage| {
        let plan = job::plan(&Spec::from_json(spec)?, bytes.as_deref(), stage)?;
        Ok(Outcome { plan, proof: None })
    })
}

#[wasm_bindgen]
impl Outcome {
    /// Cuts the shape with the emitted program; afterwards the report holds what it found.
    pub fn prove(&mut self, progress: Function) -> Result<(), JsValue> {
        self.proof = watched(progress, |stage| self.plan.prove(stage))?;
        Ok(())
    }

    /// The report as JSON.
    pub fn report(&self) -> String {
        self.plan.report(self.proof.as_ref()).to_json()
    }

    /// Eight numbers a move: tip x, y, z (mm), axis i, j, k, kind (0 cut, 1 link at feed, 2 rapid), length so far (mm).
    pub fn path(&self) -> Float32Array {
        let moves = &self.plan.emitted.toolpath.moves;
        let mut length = 0.0;
        let mut flat = Vec::with_capacity(8 * moves.len());
        for (i, m) in moves.iter().enumerate() {
            length += if i > 0 { m.to.tip.distance(moves[i - 1].to.tip) } else { 0.0 };
            let kind = match (m.role, m.rate) {
                (_, Rate::Rapid) => 2.0,
                (Role::Link, _) => 1.0,
                (Role::Cut, _) => 0.0,
            };
            flat.extend(m.to.tip.as_vec3().to_array());
            flat.extend(m.to.axis.as_vec3().to_array());
            flat.extend([kind, length as f32]);
        }
        Float32Array::from(&flat[..])
    }

    /// x, y, z a move: where the cutter touches at its end, or its tip where it touches nothing.
    pub fn contacts(&self) -> Float32Array {
        let flat: Vec<f32> =
            self.plan.touches.iter().flat_map(|touch| touch.point.as_vec3().to_array()).collect();
        Float32Array::from(&flat[..])
    }

    /// Four numbers a move, of where it ends: lead and yaw (degrees), width of the strip (mm), and what keeps the lead from
    /// being less: the number of its [`Bound`](crate::toolpath::Bound), counted from 0. Not numbers where the cutter touches nothing or nothing is known.
    pub fn postures(&self) -> Float32Array {
        let flat: Vec<f32> = self
            .plan
            .touches
            .iter()
            .flat_map(|touch| match touch.contact {
                Some((posture, work)) => {
                    let strip = work.strip.unwrap_or(f64::NAN);
                    [posture.lead.to_degrees(), posture.yaw.to_degrees(), strip, f64::from(work.bound as u8)]
                }
                None => [f64::NAN; 4],
            })
            .map(|x| x as f32)
            .collect();
        Float32Array::from(&flat[..])
    }

    /// What the cutter cannot reach.
    pub fn unreached(&self) -> Blocks {
        Blocks(Cubes::of(self.plan.unreached()))
    }

    /// The shape with its excess; nothing before the proof.
    pub fn picture(&self) -> Option<Preview> {
        self.proof.as_ref().map(|proof| Preview(proof.picture.clone()))
    }

    /// Area by excess: where the first bin begins and the last one ends (mm), then the area of each (mm²). Empty before the proof.
    pub fn histogram(&self) -> Float32Array {
        let flat = self.proof.as_ref().map_or(Vec::new(), |proof| proof.histogram.flat());
        Float32Array::from(&flat[..])
    }

    /// The program as APT text.
    pub fn apt(&self) -> String {
        self.plan.apt.clone()
    }

    /// The program as G-code, for a three-axis path.
    pub fn nc(&self) -> Option<String> {
        self.plan.nc.clone()
    }

    /// The path as a table.
    pub fn csv(&self) -> String {
        self.plan.csv.clone()
    }
}
