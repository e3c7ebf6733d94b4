//! The blocks of the factor: the small dense systems of a tile's elements and their earlier neighbours.
//!
//! They are solved in single precision: with no product more in any case, rough surfaces and films under a coating ten
//! times as stiff take a tenth less time.

use pellicle_influence::SurfaceElasticity;

use super::cholesky::{MOST_ROWS, SmallSystem};
use crate::vector::single;

/// Smallest compliance of the relief that is included, relative to an element's own elastic compliance.
const SMALLEST_COMPLIANCE: f64 = 1e-3;
/// Classes of compliance per factor of two: a preconditioner needs no more than two digits.
const CLASSES_PER_OCTAVE: f64 = 16.0;

/// The class of a compliance `η/K₀₀`; compliances of one class are treated as equal.
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

/// The representative `η/K₀₀` of a class.
pub fn compliance_of(class: u16) -> f64 {
    if class == 0 {
        return 0.0;
    }
    SMALLEST_COMPLIANCE * (f64::from(class - 1) / CLASSES_PER_OCTAVE).exp2()
}

/// Distance, in the spacing of a level, below which coefficients are taken from a separate table.
const TABLE_REACH: i32 = 32;
/// Entries of a row of that table, for distances of either sign.
const WIDTH: i32 = 2 * TABLE_REACH;
/// The coefficients of elements few places apart, in the spacing of one level.
pub struct NearCoefficients(Vec<f32>);

impl NearCoefficients {
    /// Coefficients at distances of multiples of 2^`level` elements; 0 at distances larger than the grid.
    pub fn of(elasticity: &SurfaceElasticity, level: u32) -> Self {
        let size = elasticity.size();
        let along = |distance: i32| {
            let elements = u64::from(distance.unsigned_abs()) << level;
            usize::try_from(elements)
                .ok()
                .filter(|offset| *offset < size)
        };
        let value = |(x, y): (i32, i32)| match (along(x), along(y)) {
            (Some(x), Some(y)) => elasticity.coefficient([x, y]),
            _ => 0.0,
        };
        let offsets = (-TABLE_REACH..TABLE_REACH)
            .flat_map(|x| (-TABLE_REACH..TABLE_REACH).map(move |y| (x, y)));
        Self(offsets.map(|offset| single(value(offset))).collect())
    }

    /// Replaces `keys` by the keys of `places`; the difference of two keys is the key of the offset. Returns false if
    /// some places are too far apart.
    fn keys(places: &[[i32; 2]], keys: &mut Vec<i32>) -> bool {
        let are_near = [0, 1].into_iter().all(|axis: usize| {
            let along = || places.iter().map(|place| place[axis]);
            let ends = along().min().zip(along().max());
            ends.is_none_or(|(least, most)| most - least < TABLE_REACH)
        });
        keys.clear();
        keys.extend(places.iter().map(|[x, y]| x * WIDTH + y));
        are_near
    }

    /// The coefficient between places whose keys differ by `apart`.
    #[inline]
    fn at(&self, apart: i32) -> f32 {
        let zero = TABLE_REACH * WIDTH + TABLE_REACH;
        self.0[(zero + apart).unsigned_abs() as usize]
    }
}

/// The memory of one thread that solves local systems in succession.
#[derive(Default)]
pub struct Workspace {
    system: SmallSystem,
    /// For each unknown its entries in the rows of the tile's own elements.
    rows: Vec<[f32; MOST_ROWS]>,
    keys: Vec<i32>,
}

/// The system of a tile's neighbours and, after them, its own elements.
pub struct LocalSystem<'a> {
    pub elasticity: &'a SurfaceElasticity,
    pub near: &'a NearCoefficients,
    /// The spacing of places is 2^level elements.
    pub level: u32,
    /// Offsets of the unknowns from the tile's first place.
    pub places: &'a [[i32; 2]],
    /// Class of compliance of each unknown.
    pub classes: &'a [u16],
    /// Number of the tile's own elements.
    pub own: usize,
    /// Index of the tile's first place from each axis with mirror images beyond it.
    pub to_axis: [Option<u32>; 2],
}

impl LocalSystem<'_> {
    /// The rows `G` of the tile's own elements, the last ones of `L⁻¹`: for each unknown its entry in each of them.
    ///
    /// If the system is not positive definite up to rounding, only each element's own `1/√(K₀₀ + η)` is returned.
    pub fn rows<'w>(&self, workspace: &'w mut Workspace) -> &'w [[f32; MOST_ROWS]] {
        let Workspace { system, rows, keys } = workspace;
        self.fill(system, keys);
        if let Some(rows) = system.last_rows_of_inverse(self.own) {
            return rows;
        }
        let order = self.places.len();
        rows.clear();
        rows.resize(order, [0.0; MOST_ROWS]);
        for (own, a) in (order - self.own..order).enumerate() {
            let place = self.places[a];
            let diagonal = self.elastic(place, place) + self.compliance(a);
            rows[a][own] = single(1.0 / diagonal.sqrt());
        }
        rows
    }

    /// Writes `K + η`.
    fn fill(&self, system: &mut SmallSystem, keys: &mut Vec<i32>) {
        system.begin(self.places.len());
        let are_near = NearCoefficients::keys(self.places, keys) && self.to_axis == [None, None];
        // Most unknowns have the compliance of the one before.
        let mut class = self.classes[0];
        let mut compliance = self.compliance(0);
        for (a, place) in self.places.iter().enumerate() {
            let below = system.column(a);
            if are_near {
                for (value, key) in below.iter_mut().zip(&keys[a..]) {
                    *value = self.near.at(key - keys[a]);
                }
            } else {
                for (value, other) in below.iter_mut().zip(&self.places[a..]) {
                    *value = single(self.elastic(*place, *other));
                }
            }
            if self.classes[a] != class {
                (class, compliance) = (self.classes[a], self.compliance(a));
            }
            below[0] += single(compliance);
        }
    }

    /// `η` of an unknown.
    fn compliance(&self, a: usize) -> f64 {
        self.elasticity.coefficient([0, 0]) * compliance_of(self.classes[a])
    }

    /// `K` between two places, including images beyond the axes.
    fn elastic(&self, p: [i32; 2], q: [i32; 2]) -> f64 {
        // The image of index j lies at −1 − j: i + j + 1 from the index i.
        let along = |axis: usize| {
            let apart = (p[axis].abs_diff(q[axis]) as usize) << self.level;
            let mirrored = self.to_axis[axis].and_then(|along| {
                let both = i64::from(p[axis] + q[axis]) << self.level;
                usize::try_from(2 * i64::from(along) + 1 + both).ok()
            });
            std::iter::once(apart).chain(mirrored)
        };
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
    fn a_class_represents_a_compliance_to_three_percent() {
        // Half a class of 1/16 octave: 2^(1/32).
        for relative in [1e-3, 0.02, 0.7, 5.0, 1e6] {
            let found: f64 = compliance_of(class(relative)) / relative;
            assert!((found - 1.0).abs() < 0.023, "{relative}: {found}");
        }
        assert!(class(1e-4) == 0 && compliance_of(0) < f64::MIN_POSITIVE);
    }

    #[test]
    fn a_block_solves_the_system_of_its_elements_with_mirror_images_and_springs() {
        let [coating, base] = [10.0, 1.0].map(|modulus| Material::new(modulus, 0.3).unwrap());
        let body = Foundation::coated(0.05, coating, base).unwrap();
        let tables = RadialTables::build(&body).unwrap();
        let table = CoefficientTable::assemble(&tables, 1.0 / 64.0, 64).unwrap();
        let elasticity = SurfaceElasticity::new(Arc::new(table), body);
        let near = NearCoefficients::of(&elasticity, 1);
        // A tile of every second element, eight from the axes, with four neighbours and three elements of its own.
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
            let mut workspace = Workspace::default();
            let g = system.rows(&mut workspace);
            let g = |a: usize, row: usize| f64::from(g[a][row]);
            // A G = (0, L_own)ᵀ with a lower triangle L_own: A = L Lᵀ, Lᵀ G = (0, 1)ᵀ. And Gᵀ A G = 1.
            let order = places.len();
            for column in 0..own {
                let image = |a: usize| (0..order).map(|b| matrix(a, b) * g(b, column)).sum();
                let image: Vec<f64> = (0..order).map(image).collect();
                assert!(
                    image[..order - own + column]
                        .iter()
                        .all(|x| x.abs() < 1e-6 * matrix(0, 0).sqrt()),
                    "{to_axis:?} {column}"
                );
                for other in 0..own {
                    let energy: f64 = (0..order).map(|a| g(a, other) * image[a]).sum();
                    let wanted = f64::from(u8::from(other == column));
                    // in single precision
                    assert!((energy - wanted).abs() < 1e-6, "{to_axis:?} {column}");
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
    fn near_coefficients_are_those_of_the_table_at_the_spacing_of_their_level() {
        let elasticity = of_half_space(64);
        for level in [0, 1, 5] {
            let near = NearCoefficients::of(&elasticity, level);
            let mut keys = Vec::new();
            for (p, q) in [
                ([0, 0], [0, 0]),
                ([-1, 4], [0, 4]),
                ([5, -2], [2, 5]),
                ([-20, 3], [11, -28]),
                ([7, 31], [7, 0]),
            ] {
                let offset = [0, 1].map(|axis: usize| {
                    let apart: i32 = p[axis] - q[axis];
                    (apart.unsigned_abs() as usize) << level
                });
                let is_there = offset.iter().all(|along| *along < 64);
                let wanted = if is_there {
                    elasticity.coefficient(offset)
                } else {
                    0.0
                };
                assert!(NearCoefficients::keys(&[p, q], &mut keys));
                let found = [near.at(keys[0] - keys[1]), near.at(keys[1] - keys[0])];
                assert_eq!(found, [single(wanted); 2], "{level} {p:?} {q:?}");
            }
            for far in [[32, 0], [0, -32], [-40, 40]] {
                assert!(!NearCoefficients::keys(&[[0, 0], far, [1, 1]], &mut keys));
            }
        }
    }

    #[test]
    fn a_system_that_is_not_positive_definite_is_replaced_by_its_diagonal() {
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
        let mut workspace = Workspace::default();
        let found = system.rows(&mut workspace);
        let own = single(1.0 / elasticity.coefficient([0, 0]).sqrt());
        let first_two = found.iter().map(|entries| [entries[0], entries[1]]);
        assert!(first_two.eq([[0.0; 2], [own, 0.0], [0.0, own]]));
    }
}
