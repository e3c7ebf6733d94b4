//! A study: one case solved for many values of its keys, on all cores and on many machines, resumed after a kill.
//!
//! [`study_file`] reads it, [`numbering`] numbers its cases, and [`plan`] checks what can be checked before any case is
//! solved. [`results_table`] keeps the results, one block of rows per case, and [`kept_file`] the requested fields of
//! all cases. [`runner`] solves the remaining cases, [`gather`](mod@gather) merges the tables of several machines, and
//! [`report`](mod@report) shows them. A case is read only when its turn comes: neither the start of a study nor its
//! memory depends on the number of its cases, except for a few bytes per case.

pub mod case_blocks;
mod case_counts;
pub mod case_folder;
pub mod case_solver;
pub mod case_status;
mod error;
pub mod find;
mod fingerprint;
pub mod folder;
pub mod gather;
pub mod identity;
pub mod kept_file;
pub mod kept_layout;
pub mod kept_record;
pub mod keys;
pub mod monitor;
pub mod numbering;
pub mod plan;
mod remaining;
pub mod report;
pub mod result_column;
pub mod results_table;
pub mod runner;
mod samples;
pub mod series;
pub mod shard;
pub mod status;
pub mod study_file;
mod table_columns;
mod varied_key;

use std::path::PathBuf;

use pellicle::case::Case;
use pellicle::input::diagnosis::Diagnosis;
use pellicle::input::key_path;
use pellicle::input::overrides;
use pellicle::input::toml_tree::TomlNode;
use serde::{Deserialize, Serialize};

use self::numbering::CaseNumbering;
use self::varied_key::VariedKey;

pub use error::StudyError;

/// A base case and its varied keys.
#[derive(Debug, Clone)]
pub struct Study {
    /// Name of the study file, without extension.
    pub name: String,
    /// Title of the cases, if the base case has none.
    case_name: String,
    /// Folder to which the file names of the base case are relative.
    folder: PathBuf,
    base: TomlNode,
    numbering: CaseNumbering,
    varied_keys: Vec<VariedKey>,
    /// The fields of all cases that are kept in one file.
    pub keep: Vec<KeptField>,
}

impl Study {
    /// Returns the varied keys, in the order of the file.
    #[must_use]
    pub fn varied_keys(&self) -> &[VariedKey] {
        &self.varied_keys
    }

    /// Returns the numbering of the cases.
    #[must_use]
    pub fn numbering(&self) -> &CaseNumbering {
        &self.numbering
    }

    /// Number of cases.
    #[must_use]
    pub fn case_count(&self) -> usize {
        self.numbering.case_count()
    }

    /// Returns the index of each key's value in a case; all indices count from 0.
    #[must_use]
    pub fn choice(&self, case: usize) -> Vec<usize> {
        let choice = self.numbering.choice(case);
        let keys = self.varied_keys.iter();
        keys.map(|varied| choice[varied.axis]).collect()
    }

    /// Returns the axes with a key whose path satisfies `holds`.
    #[must_use]
    pub fn axes_of(&self, holds: impl Fn(&[String]) -> bool) -> Vec<usize> {
        let is_wanted = |varied: &&VariedKey| {
            let path = key_path::parts(&varied.key);
            path.is_some_and(|path| holds(&path))
        };
        let keys = self.varied_keys.iter().filter(is_wanted);
        let mut axes: Vec<_> = keys.map(|varied| varied.axis).collect();
        axes.dedup();
        axes
    }

    /// The tree of a case: the base case with the case's own values.
    fn tree(&self, case: usize) -> Result<TomlNode, Diagnosis> {
        let mut root = self.base.clone();
        for (varied, i) in self.varied_keys.iter().zip(self.choice(case)) {
            let value = varied.value(i);
            overrides::replace(&mut root, &varied.key, &varied.key_span, value)?;
        }
        Ok(root)
    }

    /// Resolves a case, counted from 0.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if these values make an invalid case.
    pub fn case(&self, case: usize) -> Result<Case, Diagnosis> {
        Case::resolve(&self.tree(case)?, &self.case_name, &self.folder)
    }

    /// Describes the values of a case: `load.force = 1 mN, grid.elements = 64`.
    #[must_use]
    pub fn words(&self, case: usize) -> String {
        let choice = self.choice(case);
        let pair =
            |(varied, i): (&VariedKey, &usize)| format!("{} = {}", varied.key, varied.words(*i));
        let pairs: Vec<_> = self.varied_keys.iter().zip(&choice).map(pair).collect();
        pellicle::input::clean::clean(&pairs.join(", "))
    }
}

/// A field of every case that can be kept in one file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum KeptField {
    /// Pressure `p`.
    Pressure,
    /// Displacement `u` of the surface.
    Displacement,
    /// Gap `g`.
    Gap,
    /// Shortening `w*` of the relief.
    Shortening,
    /// Profile `f*` of the relief.
    Profile,
}

impl KeptField {
    /// The words of `study.keep`, in the order of [`NUMBERS`](pellicle::result::fields::NUMBERS).
    pub const CHOICES: [(&'static str, Self); 5] = [
        ("pressure", Self::Pressure),
        ("displacement", Self::Displacement),
        ("gap", Self::Gap),
        ("shortening", Self::Shortening),
        ("profile", Self::Profile),
    ];

    /// Whether the field is computed from the pressure by a product with `K`.
    #[must_use]
    pub fn is_of_the_surface(self) -> bool {
        matches!(self, Self::Displacement | Self::Gap | Self::Shortening)
    }
}

/// The README of the crate; its example is a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
