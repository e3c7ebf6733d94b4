//! `T(t)/t` as a function of `u = t²`, for the millions of evaluations in a table of coefficients.
//!
//! The panel and the position in it are read from the bits of u: the exponent and the first [`BITS`] bits of the
//! fraction number the panel, and the rest is the position. So a value costs no logarithm, root or division, only a
//! polynomial of degree 8.

use serde::{Deserialize, Serialize};

use crate::numerics::chebyshev::{ChebyshevTransform, nodes};

/// Panels per octave of u, as a power of two: 16, each 3 % wide in t.
const BITS: u32 = 4;

/// Bits of an f64's fraction that remain for the position in a panel.
const PLACE_BITS: u32 = 52 - BITS;

/// Terms of a panel's polynomial.
const TERMS: usize = 9;

/// Piecewise polynomials of `T(√u)/√u`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct FarField {
    /// Number of the first panel.
    first: usize,
    /// Coefficients of the powers of the position −1 … 1 in each panel.
    panels: Vec<[f64; TERMS]>,
    error: f64,
}

impl FarField {
    /// Tabulates `function(t) = T(t)` for t in the whole panels between two ends; errors are relative to
    /// `scale(largest value in the panel, t)`, which is called in ascending order of t.
    pub(crate) fn new(
        [start, end]: [f64; 2],
        function: impl Fn(f64) -> f64,
        mut scale: impl FnMut(f64, f64) -> f64,
    ) -> Self {
        let first = number(start * start) + 1;
        let last = number(end * end);
        let transform = ChebyshevTransform::new(TERMS, TERMS);
        let mut error = 0.0_f64;
        let panels = (first..last).map(|panel| {
            let u = |place: f64| point(panel, place);
            let wanted = |place: f64| function(u(place).sqrt()) / u(place).sqrt();
            let values: Vec<f64> = nodes(TERMS).map(wanted).collect();
            let powers = powers(&transform.coefficients(&values));
            let largest = values.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
            // The first omitted term, T_9, is largest at the ends.
            for end in [-1.0, 1.0] {
                let t = u(end).sqrt();
                let missed = t * (polynomial(&powers, end) - wanted(end)).abs();
                error = error.max(missed / scale(t * largest, t));
            }
            powers
        });
        let panels = panels.collect();
        Self {
            first,
            panels,
            error,
        }
    }

    /// `T(√u)/√u`; `None` outside the table.
    #[inline]
    pub(crate) fn value(&self, u: f64) -> Option<f64> {
        let powers = self.panels.get(number(u).wrapping_sub(self.first))?;
        Some(polynomial(powers, place(u)))
    }

    /// The largest error found at an end of a panel, relative to the scale.
    pub(crate) fn error(&self) -> f64 {
        self.error
    }
}

/// Number of the panel that holds u > 0: the sign, the exponent and the first bits of the fraction.
#[inline]
fn number(u: f64) -> usize {
    (u.to_bits() >> PLACE_BITS) as usize
}

/// The position of u in its panel, −1 … 1.
#[inline]
fn place(u: f64) -> f64 {
    const MASK: u64 = (1 << PLACE_BITS) - 1;
    let fraction = f64::from_bits((u.to_bits() & MASK) | 1_f64.to_bits()) - 1.0;
    fraction * f64::from(2_u32 << BITS) - 1.0
}

/// The u at a position in a panel.
fn point(panel: usize, place: f64) -> f64 {
    let edge = |panel: usize| f64::from_bits((panel as u64) << PLACE_BITS);
    let (start, end) = (edge(panel), edge(panel + 1));
    start + (end - start) * (1.0 + place) / 2.0
}

/// The polynomial with these coefficients at a position.
#[inline]
fn polynomial(powers: &[f64; TERMS], place: f64) -> f64 {
    let [lower @ .., highest] = powers;
    lower.iter().rev().fold(*highest, |sum, c| sum * place + c)
}

/// Converts Chebyshev coefficients to powers.
fn powers(coefficients: &[f64]) -> [f64; TERMS] {
    let mut result = [0.0; TERMS];
    let (mut before, mut current) = ([0.0; TERMS], [0.0; TERMS]);
    current[0] = 1.0;
    for (j, c) in coefficients.iter().enumerate() {
        for (entry, power) in result.iter_mut().zip(&current) {
            *entry += c * power;
        }
        // T_1 = x, T_(j+1) = 2x T_j − T_(j−1)
        let factor = if j == 0 { 1.0 } else { 2.0 };
        let mut next = before.map(|power: f64| -power);
        for power in 1..TERMS {
            next[power] += factor * current[power - 1];
        }
        (before, current) = (current, next);
    }
    result
}

#[cfg(test)]
mod tests {
    use super::{FarField, place, point};

    #[test]
    fn place_and_point_are_inverse() {
        let panel = super::number(5.3);
        for expected in [-1.0, -0.25, 0.5] {
            assert!((place(point(panel, expected)) - expected).abs() < 1e-14);
        }
    }

    #[test]
    fn a_decaying_function_is_approximated_to_rounding() {
        let function = |t: f64| (-2.0 * t).exp() + 1e-3;
        let field = FarField::new([1e-3, 100.0], function, |largest, _| largest);
        for i in 0..1000 {
            let t = 0.002 * 1.01_f64.powi(i);
            let Some(found) = field.value(t * t) else {
                assert!(t > 99.0);
                continue;
            };
            let error = found * t / function(t) - 1.0;
            assert!(error.abs() < 1e-14, "{t}: {error:e}");
        }
        assert!(field.error() < 1e-14);
    }
}
