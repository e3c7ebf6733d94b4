//! The evaluation of unloadings by Oliver and Pharr: its numbers, and the files of its results.

pub mod files;
pub mod pictures;
pub mod report;
pub mod result;
pub mod table;
pub mod text;
pub mod warnings;

use pellicle_identify::fit_file::evaluation_file::{EvaluatedFile, EvaluationFile};

use self::result::EvaluationResult;
use crate::failure::Failure;

/// The evaluation of a file of unloadings.
#[derive(Debug)]
pub struct Evaluation {
    /// The curves, in the order of the tables and their files.
    pub curves: Vec<EvaluatedFile>,
    /// Its result.
    pub found: EvaluationResult,
}

impl Evaluation {
    /// Reads and evaluates the curves of a file.
    ///
    /// # Errors
    ///
    /// [`Failure`] if a measurement gives no curve.
    pub fn new(file: &EvaluationFile) -> Result<Self, Failure> {
        let curves = EvaluatedFile::all(&file.data, &file.settings)?;
        let found = EvaluationResult::new(&file.title, &curves, &file.settings);
        Ok(Self { curves, found })
    }
}
