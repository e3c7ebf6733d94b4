//! The cache between runs: its contents, the message when it fails, and `pellicle cache`.

use std::fs;
use std::path::PathBuf;

use serde_json::Value;

use super::runner::{CASE, ProgramOutput, TestFolder};

/// A grid large enough for its coefficients to be kept, and two coarser ones.
const SIZE: &str = "grid.elements=128";

/// Runs the program with its cache in the folder `kept`.
fn with_cache(folder: &TestFolder, arguments: &[&str]) -> ProgramOutput {
    let mut command = folder.command(arguments);
    TestFolder::ran(command.env("PELLICLE_CACHE", folder.path("kept")))
}

fn summary(folder: &TestFolder) -> Value {
    with_cache(folder, &["run", "case.toml", "--json", "--set", SIZE]).json()
}

fn is_from_cache(summary: &Value) -> bool {
    summary["timing"]["coefficients_from_cache"]
        .as_bool()
        .unwrap()
}

fn codes(summary: &Value) -> Vec<&str> {
    let warnings = summary["warnings"].as_array().unwrap().iter();
    let codes = warnings.map(|warning| warning["code"].as_str().unwrap());
    codes.filter(|code| code.starts_with("cache")).collect()
}

fn kept(folder: &TestFolder) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder.path("kept")).unwrap();
    entries.map(|entry| entry.unwrap().path()).collect()
}

#[test]
fn the_second_run_reads_its_coefficients_and_gives_the_same_bits() {
    let folder = TestFolder::with_case(CASE);
    let [first, second] = [summary(&folder), summary(&folder)];
    assert_eq!(
        [is_from_cache(&first), is_from_cache(&second)],
        [false, true]
    );
    let numbers = |summary: &Value| {
        let step = &summary["steps"][0];
        [&step["penetration"], &step["max_pressure"]]
            .map(|number| number.as_f64().unwrap().to_bits())
    };
    assert_eq!(numbers(&first), numbers(&second));
    assert_eq!(codes(&second), [""; 0]);
}

#[test]
fn a_damaged_cache_is_warned_of_and_repaired() {
    let folder = TestFolder::with_case(CASE);
    summary(&folder);
    let files = kept(&folder);
    for file in &files {
        let whole = fs::read(file).unwrap();
        fs::write(file, &whole[..whole.len() / 2]).unwrap();
    }
    let damaged = summary(&folder);
    assert!(!is_from_cache(&damaged));
    assert_eq!(codes(&damaged), vec!["cache-file"; files.len()]);
    let repaired = summary(&folder);
    assert!(is_from_cache(&repaired) && codes(&repaired).is_empty());
}

#[test]
fn an_unwritable_cache_gives_one_warning_and_the_same_result() {
    let folder = TestFolder::with_case(CASE);
    fs::write(folder.path("kept"), "mine").unwrap();
    let found = summary(&folder);
    assert!(!is_from_cache(&found));
    assert_eq!(codes(&found), ["cache-folder"]);
    for line in [
        &["check", "case.toml"][..],
        &["influence", "case.toml", "--offset", "0,0"],
    ] {
        let ran = with_cache(&folder, line);
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        assert!(
            ran.stderr.contains("warning: nothing is cached"),
            "{}",
            ran.stderr
        );
    }
    for line in [&["cache"][..], &["cache", "--clear"]] {
        let ran = with_cache(&folder, line);
        assert_eq!((ran.code, ran.stdout.as_str()), (Some(2), ""));
        assert!(ran.stderr.contains("kept"), "{}", ran.stderr);
    }
    assert_eq!(fs::read_to_string(folder.path("kept")).unwrap(), "mine");
}

#[test]
fn the_cache_is_shown_and_cleared() {
    let folder = TestFolder::with_case(CASE);
    let json = |arguments: &[&str]| -> Value { with_cache(&folder, arguments).json() };
    assert_eq!(json(&["cache", "--json"])["files"], 0);
    summary(&folder);
    let shown = json(&["cache", "--json"]);
    let files = kept(&folder);
    let bytes: u64 = files.iter().map(|f| fs::metadata(f).unwrap().len()).sum();
    assert_eq!(shown["files"], files.len());
    assert_eq!(shown["bytes"], bytes);
    let text = with_cache(&folder, &["cache"]).stdout;
    assert!(
        text.contains(&format!("kept\n{} files, ", files.len())),
        "{text}"
    );
    fs::write(folder.path("kept/notes.txt"), "mine").unwrap();
    let cleared = with_cache(&folder, &["cache", "--clear"]);
    assert_eq!(cleared.code, Some(0));
    assert!(
        cleared
            .stderr
            .starts_with(&format!("removed {} files", files.len()))
    );
    assert_eq!(kept(&folder), [folder.path("kept/notes.txt")]);
}

#[test]
fn an_empty_variable_means_no_cache_on_disk() {
    let folder = TestFolder::with_case(CASE);
    let ran = folder.run(&["cache"]);
    assert_eq!(ran.code, Some(0));
    assert!(ran.stdout.starts_with("no cache on disk"), "{}", ran.stdout);
    let ran = folder.run(&["run", "case.toml", "--json"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_eq!(folder.names(), ["case.toml"]);
}

#[cfg(unix)]
#[test]
fn permissions_of_cache_and_results_follow_the_umask() {
    use std::os::unix::fs::PermissionsExt;
    let folder = TestFolder::with_case(CASE);
    summary(&folder);
    let mode = |path: &PathBuf| fs::metadata(path).unwrap().permissions().mode();
    let usual = mode(&folder.path("case.toml"));
    assert!(kept(&folder).iter().all(|file| mode(file) == usual));
    assert_eq!(
        folder.run(&["run", "case.toml", "--out", "a"]).code,
        Some(0)
    );
    assert_eq!(mode(&folder.path("a/summary.json")), usual);
    assert_eq!(mode(&folder.path("a")), mode(&folder.path("kept")));
}
