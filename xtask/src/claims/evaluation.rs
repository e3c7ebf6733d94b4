//! A claim put to the evidence, grid by grid.

use super::checker::Check;
use super::evidence::{Evidence, Subject};
use super::{Claim, Finding, Verdict};
use crate::XtaskError;

/// A claim with what was found on every grid.
#[derive(Debug, Clone, PartialEq)]
pub struct Evaluation {
    /// The claim as recorded.
    pub claim: Claim,
    /// Elements per side, and what was found there.
    pub findings: Vec<(usize, Finding)>,
    /// The verdict computed.
    pub verdict: Verdict,
}

impl Evaluation {
    /// Whether the verdict computed is the one recorded.
    #[must_use]
    pub fn is_as_recorded(&self) -> bool {
        self.verdict == self.claim.verdict
    }
}

/// Judges a claim on the given grids.
///
/// # Errors
/// Whatever stands against the evidence.
pub(super) fn evaluate(
    claim: &Claim,
    grids: &[usize],
    evidence: &mut dyn Evidence,
) -> Result<Evaluation, XtaskError> {
    let mut findings = Vec::new();
    for &elements in grids {
        findings.push((elements, find(claim, elements, evidence)?));
    }
    let all: Vec<Finding> = findings
        .iter()
        .map(|(_, finding)| finding.clone())
        .collect();
    let verdict = Verdict::of(&all).unwrap_or(Verdict::NotBorneOut);
    Ok(Evaluation {
        claim: claim.clone(),
        findings,
        verdict,
    })
}

/// What the claim's check finds on one grid.
fn find(
    claim: &Claim,
    elements: usize,
    evidence: &mut dyn Evidence,
) -> Result<Finding, XtaskError> {
    let subject = |index: usize| Subject::parse(&claim.cases[index], &claim.set, elements);
    let first = subject(0)?;
    let limit = claim.threshold;
    Ok(match claim.checker.check() {
        Check::Fields(check) => check(&*evidence.fields(first)?, limit),
        Check::Cylinders(check) => {
            check(&*evidence.fields(first)?, evidence.cylinders(first)?, limit)
        }
        Check::TwoFields(check) => check(
            &*evidence.fields(first)?,
            &*evidence.fields(subject(1)?)?,
            limit,
        ),
        Check::ShareBetween(check) => {
            let numbers = evidence.numbers(first)?;
            check(numbers.contact_area_between / numbers.contact_area, limit)
        }
        Check::PeakPlace(check) => {
            let at = evidence.numbers(first)?.max_pressure_at;
            check(at, evidence.cylinders(first)?)
        }
        Check::PeakGrowth(check) => {
            let [coarse, fine] =
                [elements / 2, elements].map(|elements| Subject { elements, ..first });
            let mut peak = |subject: Subject<'_>| -> Result<_, XtaskError> {
                Ok((subject.elements, evidence.numbers(subject)?.max_pressure))
            };
            check(peak(coarse)?, peak(fine)?, limit)
        }
        Check::Curve(check) => check(&*evidence.curve(first)?, limit),
        Check::TwoCurves(check) => check(
            &*evidence.curve(first)?,
            &*evidence.curve(subject(1)?)?,
            limit,
        ),
    })
}
