//! Merges the tables of a study's parts into one.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use super::case_status::Tally;
use super::folder;
use super::identity::StudyIdentity;
use super::results_table::{self, CaseBlocks};
use super::shard::Shard;
use crate::failure::Failure;
use crate::output::file;

/// The result of merging.
#[derive(Debug, Clone, PartialEq)]
pub struct Gathered {
    /// The statuses of the cases found.
    pub tally: Tally,
    /// The missing cases, counted from 0.
    pub missing: Vec<usize>,
    /// The merged table; none if cases are missing.
    pub table: Option<PathBuf>,
}

/// The treatment of another study's table in the place of the merged one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OtherTable {
    /// Leave it alone.
    Keep,
    /// Replace it.
    Replace,
}

/// Reads the parts in `folder` and, if no case is missing, writes the table that the undivided study would have
/// written.
///
/// # Errors
///
/// [`Failure`] if there are no parts, if they are of different studies, if a table cannot be read or written, or if
/// something else stands in the place of the merged table.
pub fn gather(folder: &Path, other: OtherTable) -> Result<Gathered, Failure> {
    let parts = parts(folder)?;
    let Some(first) = parts.first() else {
        return Err(Failure::NoParts {
            path: folder.to_owned(),
        });
    };
    if let Some(other) = parts.iter().find(|part| !are_of_one(part, first)) {
        let (a, b) = (first.shard, other.shard);
        let reason = format!("the parts {a} and {b} are of different studies");
        return Err(Failure::damaged(folder, &reason));
    }
    let whole = StudyIdentity {
        shard: Shard::WHOLE,
        ..first.clone()
    };
    let _lock = folder::wait_for_lock(folder, Shard::WHOLE)?;
    file::sweep(folder);
    check_whole(folder, &whole, other)?;
    let texts = parts.iter().map(|part| read(folder, part));
    let texts = texts.collect::<Result<Vec<_>, _>>()?;
    let mut rows = BTreeMap::new();
    let mut statuses = BTreeMap::new();
    for (part, text) in parts.iter().zip(&texts) {
        let path = part.table(folder);
        let blocks = CaseBlocks::of(text, part)
            .ok_or_else(|| Failure::damaged(&path, &"its first line is not that of this study"))?;
        rows.extend(blocks.in_order(text));
        statuses.extend(blocks.statuses());
    }
    let missing = 0..first.rows.len();
    let missing: Vec<_> = missing.filter(|case| !rows.contains_key(case)).collect();
    let table = missing.is_empty().then(|| whole.table(folder));
    if let Some(path) = &table {
        // A kill between the two leaves a study that has not begun, and not a table of an unknown study.
        whole.write(folder)?;
        results_table::write_in_order(path, &whole.header, &rows)?;
        folder::forget_before(folder, &whole)?;
    }
    Ok(Gathered {
        tally: Tally::of(statuses.into_values()),
        missing,
        table,
    })
}

/// Refuses a table of another study in the place of the merged one.
fn check_whole(folder: &Path, whole: &StudyIdentity, other: OtherTable) -> Result<(), Failure> {
    let path = whole.table(folder);
    if fs::symlink_metadata(&path).is_err() {
        return Ok(());
    }
    let remembered = StudyIdentity::read(&StudyIdentity::path(folder, Shard::WHOLE))?;
    let is_known = match &remembered {
        Some(remembered) => folder::is_table_of(folder, remembered)?,
        None => false,
    };
    match (remembered, other) {
        (Some(_), OtherTable::Replace) if is_known => Ok(()),
        (Some(remembered), _) if is_known && remembered.fingerprint == whole.fingerprint => Ok(()),
        (Some(_), _) if is_known => Err(Failure::OtherTable { path }),
        _ => Err(Failure::NoResults { path }),
    }
}

/// The table of a part; empty if no row has been written yet.
fn read(folder: &Path, part: &StudyIdentity) -> Result<Vec<u8>, Failure> {
    let path = part.table(folder);
    if path.exists() {
        results_table::read(&path)
    } else {
        Ok(Vec::new())
    }
}

fn are_of_one(part: &StudyIdentity, first: &StudyIdentity) -> bool {
    part.fingerprint == first.fingerprint && part.shard.count == first.shard.count
}

/// The identities of the parts in a folder, in order.
fn parts(folder: &Path) -> Result<Vec<StudyIdentity>, Failure> {
    fs::read_dir(folder).map_err(|cause| Failure::damaged(folder, &cause))?;
    let mut parts = folder::identities(folder)?;
    parts.retain(|part| part.shard != Shard::WHOLE);
    Ok(parts)
}
