//! Wavefront OBJ: vertices and polygonal faces.
//!
//! Source: Wavefront Technologies, Advanced Visualizer Manual, appendix B1, Object Files (.obj), version 3.0.

use super::mesh_builder::MeshBuilder;
use super::stl::clipped;
use super::{Format, ImportError, Item, MAX_TRIANGLES, Part, Place, Shape, Warning, text};
use crate::math::frame::Frame;
use glam::{DVec2, DVec3};
use std::sync::Arc;

pub(super) fn read(name: &str, bytes: &[u8]) -> Result<Part, ImportError> {
    let content = String::from_utf8_lossy(text::without_mark(bytes));
    let mut file = File::default();
    let mut lines = content.lines().enumerate();
    while let Some((number, first)) = lines.next() {
        // A backslash at the end of a line joins the next one to it.
        let mut line = std::borrow::Cow::from(first);
        while line.trim_end().ends_with('\\') {
            let joined = line.trim_end().trim_end_matches('\\').to_owned();
            line = (joined + " " + lines.next().map_or("", |(_, more)| more)).into();
        }
        file.line = number + 1;
        file.statement(&line).map_err(|message| file.error(message))?;
    }
    file.finish(name)
}

/// A file as far as it was read.
#[derive(Default)]
struct File {
    line: usize,
    vertices: Vec<DVec3>,
    /// Faces as runs of `corners`, with the line each stands in; a vertex may be named before it is given.
    faces: Vec<(std::ops::Range<usize>, usize)>,
    /// Vertex numbers from 1.
    corners: Vec<i64>,
    objects: usize,
    name: Option<String>,
    /// Lines and free-form curves and surfaces.
    left_out: usize,
}

impl File {
    fn error(&self, message: String) -> ImportError {
        ImportError::at(Format::Obj, Place::Line(self.line), message)
    }

    fn statement(&mut self, line: &str) -> Result<(), String> {
        let line = line.split('#').next().unwrap_or("");
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                // Only the three coordinates count: a weight or a colour may follow.
                let mut number =
                    || words.next().and_then(|w| w.parse::<f64>().ok()).filter(|x| x.is_finite());
                let point = number().zip(number()).zip(number());
                let ((x, y), z) = point.ok_or("`v` must be followed by three finite numbers")?;
                self.vertices.push(DVec3::new(x, y, z));
            }
            Some("f" | "fo") => self.face(words)?,
            Some("o") => {
                self.objects += 1;
                let rest = words.collect::<Vec<_>>().join(" ");
                if self.name.is_none() && !rest.is_empty() {
                    self.name = Some(rest);
                }
            }
            Some("l" | "curv" | "curv2" | "surf") => self.left_out += 1,
            _ => {}
        }
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a str>) -> Result<(), String> {
        let start = self.corners.len();
        for word in words {
            let number = word.split('/').next().and_then(|w| w.parse::<i64>().ok());
            let number = number.ok_or_else(|| format!("`{}` is no vertex of a face", clipped(word)))?;
            // Counted back from the vertex given last; -1 is that one.
            let back = if number < 0 { self.vertices.len() as i64 + 1 } else { 0 };
            self.corners.push(number.saturating_add(back));
        }
        let count = self.corners.len() - start;
        if count < 3 {
            return Err(format!("a face needs at least three vertices, found {count}"));
        }
        self.faces.push((start..self.corners.len(), self.line));
        Ok(())
    }

    fn finish(mut self, name: &str) -> Result<Part, ImportError> {
        let mut builder = MeshBuilder::default();
        let mut crossed: Option<(usize, usize)> = None;
        let faces = std::mem::take(&mut self.faces);
        if faces.is_empty() {
            let found = self.vertices.len();
            return Err(ImportError::at(
                Format::Obj,
                Place::Whole,
                format!("{found} vertices and no face (`f`); a mesh needs at least one"),
            ));
        }
        for (range, line) in faces {
            self.line = line;
            let corners = &self.corners[range];
            let vertex = |&number: &i64| {
                let index = usize::try_from(number).ok().and_then(|number| number.checked_sub(1));
                index.and_then(|index| self.vertices.get(index)).copied().ok_or_else(|| {
                    let count = self.vertices.len();
                    self.error(format!("vertex {number} does not exist: they are numbered from 1 to {count}"))
                })
            };
            let polygon: Vec<DVec3> = corners.iter().map(vertex).collect::<Result<_, _>>()?;
            let (triangles, clean) = triangulate(&polygon);
            if !clean {
                crossed.get_or_insert((0, line)).0 += 1;
            }
            for triangle in triangles {
                builder.add(triangle.map(|k| polygon[k]), || Place::Line(line));
            }
            if builder.seen() > MAX_TRIANGLES {
                return Err(self.error(format!("more than {MAX_TRIANGLES} triangles: export it coarser")));
            }
        }
        let (mesh, mut warnings) = builder.finish().ok_or_else(|| {
            ImportError::at(Format::Obj, Place::Whole, "no face has an area; a mesh needs at least one")
        })?;
        if self.objects > 1 {
            warnings.push(Warning::Joined { count: self.objects });
        }
        if self.left_out > 0 {
            let what = "lines or free-form curves and surfaces".to_owned();
            warnings.push(Warning::LeftOut { what, count: self.left_out });
        }
        warnings.extend(
            crossed.map(|(count, line)| Warning::CrossedPolygons { count, first: Place::Line(line) }),
        );
        let name = self.name.as_deref().unwrap_or(name).to_owned();
        let item = Item { name, shape: Shape::Mesh(Arc::new(mesh)) };
        Ok(Part { format: Format::Obj, unit: None, items: vec![item], warnings })
    }
}

/// Triangles of a polygon by cutting off ears, as numbers of its corners, and whether that went well: of a polygon that crosses
/// itself or has no area the rest is fanned out.
///
/// Source: G. H. Meisters, Polygons have ears, Amer. Math. Monthly 82 (1975).
fn triangulate(polygon: &[DVec3]) -> (Vec<[usize; 3]>, bool) {
    let mut left: Vec<usize> = (0..polygon.len()).collect();
    let mut triangles = Vec::with_capacity(polygon.len() - 2);
    let mut clean = true;
    if left.len() > 3 {
        let area = (1..polygon.len() - 1)
            .map(|k| (polygon[k] - polygon[0]).cross(polygon[k + 1] - polygon[0]))
            .sum();
        match DVec3::try_normalize(area) {
            Some(normal) => {
                let frame = Frame::any(normal);
                let flat: Vec<DVec2> = polygon
                    .iter()
                    .map(|p| *p - polygon[0])
                    .map(|p| DVec2::new(p.dot(frame.f), p.dot(frame.b)))
                    .collect();
                while left.len() > 3 {
                    let Some(ear) = (0..left.len()).find(|&k| is_ear(&flat, &left, k)) else {
                        clean = false;
                        break;
                    };
                    let [before, after] = neighbours(&left, ear);
                    triangles.push([before, left[ear], after]);
                    left.remove(ear);
                }
            }
            None => clean = false,
        }
    }
    triangles.extend((1..left.len() - 1).map(|k| [left[0], left[k], left[k + 1]]));
    (triangles, clean)
}

fn neighbours(left: &[usize], k: usize) -> [usize; 2] {
    let n = left.len();
    [left[(k + n - 1) % n], left[(k + 1) % n]]
}

/// Whether corner `k` of the polygon `left` can be cut off: it turns left, or not at all, and no other corner lies in its triangle.
fn is_ear(flat: &[DVec2], left: &[usize], k: usize) -> bool {
    let [i, j] = neighbours(left, k);
    let (a, b, c) = (flat[i], flat[left[k]], flat[j]);
    let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
    if side(a, b, c) <= 0.0 {
        return false;
    }
    // Corners on top of the triangle's own, as at the ends of a bridge to a hole, do not count.
    let others = left.iter().map(|&m| flat[m]).filter(|&p| p != a && p != b && p != c);
    let inside = |p: DVec2| side(a, b, p) >= 0.0 && side(b, c, p) >= 0.0 && side(c, a, p) >= 0.0;
    !others.into_iter().any(inside)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn area(polygon: &[DVec3]) -> f64 {
        let (triangles, clean) = triangulate(polygon);
        assert!(clean);
        assert_eq!(triangles.len(), polygon.len() - 2);
        triangles
            .iter()
            .map(|&[a, b, c]| (polygon[b] - polygon[a]).cross(polygon[c] - polygon[a]).z)
            .map(|z| 0.5 * z)
            .sum()
    }

    #[test]
    fn a_comb_and_a_bridged_hole_keep_their_area() {
        let comb = [
            (0.0, 0.0),
            (6.0, 0.0),
            (6.0, 5.0),
            (5.0, 1.0),
            (4.0, 5.0),
            (3.0, 1.0),
            (2.0, 5.0),
            (1.0, 1.0),
            (0.0, 5.0),
        ];
        let comb: Vec<_> = comb.iter().map(|(x, y)| DVec3::new(*x, *y, 0.0)).collect();
        let shoelace: f64 = (0..9).map(|k| comb[k].truncate().perp_dot(comb[(k + 1) % 9].truncate())).sum();
        assert!((area(&comb) - 0.5 * shoelace).abs() < 1e-12);
        let holed = [
            (0.0, 0.0),
            (4.0, 0.0),
            (4.0, 4.0),
            (0.0, 4.0),
            (0.0, 0.0),
            (1.0, 1.0),
            (1.0, 3.0),
            (3.0, 3.0),
            (3.0, 1.0),
            (1.0, 1.0),
        ];
        let holed: Vec<_> = holed.iter().map(|(x, y)| DVec3::new(*x, *y, 0.0)).collect();
        assert!((area(&holed) - 12.0).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn star_shaped_polygons_keep_their_area(radii in prop::collection::vec(0.1f64..10.0, 4..20)) {
            let n = radii.len();
            let polygon: Vec<_> = radii.iter().enumerate().map(|(k, r)| {
                let (s, c) = libm::sincos(std::f64::consts::TAU * k as f64 / n as f64);
                DVec3::new(r * c, r * s, 0.0)
            }).collect();
            let wedge = 0.5 * libm::sin(std::f64::consts::TAU / n as f64);
            let expected: f64 = (0..n).map(|k| wedge * radii[k] * radii[(k + 1) % n]).sum();
            prop_assert!((area(&polygon) - expected).abs() < 1e-9 * expected);
        }
    }
}
