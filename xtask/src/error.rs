//! What can go wrong before a rule is checked.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

/// Why the workspace could not be read.
#[derive(Debug, Error)]
pub enum XtaskError {
    /// A file or folder could not be read.
    #[error("cannot read {path}: {source}", path = path.display())]
    Read {
        /// The file or folder.
        path: PathBuf,
        /// What the operating system said.
        source: io::Error,
    },
    /// The root holds no `Cargo.toml`, so there is nothing to check.
    #[error("no Cargo.toml in {root}: not the root of a workspace", root = root.display())]
    NotAWorkspace {
        /// The folder that was given.
        root: PathBuf,
    },
}
