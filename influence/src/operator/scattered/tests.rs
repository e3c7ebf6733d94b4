//! Products among scattered elements, compared with those on the whole window.

use rayon::ThreadPoolBuilder;

use super::smooth::{ORDER, RADIUS};
use super::{ScatteredOperator, scattered_work};
use crate::operator::{ConvolutionOperator, ElasticOperator};
use crate::{CoefficientTable, RadialTables, SectorGrid};
use pellicle_kernel::{Foundation, Material};

const SIZE: usize = 300;

fn table(foundation: &Foundation, size: usize) -> CoefficientTable {
    let tables = RadialTables::build(foundation).unwrap();
    CoefficientTable::assemble(&tables, 1e-6, size).unwrap()
}

fn steel() -> Material {
    Material::new(210e9, 0.3).unwrap()
}

/// Discs of different sizes, some on the border.
fn islands(size: usize) -> Vec<u32> {
    let discs = [
        (0.0, 5.0, 9.0),
        (77.0, 140.0, 17.0),
        (120.0, 160.0, 5.0),
        (299.0, 299.0, 22.0),
        (210.0, 3.0, 1.0),
    ];
    let within = |e: &usize| {
        let [x, y] = [e / size, e % size].map(|i| i as f64);
        discs.iter().any(|(a, b, r)| (x - a).hypot(y - b) <= *r)
    };
    (0..size * size)
        .filter(within)
        .map(|e| u32::try_from(e).unwrap())
        .collect()
}

/// Displacements of the elements by the restricted and by the whole product, with pressures on two of three elements.
fn both(table: &CoefficientTable, size: usize) -> [Vec<f64>; 2] {
    let elements = islands(size);
    let pressure: Vec<f64> = (0..elements.len())
        .map(|at| {
            if at % 3 == 0 {
                0.0
            } else {
                1.0 + (at as f64).sin()
            }
        })
        .collect();
    let mut found = vec![0.0; elements.len()];
    let mut operator = ScatteredOperator::new(table, size, &elements).unwrap();
    operator.apply_into(&pressure, &mut found);
    let mut field = vec![0.0; size * size];
    for (element, p) in elements.iter().zip(&pressure) {
        field[*element as usize] = *p;
    }
    let mut whole = vec![0.0; size * size];
    ConvolutionOperator::on(table, SectorGrid::whole(size)).apply_into(&field, &mut whole);
    [
        found,
        elements
            .iter()
            .map(|element| whole[*element as usize])
            .collect(),
    ]
}

/// The largest difference, relative to the largest displacement.
fn difference([found, whole]: &[Vec<f64>; 2]) -> f64 {
    let largest =
        |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |most: f64, u| most.max(u.abs()));
    let off = largest(&mut found.iter().zip(whole).map(|(a, b)| a - b));
    off / largest(&mut whole.iter().copied())
}

#[test]
fn scattered_elements_are_displaced_like_the_whole_grid() {
    let soft = Material::new(2e9, 0.49).unwrap();
    let coatings = [1e-6, 1e-5, 1e-4].map(|h| Foundation::coated(h, soft, steel()).unwrap());
    for foundation in [Foundation::half_space(steel())].iter().chain(&coatings) {
        // On the whole grid of a table, nodes lie beyond its offsets; with a small table, far beyond.
        for (of, size, bound) in [(SIZE, SIZE, 2e-9), (SIZE, 213, 2e-9), (200, 200, 2e-8)] {
            let off = difference(&both(&table(foundation, of), size));
            assert!(off < bound, "{of} {size}: {off}");
        }
    }
}

#[test]
fn every_number_of_threads_gives_the_same_bits() {
    let table = table(&Foundation::half_space(steel()), SIZE);
    let with = |threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| both(&table, SIZE)[0].clone())
    };
    let bits = |field: Vec<f64>| field.into_iter().map(f64::to_bits).collect::<Vec<_>>();
    assert_eq!(bits(with(1)), bits(with(3)));
}

#[test]
fn near_pairs_are_counted_and_far_ones_are_not() {
    let far = [0, u32::try_from(SIZE * SIZE - 1).unwrap()];
    let interpolated = 2 * (ORDER * ORDER) * 2;
    assert_eq!(scattered_work(SIZE, &far), 2 + interpolated);
    assert_eq!(scattered_work(SIZE, &[0, 1]), 4 + interpolated);
    assert!(
        ScatteredOperator::new(&table(&Foundation::half_space(steel()), SIZE), RADIUS, &[0])
            .is_none()
    );
}
