//! The product `K p` of a periodic cell: pressures repeat with the grid's sides, and there is no padding.
//!
//! Pressures that are uniform on each element and alternate with one wavenumber `k` of the cell displace the centres of
//! the elements by `S(k)` times themselves. `S` is the sum of the responses to `k` and its aliases, which are
//! indistinguishable from it at the centres:
//!
//! ```text
//! S(k) = Σ C(|q|) sinc(q_x a) sinc(q_y a),    q = k + (m, n) π/a
//! ```
//!
//! so `K` is exact for the grid, like the coefficients of a single square. The mean displacement of a half-space under
//! a mean pressure is infinite; it is left out, so displacements are measured from the mean plane of its deformed
//! surface and `S(0) = 0`. On a rigid base `S(0)` is the shortening of layers that have no room to widen, whatever the
//! other body: [`ElasticBodies::mean_compliance`]. `C` of each body is [tabulated](compliance_table) over the
//! cell's waves, so a stack of a hundred sublayers costs little more than one layer.

mod alias_sum;
mod compliance_table;
mod squared_table;

use rayon::prelude::*;

use self::alias_sum::{AliasSum, NodeWeights, weights};
pub(crate) use self::compliance_table::ComplianceTable;
use super::ElasticOperator;
use crate::bodies::ElasticBodies;
use crate::element::direct::sinc;
use crate::transform::{FourierLines, PlaneTransform};

/// `u = K p` of a periodic cell, square or oblong, in O(N² log N), by a real FFT without padding: less than half the
/// work of [`crate::ConvolutionOperator`].
///
/// Memory: 2 bytes per element for the multipliers, 8 for the half-transformed field. Accuracy: 1e-12 of
/// the largest displacement; sums of a single square's coefficients over all cells agree to that (test
/// `the_operator_sums_the_coefficients_over_all_cells`). Uses the current rayon pool; the result has the
/// same bits for every pool.
pub struct PeriodicOperator {
    transform: PlaneTransform<FourierLines<f64>>,
    /// `S` over the number of elements at the frequencies `(i, j)`, 0 … N/2 in either direction, at index
    /// `j (N_x/2 + 1) + i`; the others are mirror images of these.
    multipliers: Vec<f64>,
    lengths: [usize; 2],
}

impl PeriodicOperator {
    /// The operator for `lengths` elements along x and y of side `element_side` (m), which fill the cell.
    #[must_use]
    pub fn new(bodies: &ElasticBodies, element_side: f64, lengths: [usize; 2]) -> Self {
        let transform = PlaneTransform::new(FourierLines::periodic(lengths));
        let size = lengths[0].max(lengths[1]);
        let compliance = ComplianceTable::of_cell(bodies, element_side, size);
        let half_side = element_side / 2.0;
        let aliases = AliasSum::new(bodies, &compliance, half_side);
        let [x, y] = lengths.map(WavesAlong::new);
        let scale = 1.0 / (lengths[0] * lengths[1]) as f64;
        let width = x.waves.len();
        let mut multipliers = vec![0.0; y.waves.len() * width];
        let rows = multipliers.par_chunks_exact_mut(width).enumerate();
        rows.for_each(|(j, row)| {
            let of_row = aliases.along(&y.weights[j]);
            for (i, value) in row.iter_mut().enumerate() {
                *value = if [i, j] == [0, 0] {
                    // The aliases of the mean vanish, since `sinc` does there.
                    scale * bodies.mean_compliance()
                } else {
                    let wavenumber = y.waves[j].hypot(x.waves[i]) / half_side;
                    let own = compliance.at(wavenumber) * y.sincs[j] * x.sincs[i];
                    scale * (own + of_row.at(&x.weights[i]))
                };
            }
        });
        Self {
            transform,
            multipliers,
            lengths,
        }
    }
}

/// The waves along one side of a cell, of frequencies 0 … N/2.
struct WavesAlong {
    /// `k a = π i/N`
    waves: Vec<f64>,
    sincs: Vec<f64>,
    weights: Vec<NodeWeights>,
}

impl WavesAlong {
    fn new(length: usize) -> Self {
        let wave = |i: usize| std::f64::consts::PI * i as f64 / length as f64;
        let waves: Vec<f64> = (0..=length / 2).map(wave).collect();
        Self {
            sincs: waves.iter().map(|x| sinc(*x)).collect(),
            weights: waves.iter().map(|x| weights(*x)).collect(),
            waves,
        }
    }
}

impl ElasticOperator for PeriodicOperator {
    fn size(&self) -> usize {
        self.lengths[1]
    }

    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        let width = self.lengths[0] / 2 + 1;
        let multipliers = &self.multipliers;
        self.transform.load(pressure, 1.0);
        self.transform
            .multiply(|frequency| [&multipliers[frequency * width..][..width], &[]]);
        self.transform.restore(displacement, 1.0);
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};

    use super::*;
    use crate::{CoefficientTable, RadialTables, love};

    fn material(young_modulus: f64, poisson_ratio: f64) -> Material {
        Material::new(young_modulus, poisson_ratio).unwrap()
    }

    /// The displacements under a unit pressure on the first element.
    fn response_to_unit(bodies: &ElasticBodies, size: usize) -> Vec<f64> {
        let (mut unit, mut found) = (vec![0.0; size * size], vec![0.0; size * size]);
        unit[0] = 1.0;
        PeriodicOperator::new(bodies, 1.0, [size; 2]).apply_into(&unit, &mut found);
        found
    }

    /// On a rigid base coefficients decay exponentially, so their sum over all cells converges; elements of side 1 on
    /// layers much thinner, equally thin and thicker, compressible and incompressible.
    #[test]
    fn the_operator_sums_the_coefficients_over_all_cells() {
        let size = 6;
        for (thickness, young_modulus, poisson_ratio) in [
            (0.5, 1.0, 0.3),
            (1.0, 3.0, 0.45),
            (3.0, 1.0, 0.0),
            (2.0, 1.0, 0.2),
        ] {
            let layer = |thickness, modulus| {
                Layer::new(
                    thickness,
                    material(modulus, poisson_ratio),
                    Interface::Bonded,
                )
                .unwrap()
            };
            let layers = vec![
                layer(thickness / 2.0, 2.0 * young_modulus),
                layer(thickness / 2.0, young_modulus),
            ];
            let foundation = Foundation::new(layers, Base::Rigid).unwrap();
            let tables = RadialTables::build(&foundation).unwrap();
            let reach = 26 * size;
            let table = CoefficientTable::assemble(&tables, 1.0, reach + size).unwrap();
            let found = response_to_unit(&foundation.into(), size);
            for (element, found) in found.iter().enumerate() {
                let distance = [element / size, element % size];
                let cells = -25..=25_i32;
                let pairs = cells
                    .clone()
                    .flat_map(|x| cells.clone().map(move |y| [x, y]));
                let wanted: f64 = pairs
                    .map(|cell| {
                        let along = |axis: usize| {
                            let offset = distance[axis].cast_signed()
                                + cell[axis] as isize * size.cast_signed();
                            offset.unsigned_abs()
                        };
                        table.coefficient([along(0), along(1)])
                    })
                    .sum();
                let error = (found - wanted).abs() / table.coefficient([0, 0]);
                assert!(error < 1e-10, "{thickness} {element}: {found} {wanted}");
            }
        }
    }

    /// `u(0) − u(x)` under a unit pressure in each cell: the sum of differences over a square of cells, minus those of
    /// a uniform pressure on the square, extrapolated from three squares.
    #[test]
    fn on_a_half_space_differences_equal_those_of_the_coefficients_summed_over_all_cells() {
        let (size, steel) = (4_usize, material(1.0, 0.3));
        let found = response_to_unit(&Foundation::half_space(steel).into(), size);
        let of_cells = |most: isize, [x, y]: [isize; 2]| {
            let cells = (-most..=most).flat_map(|i| (-most..=most).map(move |j| [i, j]));
            cells
                .map(|cell| {
                    let k = |[x, y]: [isize; 2]| {
                        let along = [x + 4 * cell[0], y + 4 * cell[1]];
                        love::coefficient(&steel, 1.0, along.map(isize::unsigned_abs))
                    };
                    k([0, 0]) - k([x, y])
                })
                .sum::<f64>()
        };
        let uniform = |most: isize, [x, y]: [isize; 2]| {
            let loaded = -4 * most - 1..=4 * most + 2;
            let k = |place: [isize; 2]| -> f64 {
                let pairs = loaded
                    .clone()
                    .flat_map(|i| loaded.clone().map(move |j| [i, j]));
                pairs
                    .map(|[i, j]| {
                        let along = [place[0] - i, place[1] - j];
                        love::coefficient(&steel, 1.0, along.map(isize::unsigned_abs))
                    })
                    .sum()
            };
            (k([0, 0]) - k([x, y])) / 16.0
        };
        for place in [[1, 0], [2, 0], [1, 1], [2, 2]] {
            let [w8, w16, w32] =
                [8, 16, 32].map(|most| of_cells(most, place) - uniform(most, place));
            // The remainder falls with the first and the second power of the square's side.
            let halved = [2.0 * w16 - w8, 2.0 * w32 - w16];
            let limit = (4.0 * halved[1] - halved[0]) / 3.0;
            let [x, y] = place.map(isize::unsigned_abs);
            let difference = found[0] - found[x * size + y];
            assert!(
                (difference - limit).abs() < 1e-6 * found[0],
                "{place:?}: {difference} {limit}"
            );
        }
    }

    /// A square cell twice beside itself, along x or along y, is an oblong one.
    #[test]
    fn a_pressure_repeated_within_an_oblong_cell_displaces_it_as_a_smaller_cell() {
        let layer = Layer::new(1.5, material(5.0, 0.2), Interface::Bonded).unwrap();
        for base in [Base::Rigid, Base::HalfSpace(material(1.0, 0.3))] {
            let bodies = Foundation::new(vec![layer], base).unwrap().into();
            for size in [4, 5] {
                let pressure = |element: usize| (1.7 * (element * element) as f64).sin();
                let displaced = |lengths: [usize; 2], repeats: &dyn Fn(usize) -> usize| {
                    let elements = 0..lengths[0] * lengths[1];
                    let field: Vec<f64> = elements.map(|e| pressure(repeats(e))).collect();
                    let mut found = vec![0.0; field.len()];
                    PeriodicOperator::new(&bodies, 1.0, lengths).apply_into(&field, &mut found);
                    found
                };
                let wanted = displaced([size; 2], &|e| e);
                let largest = wanted.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
                let along_x = move |e: usize| e % (size * size);
                let along_y = move |e: usize| e / (2 * size) * size + e % size;
                for (lengths, within) in [
                    ([2 * size, size], &along_x as &dyn Fn(usize) -> usize),
                    ([size, 2 * size], &along_y),
                ] {
                    for (element, found) in displaced(lengths, within).iter().enumerate() {
                        let wanted = wanted[within(element)];
                        assert!((found - wanted).abs() < 1e-13 * largest, "{found} {wanted}");
                    }
                }
            }
        }
    }

    /// A cell has no room to widen, so a uniform pressure shortens every layer by `p H (1 + ν)(1 − 2ν)/((1 − ν) E)`,
    /// above a frictionless interface too, and a spring by `p c_n`. The mean of an elastic counterbody is left out.
    #[test]
    fn a_uniform_pressure_on_layers_over_a_rigid_base_shortens_them_as_if_confined() {
        use Interface::{Bonded, Frictionless};
        let layer = |thickness, modulus, ratio, interface| {
            Layer::new(thickness, material(modulus, ratio), interface).unwrap()
        };
        let spring = Interface::spring(0.7, 0.2).unwrap();
        let confined = |thickness: f64, modulus: f64, ratio: f64| {
            thickness * (1.0 + ratio) * (1.0 - 2.0 * ratio) / ((1.0 - ratio) * modulus)
        };
        let stacks = [
            (
                vec![layer(5.0, 10.0, 0.49, Frictionless)],
                confined(5.0, 10.0, 0.49),
            ),
            (vec![layer(1.0, 0.1, 0.5, Frictionless)], 0.0),
            (
                vec![
                    layer(0.3, 2.0, 0.1, Bonded),
                    layer(0.2, 0.7, 0.4, Frictionless),
                    layer(0.5, 3.0, 0.3, Bonded),
                ],
                confined(0.3, 2.0, 0.1) + confined(0.2, 0.7, 0.4) + confined(0.5, 3.0, 0.3),
            ),
            (
                vec![
                    layer(0.3, 2.0, 0.2, Frictionless),
                    layer(0.6, 0.5, 0.45, spring),
                    layer(0.5, 3.0, 0.5, Frictionless),
                ],
                confined(0.3, 2.0, 0.2) + confined(0.6, 0.5, 0.45) + 0.7,
            ),
        ];
        let size = 8;
        for (layers, wanted) in stacks {
            let foundation = Foundation::new(layers, Base::Rigid).unwrap();
            for counterbody in [Foundation::rigid(), material(0.01, 0.3).into()] {
                let bodies = ElasticBodies::new(foundation.clone(), counterbody);
                let mut found = vec![0.0; size * size];
                let mut operator = PeriodicOperator::new(&bodies, 1.0, [size; 2]);
                operator.apply_into(&vec![2.0; size * size], &mut found);
                for found in found {
                    // roundings, of zero those of the pressure's other waves
                    assert!((found - 2.0 * wanted).abs() < 1e-14, "{found} {wanted}");
                }
            }
        }
    }

    #[test]
    fn a_pressure_wave_displaces_the_surface_in_its_own_shape_and_a_mean_pressure_does_not() {
        let (size, steel) = (512, material(2.0, 0.3));
        let mut operator =
            PeriodicOperator::new(&Foundation::half_space(steel).into(), 1.0, [size; 2]);
        let wave = |element: usize| (TAU * (element / size) as f64 / size as f64).cos();
        let pressure: Vec<f64> = (0..size * size)
            .map(|element| 3.0 + wave(element))
            .collect();
        let mut found = vec![0.0; size * size];
        operator.apply_into(&pressure, &mut found);
        // 2/(E* k) for a smooth wave, reduced by (k a)²/6 because of the elements.
        let wavenumber = TAU / size as f64;
        let amplitude = 2.0 / (steel.plane_strain_modulus() * wavenumber);
        for (element, found) in found.iter().enumerate() {
            assert!((found - amplitude * wave(element)).abs() < 1e-5 * amplitude);
        }
    }
}
