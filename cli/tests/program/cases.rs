//! Every file in `cases/` and `cases/paper/`: it runs unchanged, is certified, and begins with a comment.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::runner::TestFolder;

fn cases() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut cases: Vec<_> = ["cases", "cases/paper"]
        .iter()
        .flat_map(|folder| fs::read_dir(root.join(folder)).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "toml"))
        .collect();
    cases.sort();
    cases
}

#[test]
fn every_case_runs_to_a_satisfied_certificate() {
    let cases = cases();
    assert!(cases.len() >= 15, "{cases:?}");
    for case in cases {
        let ran = TestFolder::new().run(&["run", case.to_str().unwrap(), "--json", "--quiet"]);
        assert_eq!(ran.code, Some(0), "{}: {}", case.display(), ran.stderr);
        let summary: Value = serde_json::from_str(&ran.stdout).unwrap();
        for step in summary["steps"].as_array().unwrap() {
            let certificate = &step["certificate"];
            assert_eq!(
                certificate["satisfied"],
                true,
                "{}: {certificate}",
                case.display()
            );
        }
    }
}

#[test]
fn the_case_of_the_readme_writes_its_files() {
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("../cases/fig2c.toml");
    let folder = TestFolder::new();
    let ran = folder.run(&["run", case.to_str().unwrap(), "--out", "results"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    for file in [
        "summary.json",
        "curve.csv",
        "fields-000.npz",
        "pressure-000.png",
        "convergence.png",
        "convergence.svg",
    ] {
        let length = fs::metadata(folder.path("results").join(file))
            .unwrap()
            .len();
        assert!(length > 100, "{file}: {length} bytes");
    }
}
