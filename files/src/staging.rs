//! Names of the hidden folders in which the files of a results folder are written before they are put in place.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// Prefix of the name of a folder that is being filled.
pub const FILLING: &str = ".pellicle-run-";
/// Prefix of the name of a complete folder.
pub const COMPLETE: &str = ".pellicle-done-";
/// Prefix of the name of a complete folder that is being emptied.
pub const EMPTYING: &str = ".pellicle-move-";

/// Whether an entry of a results folder has the name of a hidden folder.
#[must_use]
pub fn is_name(name: &str) -> bool {
    let starts = [FILLING, COMPLETE, EMPTYING];
    starts.iter().any(|start| name.starts_with(start))
}

/// The path as the user will see it: without the hidden folder that is filled.
#[must_use]
pub fn visible(path: &Path) -> PathBuf {
    let is_visible = |part: &&OsStr| !part.to_str().is_some_and(is_name);
    path.iter().filter(is_visible).collect()
}
