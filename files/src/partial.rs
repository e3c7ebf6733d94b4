//! Incomplete files: each has its own random name beside its final one, and a lock that shows whether a process is
//! still writing it.

use std::fs::{self, OpenOptions};
use std::io::{self, BufWriter};
use std::path::Path;

use tempfile::NamedTempFile;

use crate::lock;

/// Prefix and suffix of the names of incomplete files.
const PARTIAL: [&str; 2] = [".pellicle-", ".partial"];

/// A file under its temporary name.
pub type PartialFile = BufWriter<NamedTempFile>;

/// Creates a file beside the path, with the permissions of any new file, locked as long as it is open.
///
/// # Errors
///
/// An error of the system if it cannot be created.
pub fn begin(path: &Path) -> io::Result<NamedTempFile> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let [prefix, suffix] = PARTIAL;
    loop {
        let mut builder = tempfile::Builder::new();
        builder.prefix(prefix).suffix(suffix).rand_bytes(12);
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let partial = builder.tempfile_in(folder)?;
        // On a file system without locks, no file is swept away either.
        drop(partial.as_file().try_lock());
        // Before it was locked, another process may have removed it as left behind.
        if lock::is_at(partial.as_file(), partial.path()) {
            return Ok(partial);
        }
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
    let opened = OpenOptions::new().read(true).write(true).open(path);
    let Ok(file) = opened else { return };
    if file.try_lock().is_ok() && lock::is_at(&file, path) {
        // Best effort: the next sweep tries again.
        drop(fs::remove_file(path));
    }
}
