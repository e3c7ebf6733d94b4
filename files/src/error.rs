//! The reasons why a file or folder of results cannot be written or read.

use std::error::Error;
use std::io;
use std::iter;
use std::path::{Path, PathBuf};

use crate::staging;

/// The reason why a file or folder of results cannot be written or read.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// A file or folder cannot be written.
    #[error("{}: cannot be written: {cause}", path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// The system's error.
        cause: io::Error,
    },
    /// A file or folder of that name exists.
    #[error("{}: found a file or folder of that name: give --force to replace it, or another --out", path.display())]
    Exists {
        /// The existing file or folder.
        path: PathBuf,
    },
    /// Something other than a results folder exists there; it is not touched.
    #[error("{}: found something other than a results folder: give another --out", path.display())]
    NoResults {
        /// The existing file or folder.
        path: PathBuf,
    },
    /// A file beside a run's summary has the name of one of the run's files but was not written by the run.
    #[error("{}: found a file that the run of the summary beside it did not write: move it away, or give another --out", path.display())]
    NotWritten {
        /// The file.
        path: PathBuf,
    },
    /// Another process is writing to a table or folder.
    #[error("{}: found another process writing to it: wait until it has ended", path.display())]
    Busy {
        /// The table or folder.
        path: PathBuf,
    },
    /// A file of a results folder is missing or was not written by a run.
    #[error("{}: cannot be read as results: {reason}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The fault.
        reason: String,
    },
}

impl FileError {
    /// Returns the failure to write a file or folder: where the user will look for it, and of its causes the system's.
    #[must_use]
    pub fn write(path: &Path, cause: io::Error) -> Self {
        let path = staging::visible(path);
        let of_system =
            causes(&cause).find_map(|cause| cause.downcast_ref::<io::Error>()?.raw_os_error());
        let cause = of_system.map_or(cause, io::Error::from_raw_os_error);
        Self::Write { path, cause }
    }

    /// Returns the failure of a results folder's file that is missing or was not written by a run.
    pub fn damaged(path: &Path, reason: &dyn std::fmt::Display) -> Self {
        Self::Damaged {
            path: path.to_owned(),
            reason: reason.to_string(),
        }
    }
}

/// The errors in an error, from the outermost on.
pub fn causes(error: &io::Error) -> impl Iterator<Item = &(dyn Error + 'static)> {
    iter::successors(Some(error as &(dyn Error + 'static)), cause_of)
}

/// The error within an error.
fn cause_of<'a>(error: &&'a (dyn Error + 'static)) -> Option<&'a (dyn Error + 'static)> {
    match error.downcast_ref::<io::Error>() {
        Some(error) => error.get_ref().map(|inner| inner as &(dyn Error + 'static)),
        None => (*error).source(),
    }
}
