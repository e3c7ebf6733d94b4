//! One case of a study: from its values to the rows of the table.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::time::Instant;

use pellicle_contact::{Observer, solve_path};
use pellicle_influence::Cache;
use serde_json::Value;

use super::Study;
use super::columns::{Columns, status};
use super::status::Status;
use crate::case::Case;
use crate::failure::Failure;
use crate::forecast::Need;
use crate::memory::Memory;
use crate::output::file::Existing;
use crate::output::folder::{Extent, ResultsFolder};
use crate::output::summary::{Clock, Summary};
use crate::output::{results, run_files};

/// What every case of a study is solved with.
#[derive(Debug)]
pub struct Kit<'a> {
    /// The study.
    pub study: &'a Study,
    /// The columns of its table.
    pub columns: &'a Columns,
    /// Shared by all cases.
    pub cache: Cache,
    /// What the cases have among them.
    pub memory: Memory,
    /// Where the results folders of the cases go, if they are wanted.
    pub folders: Option<PathBuf>,
}

/// What a case left.
#[derive(Debug, Clone, PartialEq)]
pub struct Done {
    /// How it ended.
    pub status: Status,
    /// Its rows of the table.
    pub rows: String,
    /// What a person at the terminal wants to know of it.
    pub words: String,
}

impl Kit<'_> {
    /// Solves a case; none if the user stops it, and what it had by then is not kept.
    ///
    /// # Errors
    ///
    /// [`Failure`] if its results folder cannot be written or something else is there; whatever else goes wrong is a
    /// result, `failed`.
    pub fn solve(&self, case: usize, observer: &mut dyn Observer) -> Result<Option<Done>, Failure> {
        let solved = catch_unwind(AssertUnwindSafe(|| self.attempt(case, observer)));
        match solved {
            Ok(Ok(done)) => Ok(done),
            Ok(Err(
                failure @ (Failure::Write { .. }
                | Failure::NoResults { .. }
                | Failure::NotWritten { .. }
                | Failure::OtherCase { .. }
                | Failure::Busy { .. }),
            )) => Err(failure),
            Ok(Err(failure)) => Ok(Some(self.failed(case, &failure.to_string()))),
            Err(_) => Ok(Some(self.failed(case, "an error of the program itself"))),
        }
    }

    /// The place of the results folder of a case, if one is wanted. One that is there already is of this case, from
    /// before a kill.
    fn claim(&self, number: usize, case: &Case) -> Result<Option<ResultsFolder>, Failure> {
        let Some(folders) = &self.folders else {
            return Ok(None);
        };
        let path = folders.join(format!("case-{:04}", number + 1));
        if run_files::case_in(&path).is_some_and(|written| !is_of(&written, case)) {
            return Err(Failure::OtherCase { path });
        }
        ResultsFolder::claim(&path, Existing::Replace).map(Some)
    }

    fn failed(&self, case: usize, message: &str) -> Done {
        Done {
            status: Status::Failed,
            rows: self.columns.failed(self.study, case, message),
            words: message.to_owned(),
        }
    }

    fn attempt(&self, number: usize, observer: &mut dyn Observer) -> Result<Option<Done>, Failure> {
        let start = Instant::now();
        let case = self.study.case(number)?;
        let folder = self.claim(number, &case)?;
        let model = case.model(&self.cache)?;
        let tables_seconds = start.elapsed().as_secs_f64();
        let (loads, options) = (case.load.steps(), case.solver.options());
        let domain = case
            .domain(&model.value)
            .map_err(|error| case.blame(error))?;
        let elements = case.grid.elements;
        let writers = folder.as_ref().map_or(0, |_| rayon::current_num_threads());
        let need = Need::new(&case, &model.value, domain, writers);
        let Some(_share) = self.memory.take(need)? else {
            return Ok(None);
        };
        let path = solve_path(&model.value, domain, elements, &loads, &options, observer)
            .map_err(|error| case.blame(error))?;
        if path.interrupted {
            return Ok(None);
        }
        let clock = Clock {
            start,
            tables_seconds,
            tables_origin: model.origin,
        };
        // Warnings of the cache are those of all cases together.
        let mut summary = Summary::new(&case, &path, clock, &[])?;
        if let Some(folder) = folder {
            let mut extent = Extent::Whole;
            folder.write(|folder| {
                extent =
                    results::write(folder, &path, &mut summary, &case.output, start, &|_, _| ())?;
                Ok(extent)
            })?;
            if extent == Extent::Part {
                return Ok(None);
            }
        }
        Ok(Some(Done {
            status: status(&summary),
            rows: Columns::solved(self.study, number, &summary),
            words: words(&case, &summary),
        }))
    }
}

/// Whether this is the case as a summary has it, where the side of the domain is filled in if the case leaves it open.
/// What is written of the result is not part of it.
fn is_of(written: &Value, case: &Case) -> bool {
    let mut case = case.clone();
    let side = written["grid"]["side"].as_f64();
    case.grid.side = case.grid.side.or(side);
    let without_output = |mut case: Value| {
        if let Some(table) = case.as_object_mut() {
            table.remove("output");
        }
        case
    };
    let case = serde_json::to_value(case).map(without_output);
    case.is_ok_and(|case| case == without_output(written.clone()))
}

fn words(case: &Case, summary: &Summary) -> String {
    use crate::display::{Unit, quantity};
    let word = status(summary).word();
    let last = summary.steps.last();
    last.map_or_else(String::new, |step| {
        let force = quantity(step.force, Unit::Newton, case.units);
        let penetration = quantity(step.penetration, Unit::Metre, case.units);
        format!("{word}, Q = {force}, D = {penetration}")
    })
}
