//! A study: one case solved for many values of its keys, on all cores, over many machines, through kills.
//!
//! [`file`](mod@file) reads it, [`plan`] says what there is to do, [`table`] keeps what is done, one durable block of
//! rows a case, [`runner`] does the rest of it, and [`gather`](mod@gather) puts the tables of several machines
//! together.

pub mod axis;
pub mod columns;
pub mod file;
pub mod folder;
pub mod gather;
pub mod identity;
pub mod plan;
pub mod progress;
pub mod runner;
pub mod shard;
pub mod solve;
pub mod status;
pub mod table;

use std::path::PathBuf;

use self::axis::Axis;
use crate::case::diagnosis::Diagnosis;
use crate::case::document::Node;
use crate::case::{Case, overrides};

/// How the values of several keys are put together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Combine {
    /// Every value of one with every value of the others; the last key changes fastest.
    Product,
    /// The first values of all, the second values of all, and so on.
    Zip,
}

/// A base case and what varies in it.
#[derive(Debug, Clone)]
pub struct Study {
    /// Name of its file, without the ending.
    pub name: String,
    /// Title of the cases, unless the base has one.
    case_name: String,
    /// Folder from which the base case names its files.
    folder: PathBuf,
    base: Node,
    combine: Combine,
    axes: Vec<Axis>,
}

impl Study {
    /// The keys that vary, in the order of the file.
    #[must_use]
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// Number of cases.
    #[must_use]
    pub fn len(&self) -> usize {
        let mut lengths = self.axes.iter().map(|axis| axis.values.len());
        match self.combine {
            Combine::Product => lengths.product(),
            Combine::Zip => lengths.next().unwrap_or(0),
        }
    }

    /// Which value each key has in a case, counted from 0.
    #[must_use]
    pub fn choice(&self, case: usize) -> Vec<usize> {
        let mut rest = case;
        let digit = |axis: &Axis| {
            let count = axis.values.len();
            let digit = rest % count;
            if self.combine == Combine::Product {
                rest /= count;
            }
            digit
        };
        // The last key is the last digit.
        let mut choice: Vec<_> = self.axes.iter().rev().map(digit).collect();
        choice.reverse();
        choice
    }

    /// A case, counted from 0.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if with these values it is no case.
    pub fn case(&self, case: usize) -> Result<Case, Diagnosis> {
        let mut root = self.base.clone();
        for (axis, i) in self.axes.iter().zip(self.choice(case)) {
            let value = axis.values[i].clone();
            overrides::replace(&mut root, &axis.key, &axis.key_place, value)?;
        }
        Case::resolve(&root, &self.case_name, &self.folder)
    }

    /// The values of a case in words: `load.force = 1 mN, grid.elements = 64`.
    #[must_use]
    pub fn words(&self, case: usize) -> String {
        let choice = self.choice(case);
        let pair = |(axis, i): (&Axis, &usize)| format!("{} = {}", axis.key, axis.words(*i));
        let pairs: Vec<_> = self.axes.iter().zip(&choice).map(pair).collect();
        crate::terminal::clean(&pairs.join(", "))
    }
}

#[cfg(test)]
mod tests;
