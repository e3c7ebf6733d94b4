//! Cases of the paper through the program: certified, kept, solved again when anything changes.

#![expect(
    clippy::unwrap_used,
    reason = "a test that cannot prepare itself has failed"
)]

use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;
use xtask::{PaperCase, PaperRun, Program, Request, Runner, XtaskError};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn runner(results: &TempDir) -> Runner {
    let program = Program::at(Path::new(env!("CARGO_BIN_EXE_xtask")), &["program"]).unwrap();
    Runner::new(&root(), results.path().into(), program)
}

/// The result of a request, and whether it was kept from before.
fn run(runner: &Runner, request: &Request) -> Result<(PaperRun, bool), XtaskError> {
    let mut kept = false;
    let run = runner.run(request, &mut |line| kept |= line.starts_with("kept:"))?;
    Ok((run, kept))
}

#[test]
fn a_run_has_certified_numbers_and_its_fields() {
    let results = tempfile::tempdir().unwrap();
    let request = Request::fields(PaperCase::Fig2a, 32);
    let (solved, kept) = run(&runner(&results), &request).unwrap();
    assert!(!kept);
    assert!(solved.worst() <= 1e-8, "{}", solved.worst());
    let stored = solved.fields(0).unwrap();
    let fields = stored.fields(solved.side());
    let area = fields.element_side().powi(2);
    let force = area * fields.pressure.iter().sum::<f64>();
    // The file holds every bit of the pressure; what remains is the certificate's own line of the load.
    let error = (force / 0.3571e-4 - 1.0).abs();
    assert!(error <= 1e-8, "{error}");
}

#[test]
fn an_identical_run_is_kept_and_another_is_not() {
    let results = tempfile::tempdir().unwrap();
    let runner = runner(&results);
    let request = Request::numbers(PaperCase::Fig2a, 32);
    let (first, _) = run(&runner, &request).unwrap();
    let (second, kept) = run(&runner, &request).unwrap();
    assert!(kept);
    assert_eq!(
        first.last().penetration.to_bits(),
        second.last().penetration.to_bits()
    );
    let heavier = request.clone().with("load.force=1e-4");
    let (third, kept) = run(&runner, &heavier).unwrap();
    assert!(!kept && third.last().penetration > first.last().penetration);
    fs::write(first.folder().join("identity"), "of another program").unwrap();
    assert!(!run(&runner, &request).unwrap().1);
}

#[test]
fn a_run_that_is_not_certified_is_an_error_and_not_kept() {
    let results = tempfile::tempdir().unwrap();
    // The smallest force that a number can hold: spread over the elements it is no number any more.
    let request = Request::numbers(PaperCase::Fig2a, 32).with("load.force=5e-324");
    let error = run(&runner(&results), &request).unwrap_err();
    let sentence = error.to_string();
    assert!(
        sentence.starts_with("not certified: fig2a, 32 × 32 elements"),
        "{sentence}"
    );
    assert_eq!(fs::read_dir(results.path()).unwrap().count(), 0);
}

#[test]
fn a_value_that_the_program_refuses_is_named() {
    let results = tempfile::tempdir().unwrap();
    let request = Request::numbers(PaperCase::Fig2a, 32).with("load.force=-1");
    let error = run(&runner(&results), &request).unwrap_err();
    assert!(
        matches!(&error, XtaskError::Refused { message, .. } if message.contains("force")),
        "{error}"
    );
}
