//! The blocks of the factor: the small dense systems of a tile's elements and their earlier neighbours.

use faer::{
    Mat, Par, Side,
    linalg::{solvers::Llt, triangular_solve::solve_upper_triangular_in_place},
};
use pellicle_influence::SurfaceElasticity;

/// Compliances of relief, relative to an element's own elastic compliance, from which on the relief counts.
const SMALLEST_COMPLIANCE: f64 = 1e-3;
/// Classes of compliance to a factor of two: a preconditioner needs no more than two digits of it.
const CLASSES_PER_OCTAVE: f64 = 16.0;

/// The class of compliances `η/K₀₀` that are treated as one.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "rounded and clamped to the class's range"
)]
pub fn class(relative_compliance: f64) -> u16 {
    if relative_compliance < SMALLEST_COMPLIANCE {
        return 0;
    }
    let octaves = (relative_compliance / SMALLEST_COMPLIANCE).log2();
    1 + (CLASSES_PER_OCTAVE * octaves).round().clamp(0.0, 60_000.0) as u16
}

/// The `η/K₀₀` that stands for a class.
pub fn compliance_of(class: u16) -> f64 {
    if class == 0 {
        return 0.0;
    }
    SMALLEST_COMPLIANCE * (f64::from(class - 1) / CLASSES_PER_OCTAVE).exp2()
}

/// Distance, in the spacing of a level, below which coefficients are looked up in a table of their own.
const NEAR: usize = 32;

/// The coefficients of elements few places apart, in the spacing of one level.
pub struct NearCoefficients(Vec<f64>);

impl NearCoefficients {
    /// Those at distances of whole multiples of 2^`level` elements; none where the grid has no two such elements.
    pub fn of(elasticity: &SurfaceElasticity, level: u32) -> Self {
        let size = elasticity.size();
        if 1 << level >= size {
            return Self(Vec::new());
        }
        let offsets = (0..NEAR).flat_map(|x| (0..NEAR).map(move |y| [x << level, y << level]));
        let value = |offset: [usize; 2]| {
            let is_there = offset.iter().all(|along| *along < size);
            if is_there {
                elasticity.coefficient(offset)
            } else {
                0.0
            }
        };
        Self(offsets.map(value).collect())
    }

    /// The coefficient at so many places, if it is near enough to be kept.
    pub fn coefficient(&self, [x, y]: [usize; 2]) -> Option<f64> {
        let is_near = x < NEAR && y < NEAR;
        is_near.then(|| self.0.get(x * NEAR + y).copied()).flatten()
    }
}

/// The system of a tile's own elements, last, and their neighbours before them.
pub struct LocalSystem<'a> {
    pub elasticity: &'a SurfaceElasticity,
    pub near: &'a NearCoefficients,
    /// The spacing of places is 2^level elements.
    pub level: u32,
    /// Where its unknowns lie, from the tile's first place.
    pub places: &'a [[i32; 2]],
    /// Class of compliance of each.
    pub classes: &'a [u16],
    /// How many are the tile's own.
    pub own: usize,
    /// Index of the tile's first place from each axis beyond which mirror images press too.
    pub to_axis: [Option<u32>; 2],
}

impl LocalSystem<'_> {
    /// The columns `G` of the tile's own elements, `Lᵀ G = (0, 1)ᵀ`: the last rows of the inverse of `L`, transposed.
    ///
    /// A system that is not positive definite up to rounding gives each element's own `1/√(K₀₀ + η)` and nothing else.
    pub fn columns(&self) -> Mat<f64> {
        let order = self.places.len();
        let first = order - self.own;
        let matrix = self.lower_triangle();
        let mut columns = Mat::zeros(order, self.own);
        for own in 0..self.own {
            columns[(first + own, own)] = 1.0;
        }
        if let Ok(factor) = Llt::new(matrix.as_ref(), Side::Lower) {
            let upper = factor.L().transpose();
            solve_upper_triangular_in_place(upper, columns.as_mut(), Par::Seq);
        } else {
            for own in 0..self.own {
                let a = first + own;
                columns[(a, own)] = 1.0 / matrix[(a, a)].sqrt();
            }
        }
        columns
    }

    /// The lower triangle of `K + η`, which is all that its factor takes.
    fn lower_triangle(&self) -> Mat<f64> {
        let order = self.places.len();
        let own = self.elasticity.coefficient([0, 0]);
        let mut matrix = Mat::zeros(order, order);
        for (a, place) in self.places.iter().enumerate() {
            let below = &mut matrix.col_as_slice_mut(a)[a..];
            for (value, other) in below.iter_mut().zip(&self.places[a..]) {
                *value = self.elastic(*place, *other);
            }
            below[0] += own * compliance_of(self.classes[a]);
        }
        matrix
    }

    /// `K` between two places.
    #[inline]
    fn elastic(&self, p: [i32; 2], q: [i32; 2]) -> f64 {
        let apart = [0, 1].map(|axis: usize| p[axis].abs_diff(q[axis]) as usize);
        match self.near.coefficient(apart) {
            Some(coefficient) if self.to_axis == [None, None] => coefficient,
            _ => self.with_images(apart, [p[0] + q[0], p[1] + q[1]]),
        }
    }

    /// `K` between places so far apart with the images beyond the axes, by the sum of their indices.
    fn with_images(&self, apart: [usize; 2], both: [i32; 2]) -> f64 {
        // The image of index j lies at −1 − j: i + j + 1 from the index i.
        let mirrored = [0, 1].map(|axis: usize| {
            let twice = 2 * i64::from(self.to_axis[axis]?) + 1;
            usize::try_from(twice + (i64::from(both[axis]) << self.level)).ok()
        });
        let along = |axis: usize| std::iter::once(apart[axis] << self.level).chain(mirrored[axis]);
        let offsets = along(0).flat_map(|x| along(1).map(move |y| [x, y]));
        offsets
            .map(|offset| self.elasticity.coefficient(offset))
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use pellicle_influence::{CoefficientTable, RadialTables};
    use pellicle_kernel::{Foundation, Material};

    use super::*;

    #[test]
    fn a_class_keeps_a_compliance_to_three_percent() {
        // Half a class of 1/16 octave: 2^(1/32).
        for relative in [1e-3, 0.02, 0.7, 5.0, 1e6] {
            let found: f64 = compliance_of(class(relative)) / relative;
            assert!((found - 1.0).abs() < 0.023, "{relative}: {found}");
        }
        assert!(class(1e-4) == 0 && compliance_of(0) < f64::MIN_POSITIVE);
    }

    #[test]
    fn a_block_solves_the_system_of_its_elements_with_mirror_images_and_springs() {
        let [coat, base] = [10.0, 1.0].map(|modulus| Material::new(modulus, 0.3).unwrap());
        let body = Foundation::coated(0.05, coat, base).unwrap();
        let tables = RadialTables::build(&body).unwrap();
        let table = CoefficientTable::assemble(&tables, 1.0 / 64.0, 64).unwrap();
        let elasticity = SurfaceElasticity::new(Arc::new(table), body);
        let near = NearCoefficients::of(&elasticity, 1);
        // A tile of every second element, eight from the axes; four neighbours and three elements of its own.
        let first = 8;
        let places = [[5, 1], [-4, 0], [0, -3], [6, 6], [0, 1], [1, 1], [3, 2]];
        let (classes, own) = ([0, 150, 60, 3, 100, 0, 30], 3);
        for to_axis in [
            [None, None],
            [Some(8), None],
            [None, Some(8)],
            [Some(8), Some(8)],
        ] {
            let system = LocalSystem {
                elasticity: &elasticity,
                near: &near,
                level: 1,
                places: &places,
                classes: &classes,
                own,
                to_axis,
            };
            // On the whole grid, whose axes lie between its elements 31 and 32.
            let along = |k: usize, axis: usize| first + 2 * places[k][axis];
            let images = |k: usize, axis: usize| {
                let i = along(k, axis);
                std::iter::once(32 + i).chain(to_axis[axis].map(|_| 31 - i))
            };
            let matrix = |a: usize, b: usize| {
                let mut sum = 0.0;
                for x in images(b, 0) {
                    for y in images(b, 1) {
                        let offset = [(0, x), (1, y)].map(|(axis, image): (usize, i32)| {
                            (32 + along(a, axis)).abs_diff(image) as usize
                        });
                        sum += elasticity.coefficient(offset);
                    }
                }
                if a == b {
                    sum += elasticity.coefficient([0, 0]) * compliance_of(classes[a]);
                }
                sum
            };
            let g = system.columns();
            // A G = (0, L_own)ᵀ of a lower triangle: A = L Lᵀ, Lᵀ G = (0, 1)ᵀ. And Gᵀ A G = 1.
            let order = places.len();
            for column in 0..own {
                let image = |a: usize| (0..order).map(|b| matrix(a, b) * g[(b, column)]).sum();
                let image: Vec<f64> = (0..order).map(image).collect();
                assert!(
                    image[..order - own + column]
                        .iter()
                        .all(|x| x.abs() < 1e-13),
                    "{to_axis:?} {column}"
                );
                for other in 0..own {
                    let energy: f64 = (0..order).map(|a| g[(a, other)] * image[a]).sum();
                    let wanted = f64::from(u8::from(other == column));
                    assert!((energy - wanted).abs() < 1e-13, "{to_axis:?} {column}");
                }
            }
        }
    }

    fn of_half_space(size: usize) -> SurfaceElasticity {
        let body = Foundation::half_space(Material::new(1.0, 0.3).unwrap());
        let tables = RadialTables::build(&body).unwrap();
        let table = CoefficientTable::assemble(&tables, 1.0 / size as f64, size).unwrap();
        SurfaceElasticity::new(Arc::new(table), body)
    }

    #[test]
    fn near_coefficients_are_those_of_the_table_in_the_spacing_of_their_level() {
        let elasticity = of_half_space(64);
        for level in [0, 1, 5] {
            let near = NearCoefficients::of(&elasticity, level);
            for apart in [[0, 0], [1, 0], [0, 1], [3, 7], [31, 31], [31, 2]] {
                let offset = apart.map(|along: usize| along << level);
                let is_there = offset.iter().all(|along| *along < 64);
                let wanted = if is_there {
                    elasticity.coefficient(offset)
                } else {
                    0.0
                };
                assert_eq!(near.coefficient(apart), Some(wanted), "{level} {apart:?}");
            }
            let far = [[32, 0], [0, 32], [2, 40], [40, 2], [40, 40]];
            assert!(far.iter().all(|apart| near.coefficient(*apart).is_none()));
        }
        // No two elements of a grid are so far apart as the spacing of its highest levels.
        assert_eq!(
            NearCoefficients::of(&elasticity, 6).coefficient([0, 0]),
            None
        );
    }

    #[test]
    fn of_a_system_that_is_not_positive_definite_each_element_stands_alone() {
        let elasticity = of_half_space(16);
        let system = LocalSystem {
            elasticity: &elasticity,
            near: &NearCoefficients::of(&elasticity, 0),
            level: 0,
            // The same element twice.
            places: &[[3, 3], [5, 5], [5, 5]],
            classes: &[0, 0, 0],
            own: 2,
            to_axis: [None, None],
        };
        let (found, own) = (system.columns(), elasticity.coefficient([0, 0]));
        for column in 0..2 {
            for row in 0..3 {
                let wanted = if row == 1 + column {
                    1.0 / own.sqrt()
                } else {
                    0.0
                };
                assert!((found[(row, column)] - wanted).abs() < 1e-14 * wanted.max(1.0));
            }
        }
    }
}
