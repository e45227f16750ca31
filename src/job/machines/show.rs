//! A program and its machine, to be drawn and played.

use super::post::Posted;
use super::timeline::Timeline;
use crate::machine::{Chain, Figure, Part, Scene, Tool};
use crate::toolpath::Role;
use glam::DVec3;
use serde_json::{Value, json};

/// What a machine looks like with its part, and how it moves.
#[derive(Debug, Clone, PartialEq)]
pub struct Show {
    chain: Chain,
    figure: Figure,
    /// The tip's way over the workpiece, thinned out, workpiece frame, mm.
    line: Vec<DVec3>,
    /// The farthest points of the figure on its way, machine frame, mm: what is to be seen in any picture of it.
    hull: Vec<DVec3>,
    zero: DVec3,
}

/// Points of the tip's way that are drawn: more than a small picture shows.
const MOST_POINTS: usize = 700;

impl Show {
    /// Of what was written.
    pub fn new(posted: &Posted) -> Self {
        let cuts = posted.toolpath.moves.iter().filter(|step| step.role == Role::Cut);
        let tips: Vec<DVec3> = cuts.map(|step| step.to.tip).collect();
        let low = tips.iter().copied().reduce(DVec3::min).unwrap_or_default();
        let high = tips.iter().copied().reduce(DVec3::max).unwrap_or_default();
        let cutter = &posted.read.cutter;
        let tool = Tool {
            length: posted.kinematics.tool_length(),
            radius: cutter.largest_radius(),
            height: cutter.height,
        };
        let chain = Chain::new(&posted.machine, &posted.kinematics);
        let scene = Scene { tool, workpiece: [low, high], used: used(posted) };
        let figure = chain.figure(&posted.machine, &scene);
        let hull = hull(posted, &chain, &figure);
        let every = 1 + tips.len() / MOST_POINTS;
        let line = tips.into_iter().step_by(every).collect();
        Self { chain, figure, line, hull, zero: posted.machine.workpiece_zero }
    }

    /// The figure as JSON: `solids` of `{body, part, corners, faces}`, `labels` of `{letter, body, at}`, and `line`, the tip's way, with
    /// its `body`, and `hull`, its farthest points on its way; where they are while every axis stands at 0, machine frame, mm.
    pub fn to_json(&self) -> String {
        let solids = self.figure.solids.iter().map(|solid| {
            json!({
                "body": solid.body,
                "part": word(solid.part),
                "corners": solid.corners.iter().flat_map(|c| c.to_array()).map(rounded).collect::<Vec<_>>(),
                "faces": solid.faces,
            })
        });
        let labels = self.figure.labels.iter().map(|label| {
            json!({ "letter": label.letter.to_string(), "body": label.body, "at": label.at.to_array().map(rounded) })
        });
        let line = self.line.iter().flat_map(|tip| (self.zero + *tip).to_array()).map(rounded);
        json!({
            "solids": solids.collect::<Vec<Value>>(),
            "labels": labels.collect::<Vec<Value>>(),
            "hull": self.hull.iter().flat_map(|p| p.to_array()).map(rounded).collect::<Vec<_>>(),
            "line": { "body": self.chain.workpiece(), "points": line.collect::<Vec<_>>() },
        })
        .to_string()
    }

    /// Twelve numbers a body: where it has gone when a share of the toolpath's length is done, the columns of its matrix and its shift.
    pub fn bodies(&self, timeline: &Timeline, share: f64) -> Vec<f32> {
        let bodies = self.chain.bodies(&timeline.at_share(share).position);
        bodies.iter().flat_map(|body| body.to_cols_array()).map(|x| x as f32).collect()
    }
}

/// The moment at which a share of the toolpath's length is done: seconds, and the positions of the axes, mm and degrees.
pub fn told(posted: &Posted, timeline: &Timeline, share: f64) -> Vec<f64> {
    let moment = timeline.at_share(share);
    let axes = posted.kinematics.axes().iter().zip(moment.position.all());
    let positions = axes.map(|(axis, at)| axis.shown(at));
    std::iter::once(moment.seconds).chain(positions).collect()
}

/// Least and greatest position of the axis at `place`, mm or degrees, or of its speed, a second, in `columns` of equal time between two times
/// (s). Columns in which nothing moves are not numbers.
pub fn band(
    posted: &Posted,
    timeline: &Timeline,
    place: usize,
    speeds: bool,
    span: [f64; 2],
    columns: usize,
) -> Vec<f32> {
    let Some(axis) = posted.kinematics.axes().get(place) else { return Vec::new() };
    let columns = columns.clamp(1, 10_000);
    let band =
        if speeds { timeline.speeds(place, span, columns) } else { timeline.positions(place, span, columns) };
    let known = |x: f64| if x.is_finite() { axis.shown(x) as f32 } else { f32::NAN };
    band.into_iter().flatten().map(known).collect()
}

/// From where to where each axis goes.
fn used(posted: &Posted) -> [[f64; 2]; 5] {
    let mut used = [[f64::INFINITY, f64::NEG_INFINITY]; 5];
    // Where it cuts: on links it may go far.
    for step in posted.path.moves.iter().filter(|step| step.role == Role::Cut) {
        for (span, at) in used.iter_mut().zip(step.at.all()) {
            *span = [span[0].min(at), span[1].max(at)];
        }
    }
    used.map(|[low, high]| if low <= high { [low, high] } else { [0.0; 2] })
}

/// Places of the motion that are looked at for the room that the figure takes.
const PLACES: usize = 24;

/// The farthest points of the figure on its way in directions all around, machine frame, mm.
fn hull(posted: &Posted, chain: &Chain, figure: &Figure) -> Vec<DVec3> {
    let around = [-1.0, -0.5, 0.0, 0.5, 1.0];
    let mut farthest: Vec<(DVec3, f64, DVec3)> = Vec::new();
    for direction in around.iter().flat_map(|x| around.iter().map(move |y| (*x, *y))).flat_map(|(x, y)| {
        [
            DVec3::new(x, y, 1.0),
            DVec3::new(x, y, -1.0),
            DVec3::new(x, 1.0, y),
            DVec3::new(x, -1.0, y),
            DVec3::new(1.0, x, y),
            DVec3::new(-1.0, x, y),
        ]
    }) {
        farthest.push((direction, f64::NEG_INFINITY, DVec3::ZERO));
    }
    let cuts: Vec<_> = posted.path.moves.iter().filter(|step| step.role == Role::Cut).collect();
    for step in cuts.iter().step_by(1 + cuts.len() / PLACES) {
        let bodies = chain.bodies(&step.at);
        let corners = figure.solids.iter().flat_map(|solid| solid.corners.iter().map(|at| (solid.body, at)));
        for at in corners.map(|(body, at)| bodies[body].transform_point3(*at)) {
            for (direction, most, point) in &mut farthest {
                let out = direction.dot(at);
                if out > *most {
                    (*most, *point) = (out, at);
                }
            }
        }
    }
    farthest.into_iter().map(|(_, _, point)| point).collect()
}

/// A tenth of a millimetre: nobody sees less.
fn rounded(x: f64) -> f64 {
    (10.0 * x).round() / 10.0
}

fn word(part: Part) -> &'static str {
    match part {
        Part::Bed => "bed",
        Part::Table => "table",
        Part::Head => "head",
        Part::Rail => "rail",
        Part::Drum => "drum",
        Part::Cutter => "cutter",
    }
}
