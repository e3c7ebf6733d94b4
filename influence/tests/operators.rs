//! The product `K p`: two implementations, one answer.

use std::iter::successors;

use pellicle_influence::{
    CoefficientTable, ConvolutionOperator, DenseOperator, ElasticOperator, Sector, SectorGrid,
    WindowOperator, love,
};
use pellicle_kernel::Material;

fn steel_table(size: usize) -> CoefficientTable {
    let steel = Material::new(210e9, 0.3).expect("valid input");
    CoefficientTable::from_fn(1e-6, size, |offset| love::coefficient(&steel, 1e-6, offset))
        .expect("valid input")
}

/// Reproducible numbers between 0 and 1 without a pattern.
fn scattered(count: usize) -> Vec<f64> {
    let next = |state: &u64| {
        Some(
            state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1),
        )
    };
    let states = successors(Some(42_u64), next).skip(1).take(count);
    states
        .map(|state| (state >> 11) as f64 / (1_u64 << 53) as f64)
        .collect()
}

fn apply(operator: &mut dyn ElasticOperator, pressure: &[f64]) -> Vec<f64> {
    let mut displacement = vec![f64::NAN; pressure.len()];
    operator.apply_into(pressure, &mut displacement);
    displacement
}

fn largest(field: &[f64]) -> f64 {
    field
        .iter()
        .fold(0.0, |largest: f64, value| largest.max(value.abs()))
}

#[test]
fn both_operators_agree_to_rounding() {
    for size in [1, 2, 3, 5, 16, 17, 31, 48, 67] {
        let table = steel_table(size);
        let pressure = scattered(size * size);
        let fast = apply(&mut ConvolutionOperator::new(&table), &pressure);
        let dense = apply(&mut DenseOperator::new(&table), &pressure);
        let difference: Vec<f64> = fast.iter().zip(&dense).map(|(a, b)| a - b).collect();
        // Rounding of transforms of up to 144² numbers and of sums of up to 67² terms.
        assert!(largest(&difference) < 1e-13 * largest(&dense), "N = {size}");
    }
}

/// The field on the whole grid from that on a quadrant, mirrored in both axes.
fn unfolded(quadrant: &[f64], size: usize) -> Vec<f64> {
    let along = |i: usize| if i < size { size - 1 - i } else { i - size };
    (0..4 * size * size)
        .map(|e| quadrant[along(e / (2 * size)) * size + along(e % (2 * size))])
        .collect()
}

#[test]
fn a_quadrant_is_displaced_like_the_whole_surface() {
    for size in [1, 2, 3, 5, 8, 9, 31, 64] {
        let table = steel_table(2 * size);
        for loaded in [1, size.div_ceil(3), size.div_ceil(2), size] {
            let loads = scattered(loaded * loaded);
            let mut pressure = vec![0.0; size * size];
            for (row, loads) in pressure
                .chunks_exact_mut(size)
                .zip(loads.chunks_exact(loaded))
            {
                row[..loaded].copy_from_slice(loads);
            }
            let expected = apply(
                &mut ConvolutionOperator::new(&table),
                &unfolded(&pressure, size),
            );
            let mut found = vec![f64::NAN; size * size];
            let quadrant = SectorGrid::new(Sector::Quadrant, size);
            let mut under_window = WindowOperator::new(&table, quadrant, [0; 2], loaded);
            let mut operator = ConvolutionOperator::on(&table, quadrant);
            for is_whole in [false, false, true, true] {
                if is_whole {
                    operator.apply_into(&pressure, &mut found);
                } else {
                    under_window.apply_into(&loads, &mut found);
                }
                let found = unfolded(&found, size);
                let difference: Vec<f64> =
                    found.iter().zip(&expected).map(|(a, b)| a - b).collect();
                // Rounding of two transforms.
                let bound = 1e-14 * largest(&expected);
                assert!(largest(&difference) < bound, "{loaded} of {size}");
            }
        }
    }
}

#[test]
fn a_half_is_displaced_like_the_whole_surface() {
    let unfolded = |half: &[f64], size: usize| -> Vec<f64> {
        let along = |j: usize| if j < size { size - 1 - j } else { j - size };
        let elements = 0..4 * size * size;
        elements
            .map(|e| half[e / (2 * size) * size + along(e % (2 * size))])
            .collect()
    };
    for size in [1, 2, 3, 5, 8, 9, 31, 64] {
        let table = steel_table(2 * size);
        let half = SectorGrid::new(Sector::Half, size);
        let mut operator = ConvolutionOperator::on(&table, half);
        for loaded in [1, size.div_ceil(3), size.div_ceil(2), size] {
            let loads = scattered(2 * loaded * loaded);
            for above in [0, (size - loaded).div_ceil(2), 2 * (size - loaded)] {
                let mut pressure = vec![0.0; 2 * size * size];
                let rows = pressure.chunks_exact_mut(size).skip(above);
                for (row, loads) in rows.zip(loads.chunks_exact(loaded)) {
                    row[..loaded].copy_from_slice(loads);
                }
                let expected = apply(
                    &mut ConvolutionOperator::new(&table),
                    &unfolded(&pressure, size),
                );
                let mut under_window = WindowOperator::new(&table, half, [above, 0], loaded);
                let mut found = [vec![f64::NAN; 2 * size * size], pressure.clone()];
                for _ in 0..2 {
                    under_window.apply_into(&loads, &mut found[0]);
                }
                operator.apply_into(&pressure, &mut found[1]);
                for found in found {
                    let found = unfolded(&found, size);
                    let difference: Vec<f64> =
                        found.iter().zip(&expected).map(|(a, b)| a - b).collect();
                    // Rounding of two transforms.
                    let bound = 1e-14 * largest(&expected);
                    assert!(largest(&difference) < bound, "{loaded} of {size}, {above}");
                }
            }
        }
    }
}

#[test]
fn a_window_gives_the_displacement_of_the_whole_pressure() {
    // In the middle, at two borders, at a corner, one element, all.
    for (size, origin, part) in [
        (40, [12, 14], 15),
        (40, [0, 13], 20),
        (37, [7, 11], 26),
        (33, [28, 0], 5),
        (24, [23, 23], 1),
        (18, [0, 0], 18),
    ] {
        let table = steel_table(size);
        let loads = scattered(part * part);
        let mut pressure = vec![0.0; size * size];
        for (i, row) in loads.chunks_exact(part).enumerate() {
            let first = (origin[0] + i) * size + origin[1];
            pressure[first..first + part].copy_from_slice(row);
        }
        let expected = apply(&mut ConvolutionOperator::new(&table), &pressure);
        let mut found = vec![f64::NAN; size * size];
        let mut under_window = WindowOperator::new(&table, SectorGrid::whole(size), origin, part);
        for _ in 0..2 {
            under_window.apply_into(&loads, &mut found);
            for (u, wanted) in found.iter().zip(&expected) {
                // Rounding of two transforms.
                assert!(
                    (u - wanted).abs() < 1e-14 * largest(&expected),
                    "{origin:?} + {part} of {size}"
                );
            }
        }
    }
}

#[test]
fn a_window_beyond_the_grid_is_no_window() {
    for (grid, origin, size) in [
        (8, [5, 0], 4),
        (8, [0, 6], 3),
        (8, [0, 0], 9),
        (8, [2, 2], 0),
        (9, [2, 2], 3),
    ] {
        let attempt = std::panic::catch_unwind(|| {
            WindowOperator::new(&steel_table(8), SectorGrid::whole(grid), origin, size)
        });
        assert!(attempt.is_err(), "{origin:?}, {size} of {grid}");
    }
}

#[test]
fn a_second_product_is_independent_of_the_first() {
    let table = steel_table(20);
    let mut operator = ConvolutionOperator::new(&table);
    let pressure = scattered(400);
    let first = apply(&mut operator, &pressure);
    let nothing = apply(&mut operator, &[0.0; 400]);
    assert!(nothing.iter().all(|u| *u == 0.0));
    assert_eq!(apply(&mut operator, &pressure), first);
}

#[test]
fn one_loaded_element_gives_the_coefficients_themselves() {
    let size = 24;
    let table = steel_table(size);
    let mut pressure = vec![0.0; size * size];
    pressure[5 * size + 7] = 1.0;
    let found = apply(&mut ConvolutionOperator::new(&table), &pressure);
    for i in 0..size {
        for j in 0..size {
            let expected = table.coefficient([i.abs_diff(5), j.abs_diff(7)]);
            // Rounding of the transforms, relative to the largest coefficient.
            assert!((found[i * size + j] - expected).abs() < 1e-14 * table.coefficient([0, 0]));
        }
    }
}

#[test]
fn the_result_has_the_same_bits_for_every_number_of_threads() {
    let table = steel_table(150);
    let pressure = scattered(150 * 150);
    let with_threads = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| apply(&mut ConvolutionOperator::new(&table), &pressure))
    };
    let alone = with_threads(1);
    for threads in [2, 3, 7] {
        assert_eq!(with_threads(threads), alone);
    }
}

#[test]
fn the_product_is_symmetric() {
    let size = 32;
    let mut operator = ConvolutionOperator::new(&steel_table(size));
    let p = scattered(size * size);
    let q: Vec<f64> = p.iter().rev().map(|value| value * value).collect();
    let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let (left, right) = (
        dot(&q, &apply(&mut operator, &p)),
        dot(&p, &apply(&mut operator, &q)),
    );
    // Rounding of two products and two sums of 1024 terms.
    assert!((left / right - 1.0).abs() < 1e-13);
}
