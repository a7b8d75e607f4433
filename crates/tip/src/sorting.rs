//! Sorting by a number, and the least and the largest of numbers. The sort itself is compiled once, for all kinds of
//! items: a copy of it for each takes as long to compile as the code that uses it.

use crate::elementary::{larger, smaller};

/// Sorts numbers, the least first, as [`f64::total_cmp`] orders them.
pub fn sort_numbers(numbers: &mut [f64]) {
    numbers.sort_by(f64::total_cmp);
}

/// The least and the largest of these numbers; ∞ and -∞ if there are none.
pub fn ends(numbers: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let wider = |(low, high), number| (smaller(number, low), larger(number, high));
    numbers.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), wider)
}

/// The least and the largest of these numbers, as [`ends`], which compares each with all before.
#[inline]
pub(crate) fn ends_of(numbers: &[f64]) -> (f64, f64) {
    let (mut low, mut high) = ([f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES]);
    let (groups, rest) = numbers.as_chunks::<LANES>();
    for group in groups {
        for i in 0..LANES {
            low[i] = smaller(group[i], low[i]);
            high[i] = larger(group[i], high[i]);
        }
    }
    for (i, number) in rest.iter().enumerate() {
        low[i] = smaller(*number, low[i]);
        high[i] = larger(*number, high[i]);
    }
    let low = smaller(smaller(low[0], low[1]), smaller(low[2], low[3]));
    (low, larger(larger(high[0], high[1]), larger(high[2], high[3])))
}

const LANES: usize = 4;

/// Sorts items by a number, the least first. Items with the same number keep their order.
pub fn sort_by_number<T>(items: &mut [T], number: impl FnMut(&T) -> f64) {
    let numbers: Vec<f64> = items.iter().map(number).collect();
    let mut places = places(&numbers);
    for i in 0..items.len() {
        while places[i] != i {
            let place = places[i];
            items.swap(i, place);
            places.swap(i, place);
        }
    }
}

/// The indices of these numbers in ascending order of the numbers; equal numbers keep their order.
pub fn ascending(numbers: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..numbers.len()).collect();
    order.sort_by(|a, b| numbers[*a].total_cmp(&numbers[*b]));
    order
}

/// The rank of each number in ascending order, from 0.
fn places(numbers: &[f64]) -> Vec<usize> {
    let mut places = vec![0; numbers.len()];
    for (place, i) in ascending(numbers).into_iter().enumerate() {
        places[i] = place;
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_are_in_order_and_equal_ones_stay_in_theirs() {
        // Every 37th number of a hundred, with ten different values.
        let mut items: Vec<(usize, f64)> =
            (0..100).map(|i| (i, (i * 37 % 100 / 10) as f64 - 5.0)).collect();
        let mut expected = items.clone();
        expected.sort_by(|a, b| a.1.total_cmp(&b.1));
        sort_by_number(&mut items, |item| item.1);
        assert_eq!(items, expected);
        sort_by_number(&mut items, |item| -(item.0 as f64));
        assert!(items.iter().rev().map(|item| item.0).eq(0..100));
    }
}
