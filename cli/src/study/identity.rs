//! `study.json`, beside the table of results: it tells one study from another.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::Study;
use super::numbering::CaseNumbering;
use super::row_counts::RowCounts;
use super::shard::Shard;
use crate::failure::Failure;
use crate::output::{file, json};

/// Name and version of the layout.
const SCHEMA: &str = "pellicle-study/2";

/// A study and its part, as stored in its folder.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StudyIdentity {
    /// Name and version of this layout.
    pub schema: String,
    /// Version of the program.
    pub version: String,
    /// Name of the study.
    pub study: String,
    /// The part of it in the table beside this file.
    pub shard: Shard,
    /// Hash of everything that the results depend on: version, cases, maps.
    pub fingerprint: String,
    /// First line of the table.
    pub header: String,
    /// The cases of the whole study.
    pub numbering: CaseNumbering,
    /// Rows of every case, in this part or not, unless it fails.
    pub rows: RowCounts,
    /// Number of cases that the table held when this part was last started.
    #[serde(default)]
    pub done_before: usize,
}

impl StudyIdentity {
    /// The identity of a study with this hash and this header.
    #[must_use]
    pub fn new(study: &Study, fingerprint: String, header: String, shard: Shard) -> Self {
        Self {
            schema: SCHEMA.into(),
            version: env!("CARGO_PKG_VERSION").into(),
            study: study.name.clone(),
            shard,
            fingerprint,
            header,
            numbering: study.numbering().clone(),
            rows: RowCounts::new(study),
            done_before: 0,
        }
    }

    /// Number of cases of this part.
    #[must_use]
    pub fn len(&self) -> usize {
        self.shard.count_of(self.numbering.len())
    }

    /// The rows of a case of this part unless it fails; none of any other case.
    #[must_use]
    pub fn rows_of(&self, case: usize) -> Option<usize> {
        let rows = self.rows.of(&self.numbering, case);
        rows.filter(|_| self.shard.holds(case))
    }

    /// The path of its file.
    #[must_use]
    pub fn path(folder: &Path, shard: Shard) -> PathBuf {
        folder.join(shard.file("study", "json"))
    }

    /// The path of the table of results.
    #[must_use]
    pub fn table(&self, folder: &Path) -> PathBuf {
        folder.join(self.shard.file("results", "csv"))
    }

    /// The cases of this part, counted from 0.
    pub fn cases(&self) -> impl Iterator<Item = usize> + use<> {
        let shard = self.shard;
        (0..self.numbering.len()).filter(move |case| shard.holds(*case))
    }

    /// Writes it.
    ///
    /// # Errors
    ///
    /// [`Failure::Write`] if it cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), Failure> {
        let text = json(self)?;
        let path = Self::path(folder, self.shard);
        file::write_whole(&path, |file| file.write_all(text.as_bytes()))
    }

    /// Reads one; none if there is no such file.
    ///
    /// # Errors
    ///
    /// [`Failure::Damaged`] if the file was not written by [`Self::write`].
    pub fn read(path: &Path) -> Result<Option<Self>, Failure> {
        if !path.exists() {
            return Ok(None);
        }
        let text = fs::read_to_string(path).map_err(|cause| Failure::damaged(path, &cause))?;
        let read: Self =
            serde_json::from_str(&text).map_err(|cause| Failure::damaged(path, &cause))?;
        if read.schema != SCHEMA || read.shard.index == 0 || read.shard.index > read.shard.count {
            return Err(Failure::damaged(path, &"it is of another version"));
        }
        Ok(Some(read))
    }
}
