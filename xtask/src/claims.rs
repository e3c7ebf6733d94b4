//! What becomes of each sentence of the paper about results: `docs/claims.toml` read, computed afresh, compared.
//!
//! A [`Claim`] names a [`Checker`] and cases; an [`Evaluation`] is what the check found on every grid, with the
//! [`Verdict`]; the [`ClaimsReport`] says which verdicts are no longer the ones recorded. A run over all claims on the full
//! grids, if none has changed, writes `docs/claims.md`.

mod arguments;
mod checker;
mod checks;
mod contact_fields;
#[cfg(test)]
mod controls;
mod curve;
mod cylinders;
mod document;
mod error;
mod evaluation;
mod evidence;
mod file;
mod finding;
#[cfg(test)]
mod made_up;
mod refinement;
mod report;
mod runs;
#[cfg(test)]
mod tests;
mod verdict;

use std::fs;
use std::path::Path;

pub use arguments::ClaimsArguments;
pub use checker::Checker;
pub use error::ClaimsError;
pub use evaluation::Evaluation;
pub use file::{Claim, ClaimsFile, Contradiction, Refinement, Source};
pub use finding::Finding;
pub use report::ClaimsReport;
pub use verdict::Verdict;

use contact_fields::ContactFields;
use curve::Curve;
use cylinders::Cylinders;
use evidence::Evidence;

use crate::{Runner, XtaskError};

/// The file of claims, and the document made from it, from the root of the workspace.
const FILE: &str = "docs/claims.toml";
const DOCUMENT: &str = "docs/claims.md";

/// Computes the verdicts from runs of the release binary; `tell` hears what is going on.
///
/// # Errors
/// A file of claims that is not in order, a name in `--only` that no claim has, a run that fails or is not certified, a
/// document that cannot be written.
pub fn claims(
    arguments: &ClaimsArguments,
    root: &Path,
    tell: &mut dyn FnMut(&str),
) -> Result<ClaimsReport, XtaskError> {
    let file = ClaimsFile::read(&root.join(FILE))?;
    file.chosen(&arguments.only)?;
    let runner = Runner::prepare(root, tell)?;
    let report = judge(&file, arguments, &mut runs::Runs::new(runner, tell))?;
    if arguments.is_everything() && report.changed().next().is_none() {
        write(&root.join(DOCUMENT), &document::document(&file, &report))?;
    }
    Ok(report)
}

/// Judges the chosen claims by any evidence; refinements are followed if everything is asked for.
fn judge(
    file: &ClaimsFile,
    arguments: &ClaimsArguments,
    evidence: &mut dyn Evidence,
) -> Result<ClaimsReport, XtaskError> {
    let mut report = ClaimsReport::default();
    for claim in file.chosen(&arguments.only)? {
        match arguments.grids(claim) {
            [] => report.left_out.push(claim.id.clone()),
            grids => report
                .evaluations
                .push(evaluation::evaluate(claim, grids, evidence)?),
        }
    }
    if arguments.is_everything() {
        let refined = file
            .refinements
            .iter()
            .map(|one| refinement::refine(one, evidence));
        report.refined = refined.collect::<Result<_, _>>()?;
    }
    Ok(report)
}

/// Writes a file whole or not at all.
fn write(path: &Path, text: &str) -> Result<(), XtaskError> {
    let failed = |source| XtaskError::Write {
        path: path.into(),
        source,
    };
    let partial = path.with_extension("partial");
    fs::write(&partial, text).map_err(failed)?;
    fs::rename(&partial, path).map_err(failed)?;
    Ok(())
}
