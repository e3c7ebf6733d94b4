//! The verdicts of all claims from made-up evidence: the file is complete, and a verdict that changes is named.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::ExitCode;
use std::rc::Rc;

use super::evidence::{Numbers, Subject};
use super::made_up::{CYLINDERS, power_law, pressed};
use super::*;
use crate::PaperCase;

/// Evidence without any run: dishes on the elements, a half-space's curve, a peak at the central edge that grows as
/// `N^(1/2)`.
struct MadeUp;

impl Evidence for MadeUp {
    fn fields(&mut self, _: Subject<'_>) -> Result<Rc<ContactFields>, XtaskError> {
        Ok(Rc::new(pressed(|radius, relative| {
            f64::from(relative < 1.0) * (1.0 + relative.powi(4)) * (5.0 - radius)
        })))
    }

    fn cylinders(&mut self, _: Subject<'_>) -> Result<Cylinders, XtaskError> {
        Ok(CYLINDERS)
    }

    fn numbers(&mut self, subject: Subject<'_>) -> Result<Numbers, XtaskError> {
        Ok(Numbers {
            element_side: 5.0 / subject.elements as f64,
            penetration: 1.0,
            max_pressure: (subject.elements as f64).sqrt(),
            max_pressure_at: [0.24, 0.0],
            contact_area: 1.0,
            contact_area_between: 0.0,
            spring_length: 0.01,
        })
    }

    fn curve(&mut self, _: Subject<'_>) -> Result<Rc<Curve>, XtaskError> {
        Ok(Rc::new(power_law(1.0, 2.0 / 3.0)))
    }
}

fn recorded() -> ClaimsFile {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    ClaimsFile::read(&root.join(FILE)).unwrap()
}

fn only(id: &str) -> ClaimsArguments {
    ClaimsArguments {
        only: vec![id.to_owned()],
        quick: false,
    }
}

fn judged(text: &str) -> ClaimsReport {
    let file = ClaimsFile::parse(text).unwrap();
    judge(&file, &ClaimsArguments::default(), &mut MadeUp).unwrap()
}

const CLAIM: &str = r#"
[[claim]]
id = "2a-elements-only"
place = "Fig. 2(a)"
sentence = "only the elements touch"
quantity = "share between"
checker = "only-elements-touch"
cases = ["fig2a"]
elements = [64, 128]
threshold = 1e-3
because = "a reason"
verdict = "borne out"
reason = "a reason"
"#;

#[test]
fn every_checker_is_named_by_a_claim() {
    let file = recorded();
    let named: BTreeSet<Checker> = file.claims().map(|claim| claim.checker).collect();
    assert_eq!(named, BTreeSet::from(Checker::ALL));
}

#[test]
fn every_claim_and_refinement_names_cases_that_exist() {
    let file = recorded();
    let claims = file.claims().flat_map(|claim| claim.cases.iter());
    for called in claims.chain(file.refinements.iter().map(|one| &one.case)) {
        let subject = Subject::parse(called, &[], 64).unwrap();
        assert!(
            PaperCase::ALL
                .iter()
                .any(|case| case.name() == subject.case),
            "{called}"
        );
    }
}

/// What the issue and the notes on the paper ask for at least, by id or its beginning.
#[test]
fn no_sentence_that_was_asked_for_is_missing() {
    let file = recorded();
    for id in [
        "2a-incomplete",
        "2b-incomplete",
        "2a-elements-only",
        "2b-elements-only",
        "2c-between-near-axis",
        "2d-between-near-axis",
        "2a-edge-peaks",
        "2b-edge-peaks",
        "2c-edge-peaks",
        "2d-edge-peaks",
        "2a-largest-at-centre",
        "2b-largest-at-centre",
        "2c-largest-at-centre",
        "2d-largest-at-centre",
        "3-2a-curved",
        "3-2b-beside-elements",
        "4-soft-60-nonlinear",
        "4-stiff-80-gradient-falls",
        "4-stiff-80-gradient-constant",
        "4-soft-smaller-period",
        "4-stiff-smaller-period",
        "4-similar",
        "5-larger-area",
        "5-lower-peak",
        "5-more-pyramidal",
        "6-gradients-differ",
        "6-effect-fades",
    ] {
        assert!(file.claims().any(|claim| claim.is_named(id)), "{id}");
    }
    assert!(file.contradictions.len() >= 3);
}

#[test]
fn verdicts_as_recorded_succeed() {
    let report = judged(CLAIM);
    assert_eq!(report.exit_code(), ExitCode::SUCCESS);
    assert_eq!(report.complaints(), "");
    assert!(
        report
            .to_string()
            .ends_with("1 of 1 verdicts as recorded\n"),
        "{report}"
    );
}

#[test]
fn an_altered_recorded_verdict_fails_and_is_named() {
    for altered in ["not borne out", "depends on the grid"] {
        let report = judged(&CLAIM.replace(
            r#"verdict = "borne out""#,
            &format!("verdict = \"{altered}\""),
        ));
        assert_eq!(report.exit_code(), ExitCode::FAILURE);
        let expected =
            format!("claim `2a-elements-only`: recorded as {altered}, computed as borne out\n");
        assert_eq!(report.complaints(), expected);
    }
}

#[test]
fn a_claim_without_quick_grids_is_left_out_of_a_quick_look() {
    let file = ClaimsFile::parse(CLAIM).unwrap();
    let quick = ClaimsArguments {
        quick: true,
        ..ClaimsArguments::default()
    };
    let report = judge(&file, &quick, &mut MadeUp).unwrap();
    assert!(report.evaluations.is_empty());
    assert_eq!(report.left_out, ["2a-elements-only"]);
}

#[test]
fn every_claim_of_the_file_can_be_judged_and_shown() {
    let file = recorded();
    let report = judge(&file, &ClaimsArguments::default(), &mut MadeUp).unwrap();
    assert_eq!(report.evaluations.len(), file.claims().count());
    // Made-up fields have no film, no gaps that close: some verdicts must differ from those of the paper's cases.
    assert_eq!(report.exit_code(), ExitCode::FAILURE);
    let document = document::document(&file, &report);
    for claim in file.claims() {
        assert!(
            document.contains(&format!("| `{}` |", claim.id)),
            "{}",
            claim.id
        );
    }
}

#[test]
fn only_the_named_claims_are_judged_and_an_unknown_name_is_an_error() {
    let file = recorded();
    let report = judge(&file, &only("4-similar"), &mut MadeUp).unwrap();
    assert_eq!(report.evaluations.len(), 2);
    let error = judge(&file, &only("7-nothing"), &mut MadeUp)
        .unwrap_err()
        .to_string();
    assert!(
        error.starts_with("no claim is called `7-nothing`; there are: 2a-"),
        "{error}"
    );
}

/// Fails if a sentence or a recorded verdict was edited without `cargo xtask claims` having been run since.
#[test]
fn the_document_shows_every_sentence_and_recorded_verdict() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let document = fs::read_to_string(root.join(DOCUMENT)).unwrap();
    for claim in recorded().claims() {
        let start = format!("| `{}` | {} | {} |", claim.id, claim.place, claim.sentence);
        let line = document.lines().find(|line| line.starts_with(&start));
        let verdict = format!("**{}** |", claim.verdict);
        assert!(
            line.is_some_and(|line| line.ends_with(&verdict)),
            "{}",
            claim.id
        );
    }
}
