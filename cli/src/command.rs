//! The commands, one per file, and the outcomes of a command that does not fail.

pub mod cache;
pub mod check;
pub mod completions;
pub mod explore;
pub mod find;
pub mod gather;
pub mod identify;
pub mod influence;
pub mod init;
pub mod kernel;
pub mod plot;
pub mod run;
pub mod solve;
pub mod stress;
pub mod study;
pub mod surface;
pub mod validate;

use pellicle_contact::Status;

/// The outcome of a command that did not fail.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// Everything is done, and every solution is certified.
    Done,
    /// The result is written, but marked as not converged, beyond the model or cut off; in a study, some case has no
    /// certified result.
    NotConverged,
    /// The program disagrees with a reference: a row of its validation fails.
    Refuted,
    /// The model does not fit the measurements: the best fit is written, but marked.
    Misfit,
    /// The user asked to stop; finished results are written.
    Stopped,
}

/// The sentence on a result that is not certified; none on one that is.
fn complaint(status: Status) -> Option<String> {
    let what = match status {
        Status::Certified => return None,
        Status::CutOff => {
            "cut off: the contact would extend beyond the edge of the domain or of a map"
        }
        Status::BeyondModel => {
            "beyond the model: linear elasticity does not describe such a contact"
        }
        Status::NotConverged => "not converged: the certificate is not satisfied",
    };
    Some(format!("Error: {what}, do not use these numbers"))
}
