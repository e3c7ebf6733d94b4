//! Multiplication of a field's Fourier series by a function of the symbol, on the periodic grid or a sector of it.
//!
//! The arithmetic is in single precision: the result is only a preconditioned direction, for which seven digits are
//! more than enough. The field is first scaled to a largest value of 1, so that no choice of units can overflow.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::symbol::PeriodicSymbol;
use crate::sector::{Sector, SectorGrid};
use crate::transform::{Columns, EvenLines, FourierLines, HalfLines, Lines, PlaneTransform};

/// Numbers of a field searched at a time.
const PART: usize = 1 << 14;

/// `F⁻¹ f(K̂) F` on one grid, with the [symbol](PeriodicSymbol) `K̂` and any function f of it.
pub struct PeriodicFilter {
    symbol: PeriodicSymbol,
    transform: SectorTransform,
    /// For each frequency along one axis and each along the other, the factor divided by the largest one,
    /// times the normalisation.
    multipliers: Vec<f32>,
    largest_multiplier: f64,
}

enum SectorTransform {
    Whole(PlaneTransform<FourierLines<f32>>),
    Half(PlaneTransform<HalfLines<f32>>),
    Quadrant(PlaneTransform<EvenLines<f32>>),
}

impl PeriodicFilter {
    /// A filter for fields on the symbol's grid or a sector of it; it multiplies by 0 until
    /// [`Self::multiply_by`] is called.
    ///
    /// # Panics
    /// If the symbol belongs to another grid.
    #[must_use]
    pub fn new(symbol: PeriodicSymbol, grid: SectorGrid) -> Self {
        assert_eq!(
            grid.whole_lengths(),
            symbol.lengths(),
            "the symbol of the grid"
        );
        let size = grid.size();
        let transform = match grid.sector() {
            Sector::Whole => {
                SectorTransform::Whole(PlaneTransform::new(FourierLines::periodic(grid.lengths())))
            }
            Sector::Half => SectorTransform::Half(PlaneTransform::new(HalfLines::periodic(size))),
            Sector::Quadrant => {
                SectorTransform::Quadrant(PlaneTransform::new(EvenLines::periodic(size)))
            }
        };
        let multipliers = vec![0.0; transform.frequencies().iter().product()];
        Self {
            symbol,
            transform,
            multipliers,
            largest_multiplier: 0.0,
        }
    }

    /// Sets the factor of every frequency to `multiplier(symbol)`.
    pub fn multiply_by(&mut self, multiplier: impl Fn(f64) -> f64 + Sync) {
        let quarter = self.symbol.quarter();
        let multipliers = quarter.iter().map(|symbol| multiplier(*symbol));
        let largest = multipliers.fold(0.0, f64::max);
        self.largest_multiplier = largest;
        let symbol = &self.symbol;
        let [rows, columns] = symbol.lengths();
        // The forward and backward transforms multiply by the number of elements of the period.
        let scale = 1.0 / narrow((rows * columns) as f64);
        let [_, width] = self.transform.frequencies();
        let rows = self.multipliers.par_chunks_exact_mut(width);
        rows.enumerate().for_each(|(i, factors)| {
            for (j, factor) in factors.iter_mut().enumerate() {
                *factor = scale * narrow(multiplier(symbol.value([i, j])) / largest);
            }
        });
    }

    /// `field ← F⁻¹ multiplier F field`, in place.
    ///
    /// # Panics
    /// If the field does not have one value per element.
    pub fn apply(&mut self, field: &mut [f64]) {
        let most = |part: &[f64]| {
            part.iter()
                .fold(0.0, |most: f64, value| most.max(value.abs()))
        };
        let largest = field.par_chunks(PART).map(most);
        let largest = largest.collect::<Vec<_>>().into_iter().fold(0.0, f64::max);
        if largest == 0.0 {
            return;
        }
        let scales = [1.0 / largest, largest * self.largest_multiplier];
        let [_, width] = self.transform.frequencies();
        let multipliers = (&self.multipliers[..], width);
        match &mut self.transform {
            SectorTransform::Whole(transform) => filter(transform, multipliers, field, scales),
            SectorTransform::Half(transform) => filter(transform, multipliers, field, scales),
            SectorTransform::Quadrant(transform) => filter(transform, multipliers, field, scales),
        }
    }

    /// The response of the filter with `multiplier(symbol)` on the whole periodic grid to a unit, at the offsets below
    /// `REACH` along y and x: `F_mn = N⁻² Σ_ij multiplier cos(2πim/N) cos(2πjn/N)`.
    pub fn answers<const REACH: usize>(
        &self,
        multiplier: impl Fn(f64) -> f64 + Sync,
    ) -> [[f64; REACH]; REACH] {
        // Each frequency of the quarter stands for its mirror images as well; those at the ends of the range have none.
        let waves = |size: usize| -> Vec<[f64; REACH]> {
            let wave = |i: usize| {
                let images = if i == 0 || 2 * i == size { 1.0 } else { 2.0 };
                let cosine = |m: usize| (TAU * (i * m % size) as f64 / size as f64).cos();
                std::array::from_fn(|m| images / size as f64 * cosine(m))
            };
            (0..=size / 2).map(wave).collect()
        };
        let [along_x, along_y] = self.symbol.lengths().map(waves);
        let rows = self.symbol.quarter().par_chunks_exact(along_x.len());
        let along: Vec<[f64; REACH]> = rows
            .map(|row| {
                let mut sums = [0.0; REACH];
                for (symbol, wave) in row.iter().zip(&along_x) {
                    let multiplier = multiplier(*symbol);
                    (sums.iter_mut().zip(wave)).for_each(|(sum, w)| *sum += multiplier * w);
                }
                sums
            })
            .collect();
        let mut response = [[0.0; REACH]; REACH];
        for (wave, along) in along_y.iter().zip(&along) {
            for (row, w) in response.iter_mut().zip(wave) {
                (row.iter_mut().zip(along)).for_each(|(value, sum)| *value += w * sum);
            }
        }
        response
    }
}

impl SectorTransform {
    /// Frequencies along the rows, and along the columns.
    fn frequencies(&self) -> [usize; 2] {
        match self {
            Self::Whole(transform) => {
                let lines = transform.lines();
                [lines.width(), lines.columns().length() / 2 + 1]
            }
            Self::Half(transform) => {
                let half = transform.lines().columns().length() / 2;
                [half, half + 1]
            }
            Self::Quadrant(transform) => [transform.lines().columns().length(); 2],
        }
    }
}

/// Transforms a field times the first scale, multiplies it, and transforms it back times the second.
fn filter<L: Lines<Real = f32>>(
    transform: &mut PlaneTransform<L>,
    (multipliers, width): (&[f32], usize),
    field: &mut [f64],
    [scale, scale_back]: [f64; 2],
) {
    transform.load(field, scale);
    transform.multiply(|frequency| [&multipliers[frequency * width..][..width], &[]]);
    transform.restore(field, scale_back);
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "preconditioners are applied in single precision"
)]
fn narrow(value: f64) -> f32 {
    value as f32
}

impl std::fmt::Debug for PeriodicFilter {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut shown = formatter.debug_struct("PeriodicFilter");
        shown
            .field("lengths", &self.symbol.lengths())
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use pellicle_kernel::{Foundation, Material};

    use super::{PeriodicFilter, PeriodicSymbol, Sector, SectorGrid};

    fn symbol(size: usize) -> PeriodicSymbol {
        let foundation = Foundation::half_space(Material::new(1.0, 0.0).unwrap());
        PeriodicSymbol::new(&foundation.into(), 0.5, size)
    }

    fn reciprocal(symbol: f64) -> f64 {
        1.0 / (symbol + 0.3)
    }

    #[test]
    fn the_impulse_response_is_the_filtered_unit_impulse() {
        for size in [8, 15, 64] {
            let mut filter = PeriodicFilter::new(symbol(size), SectorGrid::whole(size));
            filter.multiply_by(reciprocal);
            let mut unit = vec![0.0; size * size];
            unit[0] = 1.0;
            filter.apply(&mut unit);
            let response = filter.answers::<4>(reciprocal);
            for (m, row) in response.iter().enumerate() {
                for (n, value) in row.iter().enumerate() {
                    // Single precision of a value of order 1.
                    assert!((value - unit[m * size + n]).abs() < 1e-6, "{size} {m} {n}");
                }
            }
        }
    }

    #[test]
    fn a_sector_is_filtered_like_the_whole_field() {
        for (sector, half) in [Sector::Half, Sector::Quadrant]
            .into_iter()
            .flat_map(|sector| [4, 9, 32].map(|half| (sector, half)))
        {
            let grid = SectorGrid::new(sector, half);
            let elements = 0..grid.elements();
            let part: Vec<f64> = elements.map(|e| (0.7 * e as f64).sin()).collect();
            let [first, _] = grid.first_index();
            let along = |i: usize, first: usize| if i < first { first - 1 - i } else { i - first };
            let unfolded = |part: &[f64]| -> Vec<f64> {
                let elements = 0..4 * half * half;
                let image =
                    |e: usize| along(e / (2 * half), first) * half + along(e % (2 * half), half);
                elements.map(|e| part[image(e)]).collect()
            };
            let (mut whole, mut solved) = (unfolded(&part), part);
            let mut filter = PeriodicFilter::new(symbol(2 * half), SectorGrid::whole(2 * half));
            filter.multiply_by(reciprocal);
            filter.apply(&mut whole);
            let mut filter = PeriodicFilter::new(symbol(2 * half), grid);
            filter.multiply_by(reciprocal);
            filter.apply(&mut solved);
            for (one, other) in whole.iter().zip(&unfolded(&solved)) {
                // Single precision of answers of order 1.
                assert!((one - other).abs() < 2e-6, "{sector:?} {half}");
            }
        }
    }
}
