//! The influence coefficients of one grid, by offset.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::element::check_element_side;
use crate::error::InfluenceError;
use crate::radial::RadialTables;

/// The largest number of elements per side: the pressure alone on 16,384² elements takes 2 GB.
const LARGEST_SIZE: usize = 1 << 14;
/// Rows that one thread searches at a time.
const ROWS: usize = 64;

/// The coefficients `k(m, n)` of the square elements of an N × N grid, m/Pa, by the offset in elements.
///
/// By translation and the symmetry of the square, `0 ≤ n ≤ m < N` suffices: N(N+1)/2 numbers, 4 bytes
/// per element of the grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CoefficientTable {
    element_side: f64,
    size: usize,
    /// Row m holds n = 0 … m.
    triangle: Vec<f64>,
}

impl CoefficientTable {
    /// The coefficients of the `size` × `size` elements of side `element_side` (m) of one grid, in parallel on the
    /// current rayon pool.
    ///
    /// # Errors
    ///
    /// See [`Self::from_fn`].
    pub fn assemble(
        tables: &RadialTables,
        element_side: f64,
        size: usize,
    ) -> Result<Self, InfluenceError> {
        Self::from_fn(element_side, size, |offset| {
            tables.coefficient(element_side, offset)
        })
    }

    /// The table of any kernel: `coefficient(offset)` is called once for every offset with
    /// `offset[1] ≤ offset[0]`, in parallel.
    ///
    /// ```
    /// use pellicle_influence::{CoefficientTable, love};
    /// use pellicle_kernel::Material;
    ///
    /// let steel = Material::new(210e9, 0.3)?;
    /// let table = CoefficientTable::from_fn(1e-6, 64, |offset| love::coefficient(&steel, 1e-6, offset))?;
    /// assert_eq!(table.coefficient([3, 17]), table.coefficient([17, 3]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// A side that is not finite and positive, a size of 0 or above 16,384, a coefficient that is not finite.
    pub fn from_fn(
        element_side: f64,
        size: usize,
        coefficient: impl Fn([usize; 2]) -> f64 + Sync,
    ) -> Result<Self, InfluenceError> {
        check(element_side, size)?;
        let mut triangle = vec![0.0; size * (size + 1) / 2];
        fill_rows(&mut triangle, &|m, row| {
            for (n, entry) in row.iter_mut().enumerate() {
                *entry = coefficient([m, n]);
            }
        });
        let table = Self {
            element_side,
            size,
            triangle,
        };
        table.check_finite()?;
        Ok(table)
    }

    /// `k` for two elements `offset` apart, m/Pa; the sign and the order of the offsets do not matter.
    ///
    /// # Panics
    ///
    /// If an offset is not below [`Self::size`].
    #[must_use]
    #[inline]
    pub fn coefficient(&self, offset: [usize; 2]) -> f64 {
        let [m, n] = [offset[0].max(offset[1]), offset[0].min(offset[1])];
        assert!(m < self.size, "offset {m} in a table of size {}", self.size);
        self.triangle[m * (m + 1) / 2 + n]
    }

    /// The smallest coefficient (m/Pa) at or beyond each offset: entry m covers all elements at least m away along one
    /// axis or the other. It is negative where a surface bulges beside the load, as over an incompressible layer.
    #[must_use]
    pub fn least_from(&self) -> Vec<f64> {
        let row = |m: usize| &self.triangle[m * (m + 1) / 2..][..=m];
        let smaller = |a: f64, b: &f64| if *b < a { *b } else { a };
        let rows = (0..self.size).into_par_iter().with_min_len(ROWS);
        let mut least: Vec<f64> = rows
            .map(|m| row(m).iter().fold(f64::INFINITY, smaller))
            .collect();
        for m in (1..self.size).rev() {
            least[m - 1] = smaller(least[m], &least[m - 1]);
        }
        least
    }

    /// Number of elements N along one side of the grid.
    #[must_use]
    pub fn size(&self) -> usize {
        self.size
    }

    /// Side of an element, m.
    #[must_use]
    pub fn element_side(&self) -> f64 {
        self.element_side
    }

    /// The coefficients of the offsets `first` … `first` + C − 1 along one axis and `offset`, which is below the size,
    /// along the other; 0 where the table has none.
    pub(crate) fn side_by_side<const C: usize>(&self, first: usize, offset: usize) -> [f64; C] {
        let row = &self.triangle[offset * (offset + 1) / 2..][..=offset];
        match row.get(first..).and_then(<[f64]>::first_chunk) {
            Some(coefficients) => *coefficients,
            None => std::array::from_fn(|i| {
                let m = first + i;
                if m < self.size {
                    self.coefficient([m, offset])
                } else {
                    0.0
                }
            }),
        }
    }

    /// Size of the table of a grid in bytes.
    ///
    /// # Errors
    ///
    /// Those of [`Self::from_fn`] for an invalid side or size.
    pub(crate) fn bytes(element_side: f64, size: usize) -> Result<usize, InfluenceError> {
        check(element_side, size)?;
        Ok(size_of::<f64>() * (size * (size + 1) / 2))
    }

    fn check_finite(&self) -> Result<(), InfluenceError> {
        let offsets = (0..self.size).flat_map(|m| (0..=m).map(move |n| [m, n]));
        let mut entries = offsets.zip(self.triangle.iter().copied());
        match entries.find(|(_, found)| !found.is_finite()) {
            Some((offset, found)) => Err(InfluenceError::CoefficientNotFinite { offset, found }),
            None => Ok(()),
        }
    }
}

fn check(element_side: f64, size: usize) -> Result<(), InfluenceError> {
    check_element_side(element_side)?;
    if (1..=LARGEST_SIZE).contains(&size) {
        return Ok(());
    }
    Err(InfluenceError::TableSize {
        found: size,
        largest: LARGEST_SIZE,
    })
}

/// Fills each row of the triangle, by its number; compiled once for all coefficients.
fn fill_rows(triangle: &mut [f64], fill: &(dyn Fn(usize, &mut [f64]) + Sync)) {
    let mut rows = split_rows(triangle);
    let rows = rows.par_iter_mut().enumerate();
    rows.for_each(|(m, row)| fill(m, row));
}

/// The rows of the triangle, with 1, 2, 3 … entries.
fn split_rows(triangle: &mut [f64]) -> Vec<&mut [f64]> {
    let mut rows = Vec::new();
    let mut rest = triangle;
    while !rest.is_empty() {
        let (row, after) = rest.split_at_mut(rows.len() + 1);
        rows.push(row);
        rest = after;
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::CoefficientTable;
    use crate::error::InfluenceError;

    #[test]
    fn every_offset_is_computed_once_and_found_in_the_table() {
        let table = CoefficientTable::from_fn(1.0, 7, |[m, n]| (10 * m + n) as f64).unwrap();
        for m in 0..7 {
            for n in 0..7 {
                let expected = (10 * m.max(n) + m.min(n)) as f64;
                assert!((table.coefficient([m, n]) - expected).abs() < f64::EPSILON);
            }
        }
    }

    #[test]
    fn adjacent_coefficients_are_those_of_their_offsets() {
        let table = CoefficientTable::from_fn(1.0, 7, |[m, n]| (10 * m + n + 1) as f64).unwrap();
        for (first, offset) in (0..9).flat_map(|first| (0..7).map(move |n| (first, n))) {
            let found: [f64; 3] = table.side_by_side(first, offset);
            for (m, found) in (first..).zip(found) {
                let expected = if m < 7 {
                    table.coefficient([m, offset])
                } else {
                    0.0
                };
                assert!((found - expected).abs() < f64::EPSILON, "{m} {offset}");
            }
        }
    }

    #[test]
    fn the_minimum_from_an_offset_on_covers_all_larger_offsets() {
        let size = 150;
        let kernel =
            |[m, n]: [usize; 2]| (1.0 + 0.7 * m as f64 + 1.3 * n as f64).sin() / (1 + m) as f64;
        let table = CoefficientTable::from_fn(1.0, size, kernel).unwrap();
        for (offset, least) in table.least_from().into_iter().enumerate() {
            let all = (offset..size).flat_map(|m| (0..=m).map(move |n| kernel([m, n])));
            assert_eq!(all.fold(f64::INFINITY, f64::min).to_bits(), least.to_bits());
        }
    }

    #[test]
    fn invalid_sides_and_sizes_are_refused_with_their_values() {
        let build = |side, size| CoefficientTable::from_fn(side, size, |_| 1.0);
        assert!(matches!(
            build(-1.0, 4),
            Err(InfluenceError::ElementSide { found }) if found < 0.0
        ));
        assert!(matches!(
            build(f64::NAN, 4),
            Err(InfluenceError::ElementSide { .. })
        ));
        assert!(matches!(
            build(1.0, 0),
            Err(InfluenceError::TableSize { found: 0, .. })
        ));
    }

    #[test]
    fn a_coefficient_that_is_not_finite_is_refused() {
        let found = CoefficientTable::from_fn(1.0, 4, |[m, n]| 1.0 / (m + n) as f64);
        assert!(matches!(
            found,
            Err(InfluenceError::CoefficientNotFinite { offset: [0, 0], .. })
        ));
    }
}
