//! Figures on tiny grids: every picture has three files and the certificate of its data, and is redrawn to the same
//! bytes.

#![expect(
    clippy::unwrap_used,
    reason = "a test that cannot prepare itself has failed"
)]

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;
use xtask::{Figure, Runner, XtaskError, figures};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Elements per side: few enough for a test, and a multiple of four, so that there is a coarser grid.
fn runner(root: &Path, results: &TempDir) -> Runner {
    Runner {
        root: root.into(),
        results: results.path().join("runs"),
        program: [env!("CARGO_BIN_EXE_xtask"), "program"]
            .map(OsString::from)
            .to_vec(),
        elements: 32,
        tell: |_| (),
    }
}

/// The files of a figure, by name.
fn drawn(figure: Figure, results: &TempDir, folder: &str) -> BTreeMap<String, Vec<u8>> {
    let out = results.path().join(folder);
    let count = figures(&[figure], &runner(&root(), results), &out, None).unwrap();
    let file = |entry: fs::DirEntry| {
        let name = entry.file_name().into_string().unwrap();
        (name, fs::read(entry.path()).unwrap())
    };
    let entries = fs::read_dir(out).unwrap();
    let files: BTreeMap<_, _> = entries.map(|entry| file(entry.unwrap())).collect();
    assert_eq!(files.len(), 3 * count);
    files
}

fn text<'a>(files: &'a BTreeMap<String, Vec<u8>>, name: &str) -> &'a str {
    std::str::from_utf8(&files[name]).unwrap()
}

#[test]
fn a_figure_consists_of_svg_png_and_csv_with_its_certificate() {
    let results = tempfile::tempdir().unwrap();
    let files = drawn(Figure::Six, &results, "first");
    let names: Vec<_> = files.keys().map(String::as_str).collect();
    assert_eq!(names, ["fig6.csv", "fig6.png", "fig6.svg"]);
    assert!(files["fig6.png"].starts_with(b"\x89PNG"));
    let svg = text(&files, "fig6.svg");
    for words in [
        "QUICK",
        "32 × 32 elements",
        "certificates ≤",
        "Q, mN",
        "D, nm",
        "largest p, GPa",
    ] {
        assert!(svg.contains(words), "{words}");
    }
    // Two panels, three curves, one row per load.
    let loads = 19;
    assert_eq!(text(&files, "fig6.csv").lines().count(), 1 + 2 * 3 * loads);
}

#[test]
fn a_figure_drawn_again_has_the_same_bytes() {
    let results = tempfile::tempdir().unwrap();
    let first = drawn(Figure::Two, &results, "first");
    assert!(first.contains_key("fig2-map.png") && first.contains_key("fig2-surface.svg"));
    assert!(text(&first, "fig2-map.svg").contains("certificate"));
    assert_eq!(first, drawn(Figure::Two, &results, "second"));
}

#[test]
fn stresses_have_a_section_for_each_case_of_figure_2() {
    let results = tempfile::tempdir().unwrap();
    let files = drawn(Figure::Stresses, &results, "first");
    for case in ["fig2a", "fig2b", "fig2c", "fig2d"] {
        let svg = text(&files, &format!("{case}-stress.svg"));
        assert!(svg.contains("QUICK") && svg.contains("Largest von Mises stress"));
        let table = text(&files, &format!("{case}-stress.csv"));
        assert!(table.starts_with("x,z,body,von Mises,largest principal\n"));
    }
}

#[test]
fn missing_refused_and_uncertified_cases_are_errors_and_not_drawn() {
    let results = tempfile::tempdir().unwrap();
    let nowhere = TempDir::new().unwrap();
    let out = results.path().join("out");
    let runner_of_nothing = runner(nowhere.path(), &results);
    assert!(figures(&[Figure::Five], &runner_of_nothing, &out, None).is_err());
    assert!(!out.exists());
    let run = |set: &str| {
        let run = runner(&root(), &results).run("cases/fig2a", &[set], "none");
        run.unwrap_err()
    };
    let refused = run("load.force=-1");
    assert!(matches!(&refused, XtaskError::Refused { message, .. } if message.contains("force")));
    // The smallest representable force: spread over the elements it underflows.
    let sentence = run("load.force=5e-324").to_string();
    assert!(
        sentence.starts_with("fig2a") && sentence.contains("not certified"),
        "{sentence}"
    );
}
