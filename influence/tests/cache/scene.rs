//! Foundations, folders and files for the cache's tests.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use pellicle_influence::{Cache, CacheWarning, CoefficientTable, Origin, RadialTables};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
use tempfile::TempDir;

/// Elements per side; above the threshold from which tables are kept on disk.
pub const SIZE: usize = 64;

/// m.
pub const ELEMENT_SIDE: f64 = 0.1;

pub fn material(young_modulus: f64, poisson_ratio: f64) -> Material {
    Material::new(young_modulus, poisson_ratio).unwrap()
}

pub fn coated() -> Foundation {
    Foundation::coated(1.0, material(10.0, 0.3), material(1.0, 0.4)).unwrap()
}

/// Three kinds: a half-space below, a rigid base with a frictionless interface, a soft middle layer.
pub fn foundations() -> [Foundation; 3] {
    let layer = |thickness, young_modulus, interface| {
        Layer::new(thickness, material(young_modulus, 0.45), interface).unwrap()
    };
    let on_rigid = vec![layer(0.5, 2.0, Interface::Frictionless)];
    let soft = vec![
        layer(0.1, 5.0, Interface::Bonded),
        layer(1.0, 0.05, Interface::Bonded),
    ];
    [
        coated(),
        Foundation::new(on_rigid, Base::Rigid).unwrap(),
        Foundation::new(soft, Base::HalfSpace(material(1.0, 0.3))).unwrap(),
    ]
}

/// Tables of a homogeneous body: they cost nothing, and suffice where only coefficients matter.
pub fn plain() -> RadialTables {
    RadialTables::build(&Foundation::half_space(material(1.0, 0.3))).unwrap()
}

pub fn bits(table: &CoefficientTable) -> Vec<u64> {
    let offsets = (0..table.size()).flat_map(|m| (0..=m).map(move |n| [m, n]));
    offsets
        .map(|offset| table.coefficient(offset).to_bits())
        .collect()
}

/// The coefficients of `plain` from a cache with nothing in memory, their origin, and its warnings.
pub fn coefficients(folder: &Path) -> (Arc<CoefficientTable>, Origin, Vec<CacheWarning>) {
    let cache = Cache::at(folder);
    let found = cache.coefficients(&plain(), ELEMENT_SIDE, SIZE).unwrap();
    (found.value, found.origin, cache.take_warnings())
}

pub fn expected() -> Vec<u64> {
    bits(&CoefficientTable::assemble(&plain(), ELEMENT_SIDE, SIZE).unwrap())
}

/// A folder with the coefficients in it, and their file.
pub fn filled() -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(coefficients(folder.path()).1, Origin::Computed);
    let file = only_file(folder.path());
    (folder, file)
}

pub fn only_file(folder: &Path) -> PathBuf {
    let mut entries = fs::read_dir(folder).unwrap();
    let file = entries.next().unwrap().unwrap().path();
    assert!(entries.next().is_none());
    file
}

/// Replaces the file by these bytes: they must be detected, reported and replaced, and the file valid the next time.
pub fn assert_replaced(folder: &TempDir, file: &Path, bytes: &[u8]) {
    fs::write(file, bytes).unwrap();
    let (table, origin, warnings) = coefficients(folder.path());
    assert_eq!((origin, bits(&table)), (Origin::Computed, expected()));
    let path = file.to_owned();
    assert_eq!(warnings, [CacheWarning::Damaged { path }]);
    let (table, origin, none) = coefficients(folder.path());
    assert_eq!((origin, none), (Origin::Disk, Vec::new()));
    assert_eq!(bits(&table), expected());
}

/// The name by which this binary knows a test of a module, for a process that runs it alone.
pub fn full_name(module: &str, test: &str) -> String {
    let (_, inside) = module.split_once("::").unwrap();
    format!("{inside}::{test}")
}
