//! Pellicle's pressure and the certificate that is computed for every program, held against each other without network.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use xtask::{Case, Certificate, PellicleArguments, Problem, run_pellicle};

/// A Python that has numpy and scipy: that of an earlier comparison, or the system's.
fn python() -> Option<PathBuf> {
    let earlier = root().join("target/compare/environments/the-certificate/bin/python");
    let has_numpy = |python: &PathBuf| {
        let tried = Command::new(python)
            .args(["-c", "import numpy, scipy"])
            .output();
        tried.is_ok_and(|output| output.status.success())
    };
    [earlier, PathBuf::from("python3")]
        .into_iter()
        .find(has_numpy)
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// Says that a test did nothing, past the capture of the test runner.
fn skip() {
    let line = b"skipped: no Python with numpy and scipy; `cargo xtask compare` makes one\n";
    std::io::stderr().write_all(line).unwrap();
}

fn judged(python: &Path, case: Case, elements: usize, pressure: &Path) -> Certificate {
    let mut command = Command::new(python);
    command
        .arg("-B")
        .arg(root().join("xtask/compare/certificate.py"));
    let problem = Problem::new(case, elements).unwrap();
    Certificate::judge(command, problem, pressure)
        .unwrap()
        .unwrap()
}

#[test]
fn the_independent_certificate_agrees_with_pellicles_own() {
    let Some(python) = python() else {
        return skip();
    };
    let folder = tempfile::tempdir().unwrap();
    for case in [Case::Hertz, Case::Pillars] {
        let arguments = PellicleArguments {
            case,
            elements: 128,
            threads: 1,
            tolerance: 1e-8,
            pressure: folder.path().join("pressure.npy"),
            whole_grid: false,
        };
        let measurement = run_pellicle(&arguments).unwrap();
        let certificate = judged(&python, case, arguments.elements, &arguments.pressure);
        // Pellicle's own is relative to D, which is d_H within a tenth; rounding adds some 1e-13.
        let own = measurement.own_error.unwrap();
        let ratio = certificate.penetration / 0.0225;
        assert!((0.9..1.1).contains(&ratio), "{case}: {certificate:?}");
        assert!(
            (certificate.worst() - ratio * own).abs() < 1e-12,
            "{case}: {certificate:?}, own {own:e}"
        );
        assert!(measurement.converged && certificate.min_pressure >= 0.0);
    }
}

/// Without this, a certificate that finds everything good would pass.
#[test]
fn a_wrong_pressure_is_not_certified() {
    let Some(python) = python() else {
        return skip();
    };
    let folder = tempfile::tempdir().unwrap();
    let pressure = folder.path().join("pressure.npy");
    let uniform = ndarray::Array2::from_elem((64, 64), 0.0045);
    ndarray_npy::write_npy(&pressure, &uniform).unwrap();
    let certificate = judged(&python, Case::Hertz, 64, &pressure);
    assert!(certificate.load < 1e-14, "{certificate:?}");
    assert!(
        certificate.gap_in_contact > 1.0 && certificate.overlap > 0.1,
        "{certificate:?}"
    );
}
