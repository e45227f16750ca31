//! From a specification's settings to the core's own types.

use super::error::JobError;
use super::spec::{AlongSpec, CutterSpec, FixtureSpec, HolderSpec, OrderSpec, RuleSpec, Spec, StrategySpec};
use crate::cutter::{Cutter, CutterError, Holder};
use crate::geometry::Along;
use crate::posture::{Limits, Rule};
use crate::strategy::{Finish, Linking, Order, Side};
use crate::toolpath::Posture;

impl CutterSpec {
    /// The cutter; errors name the setting.
    pub fn cutter(&self) -> Result<Cutter, JobError> {
        let made = match *self {
            Self::BullNose { diameter_mm, corner_radius_mm, height_mm } => {
                Cutter::bull_nose(diameter_mm, corner_radius_mm, height_mm)
            }
            Self::Ball { diameter_mm, height_mm } => Cutter::ball(diameter_mm, height_mm),
            Self::Flat { diameter_mm, height_mm } => Cutter::flat(diameter_mm, height_mm),
            Self::Tapered { diameter_mm, corner_radius_mm, taper_deg, height_mm } => {
                Cutter::tapered(diameter_mm, corner_radius_mm, taper_deg.to_radians(), height_mm)
            }
            Self::Conical { diameter_mm, corner_radius_mm, bottom_deg, height_mm } => {
                Cutter::conical(diameter_mm, corner_radius_mm, bottom_deg.to_radians(), height_mm)
            }
        };
        made.map_err(|CutterError { field, message }| {
            let unit = if field == "bottom_angle" || field == "taper" { "deg" } else { "mm" };
            let field = if field == "bottom_angle" { "bottom" } else { field };
            JobError::field(&format!("cutter.{field}_{unit}"), message)
        })
    }
}

impl From<AlongSpec> for Along {
    fn from(along: AlongSpec) -> Self {
        match along {
            AlongSpec::U => Self::U,
            AlongSpec::V => Self::V,
        }
    }
}

#[cfg(feature = "flow")]
impl From<super::spec::FamiliesSpec> for crate::strategy::Families {
    fn from(families: super::spec::FamiliesSpec) -> Self {
        match families {
            super::spec::FamiliesSpec::One => Self::One,
            super::spec::FamiliesSpec::Several => Self::Several,
        }
    }
}

impl From<OrderSpec> for Order {
    fn from(order: OrderSpec) -> Self {
        match order {
            OrderSpec::Zig | OrderSpec::Climb | OrderSpec::Conventional => Self::Zig,
            OrderSpec::Zigzag => Self::ZigZag,
        }
    }
}

impl OrderSpec {
    /// On which side of the feed the next pass lies, if that is asked for.
    pub(super) fn side(self) -> Option<Side> {
        match self {
            Self::Climb => Some(Side::Right),
            Self::Conventional => Some(Side::Left),
            Self::Zig | Self::Zigzag => None,
        }
    }
}

impl StrategySpec {
    /// How the cutter leans; nothing for a strategy that keeps it upright.
    ///
    /// Errors name the setting that does not go with another.
    pub(super) fn rule(&self) -> Result<Option<Rule>, JobError> {
        // The strategies that lean have the same settings for it.
        macro_rules! leaning {
            ($($(#[$when:meta])? $kind:ident),*) => {
                match self {
                    $($(#[$when])? Self::$kind {
                        rule,
                        lead_deg,
                        yaw_deg,
                        least_lead_deg,
                        most_lead_deg,
                        most_yaw_deg,
                        turn_along_deg_per_mm,
                        turn_across_deg_per_mm,
                        ..
                    } => (
                        rule,
                        [lead_deg, yaw_deg],
                        [least_lead_deg, most_lead_deg, most_yaw_deg],
                        [turn_along_deg_per_mm, turn_across_deg_per_mm],
                    ),)*
                    Self::Raster { .. } => return Ok(None),
                }
            };
        }
        let (rule, [lead, yaw], [least_lead, most_lead, most_yaw], turn) = leaning!(
            IsoParametric,
            IsoPlanar,
            #[cfg(feature = "flow")]
            ConstantScallop,
            #[cfg(feature = "flow")]
            Flow,
            #[cfg(feature = "flow")]
            PotentialField,
            #[cfg(feature = "flow")]
            Auto
        );
        let posture = Posture { lead: lead.to_radians(), yaw: yaw.to_radians() };
        let by: fn(Limits) -> Rule = match rule {
            RuleSpec::Fixed => return Ok(Some(Rule::Fixed(posture))),
            RuleSpec::Matched => Rule::Matched,
            RuleSpec::Widest => Rule::Widest,
            RuleSpec::TwoContacts => Rule::TwoContacts,
        };
        if most_lead < least_lead {
            let message = format!("must be at least {least_lead}°, the least lead");
            return Err(JobError::field("strategy.most_lead_deg", message));
        }
        let limits = Limits {
            least_lead: least_lead.to_radians(),
            most_lead: most_lead.to_radians(),
            most_yaw: most_yaw.to_radians(),
            most_turn: turn.map(|turn| turn.to_radians()),
            ..Limits::default()
        };
        Ok(Some(by(limits)))
    }
}

impl Spec {
    /// What passes are planned to keep: cusps within the share `tolerance.safety` of the limit.
    pub fn finish(&self) -> Result<Finish, JobError> {
        let tolerance = &self.tolerance;
        let finish = Finish { scallop: tolerance.safety * tolerance.scallop_mm, chord: tolerance.chord_mm };
        if finish.chord > 0.5 * finish.scallop {
            let most = 0.5 * finish.scallop;
            let message =
                format!("must be at most {most} mm, half of the scallop height that is planned for");
            return Err(JobError::field("tolerance.chord_mm", message));
        }
        Ok(finish)
    }

    /// What holds the cutter, if that is stated; errors name the setting.
    pub fn holder(&self, cutter: &Cutter) -> Result<Option<Holder>, JobError> {
        let HolderSpec::Cylinder { stickout_mm, diameter_mm, height_mm } = self.holder else {
            return Ok(None);
        };
        let made = Holder::new(stickout_mm, diameter_mm, height_mm, cutter);
        made.map(Some).map_err(|e| JobError::field(&format!("holder.{}_mm", e.field), e.message))
    }

    /// How passes are joined.
    pub fn linking(&self, cutter: &Cutter, holder: Option<&Holder>) -> Linking {
        Linking {
            cut_feed: self.feeds.cut_mm_per_min,
            plunge_feed: self.feeds.plunge_mm_per_min,
            rapid: self.feeds.rapid_mm_per_min,
            lift: self.links.lift_mm,
            lever: holder.map_or(cutter.height, |holder| holder.stickout.max(cutter.height)),
            clearance: self.links.clearance_mm,
            fixture: (self.links.fixture == FixtureSpec::Plane).then_some(self.links.fixture_z_mm),
        }
    }
}

/// Stretches of the corner in [`outline`].
const OUTLINE: usize = 24;

/// The outline of the cutter of `spec` from its tip outwards and up to its height, as flat pairs of radius and height (mm),
/// for drawing.
pub fn outline(spec: &Spec) -> Result<Vec<f32>, JobError> {
    let cutter = spec.cutter.cutter()?;
    let end = cutter.corner_end();
    let mut flat = vec![0.0, 0.0];
    for k in 0..=OUTLINE {
        let t = k as f64 / OUTLINE as f64;
        // Even in angle from where the bottom line ends to where the side begins.
        let angle =
            cutter.bottom_angle + (std::f64::consts::FRAC_PI_2 - cutter.taper - cutter.bottom_angle) * t;
        let (s, c) = libm::sincos(angle);
        flat.push(cutter.center_radius + cutter.corner_radius * s);
        flat.push(cutter.center_height - cutter.corner_radius * c);
    }
    flat.push(end.0 + (cutter.height - end.1) * libm::tan(cutter.taper));
    flat.push(cutter.height);
    Ok(flat.into_iter().map(|x| x as f32).collect())
}
