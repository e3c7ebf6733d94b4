//! A study: its cases solved in chunks, wherever an engine of Python takes them, and the table they are gathered in.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use pellicle_cli::Failure;
use pellicle_cli::studied::{
    CaseSolver, CaseStatus, ResultsTable, Shard, StudyFolder, StudyIdentity, StudyPlan, Tally,
    read, write_report,
};
use pellicle_contact::{Observer, Progress, Signal};
use pyo3::prelude::*;

use crate::error::{InternalError, Refusal};
use crate::process::{self, Shared, Threads};
use crate::work::{Watched, Work};

/// A case by its number from 0, the word of its status, and its rows of the table.
type SolvedRows = (usize, &'static str, String);

/// The cases solved so far are told.
type Solving = Watched<usize, SolvedChunk>;

/// A study, read and planned.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct Study(Arc<Planned>);

struct Planned {
    study: pellicle_cli::studied::Study,
    plan: StudyPlan,
}

#[pymethods]
impl Study {
    /// Reads the file, with the values of `sets` in place of those of the base case, as `--set` takes them.
    #[new]
    #[expect(
        clippy::needless_pass_by_value,
        reason = "Python hands over a path and a list of its own"
    )]
    fn new(py: Python<'_>, path: PathBuf, sets: Vec<String>) -> PyResult<Self> {
        let planned = Threads::work(py, || {
            let study = read(&path, &sets)?;
            let plan = StudyPlan::new(&study, Shard::WHOLE)?;
            Ok::<_, Failure>(Planned { study, plan })
        })?;
        Ok(Self(Arc::new(planned.map_err(Refusal::from)?)))
    }

    /// Number of cases.
    fn __len__(&self) -> usize {
        self.0.study.len()
    }

    #[getter]
    fn name(&self) -> &str {
        &self.0.study.name
    }

    /// Hash of all that the results depend on.
    #[getter]
    fn fingerprint(&self) -> &str {
        &self.0.plan.identity.fingerprint
    }

    /// What is wrong with the first invalid case among those tried; none if all are valid.
    #[getter]
    fn refused(&self) -> Option<String> {
        self.0.plan.refused.words()
    }

    /// Whether the fields of its cases are to be kept.
    #[getter]
    fn keeps_fields(&self) -> bool {
        self.0.plan.identity.kept.is_some()
    }

    /// Starts to solve some cases, counted from 0, one after the other on so many threads.
    fn start(&self, cases: Vec<usize>, threads: u16) -> Result<StudyRun, Refusal> {
        let (planned, shared) = (Arc::clone(&self.0), process::shared());
        let work = Work::start(Some(threads), move |watched| {
            solve(&planned, &shared, cases, watched)
        })?;
        Ok(StudyRun(work))
    }

    /// Opens the table in a folder, which belongs to this study until the table is closed; `fresh` begins it again.
    #[expect(
        clippy::needless_pass_by_value,
        reason = "Python hands over a path of its own"
    )]
    fn table(&self, py: Python<'_>, folder: PathBuf, fresh: bool) -> Result<Table, Refusal> {
        let identity = self.0.plan.identity.clone();
        let open = |folder: &Path| {
            let place = StudyFolder::claim(folder, &identity, fresh)?;
            ResultsTable::open(place, &identity)
        };
        let table = Mutex::new(Some(py.detach(|| open(&folder))?));
        Ok(Table {
            identity,
            process: std::process::id(),
            table,
        })
    }
}

/// The observer of a case of a study.
struct Watcher<'a>(&'a Solving);

impl Observer for Watcher<'_> {
    fn progress(&mut self, _: &Progress) -> Signal {
        signal(self.0)
    }
}

fn signal(watched: &Solving) -> Signal {
    if watched.stop.is_raised() {
        Signal::Cancel
    } else {
        Signal::Continue
    }
}

/// Some cases solved, and the warnings of the cache.
struct SolvedChunk {
    rows: Vec<SolvedRows>,
    warnings: Vec<String>,
}

/// Solves cases one after the other; those that are done if this is stopped.
fn solve(
    planned: &Planned,
    shared: &Shared,
    cases: Vec<usize>,
    watched: &Solving,
) -> Result<SolvedChunk, Failure> {
    let kit = CaseSolver {
        study: &planned.study,
        columns: &planned.plan.columns,
        cache: shared.study_cache.clone(),
        memory: &shared.memory,
        folders: None,
        kept: None,
    };
    let mut rows = Vec::new();
    for case in cases {
        let search = |_| signal(watched);
        let is_stopped = signal(watched) == Signal::Cancel;
        let done = if is_stopped {
            None
        } else {
            kit.solve(case, &mut Watcher(watched), &search)?
        };
        let Some(done) = done else { break };
        rows.push((case, done.status.word(), done.rows));
        watched.tell(rows.len());
    }
    let warnings = kit.cache.take_warnings();
    Ok(SolvedChunk {
        rows,
        warnings: warnings.iter().map(ToString::to_string).collect(),
    })
}

/// Cases being solved. They are left when nobody holds this any more.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct StudyRun(Work<usize, SolvedChunk>);

#[pymethods]
impl StudyRun {
    /// Waits at most so many milliseconds; whether the work is finished.
    fn wait(&self, py: Python<'_>, milliseconds: u64) -> bool {
        self.0.wait(py, milliseconds)
    }

    /// Asks the work to end; the cases solved so far are kept.
    fn cancel(&self) {
        self.0.cancel();
    }

    /// The number of cases solved; none before the first.
    fn progress(&self) -> Option<usize> {
        self.0.progress()
    }

    /// The cases solved, each with the word of its status and its rows, and warnings; handed out once.
    fn result(&self) -> PyResult<(Vec<SolvedRows>, Vec<String>)> {
        let SolvedChunk { rows, warnings } = self.0.result()?;
        Ok((rows, warnings))
    }
}

/// The table of a study, open for this process alone until it is closed.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct Table {
    identity: StudyIdentity,
    process: u32,
    table: Mutex<Option<ResultsTable>>,
}

impl Table {
    fn lock(&self) -> MutexGuard<'_, Option<ResultsTable>> {
        self.table.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Does something with the table, which must be open, while Python's other threads go on.
    fn with<T: Send>(
        &self,
        py: Python<'_>,
        action: impl FnOnce(&mut ResultsTable) -> Result<T, Failure> + Send,
    ) -> PyResult<T> {
        let done = py.detach(|| self.lock().as_mut().map(action));
        let closed = || InternalError::new_err("the table is closed");
        Ok(done.ok_or_else(closed)?.map_err(Refusal::from)?)
    }
}

impl Drop for Table {
    /// A forked child leaves the table, and the lock of its folder, to the parent.
    fn drop(&mut self) {
        if self.process != std::process::id() {
            let table = self.table.get_mut();
            std::mem::forget(table.unwrap_or_else(PoisonError::into_inner).take());
        }
    }
}

#[pymethods]
impl Table {
    /// The cases that it has no rows of, counted from 0.
    fn remaining(&self, py: Python<'_>) -> PyResult<Vec<usize>> {
        self.with(py, |table| Ok(table.remaining(&self.identity).collect()))
    }

    /// Appends the rows of cases, each with the word of its status.
    fn add(&self, py: Python<'_>, solved: Vec<(usize, String, String)>) -> PyResult<()> {
        let statuses = solved.iter().map(|(_, word, _)| CaseStatus::of(word));
        let statuses: Option<Vec<_>> = statuses.collect();
        let unknown = || InternalError::new_err("a case has no status");
        let statuses = statuses.ok_or_else(unknown)?;
        self.with(py, |table| {
            let mut both = solved.iter().zip(statuses);
            both.try_for_each(|((case, _, rows), status)| table.add(*case, status, rows))
        })
    }

    /// Forces what was added to the disk.
    fn force(&self, py: Python<'_>) -> PyResult<()> {
        self.with(py, |table| {
            let unforced = table.unforced()?;
            unforced.map_or(Ok(()), |file| file.force())
        })
    }

    /// The numbers of cases that are certified, not converged, cut off, and failed.
    fn tally(&self, py: Python<'_>) -> PyResult<(usize, usize, usize, usize)> {
        let Tally {
            certified,
            not_converged,
            cut_off,
            failed,
        } = self.with(py, |table| Ok(table.tally()))?;
        Ok((certified, not_converged, cut_off, failed))
    }

    /// Its file.
    fn path(&self, py: Python<'_>) -> PyResult<PathBuf> {
        self.with(py, |table| Ok(table.path().to_owned()))
    }

    /// Closes it, sorted and with its page beside it if every case is done, and lets others have the folder.
    fn close(&self, py: Python<'_>) -> Result<(), Refusal> {
        let table = self.lock().take();
        let cases = self.identity.len();
        let close = |table: ResultsTable| match table.tally().done() {
            done if done == cases => {
                let folder = table.place().folder.clone();
                table.finish(&self.identity)?;
                write_report(&folder, std::slice::from_ref(&self.identity)).map(drop)
            }
            _ => Ok(()),
        };
        Ok(py.detach(|| table.map_or(Ok(()), close))?)
    }
}
