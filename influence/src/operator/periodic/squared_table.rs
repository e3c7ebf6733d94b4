//! A smooth function of `√(x² + y²)`, which is evaluated a million times without a root, logarithm or division.
//!
//! The exponent and the leading bits of the square choose a cell, 1/32 of an octave wide. In it the function is a
//! polynomial of the remaining bits.

use crate::numerics::chebyshev::{ChebyshevTransform, nodes, sum};

/// Leading bits of the fraction that choose a cell.
const LEADING: u32 = 5;
/// Terms of a cell's expansion. A cell is 1/64 of its root wide, so where the next singularity of the function is at
/// half the root, an expansion falls by 100 with each term: to 1e-16.
const TERMS: usize = 8;
/// Bits below the leading ones.
const REST: u32 = f64::MANTISSA_DIGITS - 1 - LEADING;
const REST_MASK: u64 = (1 << REST) - 1;

/// The function between two values of the root.
pub struct SquaredTable {
    /// The exponent and leading bits of the first cell.
    first: u64,
    /// Chebyshev coefficients of each cell.
    cells: Vec<[f64; TERMS]>,
}

impl SquaredTable {
    /// Tabulates `function` from the smallest root > 0 to the largest.
    pub fn new([smallest, largest]: [f64; 2], function: impl Fn(f64) -> f64) -> Self {
        let [first, last] = [smallest, largest].map(|root| (root * root).to_bits() >> REST);
        let transform = ChebyshevTransform::new(TERMS, TERMS);
        let cell = |leading: u64| {
            let [start, end] = [leading, leading + 1].map(|bits| f64::from_bits(bits << REST));
            let square = |x: f64| start + (end - start) * f64::midpoint(1.0, x);
            let values: Vec<f64> = nodes(TERMS).map(|x| function(square(x).sqrt())).collect();
            let coefficients = transform.coefficients(&values);
            std::array::from_fn(|term| coefficients[term])
        };
        Self {
            first,
            cells: (first..=last).map(cell).collect(),
        }
    }

    /// The function where `x² + y²` is this square.
    ///
    /// # Panics
    /// Outside the table's range.
    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the number of a cell, far below the largest integer"
    )]
    pub fn at(&self, square: f64) -> f64 {
        let bits = square.to_bits();
        let cell = (bits >> REST) - self.first;
        // The remaining bits as a number from 1 to 1 + 1/32, in units of half a cell from its middle.
        let rest = f64::from_bits((bits & REST_MASK) | 1_f64.to_bits());
        let place = (rest - 1.0) * f64::from(2_u32 << LEADING) - 1.0;
        sum(&self.cells[cell as usize], place)
    }
}

#[cfg(test)]
mod tests {
    use super::SquaredTable;

    /// A pole at half the root's distance from the axis, and one at zero.
    #[test]
    fn the_table_equals_the_function() {
        for function in [
            |q: f64| q.powi(-4),
            |q: f64| 1.0 / (1.0 + ((q - 3.0) / 1.5).powi(2)),
        ] {
            let table = SquaredTable::new([1.5, 180.0], function);
            for i in 0..=10_000 {
                let q = 1.5 * 120_f64.powf(f64::from(i) / 1e4);
                let (found, wanted) = (table.at(q * q), function(q));
                // a rounding of the square, raised to the power two, and those of the expansion
                assert!(
                    (found / wanted - 1.0).abs() < 2e-15,
                    "{q}: {found:e} {wanted:e}"
                );
            }
        }
    }
}
