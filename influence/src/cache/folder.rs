//! The folder on disk.

use std::fs::{self, DirEntry, File, Metadata};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use super::encoding::Decoder;
use super::file::{self, HEADER};
use super::key::Key;
use super::warning::{CacheWarning, FileFault};

/// End of the names of the cache's files.
const EXTENSION: &str = ".pellicle";

/// Beginning and end of the names of files that are not complete yet.
const PARTIAL: [&str; 2] = [".pellicle-", ".partial"];

/// Hexadecimal digits of a key.
const DIGITS: usize = 64;

/// What a cache takes on disk.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Usage {
    /// Number of files.
    pub files: usize,
    /// Their lengths together.
    pub bytes: u64,
}

#[derive(Debug)]
pub(super) struct Folder {
    path: PathBuf,
    /// Set by the first failure: nothing is written any more.
    refused: AtomicBool,
}

impl Folder {
    pub(super) fn new(path: PathBuf) -> Self {
        Self {
            path,
            refused: AtomicBool::new(false),
        }
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// What was kept, or none if there is no such file.
    pub(super) fn read<T>(
        &self,
        key: &Key,
        largest_payload: usize,
        decode: impl FnOnce(&mut Decoder<'_>) -> Option<T>,
    ) -> Result<Option<T>, CacheWarning> {
        let path = self.file(key);
        let opened = open(&path, HEADER + largest_payload);
        let read = opened.and_then(|opened| {
            opened
                .map(|(file, length)| file::unseal(key, file, length, decode))
                .transpose()
        });
        read.map_err(|fault| CacheWarning::File { path, fault })
    }

    /// Keeps a payload, unless the folder has refused one before.
    pub(super) fn write(
        &self,
        key: &Key,
        payload: impl FnOnce() -> Vec<u8>,
    ) -> Result<(), CacheWarning> {
        if self.refused.load(Ordering::Relaxed) {
            return Ok(());
        }
        let payload = payload();
        self.write_whole(key, &payload).map_err(|cause| {
            self.refused.store(true, Ordering::Relaxed);
            CacheWarning::Folder {
                path: self.path.clone(),
                kind: cause.kind(),
            }
        })
    }

    /// Writes under a temporary name and renames. What a crash or power failure leaves half written, its checksum gives away, so nothing
    /// waits for the disk.
    fn write_whole(&self, key: &Key, payload: &[u8]) -> io::Result<()> {
        fs::create_dir_all(&self.path)?;
        let [prefix, suffix] = PARTIAL;
        let mut builder = tempfile::Builder::new();
        builder.prefix(prefix).suffix(suffix);
        // As any new file: others may read it unless the user's mask says no.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let mut partial = builder.tempfile_in(&self.path)?;
        partial.write_all(&file::seal(key, payload))?;
        partial.write_all(payload)?;
        match partial.persist(self.file(key)) {
            // Another process cleared the cache meanwhile.
            Err(failure) if failure.error.kind() == ErrorKind::NotFound => Ok(()),
            Err(failure) => Err(failure.error),
            Ok(_) => Ok(()),
        }
    }

    pub(super) fn usage(&self) -> io::Result<Usage> {
        let mut usage = Usage::default();
        for (_, metadata) in self.own()? {
            usage.add(&metadata);
        }
        Ok(usage)
    }

    pub(super) fn clear(&self) -> io::Result<Usage> {
        let mut usage = Usage::default();
        for (path, metadata) in self.own()? {
            if unless_missing(fs::remove_file(path))?.is_some() {
                usage.add(&metadata);
            }
        }
        Ok(usage)
    }

    /// The cache's own files, by their names.
    fn own(&self) -> io::Result<Vec<(PathBuf, Metadata)>> {
        let Some(entries) = unless_missing(fs::read_dir(&self.path))? else {
            return Ok(Vec::new());
        };
        let mut own = Vec::new();
        for entry in entries {
            let entry = entry?;
            if !is_own(&entry) {
                continue;
            }
            if let Some(metadata) = unless_missing(entry.metadata())?.filter(Metadata::is_file) {
                own.push((entry.path(), metadata));
            }
        }
        Ok(own)
    }

    fn file(&self, key: &Key) -> PathBuf {
        self.path.join(format!("{}{EXTENSION}", key.0.to_hex()))
    }
}

impl Usage {
    fn add(&mut self, metadata: &Metadata) {
        self.files += 1;
        self.bytes += metadata.len();
    }
}

/// A file that is not longer than it may be, and its length; none if there is none.
fn open(path: &Path, largest: usize) -> Result<Option<(File, u64)>, FileFault> {
    let metadata = match fs::metadata(path) {
        Ok(metadata) => metadata,
        Err(error) => return missing(&error),
    };
    if !metadata.is_file() {
        return Err(FileFault::NotAFile);
    }
    let opened = File::open(path).and_then(|file| {
        // Another process may have put another file in its place meanwhile.
        let length = file.metadata()?.len();
        Ok((file, length))
    });
    match opened {
        Ok((_, found)) if found > largest as u64 => Err(FileFault::Length {
            found,
            wanted: largest as u64,
        }),
        Ok(opened) => Ok(Some(opened)),
        Err(error) => missing(&error),
    }
}

/// A file that is not there is no fault. That its folder is none shows when it is written to.
fn missing<T>(error: &io::Error) -> Result<Option<T>, FileFault> {
    match error.kind() {
        ErrorKind::NotFound | ErrorKind::NotADirectory => Ok(None),
        kind => Err(FileFault::Unreadable(kind)),
    }
}

fn unless_missing<T>(result: io::Result<T>) -> io::Result<Option<T>> {
    match result {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        result => result.map(Some),
    }
}

/// Whether the name is one that the cache gives.
fn is_own(entry: &DirEntry) -> bool {
    let name = entry.file_name();
    let Some(name) = name.to_str() else {
        return false;
    };
    let [prefix, suffix] = PARTIAL;
    let is_key = |stem: &str| {
        let digit = |byte: u8| matches!(byte, b'0'..=b'9' | b'a'..=b'f');
        stem.len() == DIGITS && stem.bytes().all(digit)
    };
    name.strip_suffix(EXTENSION).is_some_and(is_key)
        || (name.starts_with(prefix) && name.ends_with(suffix))
}
