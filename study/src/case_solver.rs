//! Solves one case of a study: from its values to the rows of the table.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::time::Instant;

use pellicle::case::Case;
use pellicle::input::units::Units;
use pellicle::memory::MemoryBudget;
use pellicle::run::{self, Resources, Run};
use pellicle::{Completeness, Monitor};
use pellicle_files::FileError;
use pellicle_influence::Cache;

use crate::Study;
use crate::StudyError;
use crate::case_folder::{CaseFolder, CaseFolders};
use crate::case_status::CaseStatus;
use crate::kept_record::{self, FieldKeeper, KeptRecords};
use crate::table_columns::{TableColumns, status};

/// Solves the cases of a study.
#[derive(Debug)]
pub struct CaseSolver<'a> {
    /// The study.
    pub study: &'a Study,
    /// The columns of its table.
    pub columns: &'a TableColumns,
    /// The cache, shared by all cases.
    pub cache: Cache,
    /// The memory budget, shared by all cases.
    pub memory: &'a MemoryBudget,
    /// The parent of the cases' results folders, and who makes them, if they are wanted.
    pub folders: Option<(PathBuf, &'a dyn CaseFolders)>,
    /// The keeper of the fields of all cases, if any are kept.
    pub kept: Option<&'a dyn FieldKeeper>,
}

/// The result of a case.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseResult {
    /// Its status.
    pub status: CaseStatus,
    /// Its rows of the table.
    pub rows: String,
    outcome: CaseOutcome,
}

/// The outcome of a case, as shown to the user.
#[derive(Debug, Clone, PartialEq)]
enum CaseOutcome {
    /// The case was solved: force and penetration of the last step, in these units.
    Solved(Units, Option<[f64; 2]>),
    /// The case failed, with the reason.
    Failed(String),
}

impl CaseResult {
    /// Describes the outcome for the terminal: `certified, Q = 1 mN, D = 20 nm`.
    #[must_use]
    pub fn words(&self) -> String {
        use pellicle::display::{Unit, quantity};
        match &self.outcome {
            CaseOutcome::Failed(message) => message.clone(),
            CaseOutcome::Solved(_, None) => String::new(),
            CaseOutcome::Solved(units, Some([force, penetration])) => {
                let force = quantity(*force, Unit::Newton, *units);
                let penetration = quantity(*penetration, Unit::Metre, *units);
                let word = self.status.word();
                format!("{word}, Q = {force}, D = {penetration}")
            }
        }
    }
}

impl CaseSolver<'_> {
    /// Solves a case. Returns `None` if the monitor stops it; unfinished results are then discarded.
    ///
    /// # Errors
    ///
    /// [`StudyError`] if its results folder cannot be written or belongs to something else. Any other error gives the
    /// result `failed`.
    pub fn solve(
        &self,
        case: usize,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<CaseResult>, StudyError> {
        let solved = catch_unwind(AssertUnwindSafe(|| self.attempt(case, monitor)));
        match solved {
            Ok(Ok(done)) => Ok(done),
            Ok(Err(failure)) if ends_study(&failure) => Err(failure),
            Ok(Err(failure)) => self.failed(case, &failure.to_string()).map(Some),
            Err(_) => self
                .failed(case, "an internal error of the program")
                .map(Some),
        }
    }

    /// Claims the results folder of a case, if one is wanted.
    fn claim(&self, number: usize, case: &Case) -> Result<Option<Box<dyn CaseFolder>>, StudyError> {
        let Some((parent, folders)) = &self.folders else {
            return Ok(None);
        };
        let folder = parent.join(format!("case-{:04}", number + 1));
        folders.claim(&folder, case).map(Some)
    }

    fn failed(&self, case: usize, message: &str) -> Result<CaseResult, StudyError> {
        self.kept
            .map_or(Ok(()), |kept| kept_record::add_failed(kept, case))?;
        Ok(CaseResult {
            status: CaseStatus::Failed,
            rows: self.columns.failed(self.study, case, message),
            outcome: CaseOutcome::Failed(message.to_owned()),
        })
    }

    /// Number of threads that need memory for the fields of a case.
    fn writers(&self, folder: Option<&dyn CaseFolder>) -> usize {
        let kept = self.kept.map(FieldKeeper::records);
        let is_kept = kept.is_some_and(KeptRecords::need_the_surface);
        folder.map_or(usize::from(is_kept), |_| rayon::current_num_threads())
    }

    fn attempt(
        &self,
        number: usize,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<CaseResult>, StudyError> {
        let start = Instant::now();
        let case = self.study.case(number)?;
        let folder = self.claim(number, &case)?;
        let resources = Resources {
            cache: &self.cache,
            memory: self.memory,
            writers: self.writers(folder.as_deref()),
        };
        let Some(solved) = run::solve(&case, resources, start, monitor)? else {
            return Ok(None);
        };
        if solved.completeness == Completeness::Part {
            return Ok(None);
        }
        // Warnings of the cache concern all cases and are printed at the end.
        let Run {
            path, mut summary, ..
        } = solved;
        if let Some(kept) = self.kept {
            kept_record::add(kept, number, status(&summary), &path)?;
        }
        if let Some(folder) = folder {
            summary.add_case(&case)?;
            let completeness = folder.write(&path, &mut summary, &case, start)?;
            if completeness == Completeness::Part {
                return Ok(None);
            }
        }
        let last = summary.steps.last();
        let last = last.map(|step| [step.force, step.penetration]);
        Ok(Some(CaseResult {
            status: status(&summary),
            rows: self.columns.solved(self.study, number, &summary),
            outcome: CaseOutcome::Solved(case.units, last),
        }))
    }
}

/// Whether the results of other cases could not be written either.
fn ends_study(error: &StudyError) -> bool {
    matches!(
        error,
        StudyError::OtherCase { .. }
            | StudyError::File(
                FileError::Write { .. }
                    | FileError::NoResults { .. }
                    | FileError::NotWritten { .. }
                    | FileError::Busy { .. },
            )
    )
}
