//! `pellicle surface`: rough surfaces as height maps.

use std::fs;

use super::runner::{CASE, TestFolder};

const LINE: [&str; 8] = [
    "--side", "1 um", "--rms", "0.2 nm", "--size", "64", "--seed", "5",
];

/// The case with the surface of a file.
fn case(keys: &str) -> String {
    let (before, after) = CASE.split_once("[surface]").unwrap();
    let (_, after) = after.split_once("[indenter]").unwrap();
    // A key of the root comes before all tables.
    format!("surface = {{ kind = \"rough\", {keys} }}\n{before}[indenter]{after}")
}

#[test]
fn a_surface_is_written_in_both_formats_and_runs_in_a_case() {
    let folder = TestFolder::with_case(CASE);
    let mut penetrations = Vec::new();
    for name in ["rough.npy", "rough.gsf"] {
        let made = folder.run(&[&["surface", "--out", name][..], &LINE].concat());
        assert_eq!(made.code, Some(0), "{}", made.stderr);
        // The printed table can be used in a case.
        let (_, keys) = made.stderr.split_once("kind = \"rough\", ").unwrap();
        let keys = keys.trim_end().trim_end_matches(" }");
        fs::write(folder.path("rough.toml"), case(keys)).unwrap();
        let summary = folder.run(&["run", "rough.toml", "--json"]).json();
        penetrations.push(summary["steps"][0]["penetration"].as_f64().unwrap());
    }
    // Single precision is the only difference.
    let [npy, gsf] = penetrations[..] else {
        panic!("two runs")
    };
    approx::assert_relative_eq!(npy, gsf, max_relative = 1e-6);
}

#[test]
fn the_same_seed_gives_the_same_file_and_none_is_replaced_without_force() {
    let folder = TestFolder::with_case(CASE);
    let make =
        |more: &[&str]| folder.run(&[&["surface", "--out", "rough.npy"][..], &LINE, more].concat());
    assert_eq!(make(&[]).code, Some(0));
    let first = fs::read(folder.path("rough.npy")).unwrap();
    let again = make(&[]);
    assert_eq!(again.code, Some(2));
    assert!(again.stderr.contains("--force"), "{}", again.stderr);
    assert_eq!(make(&["--force"]).code, Some(0));
    assert!(fs::read(folder.path("rough.npy")).unwrap() == first);
    assert_eq!(make(&["--force", "--hurst", "0.5"]).code, Some(0));
    assert!(fs::read(folder.path("rough.npy")).unwrap() != first);
}

#[test]
fn invalid_surface_options_are_rejected_in_one_sentence() {
    let folder = TestFolder::with_case(CASE);
    for (more, wanted) in [
        (&["--wavelengths", "1 nm", "1 um"][..], "two samples"),
        (&["--wavelengths", "2 um", "0.1 um"], "longer than the side"),
        (
            &["--wavelengths", "110.07 nm", "110.25 nm"],
            "no wave between",
        ),
        (&["--hurst", "1.2"], "from 0 to 1"),
        (&["--rms", "-1 nm"], "above zero"),
        (&["--size", "3"], "4..=16384"),
    ] {
        let line: Vec<&str> = LINE
            .chunks(2)
            .filter(|pair| pair[0] != more[0])
            .flatten()
            .copied()
            .collect();
        let ran = folder.run(&[&["surface", "--out", "rough.npy"][..], &line, more].concat());
        assert_eq!(ran.code, Some(2), "{more:?}");
        assert!(ran.stderr.contains(wanted), "{more:?}: {}", ran.stderr);
    }
    let ran = folder.run(&[&["surface", "--out", "rough.tif"][..], &LINE].concat());
    assert_eq!(ran.code, Some(2));
    assert!(ran.stderr.contains(".npy or .gsf"), "{}", ran.stderr);
    assert_eq!(folder.names(), ["case.toml"]);
}
