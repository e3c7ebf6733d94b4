//! Files that are not complete yet: each has a random name of its own beside the one that it will have, and a lock that
//! tells whether somebody still writes it.

use std::fs::{self, OpenOptions};
use std::io::{self, BufWriter};
use std::path::Path;

use tempfile::NamedTempFile;

use super::lock;

/// Beginning and end of the names of files that are not complete yet.
const PARTIAL: [&str; 2] = [".pellicle-", ".partial"];

/// A file under its temporary name.
pub type PartialFile = BufWriter<NamedTempFile>;

/// A new file beside the path, with the permissions that any new file has, locked as long as it is open.
///
/// # Errors
///
/// Those of the system if it cannot be created.
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
        // Where the file system knows no locks nothing is swept away either.
        drop(partial.as_file().try_lock());
        // Before it was locked it may have been taken for one that somebody left.
        if lock::is_at(partial.as_file(), partial.path()) {
            return Ok(partial);
        }
    }
}

/// Removes the half-written files that dead processes have left in a folder.
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

/// Whether this is the name of a file that is not complete yet.
#[must_use]
pub fn is_partial(name: &str) -> bool {
    let [prefix, suffix] = PARTIAL;
    name.starts_with(prefix) && name.ends_with(suffix)
}

/// Removes a file whose owner is dead: it has no lock on it any more.
fn remove_if_left(path: &Path) {
    let opened = OpenOptions::new().read(true).write(true).open(path);
    let Ok(file) = opened else { return };
    if file.try_lock().is_ok() && lock::is_at(&file, path) {
        // Best effort: it is tried again by the next.
        drop(fs::remove_file(path));
    }
}
