//! The tables of a study's parts put together into one.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use super::identity::Identity;
use super::shard::Shard;
use super::status::Tally;
use super::table::{self, Blocks};
use crate::failure::Failure;

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

/// Puts the parts in `folder` together and, if no case is missing, writes the table that the undivided study would have written.
///
/// # Errors
///
/// [`Failure`] if there are no parts, if they are of different studies, or if a table cannot be read or written.
pub fn gather(folder: &Path) -> Result<Gathered, Failure> {
    let parts = parts(folder)?;
    let Some(first) = parts.first() else {
        return Err(Failure::damaged(folder, &"there is no study-I-of-N.json"));
    };
    if let Some(other) = parts.iter().find(|part| !are_of_one(part, first)) {
        let (a, b) = (first.shard, other.shard);
        let reason = format!("the parts {a} and {b} are of different studies");
        return Err(Failure::damaged(folder, &reason));
    }
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
    let whole = Identity {
        shard: Shard::WHOLE,
        ..first.clone()
    };
    let table = missing.is_empty().then(|| whole.table(folder));
    if let Some(path) = &table {
        table::write_in_order(path, &whole.header, &rows)?;
        whole.write(folder)?;
    }
    Ok(Gathered {
        tally: Tally::of(statuses.into_values()),
        missing,
        table,
    })
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
    let entries = fs::read_dir(folder).map_err(|cause| Failure::damaged(folder, &cause))?;
    let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let is_part = |name: &String| {
        let middle = name
            .strip_prefix("study-")
            .and_then(|name| name.strip_suffix(".json"));
        middle.is_some_and(|middle| middle.replace("-of-", "/").parse::<Shard>().is_ok())
    };
    let mut parts = Vec::new();
    for name in names.filter(is_part) {
        parts.extend(Identity::read(&folder.join(name))?);
    }
    parts.sort_by_key(|part| part.shard.index);
    Ok(parts)
}
