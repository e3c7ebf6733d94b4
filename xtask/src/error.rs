//! The errors of the chores.

use std::io;
use std::path::{Path, PathBuf};

use pellicle_cli::Failure;
use pellicle_validation::ValidationError;
use thiserror::Error;

use crate::site::PageFault;

/// The reason why a chore could not be done.
#[derive(Debug, Error)]
pub enum XtaskError {
    /// A file or folder could not be read.
    #[error("{}: cannot be read: {cause}", path.display())]
    Read {
        /// The file or folder.
        path: PathBuf,
        /// The error of the operating system.
        cause: io::Error,
    },
    /// A file could not be written.
    #[error("{}: cannot be written: {cause}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        cause: io::Error,
    },
    /// The root holds no `Cargo.toml`, so there is nothing to check.
    #[error("{}: found no Cargo.toml, wanted the root of a workspace", root.display())]
    NotAWorkspace {
        /// The folder that was given.
        root: PathBuf,
    },
    /// A program could not be started or waited for.
    #[error("{}: cannot be run: {cause}", program.display())]
    Start {
        /// The program.
        program: PathBuf,
        /// The error of the operating system.
        cause: io::Error,
    },
    /// The program could not be built; cargo has said why.
    #[error("the program cannot be built in release")]
    NotBuilt,
    /// A page that the contents of the site lack.
    #[error(transparent)]
    Page(#[from] PageFault),
    /// The site could not be built; mdBook has said why.
    #[error("mdBook cannot build the site")]
    NoSite,
    /// A run of a case of the paper is not certified, so nothing is drawn from it.
    #[error("{run}: found a solution that is not certified, wanted one to draw")]
    NotCertified {
        /// The case, its elements and values.
        run: String,
    },
    /// The program refused a case of the paper.
    #[error("{run}: cannot be solved: {message}")]
    Refused {
        /// The case, its elements and values.
        run: String,
        /// The program's error message.
        message: String,
    },
    /// Results of a run could not be read, or a picture could not be written.
    #[error(transparent)]
    Results(#[from] Failure),
    /// A number for a documentation page could not be computed.
    #[error(transparent)]
    Evidence(#[from] ValidationError),
}

impl XtaskError {
    /// A file or folder that cannot be read.
    pub(crate) fn read(path: &Path, cause: io::Error) -> Self {
        Self::Read {
            path: path.into(),
            cause,
        }
    }

    /// A program that cannot be started or waited for.
    #[must_use]
    pub fn start(program: &Path, cause: io::Error) -> Self {
        Self::Start {
            program: program.into(),
            cause,
        }
    }

    /// A file that cannot be written.
    pub(crate) fn write(path: &Path, cause: io::Error) -> Self {
        Self::Write {
            path: path.into(),
            cause,
        }
    }
}
