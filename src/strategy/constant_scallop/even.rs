//! Passes spaced by widths that are evened out over strips.
//!
//! A strip of chosen postures is as wide as it can be, and half as wide beside: near where curvatures match, its profile breaks off.
//! Passes that keep to each strip's own width bend with that, and choose other postures then, and bend more. Evened out, widths change
//! as the surface does, and passes that are as far apart as those stay smooth.

use super::offset::{Offset, period};
use super::strips::Strips;
use super::{crest, fill};
use crate::cutter::Tool;
use crate::geometry::{Face, Field};
use crate::monitor::Stage;
use crate::posture::Rule;
use crate::strategy::family::Family;
use crate::strategy::follow::Part;
use crate::strategy::laid::Laid;
use crate::strategy::probe::Setup;
use crate::strategy::{Finish, Order, StrategyError};
use std::sync::Arc;

/// Over how many mean strips widths are evened out, in each way of which no formula tells which makes passes shorter; the less the more
/// passes bend.
const OVER: [f64; 3] = [9.0, 4.0, 2.0];
/// Rounds in which postures, widths and the passes' direction come to agree; and after how many passes are laid, since more rounds
/// may make them shorter or longer.
const ROUNDS: usize = 4;
const LAID: usize = 3;
/// Where the face's area in strips is more than so many times what passes may be long, they are not laid: it counts what the cutter
/// cannot reach as well, and by the way of the contact.
const MARGIN: f64 = 1.05;
/// Passes that leave something and still come out more than so many times as long as their lines are broken into pieces (on BladeX over
/// few strips 1.7 to 2.9 times): what bends more is not laid.
const BROKEN: f64 = 1.5;

/// The passes offset from the line of `seed` to both sides, the shorter ones of those that leave nothing; none where all come out
/// longer than `most` (mm), and where fronts run round the face and meet.
pub(in crate::strategy) fn passes<'a>(
    (face, tool): (&'a Face, &'a Tool),
    (from, level, column): &(Field, f64, Field),
    rule: &Rule,
    finish: Finish,
    order: Order,
    most: f64,
    stage: &Stage,
) -> Result<Option<Laid<'a>>, StrategyError> {
    if period(face, from).is_some() {
        return Ok(None);
    }
    let finish = finish.with_fine_chords();
    let fields = (from.clone(), column.clone());
    let first = Setup::new(face, tool, rule, finish, fields, order, &stage.part(super::TILT, 0.0, 0.08))?;
    let offset = Offset::new(&first, from, *level);
    let begun = Strips::of((&first, order), &stage.part(super::SOLVE, 0.08, 0.1))?;
    let mut best: Option<Laid<'a>> = None;
    // What passes were longer than their lines.
    let mut longer = 1.0;
    'over: for (k, over) in OVER.into_iter().enumerate() {
        let (mut setup, mut strips) = (first.clone(), begun.clone());
        for round in 0..ROUNDS {
            let part = |name, a: f64, b: f64| {
                let at =
                    |t: f64| 0.1 + 0.9 * ((k * ROUNDS + round) as f64 + t) / (OVER.len() * ROUNDS) as f64;
                stage.part(name, at(a), at(b))
            };
            if round > 0 {
                strips = Strips::of((&setup, order), &part(super::SOLVE, 0.0, 0.1))?;
            }
            let Some((spaced, length)) = strips.spacing(&offset, over, &part(super::SOLVE, 0.1, 0.15))?
            else {
                continue 'over;
            };
            let most = best.as_ref().map_or(most, |best| best.most().min(most));
            if length > MARGIN * most {
                continue 'over;
            }
            setup.field = Field::Given(Arc::new(spaced));
            if round > 0 {
                setup.courses = strips.courses(&setup, &offset, &part(super::SOLVE, 0.15, 0.2))?;
            }
            setup.choose(rule, order, &part(super::TILT, 0.2, 0.4))?;
            if round + 1 < LAID {
                continue;
            }
            let most = most / f64::max(longer / MARGIN, 1.0);
            let laying = part("Following the surface", 0.4, 1.0);
            let (laid, lines) = match lay((&setup, rule, order), &offset, most, &laying) {
                Ok(Some(laid)) => laid,
                Ok(None) => continue,
                Err(StrategyError::Cancelled(cancelled)) => return Err(cancelled.into()),
                // There are passes already.
                Err(_) if best.is_some() => continue,
                Err(why) => return Err(why),
            };
            let is_broken = !laid.is_whole && laid.planned.length() > BROKEN * lines;
            if best.as_ref().is_none_or(|best| laid.is_better(best)) {
                longer = if laid.is_whole { laid.planned.length() / lines } else { 1.0 };
                best = Some(laid);
            }
            if is_broken {
                break 'over;
            }
        }
    }
    Ok(best)
}

/// The passes of `setup`, and how long their lines are, mm; `None` where those are longer than `most`.
fn lay<'a>(
    (setup, rule, order): (&Setup<'a>, &Rule, Order),
    offset: &Offset,
    most: f64,
    stage: &Stage,
) -> Result<Option<(Laid<'a>, f64)>, StrategyError> {
    let family = Family::on_grid(setup.clone(), order, offset.grid.clone());
    let placed = family.place(&stage.part(super::PLACE, 0.0, 0.33))?;
    let tracks = fill::tracks(&family, placed, &stage.part(super::FILL, 0.33, 0.5))?;
    let lines = family.length(&tracks);
    if lines > most {
        return Ok(None);
    }
    let crests = crest::places(&family, offset);
    let following = stage.part("Following the surface", 0.5, 1.0);
    Ok(Some((Laid::of(*rule, Part::whole(family, tracks), crests, &following)?, lines)))
}
