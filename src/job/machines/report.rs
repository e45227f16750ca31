//! What is known of a program, as JSON for programs and the page.

use super::note::{Matter, Note, notes};
use super::post::Posted;
use super::prove::Kept;
use super::timeline::Timeline;
use serde_json::{Value, json};

/// The program in numbers: blocks, time by kind of move (s), how far it reads back from its path, what the cutter gets, the way of
/// every axis (mm and degrees, machine coordinates), and what is worth knowing.
pub fn report_json(posted: &Posted, timeline: &Timeline) -> String {
    let axes = posted.kinematics.axes().iter().enumerate().map(|(place, axis)| {
        let [least, greatest] = posted.path.span(place).map(|x| axis.shown(x));
        json!({
            "letter": axis.letter.to_string(),
            "unit": axis.unit().trim(),
            "limits": axis.limits.map(|limits| limits.map(|x| axis.shown(x))),
            "speed": axis.shown(axis.speed),
            "least": least,
            "greatest": greatest,
        })
    });
    let times = &posted.times;
    json!({
        "machine": posted.machine.name,
        "tool_length_mm": posted.kinematics.tool_length(),
        "blocks": posted.text.lines().count(),
        "turn_overs": posted.path.turn_overs,
        "seconds": {
            "total": times.total(), "cut": times.cut, "link": times.link, "rapid": times.rapid, "shown": timeline.seconds(),
        },
        "deviation": { "tip_mm": posted.deviation.tip_mm, "axis_deg": posted.deviation.axis_deg },
        "cutting": posted.cutting.map(|cutting| json!({
            "rpm": cutting.rpm,
            "feed_mm_per_min": cutting.feed,
            "feed_per_tooth_mm": cutting.feed_per_tooth,
            "diameters_mm": cutting.at_contact,
            "speeds_m_per_min": cutting.at_contact.map(|d| cutting.speed(d)),
            "least_diameter_mm": cutting.least,
            "least_speed_m_per_min": cutting.speed(cutting.least),
            "least_lead_deg": cutting.least_lead.to_degrees(),
            "clearing_lead_deg": cutting.clearing_lead.to_degrees(),
        })),
        "axes": axes.collect::<Vec<_>>(),
        "notes": notes(posted).iter().map(note).collect::<Vec<_>>(),
    })
    .to_string()
}

fn note(note: &Note) -> Value {
    let mut shown = match note.matter {
        Matter::Slowed { letter, share } => {
            json!({ "matter": "slowed", "axis": letter.to_string(), "share": share })
        }
        Matter::TurnedOver => json!({ "matter": "turned_over" }),
        Matter::Pole { letter, degrees } => {
            json!({ "matter": "pole", "axis": letter.to_string(), "degrees": degrees })
        }
        Matter::Aside => json!({ "matter": "aside" }),
        Matter::NearLimit { letter, left, unit } => {
            json!({ "matter": "near_limit", "axis": letter.to_string(), "left": left, "unit": unit.trim() })
        }
        Matter::ZeroSpeed { lead, needed } => {
            json!({ "matter": "zero_speed", "lead": lead, "needed": needed })
        }
    };
    shown["first"] = note.first.into();
    shown["last"] = note.last.into();
    shown["text"] = note.text().into();
    shown
}

/// What the program cuts beside what was planned, mm.
pub fn kept_json(kept: &Kept) -> String {
    json!({
        "planned": kept.planned,
        "posted": kept.posted,
        "largest_change_mm": kept.largest_change,
        "allowed_mm": kept.allowed,
        "samples": kept.samples,
    })
    .to_string()
}
