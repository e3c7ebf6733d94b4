//! Threads and processes at once.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;

use pellicle_influence::Cache;

use super::scene::{bits, coefficients, expected, full_name, only_file};

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
    let test = "processes_may_write_read_and_clear_at_once";
    let name = full_name(module_path!(), test);
    let start = || {
        Command::new(std::env::current_exe().unwrap())
            .args([&name, "--exact"])
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
