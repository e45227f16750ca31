//! Cutting speeds: from material and cutter to spindle and feed, and from these to what every contact gets.

use super::contacts::Contact;
use crate::cutter::Cutter;
use crate::job::error::JobError;
use crate::toolpath::{Rate, Role, Toolpath};
use std::f64::consts::PI;

/// What is cut, with ordinary values for finishing with coated carbide. Makers' tables differ by a half and more: they are to begin with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// A word that stays the same.
    pub name: &'static str,
    /// Least and greatest surface speed, m/min.
    pub surface_speed: [f64; 2],
    /// Feed a tooth over the cutter's diameter.
    pub feed_per_tooth: f64,
}

const fn material(name: &'static str, surface_speed: [f64; 2], feed_per_tooth: f64) -> Material {
    Material { name, surface_speed, feed_per_tooth }
}

/// The materials.
pub const MATERIALS: [Material; 9] = [
    material("aluminium", [200.0, 600.0], 0.010),
    material("brass", [150.0, 350.0], 0.010),
    material("plastic", [150.0, 400.0], 0.015),
    material("graphite", [200.0, 450.0], 0.012),
    material("steel", [100.0, 220.0], 0.007),
    material("hard_steel", [60.0, 140.0], 0.005),
    material("stainless", [60.0, 130.0], 0.006),
    material("titanium", [40.0, 80.0], 0.005),
    material("nickel", [20.0, 45.0], 0.004),
];

/// How spindle and feed are chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Choice {
    /// What is cut.
    pub material: Material,
    /// Teeth of the cutter, 1 or more.
    pub teeth: f64,
    /// The fastest that the spindle turns, 1/min, above 0.
    pub most_rpm: f64,
}

/// What the cutter gets along a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cutting {
    /// Speed of the spindle, 1/min.
    pub rpm: f64,
    /// Feed that was chosen for all cuts, mm/min; nothing if they keep their own.
    pub feed: Option<f64>,
    /// Feed a tooth that goes with it, mm.
    pub feed_per_tooth: Option<f64>,
    /// Effective diameters at the contacts, least and greatest, mm.
    pub at_contact: [f64; 2],
    /// The least effective diameter within the allowance, mm: 0 where the middle of the bottom cuts.
    pub least: f64,
    /// The move with it, counted from 0.
    pub least_at: usize,
    /// The lead there, radians.
    pub least_lead: f64,
    /// The least lead with which the middle of the bottom would stay clear of the allowance, radians.
    pub clearing_lead: f64,
}

impl Cutting {
    /// Surface speed at an effective diameter, m/min.
    pub fn speed(&self, diameter: f64) -> f64 {
        PI * diameter * self.rpm / 1000.0
    }
}

/// The effective diameter at a contact, mm: twice its distance from the cutter's axis.
fn at_contact(cutter: &Cutter, lead: f64) -> f64 {
    2.0 * (cutter.center_radius + cutter.corner_radius * libm::sin(lead))
}

/// The least diameter on which the cutter, leaning by `lead` (radians), cuts an allowance of `depth` mm, mm; 0 where its middle does.
///
/// On the corner a point at the angle ψ from the contact is `r (1 − cos ψ)` above the surface; on the flat bottom, leaning by λ, one at
/// the distance s from the axis is `(R₁ − s) sin λ + r (1 − cos λ)` above it.
pub fn least_diameter(cutter: &Cutter, lead: f64, depth: f64) -> f64 {
    let (r, lead) = (cutter.corner_radius, lead - cutter.bottom_angle);
    let inner = cutter.center_radius;
    if lead <= 0.0 {
        return 0.0;
    }
    let bottom = r * (1.0 - libm::cos(lead));
    let radius = if depth < bottom {
        inner + r * libm::sin(lead - libm::acos(1.0 - depth / r))
    } else {
        inner - (depth - bottom) / libm::sin(lead)
    };
    2.0 * radius.max(0.0)
}

/// The least lead with which the middle of the bottom stays above an allowance of `depth` mm, radians; a right angle if none does.
pub fn clearing_lead(cutter: &Cutter, depth: f64) -> f64 {
    // What grows with the lead is halved to a thousandth of a degree.
    let (mut low, mut high) = (0.0, 0.5 * PI);
    for _ in 0..24 {
        let middle = 0.5 * (low + high);
        if least_diameter(cutter, middle, depth) > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

/// The leads at the contacts of cuts, each with its move.
fn leads<'a>(path: &'a Toolpath, contacts: &'a [Option<Contact>]) -> impl Iterator<Item = (usize, f64)> + 'a {
    let moves = path.moves.iter().zip(contacts).enumerate();
    let cuts = moves.filter(|(_, (step, _))| step.role == Role::Cut);
    cuts.filter_map(|(index, (_, contact))| Some((index, contact.as_ref()?.lead)))
}

/// Chooses spindle and feed for the cuts of `path`, and writes them into `path` and `rpm`.
///
/// The spindle turns so that the largest effective diameter runs at the material's greatest surface speed, as far as the spindle can; cuts
/// are fed by teeth and speed.
///
/// Errors: contacts that are not known, or that all stand still.
pub(super) fn choose(
    path: &mut Toolpath,
    cutter: &Cutter,
    rpm: &mut Option<f64>,
    contacts: &[Option<Contact>],
    choice: &Choice,
) -> Result<(), JobError> {
    let &Choice { material, most_rpm, .. } = choice;
    let widest = leads(path, contacts).map(|(_, lead)| at_contact(cutter, lead)).fold(0.0, f64::max);
    if widest <= 0.0 {
        let why =
            "takes the table of the path's contacts (path.csv), and cuts that are not all at zero speed";
        return Err(JobError::field("cutting.material", why.into()));
    }
    let turned = (1000.0 * material.surface_speed[1] / (PI * widest)).min(most_rpm);
    // To ten a minute and to a millimetre a minute: nobody sets more.
    let turned = (10.0 * (turned / 10.0).floor()).max(1.0);
    let feed = (choice.teeth * material.feed_per_tooth * cutter.diameter * turned).round().max(1.0);
    *rpm = Some(turned);
    for step in path.moves.iter_mut().filter(|step| step.role == Role::Cut) {
        if let Rate::Feed(asked) = &mut step.rate {
            *asked = feed;
        }
    }
    Ok(())
}

/// What the cutter gets at its `contacts` along `path`, taking off `depth` mm, with the spindle at `rpm`; nothing where no contacts of cuts
/// are known. `choice` is what spindle and feed were chosen by.
pub(super) fn look(
    path: &Toolpath,
    cutter: &Cutter,
    rpm: f64,
    contacts: &[Option<Contact>],
    choice: Option<&Choice>,
    depth: f64,
) -> Option<Cutting> {
    let (mut low, mut high) = (f64::INFINITY, 0.0f64);
    let mut least: Option<(f64, usize, f64)> = None;
    for (index, lead) in leads(path, contacts) {
        let diameter = at_contact(cutter, lead);
        (low, high) = (low.min(diameter), high.max(diameter));
        let inner = least_diameter(cutter, lead, depth);
        if least.is_none_or(|(before, ..)| inner < before) {
            least = Some((inner, index, lead));
        }
    }
    let (least, least_at, least_lead) = least?;
    let feed = choice.and_then(|_| match path.moves[least_at].rate {
        Rate::Feed(feed) => Some(feed),
        Rate::Rapid => None,
    });
    Some(Cutting {
        rpm,
        feed,
        feed_per_tooth: feed.zip(choice).map(|(feed, choice)| feed / (choice.teeth * rpm)),
        at_contact: [low, high],
        least,
        least_at,
        least_lead,
        clearing_lead: clearing_lead(cutter, depth),
    })
}
