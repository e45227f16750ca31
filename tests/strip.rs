//! Strip widths against a brute-force moving cutter.
//!
//! `data/strip/strip_width.csv` was made by sweeping a densely sampled torus over the model surface; its columns
//! name their units.

use stepover::contact::{model_strip, second_order_strip_width};
use stepover::cutter::Cutter;
use stepover::geometry::Curvature;
use stepover::toolpath::Posture;

#[test]
fn widths_of_the_moving_cutter_come_back() {
    let mut rows = 0;
    for line in include_str!("data/strip/strip_width.csv").lines().skip(1) {
        let c: Vec<f64> = line.split(',').map(|x| x.parse().unwrap()).collect();
        let cutter = Cutter::bull_nose(2.0 * (c[0] + c[1]), c[1], 100.0).unwrap();
        let posture = Posture { lead: c[3].to_radians(), yaw: c[4].to_radians() };
        let surface = Curvature { ff: c[5], fb: c[6], bb: c[7] };
        let (left, right) = model_strip(&cutter, posture, &surface, c[2]).half_widths().unwrap();
        assert!((left / c[8] - 1.0).abs() < 1e-3, "left {left} of {line}");
        assert!((right / c[9] - 1.0).abs() < 1e-3, "right {right} of {line}");
        let schur = second_order_strip_width(&cutter, posture, &surface, c[2]);
        assert!((schur / c[10] - 1.0).abs() < 1e-6, "second order {schur} of {line}");
        rows += 1;
    }
    assert_eq!(rows, 16);
}
