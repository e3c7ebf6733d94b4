//! A study: one case solved for many values of its keys, on all cores and on many machines, resumed after kills.
//!
//! [`study_file`] reads it, [`plan`] lists the cases to solve, [`results_table`] keeps the results, one durable block
//! of rows per case, [`runner`] solves the remaining cases, and [`gather`](mod@gather) merges the tables of several
//! machines.

pub mod case_solver;
pub mod case_status;
pub mod folder;
pub mod gather;
pub mod identity;
pub mod plan;
pub mod progress;
pub mod results_table;
pub mod runner;
pub mod shard;
pub mod study_file;
pub mod table_columns;
pub mod varied_key;

use std::path::PathBuf;

use self::varied_key::VariedKey;
use crate::case::diagnosis::Diagnosis;
use crate::case::document::TomlNode;
use crate::case::{Case, overrides};

/// The combination of the values of several keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Combine {
    /// Every value of each with every value of the others; the last key changes fastest.
    Product,
    /// The first values of all, the second values of all, and so on.
    Zip,
}

/// A base case and the keys that vary in it.
#[derive(Debug, Clone)]
pub struct Study {
    /// Name of its file, without the ending.
    pub name: String,
    /// Title of the cases, unless the base case has one.
    case_name: String,
    /// Folder to which the file names of the base case are relative.
    folder: PathBuf,
    base: TomlNode,
    combine: Combine,
    varied_keys: Vec<VariedKey>,
}

impl Study {
    /// The keys that vary, in the order of the file.
    #[must_use]
    pub fn varied_keys(&self) -> &[VariedKey] {
        &self.varied_keys
    }

    /// Number of cases.
    #[must_use]
    pub fn len(&self) -> usize {
        let mut lengths = self.varied_keys.iter().map(|varied| varied.values.len());
        match self.combine {
            Combine::Product => lengths.product(),
            Combine::Zip => lengths.next().unwrap_or(0),
        }
    }

    /// The number of each key's value in a case, all counted from 0.
    #[must_use]
    pub fn choice(&self, case: usize) -> Vec<usize> {
        let mut rest = case;
        let digit = |varied: &VariedKey| {
            let count = varied.values.len();
            let digit = rest % count;
            if self.combine == Combine::Product {
                rest /= count;
            }
            digit
        };
        // The last key is the last digit.
        let mut choice: Vec<_> = self.varied_keys.iter().rev().map(digit).collect();
        choice.reverse();
        choice
    }

    /// A case, counted from 0.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if these values make an invalid case.
    pub fn case(&self, case: usize) -> Result<Case, Diagnosis> {
        let mut root = self.base.clone();
        for (varied, i) in self.varied_keys.iter().zip(self.choice(case)) {
            let value = varied.values[i].clone();
            overrides::replace(&mut root, &varied.key, &varied.key_span, value)?;
        }
        Case::resolve(&root, &self.case_name, &self.folder)
    }

    /// The values of a case in words: `load.force = 1 mN, grid.elements = 64`.
    #[must_use]
    pub fn words(&self, case: usize) -> String {
        let choice = self.choice(case);
        let pair =
            |(varied, i): (&VariedKey, &usize)| format!("{} = {}", varied.key, varied.words(*i));
        let pairs: Vec<_> = self.varied_keys.iter().zip(&choice).map(pair).collect();
        crate::terminal::clean(&pairs.join(", "))
    }
}

#[cfg(test)]
mod tests;
