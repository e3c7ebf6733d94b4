//! A run as its files tell it: what pictures and report are made from, so that drawing again gives the same.

use std::fs;
use std::path::Path;

use serde::Deserialize;
use serde_json::Value;

use super::curve;
use super::summary::{self, GridSummary, StepSummary, Timing};
use crate::case::units::Units;
use crate::failure::Failure;

/// The content of `summary.json`, and the units that `curve.csv` names.
#[derive(Debug, Clone, Deserialize)]
pub struct Record {
    /// What the case is called.
    pub title: String,
    /// Version of the program.
    pub version: String,
    /// The case as resolved.
    pub case: Value,
    /// What its numbers are measured in.
    #[serde(skip)]
    pub units: Units,
    /// The grid.
    pub grid: GridSummary,
    /// The loading steps.
    pub steps: Vec<StepSummary>,
    /// How long it took.
    pub timing: Timing,
    /// What should be known before the numbers are used.
    pub warnings: Vec<StoredWarning>,
}

/// A warning as read back.
#[derive(Debug, Clone, Deserialize)]
pub struct StoredWarning {
    /// A sentence for people.
    pub message: String,
}

impl Record {
    /// The record of a run whose `summary.json` has this text.
    ///
    /// # Errors
    ///
    /// Those of the reader if it is no summary.
    pub fn parse(text: &str, units: Units) -> Result<Self, serde_json::Error> {
        let record = serde_json::from_str(text)?;
        Ok(Self { units, ..record })
    }

    /// The record of a results folder.
    ///
    /// # Errors
    ///
    /// [`Failure::Damaged`] if its files are missing or not what a run writes.
    pub fn read(folder: &Path) -> Result<Self, Failure> {
        let path = folder.join(summary::FILE);
        let text = read_text(&path)?;
        let units = curve::units(&read_text(&folder.join(curve::FILE))?);
        Self::parse(&text, units).map_err(|cause| Failure::damaged(&path, &cause))
    }

    /// Whether the surface, and whether the indenter, is a measured map.
    #[must_use]
    pub fn maps(&self) -> [bool; 2] {
        ["surface", "indenter"].map(|table| self.case[table]["file"].is_string())
    }

    /// Height of the relief above the surface of the body, m, where it is the same everywhere: of cylinders or a film,
    /// 0 of a bare surface.
    #[must_use]
    pub fn relief_height(&self) -> Option<f64> {
        let surface = &self.case["surface"];
        match surface["kind"].as_str()? {
            "bare" => Some(0.0),
            "cylinders" => surface["height"].as_f64(),
            "film" => surface["thickness"].as_f64(),
            _ => None,
        }
    }
}

fn read_text(path: &Path) -> Result<String, Failure> {
    fs::read_to_string(path).map_err(|cause| Failure::damaged(path, &cause))
}
