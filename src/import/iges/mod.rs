//! IGES in its fixed-column text form: every rational B-spline surface (entity 128) with the transformations (124) it refers to.
//!
//! Trimming is not applied. A face whose boundary (entities 144 with 142, or 510 with 508) leaves the natural border of its
//! surface is reported.
//!
//! Source: US Product Data Association, Initial Graphics Exchange Specification 5.3, 1996.

mod file;
mod record;
mod surface;
mod trim;

use super::{Format, ImportError, Item, Part, Place, Shape, Unit, Warning};
use crate::geometry::{Along, MAX_POINTS};
use file::{Entry, File};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Entities that are surfaces or solids and are not read.
const NOT_READ: [(i64, &str); 24] = [
    (108, "plane"),
    (114, "parametric spline surface"),
    (118, "ruled surface"),
    (120, "surface of revolution"),
    (122, "tabulated cylinder"),
    (140, "offset surface"),
    (150, "block"),
    (152, "wedge"),
    (154, "cylinder"),
    (156, "cone"),
    (158, "sphere"),
    (160, "torus"),
    (162, "solid of revolution"),
    (164, "solid of extrusion"),
    (168, "ellipsoid"),
    (180, "Boolean tree"),
    (190, "plane surface"),
    (192, "cylindrical surface"),
    (194, "conical surface"),
    (196, "spherical surface"),
    (198, "toroidal surface"),
    (408, "placed subfigure"),
    (416, "external reference"),
    (430, "placed solid"),
];

pub(super) fn read(bytes: &[u8]) -> Result<Part, ImportError> {
    let file = File::of(bytes)?;
    let mut warnings = Vec::new();
    let (unit, scale) = unit_and_scale(&file, &mut warnings)?;
    let faces = trim::faces(&file)?;
    let mut items = Vec::new();
    let mut points = 0;
    for entry in file.directory.iter().filter(|entry| entry.kind == 128) {
        let (surface, partly) = surface::read(&file, entry)?;
        // Entries may share parameters, so that the file's size alone is no bound.
        points += surface.count(Along::U) * surface.count(Along::V);
        if points > MAX_POINTS {
            return Err(fault(
                entry,
                format!("the file has more than {MAX_POINTS} control points up to here"),
            ));
        }
        let own: Vec<&trim::Face> = faces.iter().filter(|face| face.surface == entry.number).collect();
        let label =
            own.iter().map(|face| face.label.as_str()).chain([entry.label.as_str()]).find(|l| !l.is_empty());
        let name = format!("{} D{}", label.unwrap_or("face"), entry.number);
        if partly {
            let why = "it uses only a part of the parameters of its surface".to_owned();
            warnings.push(Warning::Trimmed { face: name.clone(), why });
        }
        for face in own {
            let why = trim::beyond_border(&file, face, &surface)?;
            warnings.extend(why.map(|why| Warning::Trimmed { face: name.clone(), why }));
        }
        let surface = if scale == 1.0 { surface } else { surface.scaled(1.0 / scale) };
        items.push(Item { name, shape: Shape::Surface(Arc::new(surface)) });
    }
    let left_out = left_out(&file);
    if items.is_empty() {
        let found: Vec<_> = left_out.iter().map(|(what, count)| format!("{count} × {what}")).collect();
        let found = if found.is_empty() { "no surface of any kind".to_owned() } else { found.join(", ") };
        let message =
            format!("no NURBS surface (entity 128), but {found}; export all faces as NURBS surfaces");
        return Err(ImportError::at(Format::Iges, Place::Whole, message));
    }
    warnings.extend(left_out.into_iter().map(|(what, count)| Warning::LeftOut { what, count }));
    Ok(Part { format: Format::Iges, unit: Some(unit), items, warnings })
}

/// How many entities of each kind hold geometry that is not read.
fn left_out(file: &File) -> Vec<(String, usize)> {
    let mut counts: BTreeMap<i64, usize> = BTreeMap::new();
    for entry in &file.directory {
        *counts.entry(entry.kind).or_default() += 1;
    }
    let named = |(kind, name): &(i64, &str)| {
        counts.get(kind).map(|count| (format!("{name} (entity {kind})"), *count))
    };
    NOT_READ.iter().filter_map(named).collect()
}

/// The file's unit, and model lengths for one real length.
fn unit_and_scale(file: &File, warnings: &mut Vec<Warning>) -> Result<(Unit, f64), ImportError> {
    let place = Place::Field("global section".into());
    let flag = file.global.get(13).and_then(record::Field::number);
    let name = file.global.get(14).map(record::Field::text).unwrap_or_default();
    let unit = match flag {
        // An inch is what the standard takes where nothing is said.
        None => Some(Unit::Inch),
        Some(2.0) => Some(Unit::Millimetre),
        Some(1.0) => Some(Unit::Inch),
        Some(3.0) => Unit::named(&name),
        Some(4.0) => Some(Unit::Foot),
        Some(5.0) => Some(Unit::Mile),
        Some(6.0) => Some(Unit::Metre),
        Some(7.0) => Some(Unit::Kilometre),
        Some(8.0) => Some(Unit::Mil),
        Some(9.0) => Some(Unit::Micrometre),
        Some(10.0) => Some(Unit::Centimetre),
        Some(11.0) => Some(Unit::Microinch),
        Some(_) => None,
    };
    let Some(unit) = unit else {
        let message = "unit (fields 14 and 15) must be a flag from 1 to 11, with a known name where it is 3";
        return Err(ImportError::at(Format::Iges, place, message));
    };
    if flag.is_none() {
        let assumption = "the unit is missing; inches were assumed, as the standard says".to_owned();
        warnings.push(Warning::Assumed { place: place.clone(), assumption });
    } else if Unit::named(&name).is_some_and(|named| named != unit) {
        let assumption = format!("the unit's flag means {unit}, its name is {name}; {unit} was assumed");
        warnings.push(Warning::Assumed { place: place.clone(), assumption });
    }
    match file.global.get(12).and_then(record::Field::number).unwrap_or(1.0) {
        scale if scale > 0.0 && scale.is_finite() => Ok((unit, scale)),
        scale => Err(ImportError::at(
            Format::Iges,
            place,
            format!("model scale (field 13) must be above 0, found {scale}"),
        )),
    }
}

/// An error in `entry`.
fn fault(entry: &Entry, message: impl Into<String>) -> ImportError {
    let place = Place::Entity { kind: entry.kind, directory: entry.number };
    ImportError::at(Format::Iges, place, message)
}
