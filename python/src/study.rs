//! A study: its cases, solved in chunks by the workers of a Python engine, and the table that collects them.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use pellicle::{Event, Monitor};
use pellicle_cli::Failure;
use pellicle_cli::studied::discard_cases;
use pellicle_contact::Signal;
use pellicle_study::case_solver::CaseSolver;
use pellicle_study::case_status::{CaseStatus, Tally};
use pellicle_study::folder::StudyFolder;
use pellicle_study::identity::StudyIdentity;
use pellicle_study::kept_file::KeptFields;
use pellicle_study::kept_record::{FieldKeeper, RecordInMemory};
use pellicle_study::plan::StudyPlan;
use pellicle_study::results_table::ResultsTable;
use pellicle_study::shard::Shard;
use pellicle_study::{StudyError, report, study_file};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::error::{InternalError, Refusal};
use crate::process::{self, Shared, Threads};
use crate::work::{Watched, Work};

/// The index of a case, its status as a word, its rows of the table, and the record of its kept fields.
type SolvedRows = (usize, &'static str, String, Vec<u8>);

/// The same for Python.
type HandedRows<'py> = (usize, &'static str, String, Bound<'py, PyBytes>);

/// The state of a chunk; its progress is the number of cases solved so far.
type WatchedChunk = Watched<usize, SolvedChunk>;

/// A study, read and planned.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct Study(Arc<Planned>);

struct Planned {
    study: pellicle_study::Study,
    plan: StudyPlan,
}

#[pymethods]
impl Study {
    /// Reads the file, and replaces values of the base case by those in `sets`, as with `--set`.
    #[new]
    #[expect(
        clippy::needless_pass_by_value,
        reason = "Python hands over a path and a list of its own"
    )]
    fn new(py: Python<'_>, path: PathBuf, sets: Vec<String>) -> PyResult<Self> {
        let planned = Threads::work(py, || {
            let study = study_file::read(&path, &sets)?;
            let plan = StudyPlan::new(&study, Shard::WHOLE)?;
            Ok::<_, StudyError>(Planned { study, plan })
        })?;
        Ok(Self(Arc::new(planned.map_err(Refusal::from)?)))
    }

    /// Number of cases.
    fn __len__(&self) -> usize {
        self.0.study.case_count()
    }

    #[getter]
    fn name(&self) -> &str {
        &self.0.study.name
    }

    /// Hash of everything that the results depend on.
    #[getter]
    fn fingerprint(&self) -> &str {
        &self.0.plan.identity.fingerprint
    }

    /// The error of the first invalid case among those tried; `None` if all are valid.
    #[getter]
    fn refused(&self) -> Option<String> {
        self.0.plan.refused.words()
    }

    /// Maximum size of the kept fields of a case in bytes; 0 if none are kept.
    #[getter]
    fn record_bytes(&self) -> usize {
        let kept = self.0.plan.identity.kept.as_ref();
        kept.map_or(0, |layout| {
            let grids = layout.grids().into_iter();
            let bytes = grids.map(|elements| layout.record_bytes(elements));
            bytes.max().unwrap_or(0)
        })
    }

    /// Starts solving these cases, counted from 0, one after another on this many threads.
    fn start(&self, cases: Vec<usize>, threads: u16) -> Result<StudyRun, Refusal> {
        let (planned, shared) = (Arc::clone(&self.0), process::shared());
        let work = Work::start(Some(threads), move |watched| {
            solve(&planned, &shared, cases, watched)
        })?;
        Ok(StudyRun(work))
    }

    /// Opens the table in a folder, which is locked for this study until the table is closed; `fresh` starts a new
    /// table.
    #[expect(
        clippy::needless_pass_by_value,
        reason = "Python hands over a path of its own"
    )]
    fn table(&self, py: Python<'_>, folder: PathBuf, fresh: bool) -> Result<Table, Refusal> {
        let identity = self.0.plan.identity.clone();
        let open = |folder: &Path| {
            let place = StudyFolder::claim(folder, &identity, fresh, &discard_cases)?;
            let table = ResultsTable::open(place, &identity)?;
            let kept = KeptFields::open(folder, &identity, table.tally().done())?;
            Ok::<_, StudyError>(OpenTable {
                table,
                kept,
                waiting: Vec::new(),
            })
        };
        let table = Mutex::new(Some(py.detach(|| open(&folder))?));
        Ok(Table {
            identity,
            process: std::process::id(),
            open: table,
        })
    }
}

/// The monitor of a case of a study.
struct CaseMonitor<'a>(&'a WatchedChunk);

impl Monitor for CaseMonitor<'_> {
    fn told(&mut self, _: Event<'_>) -> Signal {
        signal(self.0)
    }
}

fn signal(watched: &WatchedChunk) -> Signal {
    if watched.stop.is_raised() {
        Signal::Cancel
    } else {
        Signal::Continue
    }
}

/// The solved cases of a chunk, and the warnings of the cache.
struct SolvedChunk {
    rows: Vec<SolvedRows>,
    warnings: Vec<String>,
}

/// Solves cases one after another; returns those finished if this is stopped.
fn solve(
    planned: &Planned,
    shared: &Shared,
    cases: Vec<usize>,
    watched: &WatchedChunk,
) -> Result<SolvedChunk, Failure> {
    let record = RecordInMemory::of(&planned.plan.identity);
    let kit = CaseSolver {
        study: &planned.study,
        columns: &planned.plan.columns,
        cache: shared.study_cache.clone(),
        memory: &shared.memory,
        folders: None,
        kept: record.as_ref().map(|record| record as &dyn FieldKeeper),
    };
    let mut rows = Vec::new();
    for case in cases {
        let is_stopped = signal(watched) == Signal::Cancel;
        let done = if is_stopped {
            None
        } else {
            kit.solve(case, &mut CaseMonitor(watched))?
        };
        let Some(done) = done else { break };
        let kept = record.as_ref().map(RecordInMemory::take);
        let kept = kept.unwrap_or_default();
        rows.push((case, done.status.word(), done.rows, kept));
        watched.report(rows.len());
    }
    let warnings = kit.cache.take_warnings();
    Ok(SolvedChunk {
        rows,
        warnings: warnings.iter().map(ToString::to_string).collect(),
    })
}

/// Cases being solved. The work is stopped when this object is dropped.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct StudyRun(Work<usize, SolvedChunk>);

#[pymethods]
impl StudyRun {
    /// Waits at most this many milliseconds; returns whether the work is finished.
    fn wait(&self, py: Python<'_>, milliseconds: u64) -> bool {
        self.0.wait(py, milliseconds)
    }

    /// Asks the work to end; the cases solved so far are kept.
    fn cancel(&self) {
        self.0.cancel();
    }

    /// The number of cases solved; `None` before the first.
    fn progress(&self) -> Option<usize> {
        self.0.progress()
    }

    /// Takes the solved cases, each with its status as a word, its rows and its kept fields, and the warnings.
    fn result<'py>(&self, py: Python<'py>) -> PyResult<(Vec<HandedRows<'py>>, Vec<String>)> {
        let SolvedChunk { rows, warnings } = self.0.result()?;
        let rows = rows.into_iter();
        let hand_over =
            |(case, word, rows, kept): SolvedRows| (case, word, rows, PyBytes::new(py, &kept));
        Ok((rows.map(hand_over).collect(), warnings))
    }
}

/// A table, the fields kept beside it, and the rows of cases whose fields may not yet be on disk.
struct OpenTable {
    table: ResultsTable,
    kept: Option<KeptFields>,
    waiting: Vec<(usize, CaseStatus, String)>,
}

impl OpenTable {
    /// Adds the rows of a case, or queues them until its fields are on disk.
    fn add(
        &mut self,
        (case, status, rows, record): (usize, CaseStatus, String, &[u8]),
    ) -> Result<(), StudyError> {
        let Some(kept) = &self.kept else {
            return self.table.add(case, status, &rows);
        };
        kept.write(case, 0, record)?;
        self.waiting.push((case, status, rows));
        Ok(())
    }

    /// Flushes the fields to disk, then adds the rows of their cases and flushes these.
    fn force(&mut self) -> Result<(), StudyError> {
        self.kept.as_ref().map_or(Ok(()), FieldKeeper::force)?;
        for (case, status, rows) in self.waiting.drain(..) {
            self.table.add(case, status, &rows)?;
        }
        let unforced = self.table.unforced()?;
        unforced.map_or(Ok(()), |file| file.force())
    }

    fn tally(&self) -> Tally {
        let mut tally = self.table.tally();
        let waiting = self.waiting.iter();
        waiting.for_each(|(_, status, _)| tally.add(*status));
        tally
    }

    /// Sorts the table and writes its report page, if every case is done.
    fn close(mut self, identity: &StudyIdentity) -> Result<(), StudyError> {
        self.force()?;
        if self.table.tally().done() < identity.case_count() {
            return Ok(());
        }
        self.kept.as_ref().map_or(Ok(()), KeptFields::finish)?;
        let folder = self.table.place().folder.clone();
        self.table.finish(identity)?;
        report::write(&folder, std::slice::from_ref(identity)).map(drop)
    }
}

/// The table of a study, open exclusively for this process until it is closed.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct Table {
    identity: StudyIdentity,
    process: u32,
    open: Mutex<Option<OpenTable>>,
}

impl Table {
    fn lock(&self) -> MutexGuard<'_, Option<OpenTable>> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Runs an action on the table, which must be open, while Python's other threads continue.
    fn with<T: Send>(
        &self,
        py: Python<'_>,
        action: impl FnOnce(&mut OpenTable) -> Result<T, StudyError> + Send,
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
            let table = self.open.get_mut();
            std::mem::forget(table.unwrap_or_else(PoisonError::into_inner).take());
        }
    }
}

#[pymethods]
impl Table {
    /// The cases without rows, counted from 0.
    fn remaining(&self, py: Python<'_>) -> PyResult<Vec<usize>> {
        self.with(py, |table| {
            Ok(table.table.remaining(&self.identity).collect())
        })
    }

    /// Appends the rows of cases, each with its status as a word and its kept fields.
    #[expect(
        clippy::needless_pass_by_value,
        reason = "Python hands over a list of its own"
    )]
    fn add(
        &self,
        py: Python<'_>,
        solved: Vec<(usize, String, String, Bound<'_, PyBytes>)>,
    ) -> PyResult<()> {
        let unknown = || InternalError::new_err("a case has no status");
        let with_status = solved.iter().map(|(case, word, rows, record)| {
            let status = CaseStatus::of(word).ok_or_else(unknown)?;
            Ok((*case, status, rows.clone(), record.as_bytes()))
        });
        let mut solved = with_status.collect::<PyResult<Vec<_>>>()?.into_iter();
        self.with(py, |table| solved.try_for_each(|case| table.add(case)))
    }

    /// Flushes the additions to disk.
    fn force(&self, py: Python<'_>) -> PyResult<()> {
        self.with(py, OpenTable::force)
    }

    /// The numbers of certified, not converged, cut-off, impossible and failed cases.
    fn tally(&self, py: Python<'_>) -> PyResult<(usize, usize, usize, usize, usize)> {
        let Tally {
            certified,
            not_converged,
            cut_off,
            beyond_model,
            failed,
        } = self.with(py, |table| Ok(table.tally()))?;
        Ok((certified, not_converged, cut_off, beyond_model, failed))
    }

    /// Its file.
    fn path(&self, py: Python<'_>) -> PyResult<PathBuf> {
        self.with(py, |table| Ok(table.table.path().to_owned()))
    }

    /// Closes the table, sorted and with its report page if every case is done, and unlocks the folder.
    fn close(&self, py: Python<'_>) -> Result<(), Refusal> {
        let table = self.lock().take();
        let close = |table: OpenTable| table.close(&self.identity);
        Ok(py.detach(|| table.map_or(Ok(()), close))?)
    }
}
