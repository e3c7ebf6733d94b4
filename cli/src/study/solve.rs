//! One case of a study: from its values to the rows of the table.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::Instant;

use pellicle_contact::{LoadingPath, Observer, solve_path};
use pellicle_influence::Cache;

use super::Study;
use super::columns::{Columns, status};
use super::status::Status;
use crate::case::Case;
use crate::failure::Failure;
use crate::output::folder::{Existing, Folder};
use crate::output::results::{self, Written};
use crate::output::summary::{Clock, Summary};

/// What every case of a study is solved with.
#[derive(Debug, Clone)]
pub struct Kit<'a> {
    /// The study.
    pub study: &'a Study,
    /// The columns of its table.
    pub columns: &'a Columns,
    /// Shared by all cases.
    pub cache: Cache,
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
    /// [`Failure::Write`] if its results folder cannot be written; whatever else goes wrong is a result, `failed`.
    pub fn solve(&self, case: usize, observer: &mut dyn Observer) -> Result<Option<Done>, Failure> {
        let solved = catch_unwind(AssertUnwindSafe(|| self.attempt(case, observer)));
        match solved {
            Ok(Ok(done)) => Ok(done),
            Ok(Err(failure @ (Failure::Write { .. } | Failure::NoResults { .. }))) => Err(failure),
            Ok(Err(failure)) => Ok(Some(self.failed(case, &failure.to_string()))),
            Err(_) => Ok(Some(self.failed(case, "an error of the program itself"))),
        }
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
        let model = case.model(&self.cache)?;
        let tables_seconds = start.elapsed().as_secs_f64();
        let (loads, options) = (case.load.steps(), case.solver.options());
        let (domain, elements) = (case.grid.domain(), case.grid.elements);
        let path = solve_path(&model.value, domain, elements, &loads, &options, observer)?;
        if path.interrupted {
            return Ok(None);
        }
        let clock = Clock {
            start,
            tables_seconds,
            tables_origin: model.origin,
        };
        // Warnings of the cache are those of all cases together.
        let mut summary = Summary::new(&case, &path, clock, &[]);
        if let Some(folders) = &self.folders {
            let folder = folders.join(format!("case-{:04}", number + 1));
            if write(&folder, &path, &mut summary, start)? == Written::Partly {
                return Ok(None);
            }
        }
        Ok(Some(Done {
            status: status(&summary),
            rows: self.columns.solved(self.study, number, &summary),
            words: words(&case, &summary),
        }))
    }
}

/// A results folder that is there already is of this case, from before a kill; so is one that the user did not wait for, and the next run
/// replaces it.
fn write(
    folder: &Path,
    path: &LoadingPath,
    summary: &mut Summary,
    start: Instant,
) -> Result<Written, Failure> {
    let mut written = Written::Whole;
    Folder::claim(folder, Existing::Replace)?.write(|folder| {
        written = results::write(folder, path, summary, start, &|_, _| ())?;
        Ok(())
    })?;
    Ok(written)
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
