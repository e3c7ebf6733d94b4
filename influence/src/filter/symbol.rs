//! The analytic symbol of `K` on a periodic grid, for preconditioners.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::aliases::{Aliases, GriddedBodies, NodeWeights, weights};
use crate::bodies::ElasticBodies;
use crate::operator::ComplianceTable;

/// `∫∫ dA/k` over a square of side 1 centred at k = 0: 4 ln(1+√2). It is the mean of `1/k` over the cell of the zero
/// frequency, in units of `1/k` at the next frequency.
const MEAN_OF_RECIPROCAL: f64 = 3.525_494_348_078_172;

/// `Σ C(k) sinc(k_x a) sinc(k_y a)`, m/Pa, at the frequencies of an unpadded, periodic grid of elements of side 2a.
///
/// It is the displacement of the element centres under pressures, uniform on each element, that alternate with one
/// wavenumber. The sum runs over that wavenumber and its aliases, which are `π/a` apart and indistinguishable from it
/// at the centres. Without the aliases the response to the shortest waves would be a third of the true one. Use it only
/// for preconditioning: it describes a periodic domain, and the true one is not periodic.
///
/// One quarter is stored, frequencies 0 … N/2 in both directions; the others mirror these. A frequency along y, the
/// direction of a row of a field, comes first, then that along x. At zero frequency, where C
/// is infinite on a half-space, the value is the mean of `1/k` over that frequency's cell, 4 ln(1+√2) times the value
/// at the smallest wavenumber: finite, positive, and correct for a pressure that fills the domain once.
#[derive(Clone, Debug, PartialEq)]
pub struct PeriodicSymbol {
    lengths: [usize; 2],
    quarter: Vec<f64>,
}

impl PeriodicSymbol {
    /// The symbol for `size` × `size` elements of side `element_side`, m.
    #[must_use]
    pub fn new(bodies: &ElasticBodies, element_side: f64, size: usize) -> Self {
        Self::of(&|k| bodies.compliance(k), element_side, [size; 2])
    }

    /// The same for a periodic cell of `lengths` elements along x and y, whose operator tabulates the compliance too:
    /// to 1e-13, and quicker for many layers.
    pub(crate) fn of_cell(bodies: &ElasticBodies, element_side: f64, lengths: [usize; 2]) -> Self {
        let size = lengths[0].max(lengths[1]);
        let compliance = ComplianceTable::of_cell(bodies, element_side, size);
        Self::of(&|k| compliance.at(k), element_side, lengths)
    }

    /// The symbol of a compliance.
    fn of(
        compliance: &(dyn Fn(f64) -> f64 + Sync),
        element_side: f64,
        lengths: [usize; 2],
    ) -> Self {
        let body = GriddedBodies {
            compliance,
            half_side: element_side / 2.0,
        };
        let aliases = Aliases::new(&body);
        // k = 2π i/(N h)
        let step = |length: usize| 2.0 * PI / (length as f64 * element_side);
        let along = |length: usize| -> (Vec<f64>, Vec<f64>, Vec<NodeWeights>) {
            let waves: Vec<f64> = (0..=length / 2).map(|i| step(length) * i as f64).collect();
            let sincs = waves.iter().map(|k| body.sinc(*k)).collect();
            let weight = |i: usize| weights(i as f64 * 2.0 / length as f64);
            (waves, sincs, (0..=length / 2).map(weight).collect())
        };
        let [(x, x_sincs, x_weights), (y, y_sincs, y_weights)] = lengths.map(along);
        let mut quarter = vec![0.0; x.len() * y.len()];
        let rows = quarter.par_chunks_exact_mut(x.len()).enumerate();
        rows.for_each(|(j, row)| {
            let aliases = aliases.along(&y_weights[j]);
            for (i, (entry, weights)) in row.iter_mut().zip(&x_weights).enumerate() {
                if i + j > 0 {
                    let own = body.response_of([y[j], x[i]], [y_sincs[j], x_sincs[i]]);
                    *entry = own + aliases.at(weights).max(0.0);
                }
            }
        });
        quarter[0] = MEAN_OF_RECIPROCAL * compliance(step(lengths[0].max(lengths[1])));
        Self { lengths, quarter }
    }

    /// Numbers of elements along x and y.
    #[must_use]
    pub fn lengths(&self) -> [usize; 2] {
        self.lengths
    }

    /// The symbol at frequencies along y and along x, each 0 … N−1 (beyond N/2: negative frequencies), m/Pa.
    ///
    /// # Panics
    ///
    /// If a frequency is not below N.
    #[must_use]
    pub fn value(&self, [j, i]: [usize; 2]) -> f64 {
        let [rows, columns] = self.lengths;
        let [j, i] = [j.min(columns - j), i.min(rows - i)];
        self.quarter[j * (rows / 2 + 1) + i]
    }

    /// The value (m/Pa) at a frequency along the longer side, or along x in a square.
    ///
    /// # Panics
    ///
    /// As [`Self::value`].
    #[must_use]
    pub fn along_longer(&self, frequency: usize) -> f64 {
        let [rows, columns] = self.lengths;
        let is_x = rows >= columns;
        self.value(if is_x { [0, frequency] } else { [frequency, 0] })
    }

    /// The value (m/Pa) at the shortest wave of all.
    #[must_use]
    pub fn shortest(&self) -> f64 {
        let [rows, columns] = self.lengths;
        self.value([columns / 2, rows / 2])
    }

    /// The stored quarter: for each frequency j along y all i along x, at index `j (N_x/2 + 1) + i`.
    #[must_use]
    pub fn quarter(&self) -> &[f64] {
        &self.quarter
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use pellicle_kernel::{Foundation, Material};

    use super::PeriodicSymbol;
    use crate::element::love;

    fn symbol(size: usize) -> PeriodicSymbol {
        let steel = Material::new(1.0, 0.0).unwrap();
        PeriodicSymbol::new(&Foundation::half_space(steel).into(), 0.5, size)
    }

    #[test]
    fn frequencies_above_nyquist_mirror_those_below() {
        for size in [6, 7] {
            let symbol = symbol(size);
            for i in 1..size {
                for j in 1..size {
                    let (direct, mirrored) = (symbol.value([i, j]), symbol.value([size - i, j]));
                    assert!((direct - mirrored).abs() < f64::EPSILON);
                }
            }
        }
    }

    /// `Σ k cos cos` over the offsets up to 200 elements, tapered towards the end, where the terms alternate.
    fn sum_of_coefficients(wave: [f64; 2]) -> f64 {
        const REACH: i32 = 200;
        let steel = Material::new(1.0, 0.0).unwrap();
        let fade = |m: i32| (PI * f64::from(m) / f64::from(2 * REACH)).cos().powi(2);
        let mut sum = 0.0;
        for m in -REACH..=REACH {
            for n in -REACH..=REACH {
                let offset = [m, n].map(|along| along.unsigned_abs() as usize);
                let [x, y] = [m, n].map(f64::from);
                sum += love::coefficient(&steel, 0.5, offset)
                    * (wave[0] * x).cos()
                    * (wave[1] * y).cos()
                    * fade(m)
                    * fade(n);
            }
        }
        sum
    }

    #[test]
    fn the_symbol_is_the_fourier_sum_of_the_coefficients_down_to_the_shortest_wave() {
        for frequency in [[0, 2], [1, 3], [0, 4], [4, 4]] {
            let wave = frequency.map(|f: usize| f as f64 * PI / 4.0);
            let (expected, found) = (sum_of_coefficients(wave), symbol(8).value(frequency));
            // The error of the aliases beyond the fourth.
            assert!((found / expected - 1.0).abs() < 0.02, "{found} {expected}");
        }
    }

    #[test]
    fn the_zero_frequency_is_finite_and_the_largest() {
        let symbol = symbol(8);
        let others = symbol.quarter()[1..].iter().copied();
        assert!(symbol.value([0, 0]).is_finite());
        assert!(others.fold(0.0, f64::max) < symbol.value([0, 0]));
    }
}
