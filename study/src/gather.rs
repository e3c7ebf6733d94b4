//! Merges the tables of a study's parts into one.

use std::fs::{self, File};
use std::path::{Path, PathBuf};

use pellicle_files::FileError;
use pellicle_files::partial;

use crate::StudyError;
use crate::case_blocks::CaseBlocks;
use crate::case_status::Tally;
use crate::folder;
use crate::identity::StudyIdentity;
use crate::kept_file;
use crate::report;
use crate::results_table;
use crate::shard::Shard;

/// The result of merging.
#[derive(Debug, Clone, PartialEq)]
pub struct Gathered {
    /// The statuses of the cases found.
    pub tally: Tally,
    /// The missing cases, counted from 0.
    pub missing: Vec<usize>,
    /// The merged table; `None` if cases are missing.
    pub table: Option<PathBuf>,
}

/// What to do with another study's table in the place of the merged one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OtherTable {
    /// Keep it.
    Keep,
    /// Replace it.
    Replace,
}

/// Reads the parts in `folder` and, if no case is missing, writes the table that the undivided study would have
/// written.
///
/// # Errors
///
/// [`StudyError`] if there are no parts, if they belong to different studies, if a table cannot be read or written, or
/// if something else is in the place of the merged table.
pub fn gather(folder: &Path, other: OtherTable) -> Result<Gathered, StudyError> {
    let parts = parts(folder)?;
    let Some(first) = parts.first() else {
        return Err(StudyError::NoParts {
            path: folder.to_owned(),
        });
    };
    if let Some(other) = parts.iter().find(|part| !are_of_one(part, first)) {
        let (a, b) = (first.shard, other.shard);
        let reason = format!("the parts {a} and {b} are of different studies");
        return Err(StudyError::damaged(folder, &reason));
    }
    if !first.is_of_this_layout() {
        let path = StudyIdentity::path(folder, first.shard);
        return Err(StudyError::damaged(
            &path,
            &"it was written by another version",
        ));
    }
    let whole = StudyIdentity {
        shard: Shard::WHOLE,
        ..first.clone()
    };
    let _lock = folder::wait_for_lock(folder, Shard::WHOLE)?;
    partial::sweep(folder);
    let before = StudyIdentity::read(&StudyIdentity::path(folder, Shard::WHOLE))?;
    check_whole(folder, &whole, before.as_ref(), other)?;
    // Kept fields of the study gathered here before are replaced along with its table.
    let replaceable = match (&before, other) {
        (Some(before), OtherTable::Replace) => before.kept_files(folder),
        _ => Vec::new(),
    };
    kept_file::check_whole(folder, &whole, &replaceable)?;
    let mut tables = Vec::new();
    let mut statuses = vec![None; first.numbering.case_count()];
    for part in &parts {
        let path = part.table(folder);
        // No row of this part has been written yet.
        if !path.exists() {
            continue;
        }
        let blocks = CaseBlocks::read(&path, part)?.blocks;
        for block in &blocks {
            statuses[block.case] = Some(block.status);
        }
        let file = File::open(&path).map_err(|cause| StudyError::damaged(&path, &cause))?;
        tables.push((file, blocks));
    }
    let missing = (0..statuses.len()).filter(|case| statuses[*case].is_none());
    let missing: Vec<_> = missing.collect();
    let table = missing.is_empty().then(|| whole.table(folder));
    if let Some(path) = &table {
        // The identity is written before the table: a kill in between leaves a study that has not begun, not a table of
        // an unknown study.
        whole.write(folder)?;
        kept_file::gather(folder, &whole, &parts)?;
        results_table::write_in_order(path, &whole.header, tables)?;
        folder::discard_before(folder, &whole)?;
        report::write(folder, std::slice::from_ref(&whole))?;
    }
    Ok(Gathered {
        tally: Tally::of(statuses.into_iter().flatten()),
        missing,
        table,
    })
}

/// Refuses a table of another study in the place of the merged one.
fn check_whole(
    folder: &Path,
    whole: &StudyIdentity,
    previous: Option<&StudyIdentity>,
    other: OtherTable,
) -> Result<(), StudyError> {
    let path = whole.table(folder);
    if fs::symlink_metadata(&path).is_err() {
        return Ok(());
    }
    let is_known = match previous {
        Some(previous) => folder::is_table_of(folder, previous)?,
        None => false,
    };
    match (previous, other) {
        (Some(_), OtherTable::Replace) if is_known => Ok(()),
        (Some(previous), _) if is_known && previous.fingerprint == whole.fingerprint => Ok(()),
        (Some(_), _) if is_known => Err(StudyError::OtherTable { path }),
        _ => Err(FileError::NoResults { path }.into()),
    }
}

fn are_of_one(part: &StudyIdentity, first: &StudyIdentity) -> bool {
    part.fingerprint == first.fingerprint && part.shard.count == first.shard.count
}

/// The identities of the parts in a folder, in order.
fn parts(folder: &Path) -> Result<Vec<StudyIdentity>, StudyError> {
    fs::read_dir(folder).map_err(|cause| StudyError::damaged(folder, &cause))?;
    let mut parts = folder::identities(folder)?;
    parts.retain(|part| part.shard != Shard::WHOLE);
    Ok(parts)
}
