//! From a turning specification's settings to the core's own types.

use super::spec::{
    ApertureSpec, CWordSpec, FeedWordSpec, GivenSpec, GuideSpec, InterpolationSpec, PaceSpec, PointSpec,
    PointsSpec, RateSpec, ShapeSpec, StepSpec, SurfaceSpec, ToolSpec, ToricSpec, TurningSpec, WaySpec,
    XWordSpec,
};
use super::table::table;
use crate::job::error::JobError;
use crate::post::xzc::{CWord, Feed, Reference, Rounding, XWord};
use crate::toolpath::Interpolation;
use crate::turning::sag::{
    Biconic, Conic, Freeform, GridMap, Sag, Stated, Term, Toric, ToricKind, ZernikeTerm, zernike,
};
use crate::turning::{
    Aperture, Asked, Curve, Limits, Order, Outline, Pace, Placed, Spacing, Speed, Step, Tool, Way, Ways,
};
use std::f64::consts::TAU;
use std::sync::Arc;

/// The sign of a shape's curvature, positive where hollow.
fn curvature(shape: ShapeSpec, radius: f64) -> f64 {
    match shape {
        ShapeSpec::Flat => 0.0,
        ShapeSpec::Convex => -1.0 / radius,
        ShapeSpec::Concave => 1.0 / radius,
    }
}

impl SurfaceSpec {
    /// Where the surface's own origin is held, mm, and how far it is turned, radians.
    pub(super) fn held(&self) -> ([f64; 2], f64) {
        let (Self::Toric { shift_x_mm, shift_y_mm, turn_deg, .. }
        | Self::Sphere { shift_x_mm, shift_y_mm, turn_deg, .. }
        | Self::Conic { shift_x_mm, shift_y_mm, turn_deg, .. }
        | Self::Asphere { shift_x_mm, shift_y_mm, turn_deg, .. }
        | Self::Biconic { shift_x_mm, shift_y_mm, turn_deg, .. }
        | Self::Polynomial { shift_x_mm, shift_y_mm, turn_deg, .. }
        | Self::Zernike { shift_x_mm, shift_y_mm, turn_deg, .. }
        | Self::Grid { shift_x_mm, shift_y_mm, turn_deg, .. }) = self;
        ([*shift_x_mm, *shift_y_mm], turn_deg.to_radians())
    }

    /// The file that the surface is in, if it is in one.
    pub fn file(&self) -> Option<&str> {
        match self {
            Self::Grid { path, .. } if !path.is_empty() => Some(path),
            _ => None,
        }
    }

    /// The sag, stated out to `extent` mm from its own origin; `bytes` is the content of its file, if it is in one.
    ///
    /// Errors name the setting.
    fn sag(&self, extent: f64, bytes: Option<&[u8]>) -> Result<Arc<dyn Sag>, JobError> {
        let wrong = |field: &str, message: String| JobError::field(&format!("surface.{field}"), message);
        let round = |shape, radius, conic, even| Conic::new(curvature(shape, radius), conic, even, extent);
        Ok(match self {
            Self::Toric { shape, base_radius_mm, rotation_radius_mm, .. } => {
                let kind = match shape {
                    ToricSpec::Convex => ToricKind::Convex,
                    ToricSpec::Concave => ToricKind::Concave,
                    ToricSpec::SaddleConvexBase => ToricKind::SaddleConvexBase,
                    ToricSpec::SaddleConcaveBase => ToricKind::SaddleConcaveBase,
                };
                let saddle = matches!(kind, ToricKind::SaddleConvexBase | ToricKind::SaddleConcaveBase);
                let least = if saddle { *base_radius_mm } else { -base_radius_mm };
                let made = Toric::new(kind, *base_radius_mm, *rotation_radius_mm);
                Arc::new(made.ok_or_else(|| {
                    let message =
                        format!("must be above {least} mm, so that the section across has a radius above 0");
                    wrong("rotation_radius_mm", message)
                })?)
            }
            Self::Sphere { shape, radius_mm, .. } => Arc::new(round(*shape, *radius_mm, 0.0, Vec::new())),
            Self::Conic { shape, radius_mm, conic, .. } => {
                Arc::new(round(*shape, *radius_mm, *conic, Vec::new()))
            }
            Self::Asphere { shape, radius_mm, conic, even, .. } => {
                // Stated along the bend, as lens data sheets do.
                let sign = if *shape == ShapeSpec::Convex { -1.0 } else { 1.0 };
                Arc::new(round(*shape, *radius_mm, *conic, even.iter().map(|a| sign * a).collect()))
            }
            Self::Biconic { radius_x_mm, radius_y_mm, conic_x, conic_y, .. } => {
                for (field, radius) in [("radius_x_mm", radius_x_mm), ("radius_y_mm", radius_y_mm)] {
                    if radius.abs() < 0.01 {
                        let message = "must be at least 0.01 mm, or at most −0.01 mm where it bends away";
                        return Err(wrong(field, message.into()));
                    }
                }
                let curvature = [1.0 / radius_x_mm, 1.0 / radius_y_mm];
                Arc::new(Biconic { curvature, conic: [*conic_x, *conic_y] })
            }
            Self::Polynomial { shape, radius_mm, conic, norm_mm, terms, .. } => {
                let terms = terms.iter().map(|[i, j, height]| {
                    let powers = [power(*i)?, power(*j)?];
                    Some(Term { powers, height: *height })
                });
                let terms = terms.collect::<Option<Vec<_>>>().ok_or_else(|| {
                    let message =
                        "each must be [power of x, power of y, height in mm], powers whole and at most 20";
                    wrong("terms", message.into())
                })?;
                Arc::new(Freeform::new(
                    round(*shape, *radius_mm, *conic, Vec::new()),
                    terms,
                    *norm_mm,
                    extent,
                ))
            }
            Self::Zernike { shape, radius_mm, conic, norm_mm, terms, .. } => {
                let message =
                    "each must be [n, m, height in mm] with n at most 20, |m| at most n and n − |m| even";
                let terms = terms.iter().map(|[n, m, height]| {
                    let frequency =
                        if m.fract() == 0.0 && m.abs() <= 20.0 { *m as i64 } else { return None };
                    Some(ZernikeTerm { order: power(*n)?, frequency, height: *height })
                });
                let terms =
                    terms.collect::<Option<Vec<_>>>().ok_or_else(|| wrong("terms", message.into()))?;
                let terms = zernike(&terms)
                    .map_err(|index| wrong("terms", format!("term {}: {message}", index + 1)))?;
                Arc::new(Freeform::new(
                    round(*shape, *radius_mm, *conic, Vec::new()),
                    terms,
                    *norm_mm,
                    extent,
                ))
            }
            Self::Grid { given, columns, spacing_x_mm, spacing_y_mm, heights_mm, path, .. } => {
                let stated = match given {
                    GivenSpec::Heights => Stated::Heights,
                    GivenSpec::Coefficients => Stated::Coefficients,
                };
                let from_file;
                let (numbers, columns) = if path.is_empty() {
                    (heights_mm.as_slice(), *columns as usize)
                } else {
                    let Some(bytes) = bytes else {
                        return Err(wrong("path", format!("the file {path} is not there")));
                    };
                    from_file =
                        table(bytes).map_err(|message| wrong("path", format!("{path}: {message}")))?;
                    (from_file.0.as_slice(), from_file.1)
                };
                let field = if path.is_empty() { "heights_mm" } else { "path" };
                let map = GridMap::new(stated, numbers, columns, [*spacing_x_mm, *spacing_y_mm]);
                Arc::new(map.map_err(|e| wrong(field, e.to_string()))?)
            }
        })
    }
}

/// A whole number from 0 to 20.
fn power(x: f64) -> Option<usize> {
    ((0.0..=20.0).contains(&x) && x.fract() == 0.0).then_some(x as usize)
}

impl TurningSpec {
    /// The part as it is held; `bytes` is the content of its file, if it is in one. Errors name the setting.
    pub fn part(&self, bytes: Option<&[u8]>) -> Result<Placed, JobError> {
        let (shift, angle) = self.surface.held();
        let [cx, cy] = self.aperture().center;
        // What is beyond the aperture is never part of the part.
        let rim = self.aperture();
        let own = Aperture { center: [cx - shift[0], cy - shift[1]], ..rim };
        Ok(Placed::new(self.surface.sag(own.farthest(), bytes)?, shift, angle))
    }

    /// How much of the surface is wanted.
    pub fn aperture(&self) -> Aperture {
        let (outline, center, turn) = match self.aperture {
            ApertureSpec::Round { radius_mm, center_x_mm, center_y_mm, turn_deg } => {
                (Outline::Round(radius_mm), [center_x_mm, center_y_mm], turn_deg)
            }
            ApertureSpec::Ellipse { half_x_mm, half_y_mm, center_x_mm, center_y_mm, turn_deg } => {
                (Outline::Ellipse([half_x_mm, half_y_mm]), [center_x_mm, center_y_mm], turn_deg)
            }
            ApertureSpec::Rectangle { half_x_mm, half_y_mm, center_x_mm, center_y_mm, turn_deg } => {
                (Outline::Rectangle([half_x_mm, half_y_mm]), [center_x_mm, center_y_mm], turn_deg)
            }
        };
        Aperture { outline, center, angle: turn.to_radians() }
    }

    /// Vertex of the surface and directions of its two meridians.
    pub(super) fn meridians(&self) -> ([f64; 2], Vec<f64>) {
        let (shift, angle) = self.surface.held();
        (shift, vec![angle, angle + 0.25 * TAU])
    }

    fn tool(&self) -> Tool {
        match self.tool {
            ToolSpec::Ball { radius_mm, .. } => Tool::Ball { radius: radius_mm },
            ToolSpec::Insert { radius_mm, rake_deg, least_rake_deg, clearance_deg, sweep_deg } => {
                Tool::Insert {
                    radius: radius_mm,
                    rake: rake_deg.to_radians(),
                    least_rake: least_rake_deg.to_radians(),
                    clearance: clearance_deg.to_radians(),
                    sweep: sweep_deg.to_radians(),
                }
            }
        }
    }

    fn guide(&self) -> (Ways, Step<f64>) {
        let (curve, way, step, step_mm, lead_in, lead_out) = match self.guide {
            GuideSpec::Spiral { way, step, step_mm, lead_in_turns, lead_out_turns } => {
                (Curve::Spiral, way, step, step_mm, lead_in_turns, lead_out_turns)
            }
            GuideSpec::Circles { across_deg, way, step, step_mm, lead_in_turns, lead_out_turns } => {
                (Curve::Circles(across_deg.to_radians()), way, step, step_mm, lead_in_turns, lead_out_turns)
            }
        };
        let way = match way {
            WaySpec::Inward => Way::Inward,
            WaySpec::Outward => Way::Outward,
        };
        (Ways { curve, way, lead_in, lead_out }, stepped(step, step_mm))
    }

    fn spacing(&self) -> (Step<Spacing>, Interpolation) {
        let (kind, spacing, interpolation) = match self.points {
            PointsSpec::Angle { angle_deg, spacing, interpolation } => {
                (Spacing::Angle(angle_deg.to_radians()), spacing, interpolation)
            }
            PointsSpec::Arc { arc_mm, most_angle_deg, spacing, interpolation } => {
                let most = most_angle_deg.to_radians();
                (Spacing::Arc { length: arc_mm, most }, spacing, interpolation)
            }
            PointsSpec::Hybrid { arc_mm, switch_mm, spacing, interpolation } => {
                (Spacing::Hybrid { length: arc_mm, switch: switch_mm }, spacing, interpolation)
            }
        };
        let interpolation = match interpolation {
            InterpolationSpec::Linear => Interpolation::Linear,
            InterpolationSpec::Pvt => Interpolation::Pvt,
        };
        (stepped(spacing, kind), interpolation)
    }

    fn speed(&self) -> Speed {
        let s = &self.speed;
        let omega = |rpm: f64| rpm * TAU / 60.0;
        let most = omega(s.most_rpm);
        let pace = match s.pace {
            PaceSpec::CSpeed => Pace::Even(omega(s.c_rpm)),
            PaceSpec::SurfaceSpeed => Pace::Surface { speed: s.surface_m_per_min * 1000.0 / 60.0, most },
        };
        match s.rate {
            RateSpec::Given => Speed::Given(pace),
            RateSpec::Highest => Speed::Highest { pace, least: omega(s.least_rpm), most },
        }
    }

    fn limits(&self) -> Limits {
        let l = &self.limits;
        let x = [l.x_mm_per_s, l.x_mm_per_s2, l.x_mm_per_s3];
        let z = [l.z_mm_per_s, l.z_mm_per_s2, l.z_mm_per_s3];
        let c = [l.c_rpm * TAU / 60.0, l.c_deg_per_s2.to_radians(), l.c_deg_per_s3.to_radians()];
        Limits { most: [x, z, c] }
    }

    /// Everything that the plan is made from. Errors name the setting.
    pub fn order(&self, bytes: Option<&[u8]>) -> Result<Order, JobError> {
        let t = self.tolerance;
        let (ways, step) = self.guide();
        if matches!(step, Step::Chosen(_)) && t.chord_mm >= t.residue_mm {
            let message =
                format!("must be below {} mm, the residue that the steps are chosen for", t.residue_mm);
            return Err(JobError::field("tolerance.chord_mm", message));
        }
        if self.speed.rate == RateSpec::Given
            && self.speed.pace == PaceSpec::CSpeed
            && self.speed.c_rpm > self.speed.most_rpm
        {
            let message = format!("must be at most {} rpm, the spindle's highest speed", self.speed.most_rpm);
            return Err(JobError::field("speed.c_rpm", message));
        }
        let (spacing, interpolation) = self.spacing();
        Ok(Order {
            part: self.part(bytes)?,
            aperture: self.aperture(),
            tool: self.tool(),
            ways,
            step,
            spacing,
            interpolation,
            asked: Asked { residue: t.residue_mm, chord: t.chord_mm },
            speed: self.speed(),
            limits: self.limits(),
        })
    }

    /// The words of the program: which point, X, C, and feeds.
    pub(super) fn words(&self) -> (Reference, XWord, CWord, Feed) {
        let o = &self.output;
        let reference = match o.point {
            PointSpec::Tip => Reference::Tip,
            PointSpec::Center => Reference::Center,
        };
        let x = match o.x_word {
            XWordSpec::Radius => XWord::Radius,
            XWordSpec::Diameter => XWord::Diameter,
        };
        let c = match o.c_word {
            CWordSpec::Tool => CWord::Tool,
            CWordSpec::Part => CWord::Part,
        };
        let feed = match o.feed {
            FeedWordSpec::InverseTime => Feed::InverseTime,
            FeedWordSpec::PerMinute => Feed::PerMinute,
        };
        (reference, x, c, feed)
    }

    /// Decimals of the program.
    pub(super) fn rounding(&self) -> Rounding {
        Rounding { length: self.output.decimals_mm as usize, angle: self.output.decimals_deg as usize }
    }
}

fn stepped<T>(step: StepSpec, value: T) -> Step<T> {
    match step {
        StepSpec::Given => Step::Given(value),
        StepSpec::Chosen => Step::Chosen(value),
    }
}
