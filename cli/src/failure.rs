//! Why the program ends without a certified result, and the exit code that says so.

use std::io;
use std::path::{Path, PathBuf};

use pellicle_contact::{ContactError, IndenterError};
use pellicle_influence::InfluenceError;
use pellicle_kernel::KernelError;
use pellicle_texture::TextureError;

use crate::case::diagnosis::Diagnosis;
use crate::display::memory;
use crate::forecast::Need;

/// Everything that ends a command early.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The case is wrong, at one place in its text.
    #[error(transparent)]
    Case(#[from] Box<Diagnosis>),
    /// There is no such file, or it cannot be read.
    #[error("{}: cannot be read as a case file: {cause}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
    /// The kernel refuses the foundation.
    #[error("the foundation is refused: {0}")]
    Kernel(#[from] KernelError),
    /// The influence coefficients cannot be computed.
    #[error("no influence coefficients for this foundation: {0}")]
    Influence(#[from] InfluenceError),
    /// The relief is refused.
    #[error("the surface is refused: {0}")]
    Texture(#[from] TextureError),
    /// The indenter is refused.
    #[error("the indenter is refused: {0}")]
    Indenter(#[from] IndenterError),
    /// The contact problem cannot be posed or was cancelled.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// A file or folder of that name is there already.
    #[error("{} exists: give --force to replace it, or another --out", path.display())]
    Exists {
        /// What is there.
        path: PathBuf,
    },
    /// Something is there that is not a results folder, and is not touched.
    #[error("{} is there and is not a results folder: give another --out", path.display())]
    NoResults {
        /// What is there.
        path: PathBuf,
    },
    /// Beside the summary of a run is a file under one of its names that it has not written.
    #[error("{} is not of the run whose summary is beside it: move it away, or give another --out", path.display())]
    NotWritten {
        /// The file.
        path: PathBuf,
    },
    /// Of several results only the curve can be drawn.
    #[error(
        "of several results the curves are drawn in one picture: --step, --section, --range and --colour-map are for a single one"
    )]
    OneResult,
    /// A folder has no parts of a study in it.
    #[error("{} holds no parts of a study to gather", path.display())]
    NoParts {
        /// The folder.
        path: PathBuf,
    },
    /// The fields of a loading step were not written.
    #[error("{} holds no fields of step {step} to draw: run the case with --fields all", path.display())]
    NoFields {
        /// The results folder.
        path: PathBuf,
        /// The loading step, counted from 0.
        step: usize,
    },
    /// A study has no cases.
    #[error("the study has no cases")]
    NoCases,
    /// A table is there, of a study with other values or of another version of the program.
    #[error("{} holds results of another study or of another version: give --fresh to begin again, or another --out", path.display())]
    OtherStudy {
        /// The table.
        path: PathBuf,
    },
    /// The table of another study is where the whole table of this one would be.
    #[error("{} is the table of another study: give --force to replace it", path.display())]
    OtherTable {
        /// The table.
        path: PathBuf,
    },
    /// The results of another case are where those of a study's case would be.
    #[error("{} holds results of another case: give --fresh to begin again, or another --out", path.display())]
    OtherCase {
        /// The folder.
        path: PathBuf,
    },
    /// Another process is at work on a table or in a folder.
    #[error("{}: another process is writing to it", path.display())]
    Busy {
        /// The table or folder.
        path: PathBuf,
    },
    /// There is too little memory for the case.
    #[error("the case needs some {} of memory and there are {}: wanted {}", memory(need.bytes), memory(*available), need.hint(*available))]
    Memory {
        /// What it needs.
        need: Need,
        /// What there is, bytes.
        available: u64,
    },
    /// A file or folder cannot be written.
    #[error("{}: cannot be written: {cause}", path.display())]
    Write {
        /// What cannot be written.
        path: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
    /// The folder of the cache cannot be listed, or a file in it not removed.
    #[error("{}: the cache cannot be listed or cleared: {cause}", path.display())]
    Cache {
        /// The folder.
        path: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
    /// A file of a results folder is missing or not what a run writes.
    #[error("{}: not a file of a results folder: {reason}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// Standard output cannot be written to.
    #[error("standard output: cannot be written: {cause}")]
    Output {
        /// What the system says.
        cause: io::Error,
    },
    /// The threads asked for cannot be had.
    #[error("the threads cannot be started: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// A value has no JSON form.
    #[error("no JSON form: {0}")]
    Json(#[from] serde_json::Error),
    /// A value has no TOML form.
    #[error("no TOML form: {0}")]
    Toml(#[from] toml::ser::Error),
}

impl From<Diagnosis> for Failure {
    fn from(diagnosis: Diagnosis) -> Self {
        Self::Case(Box::new(diagnosis))
    }
}

impl Failure {
    /// The failure to write a file or folder.
    #[must_use]
    pub fn write(path: &Path, cause: io::Error) -> Self {
        let path = path.to_owned();
        Self::Write { path, cause }
    }

    /// The failure that this file of a results folder is missing or not what a run writes.
    pub fn damaged(path: &Path, reason: &dyn std::fmt::Display) -> Self {
        Self::Damaged {
            path: path.to_owned(),
            reason: reason.to_string(),
        }
    }

    /// The exit code: 1 where a right case could not be solved, 2 where something is to be put right first.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Contact(
                ContactError::NotPositiveDefinite { .. } | ContactError::DomainTooSmall { .. },
            )
            | Self::Influence(_) => 1,
            _ => 2,
        }
    }

    /// The failure as it is shown on standard error: one diagnosis, drawn where there is a place for it.
    #[must_use]
    pub fn render(&self) -> String {
        match self {
            Self::Case(diagnosis) => diagnosis.render(),
            other => crate::terminal::clean(&format!("Error: {other}")),
        }
    }
}
