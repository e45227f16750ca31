//! A path as a picture that any browser shows.

use super::number::fixed;
use crate::math::frame::Frame;
use crate::toolpath::{Rate, Role, Toolpath};
use glam::DVec3;
use std::fmt::Write;

/// Room around the path, as a share of its size.
const MARGIN: f64 = 0.04;
/// Lines' width, as a share of the size.
const LINE: f64 = 0.0025;

/// The way of the tip in `toolpath`, seen against the mean of its axes, as SVG of its true size in mm: cuts dark, links lighter; rapid ways
/// are left out. Empty paths give an empty picture.
pub fn write(toolpath: &Toolpath) -> String {
    let moves = &toolpath.moves;
    let mean: DVec3 = moves.iter().map(|m| m.to.axis).sum();
    let up = mean.try_normalize().unwrap_or(DVec3::Z);
    let view = Frame::from_normal(up, DVec3::X).unwrap_or_else(|| Frame::any(up));
    // On paper y runs down.
    let seen = |p: DVec3| [p.dot(view.f), -p.dot(view.b)];
    let points: Vec<[f64; 2]> = moves.iter().map(|m| seen(m.to.tip)).collect();
    let cut = points.iter().zip(moves).filter(|(_, m)| m.role == Role::Cut).map(|(p, _)| p);
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for p in cut {
        for k in 0..2 {
            low[k] = low[k].min(p[k]);
            high[k] = high[k].max(p[k]);
        }
    }
    if low[0] > high[0] {
        (low, high) = ([0.0; 2], [1.0; 2]);
    }
    let size = (high[0] - low[0]).max(high[1] - low[1]);
    let room = MARGIN * size;
    let [left, top, width, height] =
        [low[0] - room, low[1] - room, high[0] - low[0] + 2.0 * room, high[1] - low[1] + 2.0 * room]
            .map(|x| fixed(x, 3));
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" viewBox=\"{left} {top} {width} {height}\" \
         fill=\"none\" stroke-width=\"{}\" stroke-linejoin=\"round\">\n",
        fixed(LINE * size, 4)
    );
    for (role, colour) in [(Role::Link, "#c98a2b"), (Role::Cut, "#0f766e")] {
        let mut way = String::new();
        let mut last = None;
        for i in 1..moves.len() {
            if moves[i].role != role || moves[i].rate == Rate::Rapid {
                continue;
            }
            let mut go = |letter: char, [x, y]: [f64; 2]| {
                // Writing to a string cannot fail.
                let _ = write!(way, "{letter}{} {}", fixed(x, 2), fixed(y, 2));
            };
            if last != Some(i - 1) {
                go('M', points[i - 1]);
            }
            go('L', points[i]);
            last = Some(i);
        }
        let _ = writeln!(text, "<path stroke=\"{colour}\" d=\"{way}\"/>");
    }
    text.push_str("</svg>\n");
    text
}
