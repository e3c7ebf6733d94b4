//! Pellicle's pressure checked against the certificate computed for every program, without network.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// A Python with numpy and scipy: that of an earlier comparison, or the system's.
fn python() -> Option<PathBuf> {
    let earlier = folder().join("../../target/compare/environments/the-certificate/bin/python");
    let has_numpy = |python: &PathBuf| {
        let tried = Command::new(python)
            .args(["-c", "import numpy, scipy"])
            .output();
        tried.is_ok_and(|output| output.status.success())
    };
    let found = [earlier, PathBuf::from("python3")]
        .into_iter()
        .find(has_numpy);
    if found.is_none() {
        // Bypasses the output capture of the test runner.
        let line = b"skipped: no Python with numpy and scipy; xtask/compare/compare.py makes one\n";
        std::io::stderr().write_all(line).unwrap();
    }
    found
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("compare")
}

/// The line of JSON that a command prints.
fn json(command: &mut Command) -> Value {
    let output = command.output().unwrap();
    assert!(output.status.success(), "{output:?}");
    serde_json::from_slice(&output.stdout).unwrap()
}

fn judged(python: &Path, case: &str, elements: &str, pressure: &Path) -> Value {
    let script = folder().join("certificate.py");
    json(
        Command::new(python)
            .arg("-B")
            .arg(script)
            .args([case, elements])
            .arg(pressure),
    )
}

#[test]
fn the_independent_certificate_agrees_with_pellicles_own() {
    let Some(python) = python() else { return };
    let folder = tempfile::tempdir().unwrap();
    let pressure = folder.path().join("pressure.npy");
    for case in ["hertz", "pillars"] {
        let measurement = json(
            Command::new(env!("CARGO_BIN_EXE_compare-pellicle"))
                .args([case, "128", "1", "1e-8"])
                .arg(&pressure),
        );
        let certificate = judged(&python, case, "128", &pressure);
        let line = |key: &str| certificate[key].as_f64().unwrap();
        let lines = ["complementarity", "gap_in_contact", "overlap", "load"].map(line);
        let worst = lines.into_iter().fold(0.0, f64::max);
        // Pellicle's own certificate is relative to D, which is d_H within a tenth; rounding adds about 1e-13.
        let own = measurement["own_error"].as_f64().unwrap();
        let ratio = line("penetration") / 0.0225;
        assert!((0.9..1.1).contains(&ratio), "{case}: {certificate}");
        assert!(
            (worst - ratio * own).abs() < 1e-12,
            "{case}: {certificate}, own {own:e}"
        );
        assert!(measurement["converged"] == true && line("min_pressure") >= 0.0);
    }
}

/// Without this test, a certificate that accepts everything would pass.
#[test]
fn a_wrong_pressure_is_not_certified() {
    let Some(python) = python() else { return };
    let folder = tempfile::tempdir().unwrap();
    let pressure = folder.path().join("pressure.npy");
    let uniform = ndarray::Array2::from_elem((64, 64), 0.0045);
    ndarray_npy::write_npy(&pressure, &uniform).unwrap();
    let certificate = judged(&python, "hertz", "64", &pressure);
    let line = |key: &str| certificate[key].as_f64().unwrap();
    assert!(line("load") < 1e-14, "{certificate}");
    assert!(
        line("gap_in_contact") > 1.0 && line("overlap") > 0.1,
        "{certificate}"
    );
}
