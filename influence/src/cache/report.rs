//! The reports of a cache: origin of data, size on disk, warnings.

use std::io::ErrorKind;
use std::path::PathBuf;

use thiserror::Error;

/// The origin of data; data from several origins have the largest of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Origin {
    /// Computed, and never kept on disk because reading is no faster: a homogeneous body's radial tables, a small grid.
    Immediate,
    /// Already in memory.
    Memory,
    /// Read from disk.
    Disk,
    /// Computed.
    Computed,
}

impl Origin {
    /// Whether a computation was saved.
    #[must_use]
    pub fn is_cache(self) -> bool {
        matches!(self, Self::Memory | Self::Disk)
    }
}

/// Data and their origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cached<T> {
    /// The data.
    pub value: T,
    /// Their origin.
    pub origin: Origin,
}

impl<T> Cached<T> {
    /// Other data with the same origin.
    pub fn map<U>(self, function: impl FnOnce(T) -> U) -> Cached<U> {
        Cached {
            value: function(self.value),
            origin: self.origin,
        }
    }
}

/// The size of a cache on disk.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Usage {
    /// Number of files.
    pub files: usize,
    /// Their total length.
    pub bytes: u64,
}

impl Usage {
    /// Counts one more file.
    pub(super) fn add(&mut self, bytes: u64) {
        self.files += 1;
        self.bytes += bytes;
    }
}

/// A failure of the cache on disk. The data were computed instead.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum CacheWarning {
    /// A file is truncated, altered or foreign; it is replaced.
    #[error("the cached file {} is damaged; its contents are recomputed", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
    },
    /// A file cannot be read; it is replaced.
    #[error("the cached file {} cannot be read ({kind}); its contents are recomputed", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        kind: ErrorKind,
    },
    /// The folder cannot be written to; no further writes are attempted.
    #[error("nothing is cached; the folder {} cannot be written to: {kind}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// The system's reason.
        kind: ErrorKind,
    },
}

impl CacheWarning {
    /// A short, stable name for programs.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::Damaged { .. } | Self::Unreadable { .. } => "cache-file",
            Self::Folder { .. } => "cache-folder",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Origin::{Computed, Disk, Immediate, Memory};

    #[test]
    fn combined_data_are_cached_if_no_part_was_computed_and_one_was_cached() {
        assert!(Immediate.max(Memory).max(Disk).is_cache());
        assert!(!Immediate.max(Immediate).is_cache());
        assert!(!Disk.max(Computed).is_cache());
    }
}
