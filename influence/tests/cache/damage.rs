//! Files that are damaged, foreign or of other data are detected, replaced and reported.

use std::fs;
use std::io::ErrorKind;
use std::path::PathBuf;

use pellicle_influence::{Cache, CacheWarning};

use super::scene::{SIZE, assert_replaced, filled, only_file, plain};

#[test]
fn a_file_truncated_anywhere_is_recomputed() {
    let (folder, file) = filled();
    let whole = fs::read(&file).unwrap();
    for length in (0..whole.len()).step_by(16).chain([whole.len() - 1]) {
        assert_replaced(&folder, &file, &whole[..length]);
    }
    assert_eq!(fs::read(&file).unwrap(), whole);
}

#[test]
fn a_flipped_bit_is_detected_at_every_position() {
    let (folder, file) = filled();
    let whole = fs::read(&file).unwrap();
    // In the checksum, the side of an element, the size of the grid, the number of coefficients, and the coefficients.
    for place in [0, 31, 32, 39, 40, 41, 42, 43, 1000, whole.len() - 1] {
        let mut bytes = whole.clone();
        bytes[place] ^= 0x10;
        assert_replaced(&folder, &file, &bytes);
    }
}

#[test]
fn a_file_with_trailing_bytes_is_not_trusted() {
    let (folder, file) = filled();
    let whole = fs::read(&file).unwrap();
    for surplus in [1, 100_000] {
        assert_replaced(&folder, &file, &[&whole[..], &vec![0; surplus]].concat());
    }
}

#[test]
fn a_foreign_file_of_the_same_name_is_not_trusted() {
    let (folder, file) = filled();
    let diary = "Dear diary, today I measured a contact that was smaller than a hair is wide.";
    assert_replaced(&folder, &file, diary.as_bytes());
}

#[test]
fn a_file_of_other_data_is_not_trusted() {
    let (folder, file) = filled();
    let other = tempfile::tempdir().unwrap();
    let cache = Cache::at(other.path());
    cache.coefficients(&plain(), 0.2, SIZE).unwrap();
    let bytes = fs::read(only_file(other.path())).unwrap();
    assert_replaced(&folder, &file, &bytes);
}

#[test]
fn warnings_have_codes_and_say_where_and_why() {
    let (path, kind) = (PathBuf::from("folder/file"), ErrorKind::PermissionDenied);
    let warning = CacheWarning::Unreadable { path, kind };
    assert_eq!(warning.code(), "cache-file");
    let text = warning.to_string();
    assert!(text.contains("folder") && text.contains("permission denied"));
}
