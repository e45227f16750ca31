//! The curve that passes are offset from.

use crate::geometry::Along;
use crate::strategy::Start;
use serde::{Deserialize, Serialize};

/// The curve that passes are offset from: a border, a line of that parameter, a plane section, or one
/// through given points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the names say it")]
pub enum StartSpec {
    ULow,
    UHigh,
    VLow,
    VHigh,
    ULine,
    VLine,
    Section,
    Curve,
}

impl StartSpec {
    /// The curve: `percent` tells which line of a parameter, `angle_deg` which section, `points` what it runs through.
    pub(super) fn start(self, percent: f64, angle_deg: f64, points: &[[f64; 3]]) -> Start {
        let line = |along, at| Start::Line { along, at };
        match self {
            Self::ULow => line(Along::V, 0.0),
            Self::UHigh => line(Along::V, 1.0),
            Self::VLow => line(Along::U, 0.0),
            Self::VHigh => line(Along::U, 1.0),
            Self::ULine => line(Along::V, 0.01 * percent),
            Self::VLine => line(Along::U, 0.01 * percent),
            Self::Section => Start::Section(angle_deg.to_radians()),
            Self::Curve => Start::Curve(points.iter().map(|&point| point.into()).collect()),
        }
    }
}
