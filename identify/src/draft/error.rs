//! The reasons why no fit file can be drafted from a measured file.

use std::path::PathBuf;

use crate::measured::error::CurveError;

/// The reason why no fit file can be drafted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DraftError {
    /// No file was given, or none matches.
    #[error(
        "found no file, wanted a measured curve, a pattern such as \"curves/*.txt\" or a folder"
    )]
    NoFiles,
    /// The file gives no table or no curve.
    #[error("{}: {error}", file.display())]
    Curve {
        /// The file.
        file: PathBuf,
        /// The reason.
        error: CurveError,
    },
    /// The columns are not those of a curve.
    #[error("{}: found {columns}, wanted {wanted}: name them in columns of a fit file", file.display())]
    Columns {
        /// The file.
        file: PathBuf,
        /// The columns found.
        columns: String,
        /// The columns wanted.
        wanted: &'static str,
    },
    /// The drafted table is not read.
    #[error("{}: {message}", file.display())]
    Refused {
        /// The file.
        file: PathBuf,
        /// What the reader says.
        message: String,
    },
}
