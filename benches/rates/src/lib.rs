//! The planner's three hot paths as pieces of work that are timed alike in native code and as WebAssembly.

mod dome;
mod places;
#[path = "../../../tests/support/sculpt.rs"]
mod sculpt;
mod strips;

use glam::DVec3;
use stepover::contact::{DropMesh, StripLimits, Underside, drop_cutter, face_strip, model_strip};
use stepover::cutter::Cutter;
use stepover::geometry::{Curvature, Face};
use stepover::monitor::Stage;
use stepover::toolpath::{CcPoint, Posture, Toolpath};
use stepover::verify::{Options, Samples, verify};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen::prelude::wasm_bindgen;

/// How many kinds of work there are.
pub const KINDS: u32 = 6;

/// Lowerings a run.
const DROPS: usize = 5000;

enum Task {
    Drops { mesh: DropMesh, under: Underside },
    Model { cases: Vec<(Cutter, Posture, Curvature)> },
    Surface { face: Face, contacts: Vec<(stepover::geometry::Uv, CcPoint)>, cutter: Cutter },
    Proof { cutter: Cutter, path: Toolpath, samples: Samples },
}

/// A piece of work that can be done again and again.
#[cfg_attr(target_arch = "wasm32", wasm_bindgen)]
pub struct Work(Task);

#[cfg_attr(target_arch = "wasm32", wasm_bindgen)]
impl Work {
    /// The work of a kind below [`KINDS`], made ready; nothing for any other.
    pub fn prepare(kind: u32) -> Option<Self> {
        let drops = |cells| {
            let cutter = Cutter::bull_nose(10.0, 2.0, 50.0).ok()?;
            let mesh = DropMesh::new(&sculpt::sculpt(cells));
            Some(Task::Drops { mesh, under: Underside::new(&cutter) })
        };
        let task = match kind {
            0 => drops(50)?,
            1 => drops(158)?,
            2 => drops(500)?,
            3 => Task::Model { cases: strips::cases() },
            4 => {
                let (face, contacts) = strips::contacts();
                Task::Surface { face: face?, contacts, cutter: Cutter::bull_nose(8.0, 2.0, 30.0).ok()? }
            }
            5 => {
                let cutter = Cutter::bull_nose(25.0, 3.0, 50.0).ok()?;
                let samples = Samples::of_face(&dome::dome().0, 0.09).ok()?;
                Task::Proof { path: dome::passes(&cutter, 5f64.to_radians()), samples, cutter }
            }
            _ => return None,
        };
        Some(Self(task))
    }

    /// What is counted, a line for a table.
    pub fn name(&self) -> String {
        match &self.0 {
            Task::Drops { mesh, .. } => {
                format!("bull-nose drops on {} triangles", mesh.tree().order().len())
            }
            Task::Model { .. } => "exact strips over the model surface".into(),
            Task::Surface { .. } => "exact strips over a spline surface".into(),
            Task::Proof { .. } => "samples proven under 2 m of path".into(),
        }
    }

    /// Does it once; how many were done.
    pub fn run(&self) -> u32 {
        let count = match &self.0 {
            Task::Drops { mesh, under } => (0..DROPS)
                .map(places::scattered)
                .filter(|(x, y)| drop_cutter(mesh, under, *x, *y).is_some())
                .count(),
            Task::Model { cases } => {
                // Counted whether there is a strip or not: both have to be found out.
                let found =
                    cases.iter().filter(|(c, p, k)| model_strip(c, *p, k, 0.01).half_widths().is_some());
                std::hint::black_box(found.count());
                cases.len()
            }
            Task::Surface { face, contacts, cutter } => {
                let limits = StripLimits { scallop: 0.02, gouge: 0.0005 };
                let strip = |(uv, cc): &&_| face_strip(face, cutter, cc, *uv, DVec3::ZERO, limits).is_some();
                std::hint::black_box(contacts.iter().filter(strip).count());
                contacts.len()
            }
            Task::Proof { cutter, path, samples } => {
                let options = Options { search: 0.2, ..Options::for_height(0.01, cutter) };
                match verify(cutter, path, samples, &options, &Stage::silent()) {
                    Ok(proof) => proof.excess.len(),
                    Err(_) => 0,
                }
            }
        };
        u32::try_from(count).unwrap_or(u32::MAX)
    }
}
