//! Whether a face is less than its surface.

use super::file::{Entry, File};
use super::surface;
use super::{ImportError, fault};
use crate::geometry::{Along, NurbsSurface, Surface, Uv};
use glam::DVec3;

/// A face that bounds a surface.
pub(super) struct Face {
    /// Entry of the surface.
    pub(super) surface: usize,
    pub(super) label: String,
    outer: Outer,
    /// Number of boundaries inside the outer one.
    holes: usize,
}

/// The outer boundary of a face.
enum Outer {
    /// The border of the surface itself.
    Natural,
    /// Curves in the surface's parameters.
    Parameters(Vec<usize>),
    /// Curves in space.
    Space(Vec<usize>),
    /// In an entity that is not looked into.
    Unknown(&'static str),
}

/// All faces that entities 143, 144 and 510 make.
pub(super) fn faces(file: &File) -> Result<Vec<Face>, ImportError> {
    let mut faces = Vec::new();
    for entry in &file.directory {
        faces.extend(match entry.kind {
            143 => Some(bounded(file, entry)?),
            144 => Some(trimmed(file, entry)?),
            510 => Some(shell_face(file, entry)?),
            _ => None,
        });
    }
    Ok(faces)
}

/// Entity 143: the boundary is made of entities 141.
fn bounded(file: &File, entry: &Entry) -> Result<Face, ImportError> {
    let record = file.record(entry)?;
    let boundaries = record.count(3)?;
    let outer = if boundaries == 0 { Outer::Natural } else { Outer::Unknown("a boundary of entity 141") };
    Ok(Face {
        surface: record.count(2)?,
        label: entry.label.clone(),
        outer,
        holes: boundaries.saturating_sub(1),
    })
}

/// Entity 144: the boundary is a curve on the surface, entity 142.
fn trimmed(file: &File, entry: &Entry) -> Result<Face, ImportError> {
    let record = file.record(entry)?;
    let outer = match record.count(2)? {
        0 => Outer::Natural,
        _ => {
            let boundary = pointed(file, entry, record.count(4)?, 142)?;
            let boundary_record = file.record(boundary)?;
            match (boundary_record.count(3)?, boundary_record.count(4)?) {
                (0, 0) => Outer::Unknown("a boundary without curves"),
                (0, space) => Outer::Space(vec![space]),
                (parameters, _) => Outer::Parameters(vec![parameters]),
            }
        }
    };
    Ok(Face { surface: record.count(1)?, label: entry.label.clone(), outer, holes: record.count(3)? })
}

/// Entity 510: the boundary is a loop, entity 508, of edges in lists, entity 504.
fn shell_face(file: &File, entry: &Entry) -> Result<Face, ImportError> {
    let record = file.record(entry)?;
    let (loops, has_outer) = (record.count(2)?, record.count(3)? != 0);
    let face = |outer, holes| Face { surface: 0, label: entry.label.clone(), outer, holes };
    let face = if loops == 0 {
        face(Outer::Natural, 0)
    } else if !has_outer {
        face(Outer::Unknown("loops of which none is the outer one"), 0)
    } else {
        face(Outer::Space(loop_curves(file, entry, record.count(4)?)?), loops - 1)
    };
    Ok(Face { surface: record.count(1)?, ..face })
}

/// The curves in space along the loop at `number`.
fn loop_curves(file: &File, face: &Entry, number: usize) -> Result<Vec<usize>, ImportError> {
    let entry = pointed(file, face, number, 508)?;
    let record = file.record(entry)?;
    let mut curves = Vec::new();
    let mut at = 2;
    for _ in 0..record.count(1)? {
        let [kind, list, index] = [record.count(at)?, record.count(at + 1)?, record.count(at + 2)?];
        // Of type 1 is a vertex: an edge without length, as at a pole.
        if kind == 0 {
            let edges = file.record(pointed(file, entry, list, 504)?)?;
            let curve = index.checked_sub(1).and_then(|k| k.checked_mul(5)).map(|k| edges.count(2 + k));
            curves.push(curve.unwrap_or_else(|| Err(fault(entry, "edges are counted from 1")))?);
        }
        // An edge takes five parameters and two for each of its curves in the surface's parameters.
        at = record.count(at + 4)?.saturating_mul(2).saturating_add(at + 5).min(record.len());
    }
    Ok(curves)
}

fn pointed<'a>(file: &'a File, from: &Entry, number: usize, kind: i64) -> Result<&'a Entry, ImportError> {
    let entry = file.entry(number).filter(|entry| entry.kind == kind);
    entry.ok_or_else(|| fault(from, format!("D{number}, which it refers to, is no entity {kind}")))
}

/// Distance from the border, over the size of the surface or of its domain, within which a boundary still runs along it. What
/// a trim takes away less than that is below what a finishing pass can show.
const ALONG_BORDER: f64 = 1e-4;

/// How `face` is trimmed by more than the border of its `surface`; `None` where it is not.
pub(super) fn beyond_border(
    file: &File,
    face: &Face,
    surface: &NurbsSurface,
) -> Result<Option<String>, ImportError> {
    let (curves, in_parameters) = match &face.outer {
        Outer::Natural => (&[] as &[usize], false),
        Outer::Parameters(curves) => (curves.as_slice(), true),
        Outer::Space(curves) => (curves.as_slice(), false),
        Outer::Unknown(what) => {
            return Ok(Some(format!(
                "it is bounded by {what}, which was not compared with the surface's border"
            )));
        }
    };
    let mut sampler = Sampler { file, visits: 0, points: Vec::new() };
    for &curve in curves {
        if let Some(other) = sampler.add(curve, 0)? {
            return Ok(Some(format!(
                "its boundary has a curve of entity {other}, which was not compared with the surface's border"
            )));
        }
    }
    let samples = sampler.points;
    let leaves = if in_parameters {
        let domain = surface.domain();
        let off = |x: f64, range: crate::geometry::Range| {
            (x - range.lo).abs().min((x - range.hi).abs()) / range.length()
        };
        samples.iter().any(|p| off(p.x, domain.u).min(off(p.y, domain.v)) > ALONG_BORDER)
    } else if samples.is_empty() {
        false
    } else {
        let border = border(surface);
        let (lo, hi) = surface.hull_bounds();
        let near = ALONG_BORDER * lo.distance(hi);
        samples.iter().any(|&p| border.iter().all(|&segment| distance(p, segment) > near))
    };
    Ok(match (leaves, face.holes) {
        (true, 0) => Some("its outer boundary leaves the surface's border".into()),
        (true, holes) => {
            Some(format!("its outer boundary leaves the surface's border, and it has {holes} holes"))
        }
        (false, 0) => None,
        (false, holes) => Some(format!("it has {holes} holes")),
    })
}

/// Collects points along boundary curves.
struct Sampler<'a> {
    file: &'a File,
    visits: usize,
    points: Vec<DVec3>,
}

impl Sampler<'_> {
    /// Adds points along the curve at `number`: lines (110), splines (126) and compositions (102) of them. Gives the type of a
    /// curve that is neither, 0 where there is none or there are too many.
    fn add(&mut self, number: usize, depth: usize) -> Result<Option<i64>, ImportError> {
        /// Points on a line or a knot span.
        const STEPS: usize = 8;
        /// Curves and points of one boundary: far more than a real one has, and few enough to compare with a border in time.
        const MOST_CURVES: usize = 1000;
        const MOST_POINTS: usize = 20_000;
        /// A composition that holds itself would go on for ever.
        const DEEPEST: usize = 4;
        self.visits += 1;
        let few = depth < DEEPEST && self.visits < MOST_CURVES && self.points.len() < MOST_POINTS;
        let Some(entry) = self.file.entry(number).filter(|_| few) else {
            return Ok(Some(0));
        };
        let before = self.points.len();
        match entry.kind {
            102 => {
                let record = self.file.record(entry)?;
                for k in 0..record.count(1)? {
                    if let Some(other) = self.add(record.count(2 + k)?, depth + 1)? {
                        return Ok(Some(other));
                    }
                }
                return Ok(None);
            }
            110 => {
                let ends = self.file.record(entry)?.numbers(1, 6)?;
                let (a, b) = (DVec3::from_slice(&ends), DVec3::from_slice(&ends[3..]));
                self.points.extend((0..=STEPS).map(|k| a.lerp(b, k as f64 / STEPS as f64)));
            }
            126 => {
                let (curve, [start, end]) = surface::curve(self.file, entry)?;
                let steps = STEPS * (curve.breaks(Along::U).len() - 1);
                let at = |k: usize| Uv::new(start + (end - start) * (k as f64 / steps as f64), 0.0);
                self.points.extend((0..=steps).map(|k| curve.point(at(k))));
            }
            other => return Ok(Some(other)),
        }
        if let Some(map) = surface::placement(self.file, entry)? {
            for p in &mut self.points[before..] {
                *p = map.transform_point3(*p);
            }
        }
        Ok(None)
    }
}

/// The border of `surface` as segments, fine enough that the curve strays from them by far less than [`ALONG_BORDER`].
fn border(surface: &NurbsSurface) -> Vec<[DVec3; 2]> {
    const STEPS: usize = 16;
    let domain = surface.domain();
    let mut segments = Vec::new();
    for (along, across) in [(Along::U, domain.v), (Along::V, domain.u)] {
        let breaks = surface.breaks(along);
        for end in [across.lo, across.hi] {
            let point = |t: f64| match along {
                Along::U => surface.point(Uv::new(t, end)),
                Along::V => surface.point(Uv::new(end, t)),
            };
            let inside = |pair: &[f64]| {
                let (lo, hi) = (pair[0], pair[1]);
                (0..STEPS).map(move |k| lo + (hi - lo) * (k as f64 / STEPS as f64))
            };
            let mut points: Vec<DVec3> = breaks.windows(2).flat_map(inside).map(point).collect();
            points.extend(breaks.last().map(|&t| point(t)));
            segments.extend(points.windows(2).map(|pair| [pair[0], pair[1]]));
        }
    }
    segments
}

fn distance(p: DVec3, [a, b]: [DVec3; 2]) -> f64 {
    let along = b - a;
    let length = along.length_squared();
    let t = if length > 0.0 { ((p - a).dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
    p.distance(a + along * t)
}
