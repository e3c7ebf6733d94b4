//! The folder of a study; it belongs to this study alone and to one process at a time.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

use pellicle_files::lock::Lock;
use pellicle_files::{FileError, disk, partial};

use crate::StudyError;
use crate::identity::StudyIdentity;
use crate::report;
use crate::shard::Shard;

/// Contents of the lock file.
const LOCK_TEXT: &str = "pellicle is working on this study.\n";

/// Name of the folder for the results folders of the cases.
const CASES: &str = "cases";

/// Prefix of the name of a table that a fresh study replaces, until the new one is complete.
const BEFORE: &str = ".pellicle-before-";

/// Number of attempts and interval between them, while waiting for a process that is nearly done.
const RETRIES: (usize, Duration) = (100, Duration::from_millis(50));

/// Removes the results of another study's cases from the folder that holds them, and nothing else.
pub type DiscardCases<'a> = &'a dyn Fn(&Path) -> io::Result<()>;

/// How a study begins if there is a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Begin {
    /// Continue it.
    Resume,
    /// Empty it first.
    Again,
}

/// The folder of a study, claimed for one part of it. No other process works on this part until it is dropped.
#[derive(Debug)]
pub struct StudyFolder {
    /// The folder.
    pub folder: PathBuf,
    /// How to begin with the part's table.
    pub begin: Begin,
    /// The path of the earlier table, while this study replaces it.
    pub before: Option<PathBuf>,
    _lock: Lock,
}

impl StudyFolder {
    /// Claims the folder for the part given by `identity`; `fresh` discards results of other studies in it.
    ///
    /// # Errors
    ///
    /// [`FileError::NoResults`] if there is something not written by a study, [`StudyError::OtherStudy`] if there are
    /// results of another study, [`FileError::Busy`] if another process is working on this part,
    /// [`FileError::Write`] if nothing can be written here.
    pub fn claim(
        folder: &Path,
        identity: &StudyIdentity,
        fresh: bool,
        discard_cases: DiscardCases<'_>,
    ) -> Result<Self, StudyError> {
        refuse_foreign(folder)?;
        let failed = |cause| StudyError::write(folder, cause);
        disk::create_dir_all(folder).map_err(failed)?;
        let lock = lock(folder, identity.shard)?.ok_or_else(|| FileError::Busy {
            path: identity.table(folder),
        })?;
        partial::sweep(folder);
        let existing = identities(folder)?;
        let is_other = |other: &&StudyIdentity| other.fingerprint != identity.fingerprint;
        for other in existing.iter().filter(is_other) {
            if !fresh {
                let path = other.table(folder);
                let path = if path.exists() {
                    path
                } else {
                    StudyIdentity::path(folder, other.shard)
                };
                return Err(StudyError::OtherStudy { path });
            }
            discard(folder, other, identity.shard)?;
        }
        if existing.iter().any(|other| is_other(&other)) {
            discard_cases(&folder.join(CASES)).map_err(failed)?;
        }
        if fresh {
            set_aside(folder, identity)?;
            report::discard(folder)?;
        }
        let before = before(&identity.table(folder)).filter(|path| is_file(path));
        let is_empty = fs::metadata(identity.table(folder)).map_or(true, |data| data.len() == 0);
        let begin = if fresh || is_empty {
            Begin::Again
        } else {
            Begin::Resume
        };
        Ok(Self {
            folder: folder.to_owned(),
            begin,
            before,
            _lock: lock,
        })
    }

    /// Returns the parent of the cases' results folders.
    #[must_use]
    pub fn cases(&self) -> PathBuf {
        self.folder.join(CASES)
    }
}

/// Takes the lock of a part; returns `None` if another process holds it.
///
/// # Errors
///
/// [`FileError::Write`] if it cannot be made.
pub fn lock(folder: &Path, part: Shard) -> Result<Option<Lock>, StudyError> {
    let path = lock_path(folder, part);
    Lock::take(&path, LOCK_TEXT).map_err(|cause| StudyError::write(&path, cause))
}

/// Whether a process is working on a part.
#[must_use]
pub fn is_at_work(folder: &Path, part: Shard) -> bool {
    Lock::is_held(&lock_path(folder, part))
}

fn lock_path(folder: &Path, part: Shard) -> PathBuf {
    folder.join(format!(".pellicle-{}", part.file("study", "lock")))
}

/// Takes the lock of a part, retrying for some seconds while another process holds it.
///
/// # Errors
///
/// [`FileError::Busy`] if the other process keeps it, [`FileError::Write`] if the lock cannot be made.
pub fn wait_for_lock(folder: &Path, part: Shard) -> Result<Lock, StudyError> {
    let (times, pause) = RETRIES;
    for _ in 0..times {
        if let Some(lock) = lock(folder, part)? {
            return Ok(lock);
        }
        thread::sleep(pause);
    }
    let path = folder.join(part.file("results", "csv"));
    Err(FileError::Busy { path }.into())
}

/// Reads the identities of the studies and parts of studies in a folder, in the order of their parts.
///
/// # Errors
///
/// [`FileError::Damaged`] if one was not written by a study.
pub fn identities(folder: &Path) -> Result<Vec<StudyIdentity>, StudyError> {
    let mut identities = Vec::new();
    for name in names(folder) {
        if part(&name, "study", "json").is_some() {
            identities.extend(StudyIdentity::read(&folder.join(name))?);
        }
    }
    identities.sort_by_key(|identity| (identity.shard.count, identity.shard.index));
    Ok(identities)
}

/// Whether there is a table written by this study or part of a study.
///
/// # Errors
///
/// [`FileError::Damaged`] if it cannot be read.
pub fn is_table_of(folder: &Path, identity: &StudyIdentity) -> Result<bool, StudyError> {
    let path = identity.table(folder);
    if !is_file(&path) {
        return Ok(false);
    }
    let first = File::open(&path).and_then(|file| first_line(file, identity.header.len()));
    let first = first.map_err(|cause| StudyError::damaged(&path, &cause))?;
    let header = format!("{}\n", identity.header);
    // A kill may have cut the line off.
    Ok(header.as_bytes().starts_with(&first))
}

/// Reads the first bytes of a table: as many as its first line should have, with its line end.
fn first_line(file: File, length: usize) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.take(length as u64 + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn is_file(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|data| data.is_file())
}

/// Refuses a folder with a table not written by a study, and a nonempty folder without any study.
fn refuse_foreign(folder: &Path) -> Result<(), StudyError> {
    let foreign = |path: PathBuf| Err(FileError::NoResults { path }.into());
    if fs::symlink_metadata(folder).is_ok() && !folder.is_dir() {
        return foreign(folder.to_owned());
    }
    let (names, existing) = (names(folder), identities(folder)?);
    for name in &names {
        let path = folder.join(name);
        let is_empty = is_file(&path) && fs::metadata(&path).is_ok_and(|data| data.len() == 0);
        if let Some(shard) = part(name, "results", "csv").filter(|_| !is_empty) {
            let own = existing.iter().find(|identity| identity.shard == shard);
            match own {
                Some(own) if is_table_of(folder, own)? => {}
                _ => return foreign(path),
            }
        }
    }
    let is_own = |name: &String| {
        part(name, "results", "csv").is_some() || name == CASES || name.starts_with(".pellicle-")
    };
    if existing.is_empty() && !names.iter().all(is_own) {
        return foreign(folder.to_owned());
    }
    Ok(())
}

/// Sets the table of another study aside and removes its identity.
fn discard(folder: &Path, other: &StudyIdentity, locked: Shard) -> Result<(), StudyError> {
    let _lock = if other.shard == locked {
        None
    } else {
        let lock = lock(folder, other.shard)?;
        Some(lock.ok_or_else(|| FileError::Busy {
            path: other.table(folder),
        })?)
    };
    set_aside(folder, other)?;
    remove(&StudyIdentity::path(folder, other.shard))
}

/// The path to which a table is moved while a fresh study replaces it.
fn before(table: &Path) -> Option<PathBuf> {
    let name = table.file_name()?.to_string_lossy();
    Some(table.with_file_name(format!("{BEFORE}{name}")))
}

/// Sets a table and its fields aside until their replacements are complete. If an earlier table is set aside already,
/// this one is its incomplete replacement and is removed.
fn set_aside(folder: &Path, identity: &StudyIdentity) -> Result<(), StudyError> {
    let table = identity.table(folder);
    let is_there = |path: &Path| fs::symlink_metadata(path).is_ok();
    let is_empty = fs::symlink_metadata(&table).map_or(true, |data| data.len() == 0);
    let is_replacement = before(&table).is_none_or(|before| is_there(&before));
    for path in [vec![table], identity.kept_files(folder)].concat() {
        match before(&path) {
            Some(before) if !is_empty && !is_replacement && is_there(&path) => {
                disk::rename(&path, &before).map_err(|cause| StudyError::write(&path, cause))?;
            }
            _ => remove(&path)?,
        }
    }
    Ok(())
}

/// Removes the table and the fields set aside, now that their replacements are complete; for a whole study, also those
/// of all parts.
///
/// # Errors
///
/// [`FileError::Write`] if one cannot be removed.
pub fn discard_before(folder: &Path, identity: &StudyIdentity) -> Result<(), StudyError> {
    let own = identity.shard.suffix();
    let is_replaced = |name: &String| {
        let stem = name.split('.').nth(1).unwrap_or_default();
        name.starts_with(BEFORE) && stem.ends_with(&own)
    };
    let mut replaced = names(folder).into_iter().filter(is_replaced);
    replaced.try_for_each(|name| remove(&folder.join(name)))
}

fn remove(path: &Path) -> Result<(), StudyError> {
    match disk::remove_file(path) {
        Err(cause) if cause.kind() != io::ErrorKind::NotFound => {
            Err(StudyError::write(path, cause))
        }
        _ => Ok(()),
    }
}

/// The part to which a file name belongs: `results.csv` to the whole, `results-2-of-8.csv` to the second of eight.
fn part(name: &str, stem: &str, ending: &str) -> Option<Shard> {
    let middle = name
        .strip_prefix(stem)?
        .strip_suffix(ending)?
        .strip_suffix('.')?;
    if middle.is_empty() {
        return Some(Shard::WHOLE);
    }
    let shard: Shard = middle
        .strip_prefix('-')?
        .replace("-of-", "/")
        .parse()
        .ok()?;
    (shard.file(stem, ending) == name).then_some(shard)
}

/// The names in a folder; empty if there is no such folder.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_name_states_its_part() {
        let part = |name| part(name, "results", "csv");
        assert_eq!(part("results.csv"), Some(Shard::WHOLE));
        assert_eq!(
            part("results-2-of-8.csv"),
            Some(Shard { index: 2, count: 8 })
        );
        for name in [
            "results-9-of-8.csv",
            "results-2.csv",
            "results-1-of-1.csv",
            "my results.csv",
        ] {
            assert_eq!(part(name), None, "{name}");
        }
    }
}
