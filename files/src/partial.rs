//! Incomplete files: each has its own random name beside its final one, and a lock that shows whether a process is
//! still writing it.

use std::fs;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::Path;

use tempfile::TempPath;

use crate::disk::{self, DiskFile};
use crate::lock;
use crate::unfinished::Unfinished;
use crate::whole::Existing;

/// Prefix and suffix of the names of incomplete files.
const PARTIAL: [&str; 2] = [".pellicle-", ".partial"];

/// Writes to a file under its temporary name.
pub type PartialFile = BufWriter<Partial>;

/// A file under its temporary name; removed when it is dropped.
#[derive(Debug)]
pub struct Partial {
    file: DiskFile,
    path: TempPath,
    _unfinished: Unfinished,
}

/// Creates a file beside the path, with the permissions of any new file, locked as long as it is open.
///
/// # Errors
///
/// An error of the system if it cannot be created.
pub fn begin(path: &Path) -> io::Result<Partial> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let [prefix, suffix] = PARTIAL;
    loop {
        let mut builder = tempfile::Builder::new();
        builder.prefix(prefix).suffix(suffix).rand_bytes(12);
        let begun = builder
            .disable_cleanup(true)
            .make_in(folder, DiskFile::create_new)?;
        let (file, path) = begun.into_parts();
        let partial = Partial {
            _unfinished: Unfinished::file(&path),
            file,
            path,
        };
        let file = partial.file.as_file();
        // On a file system without locks, no file is swept away either.
        drop(file.try_lock());
        // Before it was locked, another process may have removed it as left behind.
        if lock::is_at(file, &partial.path) {
            return Ok(partial);
        }
    }
}

impl Partial {
    /// The file itself.
    #[must_use]
    pub fn as_file(&self) -> &DiskFile {
        &self.file
    }

    /// Gives the file its name. It stays open, and thereby locked, until then.
    ///
    /// # Errors
    ///
    /// An error of the system, also if a file to be kept has that name; nothing is left behind then.
    pub fn place(self, path: &Path, existing: Existing) -> io::Result<()> {
        disk::allowed(path)?;
        let placed = match existing {
            Existing::Keep => self.path.persist_noclobber(path),
            Existing::Replace => self.path.persist(path),
        };
        placed.map_err(|failed| failed.error)
    }
}

impl Write for Partial {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Seek for Partial {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}

/// Removes the half-written files that dead processes left in a folder.
pub fn sweep(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten() {
        let is_file = entry.file_type().is_ok_and(|kind| kind.is_file());
        if is_file && entry.file_name().to_str().is_some_and(is_partial) {
            remove_if_left(&entry.path());
        }
    }
}

/// Whether this is the name of an incomplete file.
#[must_use]
pub fn is_partial(name: &str) -> bool {
    let [prefix, suffix] = PARTIAL;
    name.starts_with(prefix) && name.ends_with(suffix)
}

/// Removes a file if its owner is dead, so that it is no longer locked.
fn remove_if_left(path: &Path) {
    let Ok(file) = DiskFile::open(path) else {
        return;
    };
    if file.as_file().try_lock().is_ok() && lock::is_at(file.as_file(), path) {
        // Best effort: the next sweep tries again.
        drop(disk::remove_file(path));
    }
}
