//! A results folder: claimed before the work, filled when the work is done, and never replacing files of others.
//!
//! A claimed folder contains a lock and a hidden folder that is filled. Once that is complete, it takes the place of
//! the folder around it; where the system cannot do that, its files move up.

mod claim_lock;
mod hidden;
pub mod own_files;
mod swap;

use std::fs::{self, DirEntry};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use pellicle::Completeness;
use pellicle_files::FileError;
use pellicle_files::lock::Lock;
use pellicle_files::unfinished::{self, Unfinished};
use pellicle_files::whole::Existing;
use pellicle_files::{disk, partial, staging};

use self::claim_lock::{LOCK, says_made, take_lock};
use crate::failure::Failure;

/// Folder for partial results that must not replace complete ones.
const STOPPED: &str = "stopped";

/// Folder for results if files of the same names have appeared in the meantime.
const BESIDE: &str = "results";

/// Largest number tried for a name that is taken.
const MAX_NUMBER: usize = 9999;

/// Attempts to claim a folder that another process may remove meanwhile.
const ATTEMPTS: usize = 100;

/// A claimed results folder. Dropped without being written, it leaves nothing.
#[derive(Debug)]
pub struct ResultsFolder {
    path: PathBuf,
    existing: Existing,
    // Removed in this order.
    scratch: Unfinished,
    _lock: Lock,
    _made: Vec<Unfinished>,
}

impl ResultsFolder {
    /// Claims a folder for this process alone, before any long work.
    ///
    /// # Errors
    ///
    /// [`FileError::Exists`] if the folder contains results to be kept, [`FileError::NoResults`] if it contains
    /// something else, which is never replaced, [`FileError::Busy`] if another process has claimed it,
    /// [`FileError::Write`] if it cannot be written to.
    pub fn claim(path: &Path, existing: Existing) -> Result<Self, Failure> {
        check(path, existing)?;
        for _ in 0..ATTEMPTS {
            match Self::take(path, existing) {
                Err(Failure::File(FileError::Write { cause, .. }))
                    if cause.kind() == ErrorKind::NotFound => {}
                claimed => return claimed,
            }
        }
        Self::take(path, existing)
    }

    /// Claims the default folder of a case of this name: `results/name`, or `results/name-2` and so on if that is taken
    /// and to be kept.
    ///
    /// # Errors
    ///
    /// Those of [`ResultsFolder::claim`].
    pub fn claim_default(name: &str, existing: Existing) -> Result<Self, Failure> {
        let results = Path::new("results");
        let first = results.join(name);
        if existing == Existing::Replace {
            return Self::claim(&first, existing);
        }
        let numbered = (2..=MAX_NUMBER).map(|i| results.join(format!("{name}-{i}")));
        let taken = |failure: &Failure| {
            matches!(
                failure,
                Failure::File(
                    FileError::Exists { .. } | FileError::NoResults { .. } | FileError::Busy { .. }
                )
            )
        };
        for path in std::iter::once(first.clone()).chain(numbered) {
            match Self::claim(&path, existing) {
                Err(failure) if taken(&failure) => {}
                claimed => return claimed,
            }
        }
        Self::claim(&first, existing)
    }

    fn take(path: &Path, existing: Existing) -> Result<Self, Failure> {
        let failed = |cause| Failure::write(path, cause);
        let mut made = make(path).map_err(failed)?;
        let lock = take_lock(path, !made.is_empty()).map_err(failed)?;
        let lock = lock.ok_or_else(|| FileError::Busy {
            path: path.to_owned(),
        })?;
        if lock.found().is_some_and(says_made) {
            made.push(Unfinished::empty_folder(path));
        }
        hidden::settle(path).map_err(failed)?;
        swap::settle(path).map_err(failed)?;
        check(path, existing)?;
        Ok(Self {
            path: path.to_owned(),
            existing,
            scratch: hidden::scratch(path).map_err(failed)?,
            _lock: lock,
            _made: made,
        })
    }

    /// Path of the results folder.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Fills the hidden folder, puts it in place and returns the path of the results. A partial result never replaces
    /// a complete one: it goes into its own folder within.
    ///
    /// # Errors
    ///
    /// The failure of `fill`, or [`FileError::Write`]; nothing is left behind then.
    pub fn write(
        self,
        fill: impl FnOnce(&Path) -> Result<Completeness, Failure>,
    ) -> Result<PathBuf, Failure> {
        let completeness = fill(self.scratch.path())?;
        let failed = |cause| Failure::write(&self.path, cause);
        let aside = match (contents(&self.path), self.existing, completeness) {
            (FolderContents::Empty, ..)
            | (FolderContents::Results, Existing::Replace, Completeness::Whole) => None,
            (FolderContents::Results, Existing::Replace, Completeness::Part) => Some(STOPPED),
            _ => Some(BESIDE),
        };
        if let Some(name) = aside {
            return self.put_aside(name);
        }
        let scratch = self.scratch.path();
        unfinished::undisturbed(|| {
            let complete = hidden::complete(scratch)?;
            if swap::put_in_place(&self.path, &complete)? {
                return Ok(());
            }
            hidden::empty(&self.path, &complete)
        })
        .map_err(failed)?;
        Ok(self.path.clone())
    }

    /// Renames the hidden folder to `name`, or to the first numbered name that is free.
    fn put_aside(&self, name: &str) -> Result<PathBuf, Failure> {
        let numbered = (2..=MAX_NUMBER).map(|i| format!("{name}-{i}"));
        for name in std::iter::once(name.to_owned()).chain(numbered) {
            let path = self.path.join(name);
            if fs::symlink_metadata(&path).is_err() {
                let moved = unfinished::undisturbed(|| disk::rename(self.scratch.path(), &path));
                return moved
                    .map(|()| path)
                    .map_err(|cause| Failure::write(&self.path, cause));
            }
        }
        Err(FileError::Exists {
            path: self.path.join(name),
        }
        .into())
    }
}

/// Finishes or removes the files that dead processes left in the folders beside this one, as the next run there would.
pub fn sweep_beside(path: &Path) {
    let parent = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    if let Ok(entries) = fs::read_dir(parent) {
        entries.flatten().for_each(|entry| sweep(&entry.path()));
    }
}

/// Finishes or removes the files that a dead process left in a folder.
fn sweep(folder: &Path) {
    let is_left = fs::symlink_metadata(folder.join(LOCK)).is_ok_and(|lock| lock.is_file());
    if !is_left {
        return;
    }
    // Best effort: the next claim of the folder tries again and reports a failure.
    let Ok(Some(lock)) = take_lock(folder, false) else {
        return;
    };
    let _made = lock
        .found()
        .is_some_and(says_made)
        .then(|| Unfinished::empty_folder(folder));
    drop(hidden::settle(folder).and_then(|()| swap::settle(folder)));
    drop(lock);
}

/// The contents of a folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum FolderContents {
    /// Only the hidden files of a claim, or no folder.
    Empty,
    /// Results of this program.
    Results,
    /// Files that this program did not write.
    Foreign,
}

fn contents(path: &Path) -> FolderContents {
    if fs::symlink_metadata(path).is_err() {
        return FolderContents::Empty;
    }
    let Ok(mut entries) = fs::read_dir(path) else {
        return FolderContents::Foreign;
    };
    if entries.all(|entry| entry.is_ok_and(|entry| is_hidden(&entry))) {
        FolderContents::Empty
    } else if own_files::case_in(path).is_some() || own_files::is_fit(path) {
        FolderContents::Results
    } else {
        FolderContents::Foreign
    }
}

/// Whether an entry belongs to a claim.
fn is_hidden(entry: &DirEntry) -> bool {
    let name = entry.file_name();
    name.to_str().is_some_and(|name| {
        name.starts_with(LOCK) || staging::is_name(name) || partial::is_partial(name)
    })
}

fn check(path: &Path, existing: Existing) -> Result<(), Failure> {
    let path_buf = || path.to_owned();
    match (contents(path), existing) {
        (FolderContents::Foreign, _) if !hidden::is_being_emptied(path) => {
            Err(FileError::NoResults { path: path_buf() }.into())
        }
        (FolderContents::Results, Existing::Keep) => {
            Err(FileError::Exists { path: path_buf() }.into())
        }
        (FolderContents::Results, Existing::Replace) => match own_files::not_written(path) {
            Some(file) if !hidden::is_being_emptied(path) => {
                Err(FileError::NotWritten { path: file }.into())
            }
            _ => Ok(()),
        },
        _ => Ok(()),
    }
}

/// Makes a folder and its missing parents, and returns those that it made.
fn make(path: &Path) -> io::Result<Vec<Unfinished>> {
    let is_missing = |path: &&Path| !path.as_os_str().is_empty() && !path.is_dir();
    let missing: Vec<_> = path.ancestors().take_while(is_missing).collect();
    let mut made = Vec::new();
    for folder in missing.into_iter().rev() {
        match disk::create_dir(folder) {
            Ok(()) => made.push(Unfinished::empty_folder(folder)),
            Err(error) if error.kind() == ErrorKind::AlreadyExists && folder.is_dir() => {}
            Err(error) => return Err(error),
        }
    }
    // Inner folders are dropped first.
    made.reverse();
    Ok(made)
}

#[cfg(test)]
mod tests;
