//! The evaluation of unloadings by Oliver and Pharr: its numbers, and the files of its results.

pub mod depth_trend;
pub mod files;
pub mod pictures;
pub mod report;
pub mod result;
pub mod table;
pub mod text;
pub mod warnings;

use pellicle_identify::fit_file::evaluation_file::{EvaluatedFile, EvaluationFile};
use pellicle_identify::indentation::Calibration;

use self::result::EvaluationResult;
use crate::failure::Failure;

/// The evaluation of a file of unloadings.
#[derive(Debug)]
pub struct Evaluation {
    /// The curves, in the order of the tables and their files.
    pub curves: Vec<EvaluatedFile>,
    /// The calibration of indenter and frame, if it was asked for.
    pub calibration: Option<Calibration>,
    /// Its result.
    pub found: EvaluationResult,
}

impl Evaluation {
    /// Reads and evaluates the curves of a file.
    ///
    /// # Errors
    ///
    /// [`Failure`] if a measurement gives no curve, or the curves no calibration.
    pub fn new(file: &EvaluationFile) -> Result<Self, Failure> {
        let calibration = file.calibration()?;
        let settings = match &calibration {
            Some(found) => file.settings.calibrated(found),
            None => file.settings.clone(),
        };
        let curves = EvaluatedFile::all(&file.data, &settings)?;
        let found = EvaluationResult::new(file, &curves, &settings);
        Ok(Self {
            curves,
            calibration,
            found,
        })
    }
}
