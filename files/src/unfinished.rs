//! Unfinished files and folders, which must not be left behind: they are removed when dropped, and when the program
//! exits without dropping them.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::disk;

/// All unfinished files and folders of this process, in the order in which they were begun.
static ALL: Mutex<Vec<(PathBuf, Leftover)>> = Mutex::new(Vec::new());

/// An unfinished file or folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Leftover {
    File,
    /// A folder that is removed if it is empty.
    Empty,
    /// A folder and everything in it.
    Tree,
}

/// A file or folder on disk that is removed, if still there, when this is dropped.
#[derive(Debug)]
pub struct Unfinished {
    path: PathBuf,
    kind: Leftover,
}

impl Unfinished {
    /// A file.
    #[must_use]
    pub fn file(path: &Path) -> Self {
        Self::new(path, Leftover::File)
    }

    /// A folder that this process has made, to be removed if it is empty.
    #[must_use]
    pub fn empty_folder(path: &Path) -> Self {
        Self::new(path, Leftover::Empty)
    }

    /// A folder that this process has made, with everything in it.
    #[must_use]
    pub fn folder(path: &Path) -> Self {
        Self::new(path, Leftover::Tree)
    }

    fn new(path: &Path, kind: Leftover) -> Self {
        let path = path.to_owned();
        all().push((path.clone(), kind));
        Self { path, kind }
    }

    /// Its path.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    fn forget(&self) {
        let mut all = all();
        if let Some(i) = all.iter().rposition(|(path, _)| *path == self.path) {
            all.remove(i);
        }
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        self.forget();
        remove(&self.path, self.kind);
    }
}

/// Removes everything unfinished, the last begun first. A thread that begins or finishes something after this blocks
/// until the program ends.
pub fn remove_all() {
    let all = all();
    all.iter().rev().for_each(|(path, kind)| match kind {
        // Renamed first, so that no other file can be begun in it.
        Leftover::Tree => {
            let aside = path.with_extension("ended");
            let path = disk::rename(path, &aside).map_or(path, |()| &aside);
            remove(path, Leftover::Tree);
        }
        kind => remove(path, *kind),
    });
    // Locked for ever: a thread that finishes something now would assume that it exists.
    std::mem::forget(all);
}

/// Runs work that [`remove_all`] waits for.
pub fn undisturbed<T>(work: impl FnOnce() -> T) -> T {
    let _held = all();
    work()
}

fn all() -> MutexGuard<'static, Vec<(PathBuf, Leftover)>> {
    ALL.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes a file or folder as far as possible; the next run removes the rest.
fn remove(path: &Path, kind: Leftover) {
    drop(match kind {
        Leftover::File => disk::remove_file(path),
        Leftover::Empty => disk::remove_dir(path),
        Leftover::Tree => disk::remove_dir_all(path),
    });
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn files_and_folders_are_removed_but_a_folder_claimed_empty_stays_if_it_was_filled() {
        let folder = tempfile::tempdir().unwrap();
        let [full, kept, empty, file] =
            ["full", "kept", "empty", "file"].map(|name| folder.path().join(name));
        for folder in [&full, &kept] {
            fs::create_dir(folder).unwrap();
            fs::write(folder.join("in"), "").unwrap();
        }
        fs::create_dir(&empty).unwrap();
        fs::write(&file, "").unwrap();
        drop(Unfinished::folder(&full));
        drop(Unfinished::empty_folder(&kept));
        drop(Unfinished::empty_folder(&empty));
        drop(Unfinished::file(&file));
        assert_eq!(
            [full, kept, empty, file].map(|path| path.exists()),
            [false, true, false, false]
        );
    }
}
