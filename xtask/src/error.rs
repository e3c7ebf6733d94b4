//! The errors of the chores.

use std::io;
use std::path::PathBuf;

use pellicle_cli::Failure;
use pellicle_cli::evidence::ValidationError;
use thiserror::Error;

/// The reason why a chore could not be done.
#[derive(Debug, Error)]
pub enum XtaskError {
    /// A file or folder could not be read.
    #[error("cannot read {path}: {source}", path = path.display())]
    Read {
        /// The file or folder.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The root holds no `Cargo.toml`, so there is nothing to check.
    #[error("no Cargo.toml in {root}: not the root of a workspace", root = root.display())]
    NotAWorkspace {
        /// The folder that was given.
        root: PathBuf,
    },
    /// A file or folder could not be written.
    #[error("cannot write {path}: {source}", path = path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// A program could not be started or waited for.
    #[error("cannot run {program}: {source}", program = program.display())]
    Start {
        /// The program.
        program: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// A run of a case of the paper is not certified, so nothing is drawn from it.
    #[error("not certified: {run}: nothing is drawn from it")]
    NotCertified {
        /// The case, its elements and values.
        run: String,
    },
    /// The program refused a case of the paper.
    #[error("pellicle refused {run}: {message}")]
    Refused {
        /// The case, its elements and values.
        run: String,
        /// The program's error message.
        message: String,
    },
    /// Results of a run that cannot be read.
    #[error(transparent)]
    Results(#[from] Failure),
    /// A number of a page of the documentation that could not be computed.
    #[error(transparent)]
    Evidence(#[from] ValidationError),
    /// A summary that is not one.
    #[error(transparent)]
    Json(#[from] serde_json::Error),
}
