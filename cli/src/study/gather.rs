//! The tables of a study's parts put together into one.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use super::folder;
use super::identity::Identity;
use super::shard::Shard;
use super::status::Tally;
use super::table::{self, Blocks};
use crate::failure::Failure;
use crate::output::file;

/// What gathering found.
#[derive(Debug, Clone, PartialEq)]
pub struct Gathered {
    /// How the cases that are there ended.
    pub tally: Tally,
    /// The cases that are not there, counted from 0.
    pub missing: Vec<usize>,
    /// Where the whole table is; none if cases are missing.
    pub table: Option<PathBuf>,
}

/// What to do with the table of another study in the place of the whole one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Other {
    /// Leave it alone.
    Keep,
    /// Replace it.
    Replace,
}

/// Puts the parts in `folder` together and, if no case is missing, writes the table that the undivided study would have
/// written.
///
/// # Errors
///
/// [`Failure`] if there are no parts, if they are of different studies, if a table cannot be read or written, or if the
/// place of the whole table is taken by something else.
pub fn gather(folder: &Path, other: Other) -> Result<Gathered, Failure> {
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
    let whole = Identity {
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
        let blocks = Blocks::of(text, part)
            .ok_or_else(|| Failure::damaged(&path, &"its first line is not that of this study"))?;
        rows.extend(blocks.in_order(text));
        statuses.extend(blocks.statuses());
    }
    let missing = 0..first.rows.len();
    let missing: Vec<_> = missing.filter(|case| !rows.contains_key(case)).collect();
    let table = missing.is_empty().then(|| whole.table(folder));
    if let Some(path) = &table {
        // A kill between the two leaves a study that has not begun, not a table that nobody knows.
        whole.write(folder)?;
        table::write_in_order(path, &whole.header, &rows)?;
        folder::forget_before(folder, &whole)?;
    }
    Ok(Gathered {
        tally: Tally::of(statuses.into_values()),
        missing,
        table,
    })
}

/// Refuses a table in the place of the whole one that is not of this study.
fn check_whole(folder: &Path, whole: &Identity, other: Other) -> Result<(), Failure> {
    let path = whole.table(folder);
    if fs::symlink_metadata(&path).is_err() {
        return Ok(());
    }
    let remembered = Identity::read(&Identity::path(folder, Shard::WHOLE))?;
    let is_known = match &remembered {
        Some(remembered) => folder::is_table_of(folder, remembered)?,
        None => false,
    };
    match (remembered, other) {
        (Some(_), Other::Replace) if is_known => Ok(()),
        (Some(remembered), _) if is_known && remembered.fingerprint == whole.fingerprint => Ok(()),
        (Some(_), _) if is_known => Err(Failure::OtherTable { path }),
        _ => Err(Failure::NoResults { path }),
    }
}

/// A part that has not written its first row yet has no table.
fn read(folder: &Path, part: &Identity) -> Result<Vec<u8>, Failure> {
    let path = part.table(folder);
    if path.exists() {
        table::read(&path)
    } else {
        Ok(Vec::new())
    }
}

fn are_of_one(part: &Identity, first: &Identity) -> bool {
    part.fingerprint == first.fingerprint && part.shard.count == first.shard.count
}

/// What the parts in a folder remember, in order.
fn parts(folder: &Path) -> Result<Vec<Identity>, Failure> {
    fs::read_dir(folder).map_err(|cause| Failure::damaged(folder, &cause))?;
    let mut parts = folder::identities(folder)?;
    parts.retain(|part| part.shard != Shard::WHOLE);
    Ok(parts)
}
