//! Results put in place as a whole: their folder and the older one exchange names in one step of the system, so that a
//! kill leaves either of them complete.
//!
//! The new folder is beside the old one, as `.pellicle-swap-…-NAME`, until they are exchanged; then the old one has
//! this name. So of a folder of this name that a dead process left, the results are removed; other files move to
//! `NAME`.

use std::env;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use pellicle_files::disk;

use super::claim_lock::LOCK;
use crate::results_folder::own_files;

const PREFIX: &str = ".pellicle-swap-";

/// Puts a complete hidden folder in the place of the claimed folder around it, and moves there what the program has not
/// written. Returns whether it did: not where the system cannot exchange folders, nor in a folder in which this process
/// works; then nothing has changed.
pub(super) fn put_in_place(path: &Path, complete: &Path) -> io::Result<bool> {
    let Some([path, beside]) = places(path, complete) else {
        return Ok(false);
    };
    let complete = path.join(complete.file_name().unwrap_or_default());
    if disk::rename(&complete, &beside).is_err() {
        return Ok(false);
    }
    // The lock has to be in the place of the old one when the folders are exchanged.
    let prepared = disk::hard_link(&path.join(LOCK), &beside.join(LOCK))
        .and_then(|()| disk::set_permissions(&beside, fs::metadata(&path)?.permissions()));
    if prepared.and_then(|()| exchange(&path, &beside)).is_err() {
        drop(disk::remove_file(&beside.join(LOCK)));
        disk::rename(&beside, &complete)?;
        return Ok(false);
    }
    clear(&path, &beside)?;
    Ok(true)
}

/// Clears what dead processes left beside a folder whose lock this process holds.
pub(super) fn settle(path: &Path) -> io::Result<()> {
    let path = fs::canonicalize(path)?;
    let (Some(parent), Some(name)) = (path.parent(), path.file_name()) else {
        return Ok(());
    };
    for entry in fs::read_dir(parent)? {
        let entry = entry?;
        let left = entry.file_name();
        let left = left.to_str().and_then(|left| left.strip_prefix(PREFIX));
        let of = left.and_then(|left| left.split_once('-'));
        if of.is_some_and(|(_, of)| *of == *name) && entry.file_type()?.is_dir() {
            clear(&path, &entry.path())?;
        }
    }
    Ok(())
}

/// The folder without links on its way, and the place of the new one beside it.
fn places(path: &Path, complete: &Path) -> Option<[PathBuf; 2]> {
    let path = fs::canonicalize(path).ok()?;
    if env::current_dir().ok()?.starts_with(&path) {
        return None;
    }
    let random = complete.file_name()?.to_str()?.rsplit('-').next()?;
    let name = path.file_name()?.to_str()?;
    let beside = path.with_file_name(format!("{PREFIX}{random}-{name}"));
    Some([path, beside])
}

/// Moves the files of others from a folder to `path`, where nothing is replaced, and removes the rest.
fn clear(path: &Path, left: &Path) -> io::Result<()> {
    for name in own_files::others(left)? {
        let place = path.join(&name);
        if name != LOCK && fs::symlink_metadata(&place).is_err() {
            disk::rename(&left.join(&name), &place)?;
        }
    }
    own_files::remove_files(left)?;
    if fs::symlink_metadata(left.join(LOCK)).is_ok() {
        disk::remove_file(&left.join(LOCK))?;
    }
    // It stays if it has a file whose name was taken.
    drop(disk::remove_dir(left));
    Ok(())
}

#[cfg(any(target_os = "linux", target_os = "macos"))]
fn exchange(one: &Path, other: &Path) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    disk::allowed(one)?;
    Ok(renameat_with(CWD, one, CWD, other, RenameFlags::EXCHANGE)?)
}

#[cfg(not(any(target_os = "linux", target_os = "macos")))]
fn exchange(_: &Path, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}
