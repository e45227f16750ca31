//! Choosing postures for 20,000 contact points, smoothed over the whole face.

use divan::Bencher;
use divan::counter::ItemsCount;
use stepover::contact::FaceObstacle;
use stepover::cutter::Cutter;
use stepover::geometry::{Face, Field, Jet, Uv};
use stepover::job;
use stepover::math::frame::Frame;
use stepover::monitor::Stage;
use stepover::posture::{Ground, Limits, Rule, choose};

/// On the gallery's wave, nodes a tenth of this diameter apart are 141 a side.
const DIAMETER: f64 = 2.6;
const NODES: usize = 141 * 141;

fn main() {
    divan::main();
}

#[divan::bench(sample_count = 5, sample_size = 1)]
fn matched(bencher: Bencher<'_, '_>) {
    measure(bencher, Rule::Matched(Limits::default()));
}

#[divan::bench(sample_count = 5, sample_size = 1)]
fn widest(bencher: Bencher<'_, '_>) {
    measure(bencher, Rule::Widest(Limits::default()));
}

fn measure(bencher: Bencher<'_, '_>, rule: Rule) {
    let Ok((job::Shape::Face(face), _)) = job::gallery()[0].spec.source.shape(None) else { return };
    let cutter = Cutter::bull_nose(DIAMETER, 0.25 * DIAMETER, 40.0).unwrap();
    let obstacle = FaceObstacle::for_cutter(&face, &cutter);
    let feed = |uv, reversed| frame(&face, uv, reversed);
    let ground = Ground {
        face: &face,
        obstacle: &obstacle,
        cutter: &cutter,
        holder: None,
        feed: &feed,
        scallop: 0.01,
        gouge: 0.0005,
        most_lift: [0.0; 2],
    };
    bencher.counter(ItemsCount::new(NODES)).bench(|| choose(&rule, &ground, false, &Stage::silent()));
}

fn frame(face: &Face, uv: Uv, reversed: bool) -> Option<(Jet, Frame)> {
    let (jet, n) = face.at(uv)?;
    let feed = Field::V.surface_gradient(uv, &jet).cross(n) * if reversed { -1.0 } else { 1.0 };
    Some((jet, Frame::from_normal(n, feed)?))
}
