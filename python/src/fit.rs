//! A fit file: fitted, its curves together or each alone, or planned.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use numpy::PyReadonlyArray2;
use pellicle::input::span::Source;
use pellicle_cli::Failure;
use pellicle_cli::fitted::{
    EachResult, FittedFile, FittedLikelihood, PlanResult, Stage, each_table, fit, likelihood, plan,
    plan_table,
};
use pellicle_files::json;
use pellicle_identify::IdentifyError;
use pellicle_identify::fit_file::{FitFile, FitSources, Measurements};
use pellicle_identify::measured::sources::MeasurementSources;
use pyo3::prelude::*;

use crate::case::map_sources;
use crate::error::{InternalError, Refusal};
use crate::function::Functions;
use crate::process::Threads;
use crate::work::Work;

/// A fit file, read and checked, before it is fitted or planned.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct Fit {
    file: Mutex<Option<FitFile>>,
    start: Instant,
}

impl Fit {
    fn take(&self) -> PyResult<FitFile> {
        let file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        { file }
            .take()
            .ok_or_else(|| InternalError::new_err("a fit file is fitted once"))
    }
}

#[pymethods]
impl Fit {
    /// Reads a text named `source`; `name` is the default title. Maps are taken from `arrays` and measurements from
    /// `texts`, or else from files of `folder`, and shapes of kind `function` from `functions`. It can be fitted only
    /// with measurements.
    #[new]
    #[expect(
        clippy::needless_pass_by_value,
        reason = "Python hands over a path of its own"
    )]
    #[expect(clippy::too_many_arguments, reason = "each is a part of a fit file")]
    fn new(
        py: Python<'_>,
        text: String,
        source: String,
        name: &str,
        folder: PathBuf,
        arrays: BTreeMap<String, PyReadonlyArray2<'_, f64>>,
        functions: Functions,
        texts: BTreeMap<String, String>,
        is_measured: bool,
    ) -> PyResult<Self> {
        let start = Instant::now();
        let mut measurements = MeasurementSources::in_folder(&folder);
        for (name, text) in &texts {
            measurements = measurements.with_text(name, text);
        }
        let sources = FitSources {
            maps: map_sources(&folder, arrays, &functions),
            measurements,
        };
        let source = Source::new(source, text).into();
        let wanted = if is_measured {
            Measurements::Required
        } else {
            Measurements::Optional
        };
        let read = || FitFile::parse(&source, name, &sources, wanted);
        let file = Threads::work(py, read)?.map_err(Refusal::from)?;
        Ok(Self {
            file: Mutex::new(Some(file)),
            start,
        })
    }

    /// Starts fitting on this many threads.
    #[pyo3(signature = (threads = None))]
    fn start_fit(&self, threads: Option<u16>) -> PyResult<FitRun> {
        let (file, start) = (self.take()?, self.start);
        let work = Work::start(threads, move |watched| {
            let report = |stage| watched.report(counts(stage));
            let fitted = unless_stopped(fit(file, start, &watched.stop, &report))?;
            fitted.map(|fitted| Found::of_fit(&fitted)).transpose()
        });
        Ok(FitRun(work.map_err(Refusal::from)?))
    }

    /// Starts fitting each curve alone on this many threads.
    #[pyo3(signature = (threads = None))]
    fn start_each(&self, threads: Option<u16>) -> PyResult<FitRun> {
        let file = self.take()?;
        let work = Work::start(threads, move |watched| {
            let report = |done| watched.report((Some(done), None));
            let found = EachResult::new(&file, &watched.stop, &report);
            let is_begun = !found.curves.is_empty();
            is_begun.then(|| Found::of_each(&found)).transpose()
        });
        Ok(FitRun(work.map_err(Refusal::from)?))
    }

    /// Starts fitting on this many threads, to evaluate the likelihood of other values.
    #[pyo3(signature = (threads = None))]
    fn start_likelihood(&self, threads: Option<u16>) -> PyResult<LikelihoodRun> {
        let file = self.take()?;
        let work = Work::start(threads, move |watched| {
            let report = |stage| watched.report(counts(stage));
            unless_stopped(likelihood(file, &watched.stop, &report))
        });
        Ok(LikelihoodRun(work.map_err(Refusal::from)?))
    }

    /// Starts planning its design on this many threads.
    #[pyo3(signature = (threads = None))]
    fn start_plan(&self, threads: Option<u16>) -> PyResult<FitRun> {
        let (file, start) = (self.take()?, self.start);
        let work = Work::start(threads, move |watched| {
            let report = |stage| watched.report(counts(stage));
            let planned = unless_stopped(plan(&file, start, &watched.stop, &report))?;
            planned.map(|plan| Found::of_plan(&plan)).transpose()
        });
        Ok(FitRun(work.map_err(Refusal::from)?))
    }
}

/// Curves solved by a fit, and curves of the design judged.
fn counts(stage: Stage) -> (Option<usize>, Option<usize>) {
    match stage {
        Stage::Solved(curves) => (Some(curves), None),
        Stage::Planned(curves) => (None, Some(curves)),
    }
}

/// Converts the failure of work that the user stopped before it had a result to `None`.
fn unless_stopped<T>(found: Result<T, Failure>) -> Result<Option<T>, Failure> {
    match found {
        Err(Failure::Identify(IdentifyError::Stopped { .. })) => Ok(None),
        found => found.map(Some),
    }
}

/// The result of a fit, of fits of each curve, or a plan, as the texts of its files.
#[derive(Debug)]
struct Found {
    json: String,
    tables: Vec<(String, String)>,
    is_whole: bool,
}

impl Found {
    fn of_fit(fitted: &FittedFile) -> Result<Self, Failure> {
        let tables = fitted.tables().into_iter();
        Ok(Self {
            json: json(&fitted.found)?,
            tables: tables
                .map(|(name, table)| (name.to_owned(), table))
                .collect(),
            is_whole: !fitted.is_stopped(),
        })
    }

    fn of_each(each: &EachResult) -> Result<Self, Failure> {
        Ok(Self {
            json: json(each)?,
            tables: vec![("each.csv".to_owned(), each_table(each))],
            is_whole: each.not_begun == 0,
        })
    }

    fn of_plan(plan: &PlanResult) -> Result<Self, Failure> {
        Ok(Self {
            json: json(plan)?,
            tables: vec![("plan.csv".to_owned(), plan_table(plan))],
            is_whole: true,
        })
    }
}

/// The texts of a result's files, and whether the work was finished.
type Files = (String, Vec<(String, String)>, bool);

/// A running fit or plan. It is stopped when this object is dropped.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct FitRun(Work<(Option<usize>, Option<usize>), Option<Found>>);

#[pymethods]
impl FitRun {
    /// Waits at most this many milliseconds; returns whether the work is finished.
    fn wait(&self, py: Python<'_>, milliseconds: u64) -> bool {
        self.0.wait(py, milliseconds)
    }

    /// Asks the work to end; results found so far are kept.
    fn cancel(&self) {
        self.0.cancel();
    }

    /// Curves solved, or else curves of the design judged; `None` before the first.
    fn progress(&self) -> Option<(Option<usize>, Option<usize>)> {
        self.0.progress()
    }

    /// Takes the result of finished work: JSON, tables with their file names, and whether it is complete; `None` if
    /// nothing was found before the stop.
    fn result(&self) -> PyResult<Option<Files>> {
        let found = self.0.result()?;
        Ok(found.map(|found| (found.json, found.tables, found.is_whole)))
    }
}

/// A running fit whose likelihood is wanted. It is stopped when this object is dropped.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct LikelihoodRun(Work<(Option<usize>, Option<usize>), Option<FittedLikelihood>>);

#[pymethods]
impl LikelihoodRun {
    /// Waits at most this many milliseconds; returns whether the work is finished.
    fn wait(&self, py: Python<'_>, milliseconds: u64) -> bool {
        self.0.wait(py, milliseconds)
    }

    /// Asks the work to end.
    fn cancel(&self) {
        self.0.cancel();
    }

    /// Curves solved; `None` before the first.
    fn progress(&self) -> Option<(Option<usize>, Option<usize>)> {
        self.0.progress()
    }

    /// Takes the likelihood after finished work; `None` if it was stopped.
    fn result(&self) -> PyResult<Option<Likelihood>> {
        Ok(self.0.result()?.map(Likelihood))
    }
}

/// The likelihood of the data of a fit.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct Likelihood(FittedLikelihood);

#[pymethods]
impl Likelihood {
    /// Keys of the unknowns, then of the nuisances.
    #[getter]
    fn keys(&self) -> Vec<&str> {
        self.0.keys()
    }

    /// Their values in the best fit.
    #[getter]
    fn best(&self) -> Vec<f64> {
        self.0.best().to_vec()
    }

    /// The logarithm of the likelihood of other values, over that of the best fit.
    #[expect(
        clippy::needless_pass_by_value,
        reason = "Python hands over a list of its own"
    )]
    fn logarithm(&self, py: Python<'_>, values: Vec<f64>) -> PyResult<f64> {
        let found = Threads::work(py, || self.0.logarithm(&values))?;
        Ok(found.map_err(Refusal::from)?)
    }
}
