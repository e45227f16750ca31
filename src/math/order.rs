//! Sorting by a number, so that sorting is compiled once and not anew for every kind of item.
//!
//! The standard library's sorts are a dozen functions for each kind of item and comparison: an eighth of the page's
//! module, for lists that take no time beside what they are made from.

/// What items are sorted by: the first number, and among equals the second.
pub type Key = (u64, u32);

/// Up to so many items are sorted in place: for few, making room costs more than comparing.
const FEW: usize = 20;

/// The place of `x` among all numbers, in the order of [`f64::total_cmp`].
pub fn rank(x: f64) -> u64 {
    let bits = x.to_bits();
    // Below zero a larger pattern is a lower number.
    if bits >> 63 == 0 { bits | 1 << 63 } else { !bits }
}

/// Sorts `items` by their keys, rising; equal ones keep their order. Up to 2³² items.
pub fn sort_by_key<T>(items: &mut [T], key: impl Fn(&T) -> Key) {
    if items.len() <= FEW {
        for sorted in 1..items.len() {
            let mut at = sorted;
            while at > 0 && key(&items[at - 1]) > key(&items[at]) {
                items.swap(at - 1, at);
                at -= 1;
            }
        }
        return;
    }
    let pack = |(i, item): (usize, &T)| {
        let (first, second) = key(item);
        u128::from(first) << 64 | u128::from(second) << 32 | i as u128
    };
    let mut places: Vec<u128> = items.iter().enumerate().map(pack).collect();
    sort_packed(&mut places);
    // Round each cycle of places: what belongs to a place comes there, and what was there goes on to the next.
    for start in 0..items.len() {
        let mut at = start;
        loop {
            let from = places[at] as u32 as usize;
            places[at] = at as u128;
            if from == start {
                break;
            }
            items.swap(at, from);
            at = from;
        }
    }
}

/// Sorts numbers as [`f64::total_cmp`] does.
pub fn sort_numbers(numbers: &mut [f64]) {
    sort_by_key(numbers, |x| (rank(*x), 0));
}

#[inline(never)]
fn sort_packed(places: &mut [u128]) {
    places.sort_unstable();
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn sorts_as_the_standard_library_does(keys in proptest::collection::vec((0u64..9, 0u32..3), 0..90)) {
            let mut items: Vec<_> = keys.into_iter().enumerate().collect();
            let mut wanted = items.clone();
            wanted.sort_by_key(|(_, key)| *key);
            sort_by_key(&mut items, |(_, key)| *key);
            prop_assert_eq!(items, wanted);
        }

        #[test]
        fn ranks_are_in_the_order_of_numbers(a: f64, b: f64) {
            prop_assert_eq!(rank(a).cmp(&rank(b)), a.total_cmp(&b));
        }
    }

    #[test]
    fn zeros_infinities_and_what_is_no_number_have_their_ranks() {
        let mut numbers = [f64::NAN, 0.0, f64::INFINITY, -0.0, -f64::NAN, f64::NEG_INFINITY, -1.0];
        let mut wanted = numbers;
        wanted.sort_by(f64::total_cmp);
        sort_numbers(&mut numbers);
        assert_eq!(numbers.map(f64::to_bits), wanted.map(f64::to_bits));
    }
}
