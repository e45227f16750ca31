//! The time estimate, against closed forms and against a machine that is simulated step by step.

use crate::examples::example;
use glam::DVec3;
use std::collections::VecDeque;
use stepover::machine::{
    Axis, AxisMove, AxisPath, Control, Following, Kinematics, Tolerance, drive, durations, estimate,
    smoothing,
};
use stepover::toolpath::{ClPoint, Move, Rate, Role, Toolpath};

fn moves(tips: &[([f64; 3], Rate, Role)]) -> Toolpath {
    let step = |&(tip, rate, role): &([f64; 3], Rate, Role)| Move {
        to: ClPoint { tip: tip.into(), axis: DVec3::Z },
        rate,
        role,
    };
    Toolpath { moves: tips.iter().map(step).collect() }
}

fn driven(name: &str, path: &Toolpath) -> (Kinematics, AxisPath) {
    let kinematics = Kinematics::new(&example(name), 80.0).unwrap();
    // Coarse enough that blocks are long beside the rounding of angles, which the simulation below does not smooth.
    let how = within(1e-3, 0.005);
    let axes = drive(&kinematics, path, &[], &how).unwrap();
    (kinematics, axes)
}

fn within(chord: f64, axis: f64) -> Following {
    let feed = Tolerance { chord, axis: axis.to_radians() };
    Following { feed, ..Following::new(Control::Axes) }
}

#[test]
fn one_straight_move_takes_its_trapezoid_and_the_moving_average() {
    // The router: 500 mm/s² and 5000 mm/s³ along X. 50 mm/s over 100 mm take 2 s, and 0.1 s to come to speed and to rest.
    let cut = (Rate::Feed(3000.0), Role::Cut);
    let path = moves(&[([0.0, 0.0, 50.0], Rate::Rapid, Role::Link), ([100.0, 0.0, 50.0], cut.0, cut.1)]);
    let (kinematics, axes) = driven("three_axis", &path);
    let times = estimate(kinematics.axes(), &axes);
    assert!((times.cut - 2.1).abs() < 1e-12 && (times.settling - 0.1).abs() < 1e-12, "{times:?}");
    assert_eq!((times.link, times.rapid), (0.0, 0.0));
    // Too short to come to speed: 1 mm is gone through in 2 √(1/500) s.
    let path = moves(&[([0.0, 0.0, 50.0], Rate::Rapid, Role::Link), ([1.0, 0.0, 50.0], cut.0, cut.1)]);
    let (kinematics, axes) = driven("three_axis", &path);
    let times = estimate(kinematics.axes(), &axes);
    assert!((times.cut - 2.0 * (1.0f64 / 500.0).sqrt()).abs() < 1e-12, "{times:?}");
}

/// What a control does, a cycle at a time: in every cycle the greatest share of the programmed speed with which it can still slow down
/// for every corner ahead; then the axes' speeds through a moving average. Returns seconds and the greatest acceleration of each axis as a
/// share of its limit.
fn simulate(axes: &[Axis], path: &AxisPath, cycle: f64) -> (f64, [f64; 5]) {
    let tau = smoothing(axes, path);
    let blocks: Vec<_> = path.moves.windows(2).filter(|w| w[1].seconds > 0.0).collect();
    let speed =
        |b: usize, k: usize| (blocks[b][1].at.all()[k] - blocks[b][0].at.all()[k]) / blocks[b][1].seconds;
    let ramp = |b: usize| {
        axes.iter()
            .enumerate()
            .map(|(k, axis)| axis.acceleration / speed(b, k).abs())
            .fold(f64::INFINITY, f64::min)
    };
    // Ends of blocks at full speed, and the block that is gone through at a time.
    let ends: Vec<f64> = blocks
        .iter()
        .scan(0.0, |sum, w| {
            *sum += w[1].seconds;
            Some(*sum)
        })
        .collect();
    let at = |time: f64| ends.partition_point(|end| *end <= time).min(blocks.len() - 1);
    // By trying: what the axes' speeds change by over the moving average must stay within their accelerations.
    let corner = |b: usize| {
        if b + 1 == blocks.len() {
            return 0.0;
        }
        let holds = |share: f64| {
            (0..=100).all(|u| {
                let aside = 0.005 * f64::from(u) * share * tau;
                let (before, after) = (at((ends[b] - aside - 1e-9).max(0.0)), at(ends[b] + aside + 1e-9));
                (0..axes.len()).all(|k| {
                    share * (speed(after, k) - speed(before, k)).abs() <= axes[k].acceleration * tau * 1.001
                })
            })
        };
        (1..=400).rev().map(|k| f64::from(k) / 400.0).find(|share| holds(*share)).unwrap_or(0.0)
    };
    let corners: Vec<f64> = (0..blocks.len()).map(corner).collect();
    let corner = |b: usize| corners[b];
    // The fastest share now for which braking as hard as each block allows meets every corner ahead.
    let allowed = |block: usize, done: f64| {
        let (mut most2, mut way, mut left) = (1.0f64, 0.0, blocks[block][1].seconds - done);
        for b in block..blocks.len() {
            way += 2.0 * ramp(b) * left;
            most2 = most2.min(corner(b) * corner(b) + way);
            if way > 1.0 || b + 1 == blocks.len() {
                break;
            }
            left = blocks[b + 1][1].seconds;
        }
        most2.max(0.0).sqrt()
    };
    let (mut block, mut done, mut share, mut cycles) = (0, 0.0, 0.0f64, 0usize);
    let length = (tau / cycle).round().max(1.0) as usize;
    let mut window: VecDeque<[f64; 5]> = VecDeque::from(vec![[0.0; 5]; length]);
    let (mut mean, mut hardest) = ([0.0; 5], [0.0f64; 5]);
    let mut quiet = 0;
    while quiet < length {
        let mut speeds = [0.0; 5];
        if block < blocks.len() {
            let next = (share + ramp(block) * cycle).min(allowed(block, done)).max(1e-6);
            // What the cycle goes through, from block to block.
            let mut way = 0.5 * (share + next) * cycle;
            share = next;
            while block < blocks.len() && way > 0.0 {
                let rest = blocks[block][1].seconds - done;
                let part = way.min(rest);
                (0..5).for_each(|k| speeds[k] += speed(block, k) * part / cycle);
                (way, done) = (way - part, done + part);
                if part == rest {
                    share = share.min(corner(block).max(1e-6));
                    (block, done) = (block + 1, 0.0);
                }
            }
        } else {
            quiet += 1;
        }
        let old = window.pop_front().unwrap();
        window.push_back(speeds);
        for (k, axis) in axes.iter().enumerate() {
            let change = (speeds[k] - old[k]) / length as f64;
            mean[k] += change;
            hardest[k] = hardest[k].max((change / cycle).abs() / axis.acceleration);
        }
        cycles += 1;
    }
    (cycles as f64 * cycle, hardest)
}

/// Passes to and fro over waves, with links, and corners in the passes.
fn waves(lean: f64) -> Toolpath {
    let mut path = Toolpath::default();
    for pass in 0..4 {
        let y = 4.0 * f64::from(pass);
        let at = |x: f64| {
            let kink = if x > 20.0 { x - 20.0 } else { 0.0 };
            let axis = DVec3::new(lean * libm::sin(0.2 * x), 0.1 + 0.3 * lean * libm::cos(0.1 * x + y), 1.0)
                .normalize();
            ClPoint { tip: DVec3::new(x - 20.0, y + 0.7 * kink, 20.0 + 2.0 * libm::sin(0.3 * x)), axis }
        };
        let up = |cl: ClPoint| ClPoint { tip: cl.tip + 30.0 * cl.axis, ..cl };
        let mut push = |to, rate, role| path.moves.push(Move { to, rate, role });
        push(up(at(0.0)), Rate::Rapid, Role::Link);
        push(at(0.0), Rate::Feed(500.0), Role::Link);
        (1..=100).for_each(|k| push(at(0.4 * f64::from(k)), Rate::Feed(4000.0), Role::Cut));
        push(up(at(40.0)), Rate::Rapid, Role::Link);
    }
    path
}

#[test]
fn estimate_is_that_of_a_simulation_step_by_step() {
    for (name, lean) in [
        ("three_axis", None),
        ("table_table_ac", Some(0.3)),
        ("table_table_bc", Some(0.3)),
        ("head_table_bc", Some(0.2)),
        ("head_head_ab", Some(0.3)),
        ("head_head_ac", Some(0.3)),
    ] {
        let mut path = waves(lean.unwrap_or(0.0));
        if lean.is_none() {
            path.moves.iter_mut().for_each(|m| m.to.axis = DVec3::Z);
        }
        let (kinematics, axes) = driven(name, &path);
        let times = estimate(kinematics.axes(), &axes);
        let (simulated, hardest) = simulate(kinematics.axes(), &axes, 2e-4);
        let off = times.total() / simulated - 1.0;
        assert!(off.abs() < 0.02, "{name}: {times:?} but simulated {simulated} s");
        // Speeding up and turning at once may add up, and no more.
        assert!(hardest.iter().all(|share| *share < 2.01), "{name}: {hardest:?}");
    }
}

#[test]
fn the_time_is_that_of_the_motion_in_however_many_blocks_it_is_stated() {
    for (name, lean) in [("three_axis", 0.0), ("table_table_ac", 0.3), ("head_head_ac", 0.3)] {
        let mut path = waves(lean);
        if lean == 0.0 {
            path.moves.iter_mut().for_each(|m| m.to.axis = DVec3::Z);
        }
        let (kinematics, axes) = driven(name, &path);
        let total = |axes: &AxisPath| estimate(kinematics.axes(), axes).total();
        let (once, taken) = (total(&axes), durations(kinematics.axes(), &axes));
        // Every block as two on the same line.
        let mut halves = axes.clone();
        halves.moves = vec![axes.moves[0]];
        for pair in axes.moves.windows(2) {
            let mut half = pair[1];
            half.seconds *= 0.5;
            let first = AxisMove { at: pair[0].at.lerp(&pair[1].at, 0.5), is_end: false, ..half };
            halves.moves.extend([first, half]);
        }
        assert!((total(&halves) / once - 1.0).abs() < 5e-3, "{name}: {} and {once}", total(&halves));
        let of_halves = durations(kinematics.axes(), &halves);
        for (k, whole) in taken.iter().enumerate().skip(1) {
            let parts = of_halves[2 * k - 1] + of_halves[2 * k];
            assert!((parts - whole).abs() < 5e-3 * whole + 2e-3, "{name}, {k}: {parts} and {whole}");
        }
        // Twenty times as fine, with angles rounded as ever.
        let fine = drive(&kinematics, &path, &[], &within(5e-5, 0.002)).unwrap();
        let off = total(&fine) / once - 1.0;
        assert!(fine.moves.len() >= axes.moves.len() && off.abs() < 0.02, "{name}: {off}");
    }
}
