//! What the page asks for of machines. Names begin with `machine`, so that all modules may be compiled together.

use super::{thrown, watched};
use crate::job::Spec;
use crate::job::machines::{self, PostOptions, Posted, Show, Timeline};
use js_sys::{Float32Array, Function};
use wasm_bindgen::prelude::*;

/// The schema that the form of a program is made from, as JSON.
#[wasm_bindgen]
pub fn machine_schema() -> String {
    machines::schema()
}

/// The machines that come with the page, as a JSON list of `{id, name, text}`.
#[wasm_bindgen]
pub fn machine_shipped() -> String {
    machines::shipped_json()
}

/// The name of the machine that a file describes.
#[wasm_bindgen]
pub fn machine_name(text: &str) -> Result<String, JsValue> {
    machines::machine(text).map(|machine| machine.name).map_err(thrown)
}

/// A program for a machine.
#[wasm_bindgen]
pub struct MachineWork {
    posted: Posted,
    timeline: Timeline,
    show: Show,
}

/// Writes the program of cutter locations (APT) with their table (CSV) for a machine (JSON), and reads it back;
/// `progress(phase, fraction)` is told how far it is.
#[wasm_bindgen]
pub fn machine_post(
    apt: &str,
    table: Option<String>,
    machine: &str,
    options: &str,
    progress: Function,
) -> Result<MachineWork, JsValue> {
    watched(progress, |stage| {
        let machine = machines::machine(machine)?;
        let posted =
            machines::post(apt, table.as_deref(), &machine, &PostOptions::from_json(options)?, stage)?;
        let timeline = Timeline::new(&posted);
        let show = Show::new(&posted);
        Ok(MachineWork { posted, timeline, show })
    })
}

#[wasm_bindgen]
impl MachineWork {
    /// The program.
    pub fn text(&self) -> String {
        self.posted.text.clone()
    }

    /// What the program reads back as, as APT text.
    pub fn read_back(&self) -> String {
        self.posted.read_back()
    }

    /// The program in numbers, as JSON.
    pub fn report(&self) -> String {
        machines::report_json(&self.posted, &self.timeline)
    }

    /// Cuts the shape of a specification as planned and as the program states; as JSON.
    pub fn prove(&self, spec: &str, bytes: Option<Vec<u8>>, progress: Function) -> Result<String, JsValue> {
        watched(progress, |stage| {
            let kept = machines::prove(&self.posted, &Spec::from_json(spec)?, bytes.as_deref(), stage)?;
            Ok(machines::kept_json(&kept))
        })
    }

    /// The moment at which a share of the toolpath's length is done: seconds, and the positions of the axes, mm and degrees.
    pub fn at_share(&self, share: f64) -> Vec<f64> {
        machines::told(&self.posted, &self.timeline, share)
    }

    /// The share of the toolpath's length that is done at a time, s.
    pub fn share_at(&self, seconds: f64) -> f64 {
        self.timeline.at_seconds(seconds).share
    }

    /// Least and greatest of an axis in columns of equal time, mm and degrees, or per second; not numbers where nothing is known.
    pub fn band(&self, place: usize, speeds: bool, from: f64, to: f64, columns: usize) -> Float32Array {
        Float32Array::from(
            &machines::band(&self.posted, &self.timeline, place, speeds, [from, to], columns)[..],
        )
    }

    /// Twelve numbers a body: where it has gone when a share of the toolpath is done, the columns of its matrix and its shift.
    pub fn bodies(&self, share: f64) -> Float32Array {
        Float32Array::from(&self.show.bodies(&self.timeline, share)[..])
    }

    /// The machine to draw, as JSON: solids `{body, part, corners, faces}`, labels `{letter, body, at}`, and `line`, the tip's way over the
    /// workpiece, with `body`.
    pub fn figure(&self) -> String {
        self.show.to_json()
    }
}
