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
/// Partial maxima, which let the processor compare independent numbers at once.
const LANES: usize = 8;

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

    /// `field ← F⁻¹ multiplier F field` where `wanted` holds, in place; the other values are left as they are.
    ///
    /// # Panics
    /// If the field does not have one value per element.
    pub fn apply(&mut self, wanted: &[bool], field: &mut [f64]) {
        if let Some(scale) = self.filter(field) {
            self.transform.restore(wanted, field, scale);
        }
    }

    /// `answer ← F⁻¹ multiplier F field` where `wanted` holds; the other values are left as they are.
    ///
    /// # Panics
    /// If a field does not have one value per element.
    pub fn apply_into(&mut self, field: &[f64], wanted: &[bool], answer: &mut [f64]) {
        if let Some(scale) = self.filter(field) {
            self.transform.restore(wanted, answer, scale);
        } else {
            let wanted = answer.iter_mut().zip(wanted).filter(|(_, wanted)| **wanted);
            wanted.for_each(|(value, _)| *value = 0.0);
        }
    }

    /// Transforms and multiplies a field; returns the factor with which it is transformed back, or none if it is zero.
    fn filter(&mut self, field: &[f64]) -> Option<f64> {
        let parts = field.par_chunks(PART).map(largest);
        let largest = parts.collect::<Vec<_>>().into_iter().fold(0.0, f64::max);
        if largest == 0.0 {
            return None;
        }
        let [_, width] = self.transform.frequencies();
        let multipliers = (&self.multipliers[..], width);
        (self.transform).filter(multipliers, field, 1.0 / largest);
        Some(largest * self.largest_multiplier)
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

    fn filter(&mut self, multipliers: (&[f32], usize), field: &[f64], scale: f64) {
        match self {
            Self::Whole(transform) => filter(transform, multipliers, field, scale),
            Self::Half(transform) => filter(transform, multipliers, field, scale),
            Self::Quadrant(transform) => filter(transform, multipliers, field, scale),
        }
    }

    fn restore(&mut self, wanted: &[bool], field: &mut [f64], scale: f64) {
        match self {
            Self::Whole(transform) => transform.restore_where(wanted, field, scale),
            Self::Half(transform) => transform.restore_where(wanted, field, scale),
            Self::Quadrant(transform) => transform.restore_where(wanted, field, scale),
        }
    }
}

/// Transforms a field times a scale, and multiplies it.
fn filter<L: Lines<Real = f32>>(
    transform: &mut PlaneTransform<L>,
    (multipliers, width): (&[f32], usize),
    field: &[f64],
    scale: f64,
) {
    transform.load(field, scale);
    transform.multiply(|frequency| [&multipliers[frequency * width..][..width], &[]]);
}

/// The largest magnitude of some numbers.
fn largest(numbers: &[f64]) -> f64 {
    let (lanes, rest) = numbers.as_chunks::<LANES>();
    let mut most = [0.0; LANES];
    for numbers in lanes {
        for (most, number) in most.iter_mut().zip(numbers) {
            let number = number.abs();
            *most = if number > *most { number } else { *most };
        }
    }
    let all = most
        .into_iter()
        .chain(rest.iter().map(|number| number.abs()));
    all.fold(0.0, f64::max)
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
            filter.apply(&vec![true; size * size], &mut unit);
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
            filter.apply(&vec![true; whole.len()], &mut whole);
            let mut filter = PeriodicFilter::new(symbol(2 * half), grid);
            filter.multiply_by(reciprocal);
            filter.apply(&vec![true; solved.len()], &mut solved);
            for (one, other) in whole.iter().zip(&unfolded(&solved)) {
                // Single precision of answers of order 1.
                assert!((one - other).abs() < 2e-6, "{sector:?} {half}");
            }
        }
    }

    #[test]
    fn a_filter_answers_where_it_is_asked_to_and_leaves_the_rest() {
        for (sector, half) in [Sector::Whole, Sector::Half, Sector::Quadrant]
            .into_iter()
            .flat_map(|sector| [5, 32].map(|half| (sector, half)))
        {
            let grid = SectorGrid::new(sector, half);
            let elements = grid.elements();
            let field: Vec<f64> = (0..elements).map(|e| (0.7 * e as f64).sin()).collect();
            let mut filter = PeriodicFilter::new(symbol(grid.whole_size()), grid);
            filter.multiply_by(reciprocal);
            let mut all = field.clone();
            filter.apply(&vec![true; elements], &mut all);
            let wanted: Vec<bool> = (0..elements).map(|e| e % 7 == 3 && e > 2 * half).collect();
            let mut answer = vec![9.0; elements];
            filter.apply_into(&field, &wanted, &mut answer);
            let expected = |all: &[f64]| -> Vec<f64> {
                let values = all.iter().zip(&wanted);
                values
                    .map(|(value, wanted)| if *wanted { *value } else { 9.0 })
                    .collect()
            };
            assert_eq!(answer, expected(&all));
            filter.apply_into(&vec![0.0; elements], &wanted, &mut answer);
            assert_eq!(answer, expected(&vec![0.0; elements]));
        }
    }
}
