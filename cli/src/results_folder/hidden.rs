//! The hidden folder in which results are written, and the move of its files up into the results folder.
//!
//! Once complete it is renamed, which makes it valid; then its files move up, `summary.json` or `fit.json` last. Its
//! name shows the stage:
//!
//! | name | action of the next run if the owner is dead |
//! |---|---|
//! | `.pellicle-run-…` | removes it: it is half-written |
//! | `.pellicle-done-…` | removes the older results and continues with the next line |
//! | `.pellicle-move-…` | moves the remaining files up |

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use pellicle::summary;
use pellicle_files::disk;
use pellicle_files::partial;
use pellicle_files::staging::{COMPLETE, EMPTYING, FILLING};
use pellicle_files::unfinished::Unfinished;

use crate::identification::result;
use crate::results_folder::own_files;

/// Whether a dead process was moving results up; the next run finishes this first.
pub(super) fn is_being_emptied(path: &Path) -> bool {
    named(path, EMPTYING).is_ok_and(|folders| !folders.is_empty())
}

/// Makes a new hidden folder.
pub(super) fn scratch(path: &Path) -> io::Result<Unfinished> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(FILLING).rand_bytes(12);
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o777));
    disk::allowed(path)?;
    Ok(Unfinished::folder(&builder.tempdir_in(path)?.keep()))
}

/// Finishes complete results and removes incomplete ones, in a folder whose lock this process holds.
pub(super) fn settle(path: &Path) -> io::Result<()> {
    for left in named(path, FILLING)? {
        remove_half_written(&left);
    }
    for left in named(path, COMPLETE)? {
        empty(path, &left)?;
    }
    for left in named(path, EMPTYING)? {
        move_up(path, &left)?;
    }
    partial::sweep(path);
    Ok(())
}

/// The hidden folders whose names begin with `start`.
fn named(path: &Path, start: &str) -> io::Result<Vec<PathBuf>> {
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

/// Removes the files of a run in a hidden folder, and the folder if it is then empty.
fn remove_half_written(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten() {
        let is_partial = entry.file_name().to_str().is_some_and(partial::is_partial);
        if own_files::is_file(&entry) || own_files::is_fit_file(&entry) || is_partial {
            // Best effort: the next run tries again.
            drop(disk::remove_file(&entry.path()));
        }
    }
    drop(disk::remove_dir(folder));
}

/// Renames the hidden folder with another prefix.
fn renamed(folder: &Path, start: &str) -> io::Result<PathBuf> {
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    let random = name.rsplit('-').next().unwrap_or_default();
    let to = folder.with_file_name(format!("{start}{random}"));
    disk::rename(folder, &to)?;
    Ok(to)
}

/// Marks a filled hidden folder as complete.
pub(super) fn complete(folder: &Path) -> io::Result<PathBuf> {
    renamed(folder, COMPLETE)
}

/// Moves the files of a complete hidden folder up, replacing older results.
pub(super) fn empty(path: &Path, complete: &Path) -> io::Result<()> {
    move_up(path, &remove_older(path, complete)?)
}

/// Removes the results that complete ones replace.
fn remove_older(path: &Path, complete: &Path) -> io::Result<PathBuf> {
    own_files::remove_files(path)?;
    renamed(complete, EMPTYING)
}

/// Moves the files of a hidden folder up, the file that makes them results last, and removes it.
fn move_up(path: &Path, emptying: &Path) -> io::Result<()> {
    let names = fs::read_dir(emptying)?;
    let names = names.map(|entry| Ok(entry?.file_name()));
    let mut names = names.collect::<io::Result<Vec<_>>>()?;
    names.sort_by_key(|name| name == summary::FILE || name == result::FILE);
    for name in names {
        disk::rename(&emptying.join(&name), &path.join(&name))?;
    }
    disk::remove_dir(emptying)
}
