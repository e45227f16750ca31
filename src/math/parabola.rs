//! Parabolas through three places.

/// Where the parabola through three places, given with their values in order, is lowest; `None` where that is not between the outer ones,
/// or there is none.
pub fn vertex([(xa, ya), (xb, yb), (xc, yc)]: [(f64, f64); 3]) -> Option<f64> {
    let (before, after) = ((yb - ya) / (xb - xa), (yc - yb) / (xc - xb));
    let bend = (after - before) / (xc - xa);
    let x = 0.5 * (xa + xb - before / bend);
    (bend > 0.0 && bend.is_finite() && xa < x && x < xc).then_some(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_place_of_a_parabola_is_found_where_it_has_one_between() {
        let at = |y: fn(f64) -> f64| vertex([-1.0, 0.5, 3.0].map(|x| (x, y(x))));
        assert!((at(|x| 2.0 * (x - 1.25) * (x - 1.25) - 7.0).unwrap() - 1.25).abs() < 1e-12);
        assert_eq!(at(|x| (x - 4.0) * (x - 4.0)), None);
        assert_eq!(at(|x| -x * x), None);
        assert_eq!(at(|x| 2.0 * x), None);
        assert_eq!(at(|x| if x > 2.0 { f64::INFINITY } else { -x }), None);
    }
}
