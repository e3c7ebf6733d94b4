//! `study.json`, beside the results table: the identity of a study.

use std::fmt::Display;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use pellicle_files::{json, whole};
use serde::{Deserialize, Serialize};

use crate::Study;
use crate::StudyError;
use crate::case_counts::CaseCounts;
use crate::kept_layout::KeptLayout;
use crate::numbering::{CaseNumbering, Combine};
use crate::shard::Shard;

/// Name of the layout, without and with its version.
const LAYOUT: &str = "pellicle-study/";
const SCHEMA: &str = "pellicle-study/2";

/// A study or a part of it, as stored in its folder.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StudyIdentity {
    /// Name and version of this layout.
    pub schema: String,
    /// Version of the program.
    pub version: String,
    /// Name of the study.
    pub study: String,
    /// The part whose table is beside this file.
    pub shard: Shard,
    /// Hash of everything that the results depend on: version, cases, maps.
    pub fingerprint: String,
    /// First line of the table.
    pub header: String,
    /// The cases of the whole study.
    pub numbering: CaseNumbering,
    /// Rows of every case, whether in this part or not, unless it fails.
    pub rows: CaseCounts,
    /// Number of cases that the table held when this part was last started.
    #[serde(default)]
    pub done_before: usize,
    /// The layout of the kept fields; `None` if nothing is kept.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kept: Option<KeptLayout>,
}

impl StudyIdentity {
    /// Builds the identity of a study with this hash and this header.
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
            rows: CaseCounts::rows(study),
            done_before: 0,
            kept: None,
        }
    }

    /// Returns the number of cases of this part.
    #[must_use]
    pub fn case_count(&self) -> usize {
        self.shard.count_of(self.numbering.case_count())
    }

    /// Returns the number of rows of a case of this part unless it fails; `None` for any other case.
    #[must_use]
    pub fn rows_of(&self, case: usize) -> Option<usize> {
        let rows = self.rows.of(&self.numbering, case);
        rows.filter(|_| self.shard.holds(case))
    }

    /// Returns the path of the identity file.
    #[must_use]
    pub fn path(folder: &Path, shard: Shard) -> PathBuf {
        folder.join(shard.file("study", "json"))
    }

    /// Returns the path of the results table.
    #[must_use]
    pub fn table(&self, folder: &Path) -> PathBuf {
        folder.join(self.shard.file("results", "csv"))
    }

    /// Returns the paths of the files of kept fields.
    #[must_use]
    pub fn kept_files(&self, folder: &Path) -> Vec<PathBuf> {
        let grids = self.kept.iter().flat_map(KeptLayout::grids);
        let file = |elements| folder.join(KeptLayout::file(elements, self.shard));
        grids.map(file).collect()
    }

    /// Returns the cases of this part, counted from 0.
    pub fn cases(&self) -> impl Iterator<Item = usize> + use<> {
        let shard = self.shard;
        (0..self.numbering.case_count()).filter(move |case| shard.holds(*case))
    }

    /// Writes the identity.
    ///
    /// # Errors
    ///
    /// [`StudyError::File`] if it cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), StudyError> {
        let text = json(self)?;
        let path = Self::path(folder, self.shard);
        Ok(whole::write_whole(&path, |file| {
            file.write_all(text.as_bytes())
        })?)
    }

    /// Reads an identity; `None` if there is no such file. For a file of an older program, only the fields that
    /// distinguish it from others are read.
    ///
    /// # Errors
    ///
    /// [`StudyError::File`] if the file was not written by [`Self::write`].
    pub fn read(path: &Path) -> Result<Option<Self>, StudyError> {
        if !path.exists() {
            return Ok(None);
        }
        let damaged = |cause: &dyn Display| StudyError::damaged(path, cause);
        let text = fs::read_to_string(path).map_err(|cause| damaged(&cause))?;
        let head: Head = serde_json::from_str(&text).map_err(|cause| damaged(&cause))?;
        if !head.schema.starts_with(LAYOUT) || !(1..=head.shard.count).contains(&head.shard.index) {
            return Err(damaged(&"it does not belong to a study"));
        }
        if head.schema != SCHEMA {
            return Ok(Some(head.into()));
        }
        let read: Self = serde_json::from_str(&text).map_err(|cause| damaged(&cause))?;
        if !read.is_possible() {
            return Err(damaged(
                &"the numbers of its cases are not those of a study",
            ));
        }
        Ok(Some(read))
    }

    /// Whether a study may have these cases; a damaged file may claim others.
    fn is_possible(&self) -> bool {
        let (numbering, kept) = (&self.numbering, self.kept.iter());
        numbering.is_possible()
            && self.rows.are_of(numbering)
            && kept.into_iter().all(|kept| kept.is_of(numbering))
    }

    /// Whether it has the current layout, which gives the cases of the study.
    #[must_use]
    pub fn is_of_this_layout(&self) -> bool {
        self.schema == SCHEMA
    }
}

/// The fields that every layout has.
#[derive(Deserialize)]
struct Head {
    schema: String,
    version: String,
    study: String,
    shard: Shard,
    fingerprint: String,
    header: String,
}

impl From<Head> for StudyIdentity {
    fn from(head: Head) -> Self {
        Self {
            // No hash of the current layout equals this.
            fingerprint: format!("{}: {}", head.schema, head.fingerprint),
            schema: head.schema,
            version: head.version,
            study: head.study,
            shard: head.shard,
            header: head.header,
            numbering: CaseNumbering {
                combine: Combine::Zip,
                lengths: Vec::new(),
            },
            rows: CaseCounts::default(),
            done_before: 0,
            kept: None,
        }
    }
}
