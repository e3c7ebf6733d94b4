//! What can go wrong with a cache on disk, none of which is an error.

use std::fmt;
use std::io::ErrorKind;
use std::path::PathBuf;

use thiserror::Error;

/// Something that the cache on disk could not do. The data asked for were computed instead.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CacheWarning {
    /// A file is not what was written; it is replaced.
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        fault: FileFault,
    },
    /// The folder cannot be written to; nothing more is written to it.
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system says.
        kind: ErrorKind,
    },
}

/// What is wrong with a file of the cache.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum FileFault {
    /// The system does not let it be read.
    #[error("it cannot be read: {0}")]
    Unreadable(ErrorKind),
    /// Something else than a file has its name.
    #[error("it is no regular file")]
    NotAFile,
    /// It does not begin as the cache's files do.
    #[error("it is not a file of the cache")]
    Foreign,
    /// It has another format.
    #[error("its format has version {found}, wanted {wanted}")]
    Version {
        /// The version found.
        found: u64,
        /// The version of this crate.
        wanted: u32,
    },
    /// It holds other data than its name says.
    #[error("it holds other data than its name says")]
    OtherData,
    /// It is cut off, or goes on where it should end.
    #[error("it has {found} bytes, wanted {wanted}")]
    Length {
        /// Bytes found.
        found: u64,
        /// Bytes wanted; the largest number of them where the file itself does not say.
        wanted: u64,
    },
    /// Its bytes have changed.
    #[error("its checksum is wrong")]
    Checksum,
    /// Its checksum is right but its numbers make no sense.
    #[error("its numbers are not in order")]
    Contents,
}

impl CacheWarning {
    /// A short name that does not change, for programs.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::File { .. } => "cache-file",
            Self::Folder { .. } => "cache-folder",
        }
    }
}

impl fmt::Display for CacheWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File { path, fault } => write!(
                f,
                "computed again, the cached file {} is of no use: {fault}",
                path.display()
            ),
            Self::Folder { path, kind } => write!(
                f,
                "nothing is cached, the folder {} cannot be written to: {kind}",
                path.display()
            ),
        }
    }
}
