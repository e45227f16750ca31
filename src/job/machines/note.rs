//! What is worth knowing of a program, and where on the path.

use super::post::Posted;
use crate::machine::{Axis, AxisMove};
use crate::toolpath::{Rate, Role};

/// What a note tells of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Matter {
    /// An axis is at its greatest speed, and the feed less than asked for: the least share of it that is left.
    Slowed {
        /// The axis.
        letter: char,
        /// Of the feed, 0 to 1.
        share: f64,
    },
    /// The tool draws back on a link and is turned over.
    TurnedOver,
    /// The tool passes the pole, and an axis swings round: by so much, degrees.
    Pole {
        /// The axis.
        letter: char,
        /// By how much it turns.
        degrees: f64,
    },
    /// The axis of the path was tilted aside, so as not to pass the pole.
    Aside,
    /// An axis comes near to its limit: by so much, mm or degrees.
    NearLimit {
        /// The axis.
        letter: char,
        /// Between where it stands and its limit.
        left: f64,
        /// ` mm` or `°`.
        unit: &'static str,
    },
    /// The middle of the bottom cuts, and stands still: with this lead, degrees, where this much would do.
    ZeroSpeed {
        /// The lead there.
        lead: f64,
        /// With which it would stay clear.
        needed: f64,
    },
}

/// Something worth knowing, and the moves of the toolpath that it is true of, counted from 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Note {
    /// What.
    pub matter: Matter,
    /// Its first move.
    pub first: usize,
    /// Its last move.
    pub last: usize,
}

/// Less of a feed than this is worth a word.
const HELD: f64 = 0.95;
/// The share of an axis' way that counts as near to its limits.
const NEAR: f64 = 0.01;
/// A turn in the pole of no more than this is none, degrees.
const SWING: f64 = 20.0;
/// How near to the pole counts as passing it, the length of a cross product.
const AT_POLE: f64 = 0.02;
/// Moves of one matter that are this near are one place.
const TOGETHER: usize = 20;
/// The most places that are told of one matter: the worst.
const MOST: usize = 12;

impl Note {
    /// How bad it is: the greater the worse, among notes of one matter.
    fn weight(&self) -> f64 {
        match self.matter {
            Matter::Slowed { share, .. } => -share,
            Matter::Pole { degrees, .. } => degrees,
            Matter::NearLimit { left, .. } => -left,
            Matter::TurnedOver | Matter::Aside | Matter::ZeroSpeed { .. } => 0.0,
        }
    }

    /// What it says, in English.
    pub fn text(&self) -> String {
        match self.matter {
            Matter::Slowed { letter, share } => {
                format!("{letter} is at its greatest speed: {:.0} % of the feed is left", 100.0 * share)
            }
            Matter::TurnedOver => "the tool draws back and is turned over".into(),
            Matter::Pole { letter, degrees } => format!("{letter} swings by {degrees:.0}° in the pole"),
            Matter::Aside => "tilted aside, around the pole".into(),
            Matter::NearLimit { letter, left, unit } => {
                format!("{letter} comes to {left:.3}{unit} from its limit")
            }
            Matter::ZeroSpeed { lead, needed } => format!(
                "the middle of the bottom cuts at zero speed: the lead is {lead:.2}°, and {needed:.2}° would keep it clear"
            ),
        }
    }
}

/// What is worth knowing of a program, in the order of the path; of every matter the worst places.
pub fn notes(posted: &Posted) -> Vec<Note> {
    let moves = &posted.path.moves;
    let axes = posted.kinematics.axes();
    let swings = swings(posted);
    // An axis that swings is as fast as it can be: that need not be told twice.
    let is_told = |note: &Note| {
        let Matter::Slowed { letter: slow, .. } = note.matter else { return false };
        let near = |other: &Note| other.first <= note.last + 2 && note.first <= other.last + 2;
        let swings_so = |other: &Note| matches!(other.matter, Matter::Pole { letter, .. } if letter == slow);
        swings.iter().any(|other| swings_so(other) && near(other))
    };
    let mut all = gathered(moves.windows(2).filter_map(|pair| slowed(posted, pair)), |a, b| {
        if b.weight() > a.weight() {
            a.matter = b.matter;
        }
    });
    all.retain(|note| !is_told(note));
    all.extend(swings.iter().copied());
    let drawn_back =
        moves.iter().filter(|step| step.turns_over).map(|step| at(Matter::TurnedOver, step.source));
    all.extend(gathered(drawn_back, |_, _| {}));
    all.extend(gathered(posted.aside.iter().map(|&k| at(Matter::Aside, k)), |_, _| {}));
    all.extend(axes.iter().enumerate().filter_map(|(place, axis)| near_limit(axis, place, moves)));
    if let Some(cutting) = posted.cutting.filter(|cutting| cutting.least <= 0.0) {
        let (lead, needed) = (cutting.least_lead.to_degrees(), cutting.clearing_lead.to_degrees());
        all.push(at(Matter::ZeroSpeed { lead, needed }, cutting.least_at));
    }
    all = worst(all);
    all.sort_by_key(|note| note.first);
    all
}

/// Where cuts pass the pole, and the axis that is free there swings round.
fn swings(posted: &Posted) -> Vec<Note> {
    let Some((axis, pole)) = posted.kinematics.axes().get(3).zip(posted.kinematics.pole()) else {
        return Vec::new();
    };
    let turn = |pair: &[AxisMove]| {
        let near = pair[1].to.axis.cross(pole).length() < AT_POLE && pair[1].role == Role::Cut;
        let degrees = (pair[1].at.rotary[0] - pair[0].at.rotary[0]).to_degrees();
        near.then(|| at(Matter::Pole { letter: axis.letter, degrees }, pair[1].source))
    };
    let mut found = gathered(posted.path.moves.windows(2).filter_map(turn), |a, b| {
        if let (Matter::Pole { degrees, .. }, Matter::Pole { degrees: more, .. }) = (&mut a.matter, b.matter)
        {
            *degrees += more;
        }
    });
    for note in &mut found {
        if let Matter::Pole { degrees, .. } = &mut note.matter {
            *degrees = degrees.abs();
        }
    }
    found.retain(|note| note.weight() > SWING);
    found
}

fn at(matter: Matter, index: usize) -> Note {
    Note { matter, first: index, last: index }
}

/// The axis that takes the feed of a move, if one does.
fn slowed(posted: &Posted, pair: &[AxisMove]) -> Option<Note> {
    let [from, to] = pair else { return None };
    let Rate::Feed(_) = to.rate else { return None };
    let share = to.asked / to.seconds;
    if to.role != Role::Cut || to.seconds <= 0.0 || share >= HELD {
        return None;
    }
    let ways = from.at.all().into_iter().zip(to.at.all()).map(|(a, b)| (b - a).abs());
    let axes = posted.kinematics.axes().iter().zip(ways);
    let (axis, _) = axes.max_by(|a, b| (a.1 / a.0.speed).total_cmp(&(b.1 / b.0.speed)))?;
    Some(at(Matter::Slowed { letter: axis.letter, share }, to.source))
}

/// Where an axis is nearest to one of its limits, if it is near.
fn near_limit(axis: &Axis, place: usize, moves: &[AxisMove]) -> Option<Note> {
    let [low, high] = axis.limits?;
    let left = |step: &AxisMove| (step.at.all()[place] - low).min(high - step.at.all()[place]).max(0.0);
    let nearest = moves.iter().min_by(|a, b| left(a).total_cmp(&left(b)))?;
    let matter =
        Matter::NearLimit { letter: axis.letter, left: axis.shown(left(nearest)), unit: axis.unit() };
    (left(nearest) < NEAR * (high - low)).then(|| at(matter, nearest.source))
}

/// What was found, notes near to one another joined.
fn gathered(found: impl Iterator<Item = Note>, join: impl Fn(&mut Note, &Note)) -> Vec<Note> {
    let mut all: Vec<Note> = Vec::new();
    for note in found {
        match all.last_mut() {
            Some(open) if note.first <= open.last + TOGETHER => {
                join(open, &note);
                open.last = open.last.max(note.last);
            }
            _ => all.push(note),
        }
    }
    all
}

/// Of every matter no more than [`MOST`] notes.
fn worst(mut all: Vec<Note>) -> Vec<Note> {
    all.sort_by(|a, b| b.weight().total_cmp(&a.weight()));
    let mut kept: Vec<Note> = Vec::new();
    for note in all {
        let same =
            |other: &&Note| std::mem::discriminant(&other.matter) == std::mem::discriminant(&note.matter);
        if kept.iter().filter(same).count() < MOST {
            kept.push(note);
        }
    }
    kept
}
