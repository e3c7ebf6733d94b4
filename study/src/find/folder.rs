//! The folder of a search: `find.json`, what was asked and found, and `find.csv`, the cases tried.
//!
//! The table is written after every case, so a search that is stopped or killed continues with the cases it has. The
//! same cases serve another limit of the same number.

use std::fs;
use std::path::{Path, PathBuf};

use pellicle_files::lock::Lock;
use pellicle_files::{FileError, disk, json, partial, whole};
use serde::{Deserialize, Serialize};

use super::answer::Answer;
use super::tried::{self, Tried};
use super::{Search, own_case};
use crate::StudyError;

/// Name of the file with question and answer.
pub const FILE: &str = "find.json";

/// Name of the lock, and its contents.
const LOCK: &str = ".pellicle-find.lock";
const LOCK_TEXT: &str = "pellicle is working on this search.\n";

/// Name and version of the layout.
const SCHEMA: &str = "pellicle-find/1";

/// Question and answer, as in `find.json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SearchReport<'a> {
    schema: &'static str,
    version: &'static str,
    /// Hash of everything on which the cases depend.
    identity: &'a str,
    title: &'a str,
    /// The key, and the unit of its values.
    key: &'a str,
    unit: Option<&'static str>,
    /// The number, its unit, the sign of the condition and the limit.
    result: &'a str,
    result_unit: Option<&'a str>,
    sign: char,
    limit: f64,
    /// The range of the key.
    range: [f64; 2],
    /// Width of the final bracket, relative to the answer.
    within: f64,
    /// Number of cases tried.
    cases: usize,
    /// None while the search is not finished.
    #[serde(flatten)]
    answer: Option<&'a Answer>,
}

impl<'a> SearchReport<'a> {
    /// Returns question and answer after this number of cases.
    #[must_use]
    pub fn new(search: &'a Search, cases: usize, answer: Option<&'a Answer>) -> Self {
        let (key, condition) = (&search.key, &search.condition);
        Self {
            schema: SCHEMA,
            version: env!("CARGO_PKG_VERSION"),
            identity: &search.identity,
            title: &search.title,
            key: &key.path,
            unit: key
                .dimension
                .map(|dimension| key.units.name(dimension.si_unit())),
            result: &condition.result.name,
            result_unit: condition.result.unit.as_deref(),
            sign: condition.comparison.sign(),
            limit: condition.limit,
            range: search.range,
            within: search.within,
            cases,
            answer,
        }
    }
}

/// What identifies the search of a folder.
#[derive(Debug, Deserialize)]
struct Identity {
    schema: String,
    version: String,
    #[serde(rename = "identity")]
    hash: String,
    title: String,
    key: String,
    result: String,
    range: [f64; 2],
}

impl Identity {
    /// The refusal of another search in its folder, which names what differs first.
    fn other_than(self, search: &Search, path: &Path) -> StudyError {
        let (key, result) = (&search.key, &search.condition.result.name);
        let range = |range: [f64; 2]| range.map(|end| key.words(end)).join(" to ");
        let version = env!("CARGO_PKG_VERSION").to_owned();
        let is_other_range = own_case(&search.base).is_none()
            && self.range[0].to_bits() != search.range[0].to_bits();
        let (what, found, wanted) = if self.version != version {
            ("version".to_owned(), self.version, version)
        } else if self.key != key.path {
            ("key".to_owned(), self.key, key.path.clone())
        } else if self.result != *result {
            ("number".to_owned(), self.result, result.clone())
        } else if self.title != search.title {
            let quoted = |title: &str| format!("\"{title}\"");
            let [found, wanted] = [&self.title, &search.title].map(|title| quoted(title));
            ("title".to_owned(), found, wanted)
        } else if is_other_range {
            let what = format!("range of {}", key.path);
            (what, range(self.range), range(search.range))
        } else {
            let [found, wanted] = ["one with other values", "this one"].map(str::to_owned);
            ("case".to_owned(), found, wanted)
        };
        let path = path.to_owned();
        StudyError::OtherSearch {
            path,
            what,
            found,
            wanted,
        }
    }
}

/// The folder of a search, which no other process uses until it is dropped.
#[derive(Debug)]
pub struct SearchFolder {
    path: PathBuf,
    _lock: Lock,
}

impl SearchFolder {
    /// Claims a folder, and returns it with the cases of this search that it holds; `fresh` discards those of another.
    ///
    /// # Errors
    ///
    /// [`FileError::NoResults`] if there is something not written by a search, [`StudyError::OtherSearch`] if there are
    /// results of another search, [`FileError::Busy`] if another process uses it, [`FileError::Write`] if it cannot be
    /// written to.
    pub fn claim(
        path: &Path,
        search: &Search,
        fresh: bool,
    ) -> Result<(Self, Vec<Tried>), StudyError> {
        let of_path = || path.to_owned();
        let found = fs::read(path.join(FILE)).ok();
        let found = found.and_then(|bytes| serde_json::from_slice::<Identity>(&bytes).ok());
        let found = found.filter(|found| found.schema == SCHEMA);
        let is_empty = fs::read_dir(path).map_or(!path.exists(), |mut all| all.next().is_none());
        if found.is_none() && !is_empty {
            return Err(FileError::NoResults { path: of_path() }.into());
        }
        let other = found.filter(|found| found.hash != search.identity);
        let is_same = other.is_none() && !is_empty;
        if let Some(other) = other.filter(|_| !fresh) {
            return Err(other.other_than(search, path));
        }
        let failed = |cause| StudyError::write(path, cause);
        disk::create_dir_all(path).map_err(failed)?;
        let lock = Lock::take(&path.join(LOCK), LOCK_TEXT).map_err(failed)?;
        let lock = lock.ok_or_else(|| FileError::Busy { path: of_path() })?;
        partial::sweep(path);
        let folder = Self {
            path: of_path(),
            _lock: lock,
        };
        let table = fs::read_to_string(path.join(tried::FILE)).ok();
        let before = table.filter(|_| is_same && !fresh);
        let before = before.map_or_else(Vec::new, |table| tried::read(&table));
        folder.write(search, &before, None)?;
        Ok((folder, before))
    }

    /// The folder.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the cases tried so far, and the answer if there is one.
    ///
    /// # Errors
    ///
    /// [`FileError::Write`] if that fails.
    pub fn write(
        &self,
        search: &Search,
        tried: &[Tried],
        answer: Option<&Answer>,
    ) -> Result<(), StudyError> {
        let table = tried::table(search, tried);
        whole::write_bytes(&self.path.join(tried::FILE), table.as_bytes())?;
        let report = json(&SearchReport::new(search, tried.len(), answer))?;
        whole::write_bytes(&self.path.join(FILE), report.as_bytes())?;
        Ok(())
    }
}
