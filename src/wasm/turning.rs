//! What the page's turning mode asks for. Names begin with `turning`, so that all modules may be compiled together.

use super::{thrown, watched};
use crate::job::machines::lathe;
use crate::job::turning::{self, TurningPlan, TurningProof, TurningSpec};
use js_sys::{Float32Array, Function};
use wasm_bindgen::prelude::*;

/// The schema that the turning form is made from, as JSON.
#[wasm_bindgen]
pub fn turning_schema() -> String {
    turning::schema()
}

/// A turning specification with every setting spelled out, as JSON; `{}` is the lens of paper 004.
#[wasm_bindgen]
pub fn turning_complete(spec: &str) -> Result<String, JsValue> {
    TurningSpec::from_json(spec).map(|spec| spec.to_json()).map_err(thrown)
}

/// A turning specification with the heights of a file in itself, as JSON; see [`TurningSpec::with_table`].
#[wasm_bindgen]
pub fn turning_table(spec: &str, bytes: &[u8]) -> Result<String, JsValue> {
    let with_table = |spec: TurningSpec| spec.with_table(bytes);
    TurningSpec::from_json(spec).and_then(with_table).map(|spec| spec.to_json()).map_err(thrown)
}

/// A turning specification with the speeds, accelerations and jerks of a lathe's file (JSON text) as its limits, as JSON.
#[wasm_bindgen]
pub fn turning_lathe(spec: &str, machine: &str) -> Result<String, JsValue> {
    let spec = TurningSpec::from_json(spec).map_err(thrown)?;
    lathe(machine).map(|lathe| lathe.limiting(spec).to_json()).map_err(thrown)
}

/// A planned path, and its proof after [`Turned::prove`] was called.
#[wasm_bindgen]
pub struct Turned {
    plan: TurningPlan,
    proof: Option<TurningProof>,
}

/// Plans a turning specification and writes its program; `progress(phase, fraction)` is told how far it is.
#[wasm_bindgen]
pub fn turning_plan(spec: &str, bytes: Option<Vec<u8>>, progress: Function) -> Result<Turned, JsValue> {
    watched(progress, |stage| {
        let plan = turning::plan(&TurningSpec::from_json(spec)?, bytes.as_deref(), stage)?;
        Ok(Turned { plan, proof: None })
    })
}

#[wasm_bindgen]
impl Turned {
    /// Cuts the part with the emitted program; afterwards the report holds what it found.
    pub fn prove(&mut self, progress: Function) -> Result<(), JsValue> {
        self.proof = watched(progress, |stage| self.plan.prove(stage))?;
        Ok(())
    }

    /// Throws unless the whole path is within the travels of a lathe's file (JSON text).
    pub fn fits(&self, machine: &str) -> Result<(), JsValue> {
        lathe(machine).and_then(|lathe| lathe.holds(&self.plan.emitted)).map_err(thrown)
    }

    /// The report as JSON.
    pub fn report(&self) -> String {
        self.plan.report(self.proof.as_ref()).to_json()
    }

    /// Residues, mm, ray by ray from the axis outwards; not numbers outside of the aperture, infinite where uncut. Empty before
    /// the proof.
    pub fn residues(&self) -> Float32Array {
        Float32Array::from(self.proof.as_ref().map_or(&[][..], |proof| &proof.map.residues))
    }

    /// Number of rays of the residues, the first at 0°.
    pub fn rays(&self) -> usize {
        self.proof.as_ref().map_or(0, |proof| proof.map.rays)
    }

    /// Places on a ray.
    pub fn rings(&self) -> usize {
        self.proof.as_ref().map_or(0, |proof| proof.map.rings)
    }

    /// Distance of the farthest place from the axis, mm.
    pub fn farthest(&self) -> f64 {
        self.plan.farthest()
    }

    /// Heights of the part, mm, on `rays` rays with `rings` places each, out to [`Turned::farthest`]; not numbers outside of the
    /// aperture.
    pub fn heights(&self, rays: usize, rings: usize) -> Float32Array {
        Float32Array::from(&self.plan.heights(rays, rings)[..])
    }

    /// x, y, z of where the nose touches, mm, at no more than about `most` points of the path.
    pub fn touches(&self, most: usize) -> Float32Array {
        Float32Array::from(&self.plan.touches(most)[..])
    }

    /// What the axes do along the turn at `radius` mm from the axis; 13 numbers a point, see [`TurningPlan::motion`].
    pub fn motion(&self, radius: f64) -> Float32Array {
        flat(&self.plan.motion(radius))
    }

    /// What the axes do turn by turn; 14 numbers a turn, see [`TurningPlan::turns`].
    pub fn turns(&self) -> Float32Array {
        flat(&self.plan.turns())
    }

    /// The same as a table.
    pub fn turns_csv(&self) -> String {
        self.plan.turns_csv()
    }

    /// The program.
    pub fn program(&self) -> String {
        self.plan.program.clone()
    }

    /// The ending of its name: `nc` or `pvt`.
    pub fn extension(&self) -> String {
        self.plan.extension().into()
    }

    /// The motion as a table.
    pub fn csv(&self) -> String {
        self.plan.csv()
    }

    /// The motion as APT text.
    pub fn apt(&self) -> Result<String, JsValue> {
        self.plan.apt().map_err(thrown)
    }
}

fn flat(numbers: &[f64]) -> Float32Array {
    let single: Vec<f32> = numbers.iter().map(|x| *x as f32).collect();
    Float32Array::from(&single[..])
}
