//! The evaluation of unloadings by Oliver and Pharr, without a model.

use std::collections::BTreeMap;
use std::path::PathBuf;

use pellicle::input::span::Source;
use pellicle_cli::Failure;
use pellicle_cli::evaluated::{Evaluation, calibration_text, table, text};
use pellicle_files::json;
use pellicle_identify::fit_file::evaluation_file::Task;
use pellicle_identify::fit_file::{FitSources, Measurements};
use pellicle_identify::measured::sources::MeasurementSources;
use pyo3::prelude::*;

use crate::error::Refusal;
use crate::process::Threads;

/// JSON, the table of contacts, the file of a calibration, and the words of an evaluation.
type Evaluated = (String, String, Option<String>, String);

/// Evaluates the text of a file named `source`; `name` is the default title. Measurements are taken from `texts`, or
/// else from files of `folder`. `None` if the file has a model or unknowns, which is a fit.
#[pyfunction]
#[expect(
    clippy::needless_pass_by_value,
    reason = "Python hands over a path of its own"
)]
pub fn evaluate(
    py: Python<'_>,
    text: String,
    source: String,
    name: &str,
    folder: PathBuf,
    texts: BTreeMap<String, String>,
) -> PyResult<Option<Evaluated>> {
    let mut measurements = MeasurementSources::in_folder(&folder);
    for (name, text) in &texts {
        measurements = measurements.with_text(name, text);
    }
    let sources = FitSources {
        measurements,
        ..FitSources::in_folder(&folder)
    };
    let source = Source::new(source, text).into();
    let work = || -> Result<Option<Evaluated>, Failure> {
        match Task::parse(&source, name, &sources, Measurements::Required)? {
            Task::Fit(_) => Ok(None),
            Task::Evaluation(file) => of_evaluation(&Evaluation::new(&file)?).map(Some),
        }
    };
    Ok(Threads::work(py, work)?.map_err(Refusal::from)?)
}

fn of_evaluation(of: &Evaluation) -> Result<Evaluated, Failure> {
    Ok((
        json(&of.found)?,
        table(&of.found.indentation),
        of.calibration.as_ref().map(calibration_text),
        text(&of.found),
    ))
}
