//! The golden values of a few runs of this build: the same bits when they are compared, and a list of what was changed
//! in the file.

#![expect(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test that cannot prepare itself has failed"
)]

use std::ffi::OsString;
use std::fs;
use std::path::Path;

use xtask::{Comparison, Golden, GoldenArguments, golden};

/// The runs whose names begin with `only`, written to `file` or compared with it.
fn run(file: &Path, only: &str, write: bool) -> Golden {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let program = [env!("CARGO_BIN_EXE_xtask"), "program"].map(OsString::from);
    let arguments = GoldenArguments {
        file: file.into(),
        write,
        program: None,
        only: only.into(),
        threads: 1,
        most: 100,
    };
    golden(&root, &program, &arguments).unwrap()
}

fn compare(file: &Path, only: &str) -> Comparison {
    let Golden::Compared(comparison) = run(file, only, false) else {
        panic!("not compared");
    };
    comparison
}

#[test]
fn values_are_the_same_in_a_second_run_and_a_changed_one_is_listed() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("golden.json");
    for only in ["random/006", "case/a bare", "cases/soft-metal"] {
        let Golden::Written(count) = run(&file, only, true) else {
            panic!("not written");
        };
        assert!(count > 5, "{only}: {count}");
        let comparison = compare(&file, only);
        assert!(comparison.is_same(), "{}", comparison.report(20));
        assert_eq!(comparison.count, count, "{only}");
    }
    // The last of them writes every kind of file.
    let text = fs::read_to_string(&file).unwrap();
    for path in [
        "curve.csv.0.force [N]",
        "fields-003.npz.pressure sum",
        "fields-003.vti",
        "pressure-003.svg",
        "summary.json.steps.0.penetration",
    ] {
        assert!(text.contains(path), "{path} in {text}");
    }
    let moved = text.replace(
        "\"summary.json.grid.elements\":64",
        "\"summary.json.grid.elements\":63",
    );
    fs::write(&file, moved.replace("\"exit\":0", "\"exit\":1")).unwrap();
    let told = compare(&file, "cases/soft-metal").report(20);
    let lines: Vec<&str> = told.lines().take(2).collect();
    let wanted = [
        "cases/soft-metal: exit: 1 → 0",
        "cases/soft-metal: summary.json.grid.elements: 63 → 64 (1.6e-2)",
    ];
    assert_eq!(lines, wanted, "{told}");
}
