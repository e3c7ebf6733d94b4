//! The cache: what comes out is what was put in, to the bit, and whatever happens to the disk costs no more than time.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::thread;

use pellicle_influence::{
    Cache, CacheWarning, CoefficientTable, FileFault, InfluenceError, Origin, RadialTables,
};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
use tempfile::TempDir;

/// Elements a side; above the border from which tables are kept on disk.
const SIZE: usize = 64;

/// m.
const ELEMENT_SIDE: f64 = 0.1;

fn material(young_modulus: f64, poisson_ratio: f64) -> Material {
    Material::new(young_modulus, poisson_ratio).unwrap()
}

fn coated() -> Foundation {
    Foundation::coated(1.0, material(10.0, 0.3), material(1.0, 0.4)).unwrap()
}

/// Three kinds: a half-space below, a rigid base with a frictionless interface, a soft middle layer.
fn foundations() -> [Foundation; 3] {
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

/// Tables of a homogeneous body: they cost nothing, and are enough where only coefficients matter.
fn plain() -> RadialTables {
    RadialTables::build(&Foundation::half_space(material(1.0, 0.3))).unwrap()
}

fn bits(table: &CoefficientTable) -> Vec<u64> {
    let offsets = (0..table.size()).flat_map(|m| (0..=m).map(move |n| [m, n]));
    offsets
        .map(|offset| table.coefficient(offset).to_bits())
        .collect()
}

/// The coefficients of `plain` by a cache that has nothing in memory, their origin, and what it warns of.
fn coefficients(folder: &Path) -> (Arc<CoefficientTable>, Origin, Vec<CacheWarning>) {
    let cache = Cache::at(folder);
    let found = cache.coefficients(&plain(), ELEMENT_SIDE, SIZE).unwrap();
    (found.value, found.origin, cache.take_warnings())
}

fn expected() -> Vec<u64> {
    bits(&CoefficientTable::assemble(&plain(), ELEMENT_SIDE, SIZE).unwrap())
}

/// A folder with the coefficients in it, and their file.
fn filled() -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(coefficients(folder.path()).1, Origin::Computed);
    let file = only_file(folder.path());
    (folder, file)
}

fn only_file(folder: &Path) -> PathBuf {
    let mut entries = fs::read_dir(folder).unwrap();
    let file = entries.next().unwrap().unwrap().path();
    assert!(entries.next().is_none());
    file
}

/// Puts bytes in the file's place: they must be found out, be replaced, and be good the next time.
fn fault_of(folder: &TempDir, file: &Path, bytes: &[u8]) -> FileFault {
    fs::write(file, bytes).unwrap();
    let (table, origin, warnings) = coefficients(folder.path());
    assert_eq!(origin, Origin::Computed);
    assert_eq!(bits(&table), expected());
    let (table, origin, none) = coefficients(folder.path());
    assert_eq!((origin, none), (Origin::Disk, Vec::new()));
    assert_eq!(bits(&table), expected());
    match &warnings[..] {
        [CacheWarning::File { path, fault }] if path == file => *fault,
        other => unreachable!("{other:?}"),
    }
}

#[test]
fn what_is_read_is_what_was_computed_to_the_bit() {
    for foundation in foundations() {
        let folder = tempfile::tempdir().unwrap();
        let fresh = || Cache::at(folder.path());
        let computed = fresh().radial_tables(&foundation).unwrap();
        let read = fresh().radial_tables(&foundation).unwrap();
        assert_eq!(
            [computed.origin, read.origin],
            [Origin::Computed, Origin::Disk]
        );
        // f64's == is not that of bits: the debug form tells −0 from 0 and gives every digit.
        assert_eq!(
            format!("{computed:?}").replace("Computed", "Disk"),
            format!("{read:?}")
        );
        // Finer and coarser than the layers, so that near, far and farthest rules are all met.
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
fn the_algorithm_has_the_version_of_its_numbers() {
    // If this fails after a change of the arithmetic, put the new numbers here and raise `ALGORITHM` in `src/cache/key.rs`: files that were
    // written before must not be read any more. Length of the file of the tables, and two coefficients of each foundation.
    const WANTED: [(u64, [f64; 2]); 3] = [
        (88_736, [0.027_990_277_932_129_31, 0.015_399_846_106_460_89]),
        (
            75_776,
            [0.016_093_420_222_857_147, -4.869_525_496_913_644e-5],
        ),
        (
            94_856,
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
fn memory_is_shared_by_clones_and_asked_first() {
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
fn other_grids_and_foundations_are_other_data() {
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
fn no_cache_computes_every_time() {
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
fn what_is_computed_as_fast_as_read_is_not_written() {
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
fn a_file_cut_off_anywhere_is_computed_again() {
    let (folder, file) = filled();
    let whole = fs::read(&file).unwrap();
    for length in (0..whole.len()).step_by(16).chain([whole.len() - 1]) {
        let fault = fault_of(&folder, &file, &whole[..length]);
        match fault {
            FileFault::Foreign => assert!(length < 8),
            FileFault::Length { found, .. } => assert_eq!(found, length as u64),
            other => unreachable!("{length}: {other}"),
        }
    }
    assert_eq!(fs::read(&file).unwrap(), whole);
}

#[test]
fn a_turned_bit_is_found_wherever_it_is() {
    let (folder, file) = filled();
    let whole = fs::read(&file).unwrap();
    for place in [0, 8, 15, 16, 47, 48, 55, 56, 87, 88, 1000, whole.len() - 1] {
        let mut bytes = whole.clone();
        bytes[place] ^= 0x10;
        let fault = fault_of(&folder, &file, &bytes);
        let as_expected = match place {
            0..8 => fault == FileFault::Foreign,
            8..16 => matches!(fault, FileFault::Version { .. }),
            16..48 => fault == FileFault::OtherData,
            48..56 => matches!(fault, FileFault::Length { .. }),
            _ => fault == FileFault::Checksum,
        };
        assert!(as_expected, "{place}: {fault}");
    }
}

#[test]
fn a_file_that_is_too_long_is_not_even_read() {
    let (folder, file) = filled();
    let whole = fs::read(&file).unwrap();
    let longer = [&whole[..], &[0]].concat();
    let wanted = whole.len() as u64;
    let found = wanted + 1;
    assert_eq!(
        fault_of(&folder, &file, &longer),
        FileFault::Length { found, wanted }
    );
}

#[test]
fn a_foreign_file_of_the_same_name_is_not_trusted() {
    let (folder, file) = filled();
    assert_eq!(
        fault_of(&folder, &file, b"Dear diary, today"),
        FileFault::Foreign
    );
    assert_eq!(fault_of(&folder, &file, b""), FileFault::Foreign);
}

#[test]
fn a_file_of_a_later_version_is_not_trusted() {
    let (folder, file) = filled();
    let mut bytes = fs::read(&file).unwrap();
    bytes[8] += 1;
    let found = u64::from(bytes[8]);
    assert!(matches!(
        fault_of(&folder, &file, &bytes),
        FileFault::Version { found: f, wanted } if f == found && u64::from(wanted) + 1 == found
    ));
}

#[test]
fn a_file_of_other_data_is_not_trusted() {
    let (folder, file) = filled();
    let other = tempfile::tempdir().unwrap();
    let cache = Cache::at(other.path());
    cache.coefficients(&plain(), 0.2, SIZE).unwrap();
    let bytes = fs::read(only_file(other.path())).unwrap();
    assert_eq!(fault_of(&folder, &file, &bytes), FileFault::OtherData);
}

#[test]
fn a_folder_in_a_files_place_costs_only_the_cache() {
    let (folder, file) = filled();
    fs::remove_file(&file).unwrap();
    fs::create_dir(&file).unwrap();
    let (table, origin, warnings) = coefficients(folder.path());
    assert_eq!((origin, bits(&table)), (Origin::Computed, expected()));
    assert!(matches!(
        &warnings[..],
        [
            CacheWarning::File {
                fault: FileFault::NotAFile,
                ..
            },
            CacheWarning::Folder { .. }
        ]
    ));
    // Nothing incomplete is left behind.
    assert_eq!(only_file(folder.path()), file);
}

#[test]
fn a_file_in_the_folders_place_costs_only_the_cache() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cache");
    fs::write(&path, "mine").unwrap();
    let cache = Cache::at(&path);
    for size in [SIZE, SIZE + 1] {
        let found = cache.coefficients(&plain(), ELEMENT_SIDE, size).unwrap();
        assert_eq!(found.origin, Origin::Computed);
    }
    // One warning, however many files: after the first refusal the folder is left alone.
    let warnings = cache.take_warnings();
    assert!(
        matches!(&warnings[..], [CacheWarning::Folder { path: found, .. }] if *found == path),
        "{warnings:?}"
    );
    assert_eq!(cache.take_warnings(), []);
    assert!(cache.usage().is_err() && cache.clear().is_err());
    assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
}

#[test]
fn a_folder_that_cannot_be_created_costs_only_the_cache() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("file"), "").unwrap();
    let (table, origin, warnings) = coefficients(&folder.path().join("file/below/it"));
    assert_eq!((origin, bits(&table)), (Origin::Computed, expected()));
    assert!(matches!(&warnings[..], [CacheWarning::Folder { .. }]));
}

#[cfg(unix)]
#[test]
fn a_read_only_folder_gives_what_it_has_and_takes_nothing() {
    use std::os::unix::fs::PermissionsExt;
    let (folder, _file) = filled();
    let set = |mode| fs::set_permissions(folder.path(), fs::Permissions::from_mode(mode)).unwrap();
    set(0o555);
    let is_powerless = tempfile::tempfile_in(folder.path()).is_err();
    let cache = Cache::at(folder.path());
    let known = cache.coefficients(&plain(), ELEMENT_SIDE, SIZE).unwrap();
    let new = cache.coefficients(&plain(), 0.2, SIZE).unwrap();
    set(0o755);
    assert_eq!([known.origin, new.origin], [Origin::Disk, Origin::Computed]);
    // The superuser writes everywhere.
    assert_eq!(cache.take_warnings().len(), usize::from(is_powerless));
}

/// Names the folder for the process that the next test starts.
const FOLDER_OF_LIMITED: &str = "PELLICLE_TEST_CACHE_OF_LIMITED";

#[cfg(unix)]
#[test]
fn a_disk_that_is_full_in_the_middle_of_a_file_costs_only_the_cache() {
    if let Some(folder) = std::env::var_os(FOLDER_OF_LIMITED) {
        let (table, origin, warnings) = coefficients(Path::new(&folder));
        assert_eq!((origin, bits(&table)), (Origin::Computed, expected()));
        assert!(matches!(&warnings[..], [CacheWarning::Folder { .. }]));
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    // A process whose files cannot grow beyond 8 blocks, half of what the coefficients take, and that is told so by the write.
    let name = "a_disk_that_is_full_in_the_middle_of_a_file_costs_only_the_cache";
    let line = format!("trap '' XFSZ; ulimit -f 8; exec \"$0\" {name} --exact");
    let mut limited = Command::new("sh");
    limited.arg("-c").arg(line);
    limited.arg(std::env::current_exe().unwrap());
    limited.env(FOLDER_OF_LIMITED, folder.path());
    let status = limited.stdout(Stdio::null()).status().unwrap();
    assert!(status.success());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn threads_may_write_and_read_the_same_data_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let wanted = expected();
    thread::scope(|scope| {
        for _ in 0..8 {
            scope.spawn(|| {
                for _ in 0..20 {
                    let (table, _, warnings) = coefficients(folder.path());
                    assert_eq!((bits(&table), warnings), (wanted.clone(), Vec::new()));
                }
            });
        }
    });
    only_file(folder.path());
}

/// Names the folder for the processes that the next test starts.
const FOLDER_OF_CHILD: &str = "PELLICLE_TEST_CACHE_OF_CHILD";

#[test]
fn processes_may_write_read_and_clear_at_once() {
    if let Some(folder) = std::env::var_os(FOLDER_OF_CHILD) {
        for round in 0..30 {
            let (table, _, warnings) = coefficients(Path::new(&folder));
            assert_eq!((bits(&table), warnings), (expected(), Vec::new()));
            if round % 7 == 0 {
                Cache::at(&folder).clear().unwrap();
            }
        }
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let name = "processes_may_write_read_and_clear_at_once";
    let start = || {
        Command::new(std::env::current_exe().unwrap())
            .args([name, "--exact"])
            .env(FOLDER_OF_CHILD, folder.path())
            .stdout(Stdio::null())
            .spawn()
            .unwrap()
    };
    for mut child in [start(), start(), start()] {
        assert!(child.wait().unwrap().success());
    }
    assert!(fs::read_dir(folder.path()).unwrap().count() <= 1);
}

#[test]
fn clearing_removes_the_caches_own_files_and_no_other() {
    let (folder, file) = filled();
    let bytes = fs::metadata(&file).unwrap().len();
    let name = file.file_name().unwrap().to_str().unwrap().to_owned();
    let foreign = [
        "notes.txt".to_owned(),
        "notes.pellicle".to_owned(),
        format!("{name}.bak"),
        name.to_uppercase(),
    ];
    for name in &foreign {
        fs::write(folder.path().join(name), "mine").unwrap();
    }
    fs::create_dir(folder.path().join(name.replace(['0', '1', '2', '3'], "f"))).unwrap();
    // What a process that was killed leaves behind.
    fs::write(folder.path().join(".pellicle-abc.partial"), "half").unwrap();
    let cache = Cache::at(folder.path());
    let usage = cache.usage().unwrap();
    assert_eq!((usage.files, usage.bytes), (2, bytes + 4));
    assert_eq!(cache.clear().unwrap(), usage);
    assert_eq!(cache.usage().unwrap().files, 0);
    for name in &foreign {
        assert!(folder.path().join(name).exists(), "{name}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 5);
    assert_eq!(coefficients(folder.path()).1, Origin::Computed);
}

#[test]
fn a_folder_that_is_not_there_yet_is_an_empty_cache() {
    let folder = tempfile::tempdir().unwrap();
    let cache = Cache::at(folder.path().join("not/yet"));
    assert_eq!(cache.usage().unwrap().files, 0);
    assert_eq!(cache.clear().unwrap().files, 0);
    cache.coefficients(&plain(), ELEMENT_SIDE, SIZE).unwrap();
    assert_eq!(cache.usage().unwrap().files, 1);
}

#[test]
fn errors_are_those_of_the_computation() {
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
fn warnings_have_codes_and_say_where_and_why() {
    let fault = FileFault::Length {
        found: 3,
        wanted: 88,
    };
    let path = PathBuf::from("folder/file");
    let warning = CacheWarning::File { path, fault };
    assert_eq!(warning.code(), "cache-file");
    let text = warning.to_string();
    assert!(text.contains("folder") && text.contains("3 bytes, wanted 88"));
}
