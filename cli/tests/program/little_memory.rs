//! Runs and studies in less memory than they want.

use std::fs;

use super::runner::{CASE, ProgramOutput, TestFolder};

/// The output of the program with this many kilobytes of address space.
fn within_space(folder: &TestFolder, kilobytes: usize, line: &str) -> ProgramOutput {
    let program = env!("CARGO_BIN_EXE_pellicle");
    let script = format!("ulimit -v {kilobytes}; exec {program} {line}");
    let mut command = std::process::Command::new("sh");
    command.args(["-c", &script]).env("PELLICLE_CACHE", "");
    TestFolder::ran(command.current_dir(folder.path(".")))
}

#[test]
fn a_case_with_too_little_memory_fails_without_the_others() {
    let folder = TestFolder::with_study(
        CASE,
        "[study]\ncase = \"case.toml\"\n[study.vary]\ngrid.elements = [32, 8192, 64]\n",
    );
    let limited = |line: &str| within_space(&folder, 900_000, line);
    let ran = limited("run case.toml --set grid.elements=4096");
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert!(ran.stderr.contains("memory"), "{}", ran.stderr);
    assert!(
        ran.stderr.contains("such as grid.elements = "),
        "{}",
        ran.stderr
    );
    assert_eq!(ran.stderr.lines().count(), 1, "{}", ran.stderr);
    assert_eq!(folder.names(), ["case.toml", "many.toml"]);
    let ran = limited("study many.toml --quiet --threads 2");
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    let table = fs::read_to_string(folder.path("results/many/results.csv")).unwrap();
    let starts: Vec<_> = table.lines().map(|line| &line[..8]).collect();
    assert_eq!(starts, ["case,sta", "1,certif", "2,failed", "3,certif"]);
    assert!(table.contains("GB of memory"), "{table}");
}

#[test]
fn the_memory_found_is_the_limit_on_the_address_space_less_what_is_in_use() {
    let folder = TestFolder::with_case(CASE);
    let limits = [200_000, 300_000, 500_000, 900_000];
    let found = limits.map(|kilobytes| {
        let line = "run case.toml --set grid.elements=8192 --threads 2";
        let ran = within_space(&folder, kilobytes, line);
        assert_eq!(ran.code, Some(2), "{kilobytes}: {}", ran.stderr);
        let words: Vec<_> = ran.stderr.split_whitespace().collect();
        let place = words.iter().position(|word| *word == "MB").unwrap();
        words[place - 1].parse::<f64>().unwrap()
    });
    // In use are the program itself and the stacks of its threads; two digits are printed.
    for (kilobytes, found) in limits.into_iter().zip(found) {
        let used = kilobytes as f64 * 1.024e-3 - found;
        assert!((0.0..100.0).contains(&used), "{found} MB of {kilobytes} kB");
    }
    assert!(found.is_sorted_by(|one, other| one < other), "{found:?}");
    // A case of 40 MB.
    for kilobytes in [200_000, 300_000] {
        let ran = within_space(&folder, kilobytes, "run case.toml --json --threads 2");
        assert_eq!(ran.code, Some(0), "{kilobytes}: {}", ran.stderr);
    }
}
