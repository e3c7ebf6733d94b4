//! A results folder: its place claimed before the work, filled when the work is done, and never in the place of what
//! somebody else has written.
//!
//! A claimed place is a folder with a lock in it and a hidden folder that is filled. When that is complete it is
//! renamed, which makes it valid, and its files move up into the place, `summary.json` last. The names of the hidden
//! folder say how far this is:
//!
//! | name | what a run that finds it, its owner dead, does with it |
//! |---|---|
//! | `.pellicle-run-…` | removes it: it is half-written |
//! | `.pellicle-done-…` | removes the older results in the place and goes on with the next |
//! | `.pellicle-move-…` | moves the files that are still in it up |

use std::fs::{self, DirEntry};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::process;

use super::file::{self, Existing};
use super::lock::Lock;
use super::unfinished::{self, Unfinished};
use super::{run_files, summary};
use crate::failure::Failure;

/// Name of the lock in a claimed place.
const LOCK: &str = ".pellicle-lock";

/// Beginnings of the names of the hidden folder: being filled, complete, being emptied.
const FILLING: &str = ".pellicle-run-";
const COMPLETE: &str = ".pellicle-done-";
const EMPTYING: &str = ".pellicle-move-";

/// Where results go that are not whole and must not replace those that are.
const STOPPED: &str = "stopped";

/// Where results go if somebody has put something of the same names into the place meanwhile.
const BESIDE: &str = "results";

/// Most numbers tried for a place that is taken.
const MOST_NUMBERS: usize = 9999;

/// How often another process may remove a folder while it is being claimed.
const ATTEMPTS: usize = 100;

/// Whether results are all that was asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Every loading step.
    Whole,
    /// What was there when the user stopped it.
    Part,
}

/// A claimed place for a results folder. Dropped without being written, it leaves nothing.
#[derive(Debug)]
pub struct ResultsFolder {
    path: PathBuf,
    existing: Existing,
    // In this order they are removed.
    scratch: Unfinished,
    _lock: Lock,
    _made: Vec<Unfinished>,
}

impl ResultsFolder {
    /// Claims a place, before any long work, for this process alone.
    ///
    /// # Errors
    ///
    /// [`Failure::Exists`] if results are there and are to be kept, [`Failure::NoResults`] if something else is there,
    /// which is never replaced, [`Failure::Busy`] if another process has claimed it, [`Failure::Write`] if nothing can
    /// be written here.
    pub fn claim(path: &Path, existing: Existing) -> Result<Self, Failure> {
        check(path, existing)?;
        for _ in 0..ATTEMPTS {
            match Self::take(path, existing) {
                Err(Failure::Write { cause, .. }) if cause.kind() == ErrorKind::NotFound => {}
                claimed => return claimed,
            }
        }
        Self::take(path, existing)
    }

    /// The place for a case of this name unless another is given: `results/name`, or `results/name-2` and so on where
    /// that is taken and to be kept.
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
        let numbered = (2..=MOST_NUMBERS).map(|i| results.join(format!("{name}-{i}")));
        let taken = |failure: &Failure| {
            matches!(
                failure,
                Failure::Exists { .. } | Failure::NoResults { .. } | Failure::Busy { .. }
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
        let lock = lock.ok_or_else(|| Failure::Busy {
            path: path.to_owned(),
        })?;
        if lock.found().is_some_and(says_made) {
            made.push(Unfinished::empty_folder(path));
        }
        settle(path).map_err(failed)?;
        check(path, existing)?;
        Ok(Self {
            path: path.to_owned(),
            existing,
            scratch: scratch(path).map_err(failed)?,
            _lock: lock,
            _made: made,
        })
    }

    /// Where it will be.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Fills the hidden folder, then moves what is in it to the place; where it is now. Part of a result, as `fill`
    /// says, never replaces a whole one: it is put into a folder of its own in the place.
    ///
    /// # Errors
    ///
    /// What `fill` returns, or [`Failure::Write`]; nothing is left behind then.
    pub fn write(
        self,
        fill: impl FnOnce(&Path) -> Result<Extent, Failure>,
    ) -> Result<PathBuf, Failure> {
        let extent = fill(self.scratch.path())?;
        let failed = |cause| Failure::write(&self.path, cause);
        let aside = match (contents(&self.path), self.existing, extent) {
            (Contents::Empty, ..) | (Contents::Results, Existing::Replace, Extent::Whole) => None,
            (Contents::Results, Existing::Replace, Extent::Part) => Some(STOPPED),
            _ => Some(BESIDE),
        };
        if let Some(name) = aside {
            return self.put_aside(name);
        }
        let scratch = self.scratch.path();
        unfinished::undisturbed(|| {
            let complete = renamed(scratch, COMPLETE)?;
            let emptying = remove_older(&self.path, &complete)?;
            move_up(&self.path, &emptying)
        })
        .map_err(failed)?;
        Ok(self.path.clone())
    }

    /// The hidden folder becomes one that shows, with the first of these names that is free.
    fn put_aside(&self, name: &str) -> Result<PathBuf, Failure> {
        let numbered = (2..=MOST_NUMBERS).map(|i| format!("{name}-{i}"));
        for name in std::iter::once(name.to_owned()).chain(numbered) {
            let path = self.path.join(name);
            if fs::symlink_metadata(&path).is_err() {
                let moved = unfinished::undisturbed(|| fs::rename(self.scratch.path(), &path));
                return moved
                    .map(|()| path)
                    .map_err(|cause| Failure::write(&self.path, cause));
            }
        }
        Err(Failure::Exists {
            path: self.path.join(name),
        })
    }
}

/// Finishes or removes what dead processes have left in the folders beside a place, as the next run there would.
pub fn sweep_beside(path: &Path) {
    let parent = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    if let Ok(entries) = fs::read_dir(parent) {
        entries.flatten().for_each(|entry| sweep(&entry.path()));
    }
}

/// Finishes or removes what a dead process has left in a folder.
fn sweep(folder: &Path) {
    let is_left = fs::symlink_metadata(folder.join(LOCK)).is_ok_and(|lock| lock.is_file());
    if !is_left {
        return;
    }
    // Best effort: who claims the place tries again, and is told.
    let Ok(Some(lock)) = take_lock(folder, false) else {
        return;
    };
    let _made = lock
        .found()
        .is_some_and(says_made)
        .then(|| Unfinished::empty_folder(folder));
    drop(settle(folder));
    drop(lock);
}

/// What is at a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Contents {
    /// Nothing, or a folder with nothing but the hidden files of a claim.
    Empty,
    /// Results of this program.
    Results,
    /// Something that this program did not write.
    Foreign,
}

fn contents(path: &Path) -> Contents {
    if fs::symlink_metadata(path).is_err() {
        return Contents::Empty;
    }
    let Ok(mut entries) = fs::read_dir(path) else {
        return Contents::Foreign;
    };
    if entries.all(|entry| entry.is_ok_and(|entry| is_hidden(&entry))) {
        Contents::Empty
    } else if run_files::case_in(path).is_some() {
        Contents::Results
    } else {
        Contents::Foreign
    }
}

/// Whether a claim of a place has made an entry of it.
fn is_hidden(entry: &DirEntry) -> bool {
    let name = entry.file_name();
    name.to_str().is_some_and(|name| {
        let starts = [LOCK, FILLING, COMPLETE, EMPTYING];
        starts.iter().any(|start| name.starts_with(start)) || file::is_partial(name)
    })
}

fn check(path: &Path, existing: Existing) -> Result<(), Failure> {
    let path_buf = || path.to_owned();
    match (contents(path), existing) {
        (Contents::Foreign, _) if !is_being_emptied(path) => {
            Err(Failure::NoResults { path: path_buf() })
        }
        (Contents::Results, Existing::Keep) => Err(Failure::Exists { path: path_buf() }),
        (Contents::Results, Existing::Replace) => match run_files::not_written(path) {
            Some(file) if !is_being_emptied(path) => Err(Failure::NotWritten { path: file }),
            _ => Ok(()),
        },
        _ => Ok(()),
    }
}

/// Whether a dead process was just about to move results to this place: whoever claims it finishes this first.
fn is_being_emptied(path: &Path) -> bool {
    hidden(path, EMPTYING).is_ok_and(|hidden| !hidden.is_empty())
}

/// Makes a folder and those above it that are not there; those it has made.
fn make(path: &Path) -> io::Result<Vec<Unfinished>> {
    let is_missing = |path: &&Path| !path.as_os_str().is_empty() && !path.is_dir();
    let missing: Vec<_> = path.ancestors().take_while(is_missing).collect();
    let mut made = Vec::new();
    for folder in missing.into_iter().rev() {
        match fs::create_dir(folder) {
            Ok(()) => made.push(Unfinished::empty_folder(folder)),
            Err(error) if error.kind() == ErrorKind::AlreadyExists && folder.is_dir() => {}
            Err(error) => return Err(error),
        }
    }
    // The inner ones are dropped first.
    made.reverse();
    Ok(made)
}

fn take_lock(path: &Path, is_made: bool) -> io::Result<Option<Lock>> {
    let made = if is_made { MADE } else { "" };
    let text = format!(
        "pellicle (process {}) is at work here. If it was killed, the next run here removes what it has left.\n{made}",
        process::id()
    );
    Lock::take(&path.join(LOCK), &text)
}

/// What the lock's file says if the folder was not there before.
const MADE: &str = "It has made this folder.\n";

fn says_made(text: &str) -> bool {
    text.ends_with(MADE)
}

/// A new hidden folder in a place.
fn scratch(path: &Path) -> io::Result<Unfinished> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(FILLING).rand_bytes(12);
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o777));
    Ok(Unfinished::folder(&builder.tempdir_in(path)?.keep()))
}

/// Finishes what was complete and removes what was not, in a place whose lock this process has.
fn settle(path: &Path) -> io::Result<()> {
    for left in hidden(path, FILLING)? {
        remove_half_written(&left);
    }
    for left in hidden(path, COMPLETE)? {
        move_up(path, &remove_older(path, &left)?)?;
    }
    for left in hidden(path, EMPTYING)? {
        move_up(path, &left)?;
    }
    file::sweep(path);
    Ok(())
}

/// The hidden folders whose names begin like this.
fn hidden(path: &Path, start: &str) -> io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(path)? {
        let entry = entry?;
        let is_named = entry
            .file_name()
            .to_str()
            .is_some_and(|name| name.starts_with(start));
        if is_named && entry.file_type()?.is_dir() {
            found.push(entry.path());
        }
    }
    Ok(found)
}

/// Removes the files of a run in a hidden folder, and the folder if nothing else is in it.
fn remove_half_written(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten() {
        let is_partial = entry.file_name().to_str().is_some_and(file::is_partial);
        if run_files::is_file(&entry) || is_partial {
            // Best effort: what stays is tried again by the next run.
            drop(fs::remove_file(entry.path()));
        }
    }
    drop(fs::remove_dir(folder));
}

/// The same hidden folder with another beginning of its name.
fn renamed(folder: &Path, start: &str) -> io::Result<PathBuf> {
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    let random = name.rsplit('-').next().unwrap_or_default();
    let to = folder.with_file_name(format!("{start}{random}"));
    fs::rename(folder, &to)?;
    Ok(to)
}

/// Removes the results that complete ones replace.
fn remove_older(path: &Path, complete: &Path) -> io::Result<PathBuf> {
    run_files::remove_files(path)?;
    renamed(complete, EMPTYING)
}

/// Moves the files of a hidden folder up, the summary last, and removes it.
fn move_up(path: &Path, emptying: &Path) -> io::Result<()> {
    let names = fs::read_dir(emptying)?;
    let names = names.map(|entry| Ok(entry?.file_name()));
    let mut names = names.collect::<io::Result<Vec<_>>>()?;
    names.sort_by_key(|name| name == summary::FILE);
    for name in names {
        fs::rename(emptying.join(&name), path.join(&name))?;
    }
    fs::remove_dir(emptying)
}

#[cfg(test)]
mod tests;
