//! Results of a case beyond its rows of the table, in a folder of its own: whoever solves a study may write them.

use std::fmt::Debug;
use std::path::Path;
use std::time::Instant;

use pellicle::Completeness;
use pellicle::case::Case;
use pellicle::summary::RunSummary;
use pellicle_contact::LoadingPath;

use crate::StudyError;

/// The maker of the folders.
pub trait CaseFolders: Debug + Sync {
    /// Claims the folder of a case before it is solved. An existing one must be of this case, left by a killed run.
    ///
    /// # Errors
    ///
    /// [`StudyError::OtherCase`], and [`StudyError::File`] for a folder that cannot be written to, end the study.
    fn claim(&self, folder: &Path, case: &Case) -> Result<Box<dyn CaseFolder>, StudyError>;
}

/// A claimed folder. Dropped without being written, it leaves nothing.
pub trait CaseFolder {
    /// Writes the results of the solved case; partial ones are discarded. The summary receives the time since `start`,
    /// and the warnings about the writing.
    ///
    /// # Errors
    ///
    /// [`StudyError::File`] if a file cannot be written, which ends the study; any other error fails the case.
    fn write(
        self: Box<Self>,
        path: &LoadingPath,
        summary: &mut RunSummary,
        case: &Case,
        start: Instant,
    ) -> Result<Completeness, StudyError>;
}
