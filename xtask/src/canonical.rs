//! What LinuxCNC's interpreter makes of a program, against the program's own words.

use anyhow::{Context, Result, bail, ensure};

/// A straight move: where X, Y, Z, A, B and C end, and the inverse time in minutes if it is fed.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Move {
    to: [f64; 6],
    per_minute: Option<f64>,
}

const LETTERS: [char; 6] = ['X', 'Y', 'Z', 'A', 'B', 'C'];

/// Checks that the interpreter ended, and that its moves go where the words of the program's path say, in the time that they say.
/// Gives the number of moves.
///
/// The interpreter prints a block's feed as its way in mm a minute, X, Y and Z only, or in degrees where these stay: over the way that is
/// the inverse time stated.
pub fn compare(program: &str, printed: &str) -> Result<usize> {
    ensure!(printed.contains("PROGRAM_END()"), "broken off");
    let (stated, read) = (stated(program)?, read(printed)?);
    // Those in machine coordinates, and those that place the axes one by one, stand before and after.
    let first = stated.first().context("no moves in the program")?;
    let begin =
        read.iter().position(|step| near(step, first)).context("its first position is not reached")?;
    let read = &read[begin..];
    ensure!(read.len() > stated.len(), "{} moves of {}", read.len(), stated.len());
    for (k, (a, b)) in stated.iter().zip(read).enumerate() {
        ensure!(near(a, b), "move {k}: {b:?} is not {a:?}");
        if k == 0 {
            continue;
        }
        match (a.per_minute, b.per_minute) {
            (None, None) => {}
            (Some(asked), Some(feed)) => {
                let way = way(&read[k - 1].to, &b.to);
                // Feeds are printed to four decimals, and ways follow from positions of four.
                let off = (feed - asked * way).abs();
                ensure!(off < 2e-4 + asked * 2e-4, "move {k}: feed {feed}, but {asked} × {way}");
            }
            _ => bail!("move {k}: {b:?} is not {a:?}"),
        }
    }
    Ok(stated.len())
}

fn near(a: &Move, b: &Move) -> bool {
    a.to.iter().zip(&b.to).all(|(a, b)| (a - b).abs() < 1e-6)
}

fn way(from: &[f64; 6], to: &[f64; 6]) -> f64 {
    let part = |k: std::ops::Range<usize>| k.map(|k| (to[k] - from[k]).powi(2)).sum::<f64>().sqrt();
    let linear = part(0..3);
    if linear > 0.0 { linear } else { part(3..6) }
}

/// The moves of a program from where its tool's length is switched on to where it is switched off.
fn stated(program: &str) -> Result<Vec<Move>> {
    let (mut moves, mut at, mut fed, mut on) = (Vec::new(), [0.0; 6], false, false);
    for line in program.lines().map(|line| line.split('(').next().unwrap_or_default()) {
        if line.starts_with("G43.1") {
            on = true;
            continue;
        }
        on &= line != "G49";
        if line.contains("G53") {
            continue;
        }
        let (mut moved, mut per_minute) = (false, None);
        for word in line.split_whitespace() {
            let (letter, number) = word.split_at(1);
            let number: f64 = match number.parse() {
                Ok(number) => number,
                Err(_) => continue,
            };
            if let Some(k) = LETTERS.iter().position(|l| letter.starts_with(*l)) {
                (at[k], moved) = (number, true);
            }
            match (letter, number) {
                ("G", 0.0) => fed = false,
                ("G", 1.0) => fed = true,
                ("F", f) => per_minute = Some(f),
                _ => {}
            }
        }
        if moved && on {
            moves.push(Move { to: at, per_minute: if fed { per_minute } else { None } });
        }
    }
    Ok(moves)
}

/// The moves that the interpreter printed, each with the feed that held.
fn read(printed: &str) -> Result<Vec<Move>> {
    let (mut moves, mut feed) = (Vec::new(), None);
    for line in printed.lines() {
        if let Some(inside) = inside(line, "SET_FEED_RATE(") {
            feed = Some(inside.parse::<f64>().with_context(|| line.to_owned())?);
        }
        let fed = inside(line, "STRAIGHT_FEED(");
        let Some(numbers) = fed.or_else(|| inside(line, "STRAIGHT_TRAVERSE(")) else { continue };
        let numbers: Vec<f64> = numbers
            .split(',')
            .map(|number| number.trim().parse())
            .collect::<Result<_, _>>()
            .with_context(|| line.to_owned())?;
        let to: [f64; 6] = numbers.try_into().ok().with_context(|| format!("{line}: six numbers"))?;
        moves.push(Move { to, per_minute: fed.and(feed) });
    }
    Ok(moves)
}

fn inside<'a>(line: &'a str, call: &str) -> Option<&'a str> {
    line.split_once(call)?.1.strip_suffix(')')
}
