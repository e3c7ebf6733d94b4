//! The product `K p` summed directly: the reference.

use rayon::prelude::*;

use super::ElasticOperator;
use crate::coefficient_table::CoefficientTable;

/// `u = K p` by N⁴ multiplications, directly from the table of coefficients.
///
/// N = 256 takes 800 times as many as N = 48: use [`crate::ConvolutionOperator`] there.
#[derive(Clone, Debug)]
pub struct DenseOperator {
    table: CoefficientTable,
}

impl DenseOperator {
    /// The operator of the grid for which the table was made.
    #[must_use]
    pub fn new(table: &CoefficientTable) -> Self {
        Self {
            table: table.clone(),
        }
    }

    /// Entry of the N² × N² matrix K, m/Pa: displacement of the element `row` for unit pressure on the element
    /// `column`.
    ///
    /// # Panics
    ///
    /// If `row` or `column` is not below N².
    #[must_use]
    pub fn entry(&self, row: usize, column: usize) -> f64 {
        let size = self.table.size();
        let offset = [
            (row / size).abs_diff(column / size),
            (row % size).abs_diff(column % size),
        ];
        self.table.coefficient(offset)
    }

    /// `Σ_j K_ij p_j` for one element i.
    fn displacement_of(&self, row: usize, pressure: &[f64]) -> f64 {
        let size = self.table.size();
        let [x, y] = [row / size, row % size];
        let line = |(i, line): (usize, &[f64])| -> f64 {
            let terms = line.iter().enumerate();
            terms
                .map(|(j, p)| self.table.coefficient([x.abs_diff(i), y.abs_diff(j)]) * p)
                .sum()
        };
        pressure.chunks_exact(size).enumerate().map(line).sum()
    }
}

impl ElasticOperator for DenseOperator {
    fn size(&self) -> usize {
        self.table.size()
    }

    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        let elements = self.size().pow(2);
        assert_eq!(pressure.len(), elements, "pressures of N² elements");
        assert_eq!(displacement.len(), elements, "displacements of N² elements");
        let entries = displacement.par_iter_mut().enumerate();
        entries.for_each(|(row, entry)| *entry = self.displacement_of(row, pressure));
    }
}
