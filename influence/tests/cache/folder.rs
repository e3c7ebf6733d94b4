//! Folders that are missing, not writable or full cost no more than time.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use pellicle_files::refusal::Refusal;
use pellicle_influence::{Cache, CacheWarning, Origin};

use super::scene::{
    ELEMENT_SIDE, SIZE, bits, coefficients, expected, filled, full_name, only_file, plain,
};

#[test]
fn a_folder_in_place_of_a_file_costs_only_the_cache() {
    let (folder, file) = filled();
    fs::remove_file(&file).unwrap();
    fs::create_dir(&file).unwrap();
    let (table, origin, warnings) = coefficients(folder.path());
    assert_eq!((origin, bits(&table)), (Origin::Computed, expected()));
    assert!(matches!(
        &warnings[..],
        [CacheWarning::Damaged { .. }, CacheWarning::Folder { .. }]
    ));
    // Nothing incomplete is left behind.
    assert_eq!(only_file(folder.path()), file);
}

#[test]
fn a_file_in_place_of_the_folder_costs_only_the_cache() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cache");
    fs::write(&path, "mine").unwrap();
    let cache = Cache::at(&path);
    for size in [SIZE, SIZE + 1] {
        let found = cache.coefficients(&plain(), ELEMENT_SIDE, size).unwrap();
        assert_eq!(found.origin, Origin::Computed);
    }
    // One warning, however many files: after the first failure the folder is not used for writing.
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
fn a_read_only_folder_is_read_but_not_written() {
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
    // The superuser can write everywhere.
    assert_eq!(cache.take_warnings().len(), usize::from(is_powerless));
}

/// Names the folder for the process that the next test starts.
const FOLDER_OF_LIMITED: &str = "PELLICLE_TEST_CACHE_OF_LIMITED";

#[cfg(unix)]
#[test]
fn a_disk_that_fills_up_within_a_file_costs_only_the_cache() {
    if let Some(folder) = std::env::var_os(FOLDER_OF_LIMITED) {
        let (table, origin, warnings) = coefficients(Path::new(&folder));
        assert_eq!((origin, bits(&table)), (Origin::Computed, expected()));
        assert!(matches!(&warnings[..], [CacheWarning::Folder { .. }]));
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    // A process whose files cannot grow beyond 8 blocks, half the size of the coefficients, and whose
    // write returns an error.
    let test = "a_disk_that_fills_up_within_a_file_costs_only_the_cache";
    let name = full_name(module_path!(), test);
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
fn the_refusal_of_any_change_costs_only_the_cache() {
    let changes = {
        let folder = tempfile::tempdir().unwrap();
        let counted = Refusal::of(folder.path(), 0..0).unwrap();
        coefficients(folder.path());
        counted.changes()
    };
    assert!(changes > 4, "{changes}");
    for number in 0..changes {
        for refused in [number..number + 1, number..usize::MAX] {
            let folder = tempfile::tempdir().unwrap();
            let refusal = Refusal::of(folder.path(), refused).unwrap();
            let (table, origin, warnings) = coefficients(folder.path());
            drop(refusal);
            assert_eq!((origin, bits(&table)), (Origin::Computed, expected()));
            assert!(warnings.len() <= 1, "{warnings:?}");
            // The next process finds the whole file or computes again, and warns of nothing.
            let (table, _, warnings) = coefficients(folder.path());
            assert_eq!((bits(&table), warnings), (expected(), vec![]));
            assert_eq!(coefficients(folder.path()).1, Origin::Disk);
        }
    }
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
    // A killed process leaves such a file behind.
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
fn a_missing_folder_is_an_empty_cache() {
    let folder = tempfile::tempdir().unwrap();
    let cache = Cache::at(folder.path().join("not/yet"));
    assert_eq!(cache.usage().unwrap().files, 0);
    assert_eq!(cache.clear().unwrap().files, 0);
    cache.coefficients(&plain(), ELEMENT_SIDE, SIZE).unwrap();
    assert_eq!(cache.usage().unwrap().files, 1);
}
