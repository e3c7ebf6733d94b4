//! Tables are read back to the bit, and are kept where it pays.

use std::fs;
use std::sync::Arc;

use pellicle_influence::{Cache, CoefficientTable, InfluenceError, Origin, RadialTables};
use pellicle_kernel::Foundation;

use super::scene::{ELEMENT_SIDE, SIZE, bits, coated, filled, foundations, material, plain};

#[test]
fn data_read_equal_the_data_computed_to_the_bit() {
    for foundation in foundations() {
        let folder = tempfile::tempdir().unwrap();
        let fresh = || Cache::at(folder.path());
        let computed = fresh().radial_tables(&foundation).unwrap();
        let read = fresh().radial_tables(&foundation).unwrap();
        assert_eq!(
            [computed.origin, read.origin],
            [Origin::Computed, Origin::Disk]
        );
        // `==` of f64 does not compare bits: the debug form distinguishes −0 from 0 and gives every digit.
        assert_eq!(
            format!("{computed:?}").replace("Computed", "Disk"),
            format!("{read:?}")
        );
        // Finer and coarser than the layers, so that near, far and farthest rules are all used.
        for element_side in [0.01, 1.0, 50.0] {
            let get = |cache: &Cache, tables| cache.coefficients(tables, element_side, SIZE);
            let plain = CoefficientTable::assemble(&computed.value, element_side, SIZE).unwrap();
            let computed = get(&fresh(), &read.value).unwrap();
            let read = get(&fresh(), &read.value).unwrap();
            assert_eq!(
                [computed.origin, read.origin],
                [Origin::Computed, Origin::Disk]
            );
            assert_eq!(bits(&computed.value), bits(&plain));
            assert_eq!(bits(&read.value), bits(&plain));
        }
    }
}

#[test]
fn changed_numbers_need_a_new_version() {
    // If this fails after a change of the arithmetic, put the new numbers here and raise `VERSION` in
    // `src/cache.rs`: files written before must no longer be read. Length of the file of the tables, and two
    // coefficients of each foundation.
    const WANTED: [(u64, [f64; 2]); 3] = [
        (88_694, [0.027_990_277_932_129_31, 0.015_399_846_106_460_89]),
        (
            75_710,
            [0.016_093_420_222_857_147, -4.869_525_496_913_644e-5],
        ),
        (
            94_790,
            [0.865_603_989_171_769_5, -0.024_999_332_493_193_194],
        ),
    ];
    for (foundation, (length, coefficients)) in foundations().iter().zip(WANTED) {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::at(folder.path());
        let tables = cache.radial_tables(foundation).unwrap().value;
        let found = [[1, 0], [4, 3]].map(|offset| tables.coefficient(0.3, offset));
        assert_eq!(cache.usage().unwrap().bytes, length);
        for (found, wanted) in found.iter().zip(coefficients) {
            // Exponentials and logarithms differ in the last place between platforms.
            let error = (found - wanted).abs() / coefficients[0];
            assert!(error < 1e-14, "{found:e}, {wanted:e}");
        }
    }
}

#[test]
fn clones_share_the_memory_and_search_it_first() {
    let (folder, file) = filled();
    let cache = Cache::at(folder.path());
    let get = |cache: &Cache| cache.coefficients(&plain(), ELEMENT_SIDE, SIZE).unwrap();
    let read = get(&cache);
    fs::remove_file(file).unwrap();
    let again = get(&cache.clone());
    assert_eq!([read.origin, again.origin], [Origin::Disk, Origin::Memory]);
    assert!(Arc::ptr_eq(&read.value, &again.value));
}

#[test]
fn other_grids_and_foundations_are_cached_separately() {
    let cache = Cache::in_memory();
    let tables = cache.radial_tables(&coated()).unwrap().value;
    let origin =
        |tables: &RadialTables, side, size| cache.coefficients(tables, side, size).unwrap().origin;
    for (tables, side, size) in [
        (&*tables, 0.1, SIZE),
        (&*tables, 0.1_f64.next_up(), SIZE),
        (&*tables, 0.1, SIZE + 1),
        (&plain(), 0.1, SIZE),
    ] {
        assert_eq!(origin(tables, side, size), Origin::Computed);
        assert_eq!(origin(tables, side, size), Origin::Memory);
    }
}

#[test]
fn without_a_cache_data_are_computed_every_time() {
    let cache = Cache::none();
    for _ in 0..2 {
        let found = cache.coefficients(&plain(), ELEMENT_SIDE, SIZE).unwrap();
        assert_eq!(found.origin, Origin::Computed);
    }
    assert_eq!(cache.folder(), None);
    assert_eq!(cache.usage().unwrap().files, 0);
    assert_eq!(cache.clear().unwrap().files, 0);
}

#[test]
fn data_computed_as_fast_as_read_are_not_written() {
    let folder = tempfile::tempdir().unwrap();
    let cache = Cache::at(folder.path().join("cache"));
    let homogeneous = Foundation::half_space(material(1.0, 0.3));
    let tables = cache.radial_tables(&homogeneous).unwrap();
    let small = cache
        .coefficients(&tables.value, 0.1, Cache::SMALLEST_STORED - 1)
        .unwrap();
    assert_eq!([tables.origin, small.origin], [Origin::Immediate; 2]);
    assert!(!folder.path().join("cache").exists());
    assert_eq!(cache.take_warnings(), []);
}

#[test]
fn errors_of_the_computation_are_passed_on() {
    let folder = tempfile::tempdir().unwrap();
    let cache = Cache::at(folder.path());
    assert!(matches!(
        cache.coefficients(&plain(), f64::NAN, SIZE),
        Err(InfluenceError::ElementSide { .. })
    ));
    assert!(matches!(
        cache.coefficients(&plain(), 1.0, usize::MAX),
        Err(InfluenceError::TableSize { .. })
    ));
    assert_eq!(cache.usage().unwrap().files, 0);
}

#[test]
fn perturbed_coefficients_are_wrong_by_the_factor_and_never_cached() {
    let folder = tempfile::tempdir().unwrap();
    let cache = Cache::at(folder.path());
    let get = |tables: &RadialTables| cache.coefficients(tables, ELEMENT_SIDE, SIZE).unwrap();
    let wrong = get(&plain().perturbed(1e-3)).value;
    assert_eq!(cache.usage().unwrap().files, 0);
    let right = get(&plain());
    assert_eq!(right.origin, Origin::Computed);
    let ratio = wrong.coefficient([5, 2]) / right.value.coefficient([5, 2]);
    // Two roundings.
    assert!((ratio - 1.001).abs() < 1e-15);
    // And the correct data are not found for it.
    let again = get(&plain().perturbed(1e-3)).value;
    assert_eq!(bits(&again), bits(&wrong));
}
