//! Files that are damaged, foreign or of other data: found out, replaced, said.

use std::fs;
use std::path::PathBuf;

use pellicle_influence::{Cache, CacheWarning, FileFault};

use crate::scene::{SIZE, fault_of, filled, only_file, plain};

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
