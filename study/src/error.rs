//! The reasons why a study cannot be read, continued or merged.

use std::error::Error;
use std::fmt::Display;
use std::io;
use std::path::{Path, PathBuf};

use pellicle::input::diagnosis::Diagnosis;
use pellicle_files::FileError;

/// The reason why a study cannot be read, continued or merged.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// A case, or the study's own table, cannot be read or solved.
    #[error(transparent)]
    Case(#[from] pellicle::Error),
    /// A file or folder of results cannot be written or read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The results of a case beyond its rows cannot be written, for a reason of whoever writes them.
    #[error(transparent)]
    CaseFolder(Box<dyn Error + Send + Sync>),
    /// The folder holds no parts of a study.
    #[error("{}: found no parts of a study, wanted at least one", path.display())]
    NoParts {
        /// The folder.
        path: PathBuf,
    },
    /// The file of a study's samples cannot be read, or a value in it is wrong.
    #[error("{}{place}: found {found}, wanted {wanted}", path.display())]
    Samples {
        /// The file.
        path: PathBuf,
        /// The position in the file, in words.
        place: String,
        /// The fault.
        found: String,
        /// The values allowed.
        wanted: String,
    },
    /// A study has no cases.
    #[error("found no cases in the study, wanted at least one")]
    NoCases,
    /// The table belongs to a study with other values, or was written by another version of the program.
    #[error("{}: found results of another study or of another version: give --fresh to begin again, or another --out", path.display())]
    OtherStudy {
        /// The table.
        path: PathBuf,
    },
    /// The folder belongs to a search of another key, number or case.
    #[error(
        "{}: found a search whose {what} is {found}, wanted {wanted}: give --fresh to begin again, or another --out",
        path.display()
    )]
    OtherSearch {
        /// The folder.
        path: PathBuf,
        /// What differs.
        what: String,
        /// That of the folder.
        found: String,
        /// That of the question.
        wanted: String,
    },
    /// The table of another study is where the merged one should be.
    #[error("{}: found the table of another study: give --force to replace it", path.display())]
    OtherTable {
        /// The table.
        path: PathBuf,
    },
    /// The results of another case are where those of a study's case should be.
    #[error("{}: found results of another case: give --fresh to begin again, or another --out", path.display())]
    OtherCase {
        /// The folder.
        path: PathBuf,
    },
    /// Something else is where the kept fields of a study should be.
    #[error("{}: found other fields than this study keeps: give --fresh to begin again, or move the file away", path.display())]
    NotKept {
        /// The file.
        path: PathBuf,
    },
    /// A field of one case is too large for the format.
    #[error(
        "study.keep: found {steps} loading steps of {elements} x {elements} elements, wanted at most 4 GiB of a field in a case: set output.fields = \"last\" to keep the last step alone"
    )]
    KeptTooLarge {
        /// Elements per side.
        elements: usize,
        /// Loading steps kept.
        steps: usize,
    },
    /// Fields of an oblong cell.
    #[error(
        "study.keep: found an oblong cell, wanted a square domain: the files of kept fields are for squares"
    )]
    KeptOblong,
    /// The threads cannot be started.
    #[error("the threads cannot be started: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
}

impl StudyError {
    /// Returns the failure to write a file or folder: where the user will look for it, and of its causes the system's.
    #[must_use]
    pub fn write(path: &Path, cause: io::Error) -> Self {
        Self::File(FileError::write(path, cause))
    }

    /// Returns the failure of a results folder's file that is missing or was not written by a run.
    pub fn damaged(path: &Path, reason: &dyn Display) -> Self {
        Self::File(FileError::damaged(path, reason))
    }
}

/// Errors that are those of a case.
macro_rules! of_a_case {
    ($($error:ty),*) => {$(
        impl From<$error> for StudyError {
            fn from(error: $error) -> Self {
                Self::Case(error.into())
            }
        }
    )*};
}

of_a_case!(Diagnosis, Box<Diagnosis>, serde_json::Error);
