//! Starting points of searches.
//!
//! The first is given by the problem. The others are points of Halton's sequence, which fills the ranges evenly and
//! deterministically: J. H. Halton, Numer. Math. 2, 84 (1960).

use crate::Unknown;

/// Bases of the sequence, one per unknown; they repeat after the tenth.
const PRIMES: [usize; 10] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29];
/// Starts are taken from this middle fraction of each range. Nearer the bounds a search only takes longer.
const MIDDLE: f64 = 0.6;

/// The coordinates of start `index`.
pub(crate) fn start(unknowns: &[Unknown], index: usize) -> Vec<f64> {
    unknowns
        .iter()
        .zip(PRIMES.iter().cycle())
        .map(|(unknown, &base)| {
            if index == 0 {
                return unknown.position(unknown.start());
            }
            let [low, high] = unknown.bounds();
            let part = 0.5 + MIDDLE * (radical_inverse(index, base) - 0.5);
            low + part * (high - low)
        })
        .collect()
}

/// The digits of a number mirrored at the radix point.
fn radical_inverse(mut number: usize, base: usize) -> f64 {
    let (mut value, mut place) = (0.0, 1.0);
    while number > 0 {
        place /= base as f64;
        value += place * (number % base) as f64;
        number /= base;
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sequence_in_base_two_is_that_of_van_der_corput() {
        let first: Vec<f64> = (1..=5).map(|i| radical_inverse(i, 2)).collect();
        assert_eq!(first, [0.5, 0.25, 0.75, 0.125, 0.625]);
    }

    #[test]
    fn starts_lie_inside_the_ranges() {
        let unknowns = [
            Unknown::positive("a", [1.0, 100.0])
                .unwrap()
                .starting_at(3.0)
                .unwrap(),
            Unknown::signed("b", [-2.0, 5.0]).unwrap(),
        ];
        assert_eq!(start(&unknowns, 0)[0], 3.0_f64.ln());
        for index in 1..20 {
            for (x, unknown) in start(&unknowns, index).iter().zip(&unknowns) {
                let [low, high] = unknown.bounds();
                assert!(low < *x && *x < high);
            }
        }
    }
}
