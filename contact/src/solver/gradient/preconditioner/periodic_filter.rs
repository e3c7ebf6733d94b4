//! Multiplication of a field's Fourier series by a function of the symbol, on the periodic grid or the quadrant of one.
//!
//! In single precision: the result only preconditions, and seven digits of a direction are more than it needs. The field is
//! scaled to a largest value of 1 first, so that no unit can overflow.

use std::f64::consts::TAU;

use pellicle_influence::{PeriodicSymbol, QuadrantFilter};
use rayon::prelude::*;

use crate::solver::gradient::preconditioner::plane_filter::PlaneFilter;
use crate::{grid::sector::Sector, vector::by_parts};

/// The filter of one grid.
pub struct PeriodicFilter {
    symbol: PeriodicSymbol,
    transform: Transform,
    largest_multiplier: f64,
}

enum Transform {
    Whole(Box<PlaneFilter>),
    Quadrant(Box<QuadrantFilter>),
}

impl PeriodicFilter {
    /// For fields on a sector of the symbol's grid.
    pub fn new(symbol: PeriodicSymbol, sector: Sector) -> Self {
        let size = symbol.size() / sector.parts();
        Self {
            transform: match sector {
                Sector::Whole => Transform::Whole(Box::new(PlaneFilter::new(size))),
                Sector::Quadrant => Transform::Quadrant(Box::new(QuadrantFilter::new(size))),
            },
            symbol,
            largest_multiplier: 0.0,
        }
    }

    /// Takes `multiplier(symbol)` as the factor of every frequency from now on.
    pub fn multiply_by(&mut self, multiplier: impl Fn(f64) -> f64 + Sync) {
        let quarter = self.symbol.quarter();
        let multipliers = quarter.iter().map(|symbol| multiplier(*symbol));
        self.largest_multiplier = multipliers.fold(0.0, f64::max);
        let (symbol, largest) = (&self.symbol, self.largest_multiplier);
        let relative = |frequency| narrow(multiplier(symbol.value(frequency)) / largest);
        match &mut self.transform {
            Transform::Whole(filter) => filter.multiply_by(relative),
            Transform::Quadrant(filter) => filter.multiply_by(relative),
        }
    }

    /// `field ← F⁻¹ multiplier F field`, in place.
    pub fn apply(&mut self, field: &mut [f64]) {
        let largest = by_parts(field.len(), |part| {
            field[part]
                .iter()
                .fold(0.0, |most: f64, value| most.max(value.abs()))
        });
        let largest = largest.into_iter().fold(0.0, f64::max);
        if largest == 0.0 {
            return;
        }
        let (scale, scale_back) = (1.0 / largest, largest * self.largest_multiplier);
        match &mut self.transform {
            Transform::Whole(filter) => filter.apply(field, scale, scale_back),
            Transform::Quadrant(filter) => filter.apply(field, scale, scale_back),
        }
    }

    /// What the filter of `multiplier(symbol)` on the whole periodic grid answers a unit with, at the offsets below `REACH` along both axes:
    /// `F_mn = N⁻² Σ_ij multiplier cos(2πim/N) cos(2πjn/N)`.
    pub fn answers<const REACH: usize>(
        &self,
        multiplier: impl Fn(f64) -> f64 + Sync,
    ) -> [[f64; REACH]; REACH] {
        let size = self.symbol.size();
        let half = size / 2 + 1;
        // Each of the quarter's frequencies stands for its mirror images, the ends of the range for themselves.
        let wave = |i: usize| {
            let images = if i == 0 || 2 * i == size { 1.0 } else { 2.0 };
            let cosine = |m: usize| (TAU * (i * m % size) as f64 / size as f64).cos();
            std::array::from_fn(|m| images / size as f64 * cosine(m))
        };
        let waves: Vec<[f64; REACH]> = (0..half).map(wave).collect();
        let rows = self.symbol.quarter().par_chunks_exact(half);
        let along: Vec<[f64; REACH]> = rows
            .map(|row| {
                let mut sums = [0.0; REACH];
                for (symbol, wave) in row.iter().zip(&waves) {
                    let multiplier = multiplier(*symbol);
                    (sums.iter_mut().zip(wave)).for_each(|(sum, w)| *sum += multiplier * w);
                }
                sums
            })
            .collect();
        let mut answers = [[0.0; REACH]; REACH];
        for (wave, along) in waves.iter().zip(&along) {
            for (row, w) in answers.iter_mut().zip(wave) {
                (row.iter_mut().zip(along)).for_each(|(answer, sum)| *answer += w * sum);
            }
        }
        answers
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "single precision is what is wanted"
)]
fn narrow(value: f64) -> f32 {
    value as f32
}

#[cfg(test)]
mod tests {
    use pellicle_influence::PeriodicSymbol;
    use pellicle_kernel::{Foundation, Material};

    use super::PeriodicFilter;
    use crate::{grid::sector::Sector, grid::window::Window};

    fn filter(size: usize, sector: Sector) -> PeriodicFilter {
        let foundation = Foundation::half_space(Material::new(1.0, 0.0).unwrap());
        PeriodicFilter::new(PeriodicSymbol::new(&foundation, 0.5, size), sector)
    }

    fn reciprocal(symbol: f64) -> f64 {
        1.0 / (symbol + 0.3)
    }

    #[test]
    fn the_answers_are_those_to_a_unit() {
        for size in [8, 15, 64] {
            let mut filter = filter(size, Sector::Whole);
            filter.multiply_by(reciprocal);
            let mut unit = vec![0.0; size * size];
            unit[0] = 1.0;
            filter.apply(&mut unit);
            let answers = filter.answers::<4>(reciprocal);
            for (m, row) in answers.iter().enumerate() {
                for (n, answer) in row.iter().enumerate() {
                    // Single precision of an answer of order 1.
                    assert!((answer - unit[m * size + n]).abs() < 1e-6, "{size} {m} {n}");
                }
            }
        }
    }

    #[test]
    fn a_quadrant_is_filtered_as_the_whole_field_is() {
        for half in [4, 9, 32] {
            let part: Vec<f64> = (0..half * half).map(|e| (0.7 * e as f64).sin()).collect();
            let everywhere = Window::all_of(Sector::Quadrant, half);
            let mut whole = everywhere.spread(part.clone());
            let mut quadrant = part;
            for (field, sector) in [
                (&mut whole, Sector::Whole),
                (&mut quadrant, Sector::Quadrant),
            ] {
                let mut filter = filter(2 * half, sector);
                filter.multiply_by(reciprocal);
                filter.apply(field);
            }
            let quadrant = everywhere.spread(quadrant);
            for (one, other) in whole.iter().zip(&quadrant) {
                // Single precision of answers of order 1.
                assert!((one - other).abs() < 2e-6, "{half}");
            }
        }
    }
}
