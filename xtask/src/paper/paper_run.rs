//! A certified run: its numbers, and the fields of its steps.

use std::path::{Path, PathBuf};

use pellicle_cli::output::npz::{self, StoredFields};
use pellicle_cli::output::record::Record;
use pellicle_cli::output::summary::StepSummary;

use super::Request;
use crate::XtaskError;

/// A run of a case of the paper, every step certified.
#[derive(Debug, Clone)]
pub struct PaperRun {
    /// What was asked for.
    pub request: Request,
    /// Its summary; the steps are in the order of the loads.
    pub record: Record,
    folder: PathBuf,
}

impl PaperRun {
    pub(super) fn new(request: Request, record: Record, folder: PathBuf) -> Self {
        Self {
            request,
            record,
            folder,
        }
    }

    /// The loading steps: force, penetration, areas, largest pressure and its place, stiffness, certificate, grid error.
    #[must_use]
    pub fn steps(&self) -> &[StepSummary] {
        &self.record.steps
    }

    /// The last loading step, which is the only one of a case with a single load; a run without any is never kept.
    ///
    /// # Panics
    /// Never: a run has a step.
    #[must_use]
    pub fn last(&self) -> &StepSummary {
        self.steps()
            .last()
            .expect("a run without steps is refused when it is read")
    }

    /// Side of the square domain, in the case's unit of length.
    #[must_use]
    pub fn side(&self) -> f64 {
        self.record.grid.side
    }

    /// The largest line of the certificate over all steps.
    #[must_use]
    pub fn worst(&self) -> f64 {
        let worst = self.steps().iter().map(|step| step.certificate.worst);
        worst.fold(0.0, f64::max)
    }

    /// The fields of a step: N × N values each, first index along x. `fields(0)?.fields(solved.side())` gives them by name.
    ///
    /// # Errors
    /// [`XtaskError::Results`] if they were not kept or the file is damaged.
    pub fn fields(&self, step: usize) -> Result<StoredFields, XtaskError> {
        Ok(StoredFields::read(&self.folder.join(npz::file(step)))?)
    }

    /// The folder that holds `summary.json` and the fields that are kept.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }
}
