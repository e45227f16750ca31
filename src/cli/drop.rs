//! `stepover drop`: heights at which a cutter touches a mesh from above.

use super::{Failure, print, read, read_text};
use crate::contact::{DropMesh, Underside, drop_cutter};
use crate::cutter::Cutter;
use crate::import::{self, Shape, Unit};
use clap::Args;
use std::fmt::Write;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(super) struct Drop {
    /// The mesh, in millimetres where the file does not say.
    mesh: PathBuf,
    /// Diameter of the cutter, mm.
    #[arg(long)]
    diameter: f64,
    /// Corner radius, mm: 0 for a flat mill, half the diameter for a ball.
    #[arg(long)]
    corner_radius: f64,
    /// Where to lower the cutter: a table with the columns x_mm,y_mm.
    #[arg(long)]
    points: PathBuf,
}

impl Drop {
    pub(super) fn run(&self) -> Result<(), Failure> {
        // The underside knows nothing of the cutter's height; any that holds the corner does.
        let cutter = Cutter::bull_nose(self.diameter, self.corner_radius, 10.0 * self.diameter)
            .map_err(|e| Failure::Call(format!("--{}", e.to_string().replace('_', "-"))))?;
        let name = self.mesh.display().to_string();
        let part =
            import::read(&name, &read(&self.mesh)?).map_err(|e| Failure::Job(format!("{name}: {e}")))?;
        let part = part.in_millimetres(Unit::Millimetre);
        let Some(Shape::Mesh(mesh)) = part.items.first().map(|item| &item.shape) else {
            return Err(Failure::Job(format!("{name}: holds a surface; a mesh (STL or OBJ) is needed")));
        };
        let (mesh, under) = (DropMesh::new(mesh), Underside::new(&cutter));
        let mut table = String::from("x_mm,y_mm,z_tip_mm");
        for (x, y) in self.places()? {
            // Beyond the mesh the cutter touches nothing, and the cell stays empty.
            let z = drop_cutter(&mesh, &under, x, y).map_or(String::new(), |touch| touch.tip_z.to_string());
            // Writing to a string cannot fail.
            let _ = write!(table, "\n{x},{y},{z}");
        }
        print(&table)
    }

    fn places(&self) -> Result<Vec<(f64, f64)>, Failure> {
        let text = read_text(&self.points)?;
        let mut places = Vec::new();
        for (i, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
            let mut cells = line.split(',').map(|cell| cell.trim().parse::<f64>());
            match (cells.next(), cells.next()) {
                (Some(Ok(x)), Some(Ok(y))) if x.is_finite() && y.is_finite() => places.push((x, y)),
                // The header.
                _ if i == 0 => {}
                _ => {
                    let file = self.points.display();
                    return Err(Failure::Job(format!("{file}: line {}: two numbers x,y are needed", i + 1)));
                }
            }
        }
        Ok(places)
    }
}
