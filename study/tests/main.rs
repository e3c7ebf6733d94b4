//! Tests of a study's file and of its table after a kill.

#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a helper of a test that cannot go on has failed; numbers read are those written"
)]

mod find;
mod identity;
mod kept_fields;
mod reading;
mod table;

use std::fs;
use std::path::Path;

use pellicle_study::case_blocks::CaseBlocks;
use pellicle_study::case_status::CaseStatus;
use pellicle_study::folder::StudyFolder;
use pellicle_study::gather::{OtherTable, gather};
use pellicle_study::identity::StudyIdentity;
use pellicle_study::kept_file::KeptFields;
use pellicle_study::plan::StudyPlan;
use pellicle_study::results_table::ResultsTable;
use pellicle_study::shard::Shard;
use pellicle_study::{Study, StudyError, study_file};
use tempfile::TempDir;

const BASE: &str = r#"
[foundation]
substrate = { young_modulus = "7 GPa", poisson_ratio = 0.4 }

[[foundation.layer]]
thickness = "10 nm"
young_modulus = "70 GPa"
poisson_ratio = 0.3

[indenter]
kind = "paraboloid"
radius = "4 um"

[load]
forces = ["1 uN", "2 uN"]
"#;

const SAMPLES: &str = "\
indenter.radius [um],foundation.layer[0].thickness,title
3,10 nm,a
4,12 nm,b
5,11 nm,c
";

fn study(text: &str) -> Result<Study, String> {
    study_with(text, &[])
}

/// A study with values from the command line.
fn study_with(text: &str, sets: &[&str]) -> Result<Study, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.toml");
    fs::write(folder.path().join("base.toml"), BASE).unwrap();
    fs::write(folder.path().join("samples.csv"), SAMPLES).unwrap();
    fs::write(&path, text).unwrap();
    let named = |error: StudyError| {
        error
            .to_string()
            .replace(&folder.path().display().to_string(), "")
    };
    let sets: Vec<_> = sets.iter().map(|set| (*set).to_owned()).collect();
    study_file::read(&path, &sets).map_err(named)
}

fn plan(text: &str, shard: Shard) -> StudyPlan {
    StudyPlan::new(&study(text).unwrap(), shard).unwrap()
}

const TWO_KEYS: &str = r#"
[study]
case = "base.toml"

[study.vary]
"foundation.layer[0].thickness" = ["10 nm", "20 nm", "30 nm"]
grid.elements = { from = 32, to = 128, count = 3, spacing = "log" }
"#;

const MILLION: &str = r#"
[study]
case = "base.toml"

[study.vary]
indenter.radius = { from = "3 um", to = "5 um", count = 1000 }
"foundation.layer[0].thickness" = { from = "10 nm", to = "20 nm", count = 1000 }
"#;
