//! Solves the remaining cases of a study, as many at a time as there are threads.

use std::num::NonZero;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Barrier, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use crate::StudyError;
use crate::case_solver::{CaseResult, CaseSolver};
use crate::monitor::StudyMonitor;
use crate::remaining::RemainingCases;
use crate::results_table::ResultsTable;

/// Interval at which results are forced to disk: a power failure loses at most this much work.
const FORCE_EVERY: Duration = Duration::from_secs(1);

/// Solves `cases` and adds each to the table when it is done. Returns early, without an error, if the monitor stops it.
///
/// Every case has its own threads, a single one if there are more cases than threads. Cases do not wait for each other,
/// and results do not depend on the number of threads.
///
/// # Errors
///
/// [`StudyError`] for the first case whose results could not be written; the others would fail too.
pub fn run(
    solver: &CaseSolver<'_>,
    cases: RemainingCases,
    count: usize,
    table: &mut ResultsTable,
    monitor: &dyn StudyMonitor,
) -> Result<(), StudyError> {
    let workers = count.min(cases.count_left());
    if workers == 0 {
        return Ok(());
    }
    let shared = SharedWork {
        queue: Mutex::new(cases),
        is_closed: AtomicBool::new(false),
        table: Mutex::new(table),
        waiting: Mutex::new(Vec::new()),
        failure: Mutex::new(None),
    };
    let begun = Barrier::new(workers);
    let (working, all_done) = mpsc::channel::<()>();
    thread::scope(|scope| {
        for worker in 0..workers {
            // The first workers take the remainder.
            let own = count / workers + usize::from(worker < count % workers);
            let (shared, begun, working) = (&shared, &begun, working.clone());
            scope.spawn(move || {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(own).build();
                if let Ok(pool) = &pool {
                    pool.install(begin_threads);
                }
                // All threads allocate their memory before the first case checks how much is left.
                begun.wait();
                let work = |pool: rayon::ThreadPool| pool.install(|| work(solver, shared, monitor));
                shared.end(pool.map_err(StudyError::from).and_then(work));
                drop(working);
            });
        }
        drop(working);
        force_until(solver, &shared, &all_done);
    });
    let failure = shared.failure.into_inner();
    let failure = failure.unwrap_or_else(PoisonError::into_inner);
    failure.map_or(Ok(()), Err)
}

/// The default number of threads: one per core.
#[must_use]
pub fn default_threads() -> usize {
    thread::available_parallelism().map_or(1, NonZero::get)
}

/// Data shared by the workers.
struct SharedWork<'a> {
    queue: Mutex<RemainingCases>,
    is_closed: AtomicBool,
    table: Mutex<&'a mut ResultsTable>,
    /// Cases whose kept fields may not be on disk yet; their rows are written after them.
    waiting: Mutex<Vec<(usize, CaseResult)>>,
    failure: Mutex<Option<StudyError>>,
}

impl<'a> SharedWork<'a> {
    fn take(&self) -> Option<usize> {
        if self.is_closed.load(Ordering::SeqCst) {
            return None;
        }
        let mut queue = self.queue.lock().unwrap_or_else(PoisonError::into_inner);
        queue.next()
    }

    fn table(&self) -> MutexGuard<'_, &'a mut ResultsTable> {
        self.table.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn waiting(&self) -> MutexGuard<'_, Vec<(usize, CaseResult)>> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Keeps the first failure; no worker takes another case after it.
    fn end(&self, worked: Result<(), StudyError>) {
        if let Err(first) = worked {
            self.is_closed.store(true, Ordering::SeqCst);
            let mut failure = self.failure.lock().unwrap_or_else(PoisonError::into_inner);
            failure.get_or_insert(first);
        }
    }
}

fn work(
    solver: &CaseSolver<'_>,
    shared: &SharedWork<'_>,
    monitor: &dyn StudyMonitor,
) -> Result<(), StudyError> {
    while !monitor.is_finishing()
        && let Some(case) = shared.take()
    {
        let mut line = monitor.case(solver.study, case);
        let Some(done) = solver.solve(case, &mut *line)? else {
            return Ok(());
        };
        drop(line);
        if solver.kept.is_some() {
            shared.waiting().push((case, done.clone()));
        } else {
            shared.table().add(case, done.status, &done.rows)?;
        }
        monitor.ended(solver.study, case, &done);
    }
    Ok(())
}

/// Forces the results to disk at intervals and at the end, while the workers continue.
fn force_until(solver: &CaseSolver<'_>, shared: &SharedWork<'_>, all_done: &mpsc::Receiver<()>) {
    loop {
        // Nothing is ever sent: the channel closes when the last worker is done.
        let is_last = all_done.recv_timeout(FORCE_EVERY) == Err(RecvTimeoutError::Disconnected);
        let forced = force(solver, shared);
        let failed = forced.is_err();
        shared.end(forced);
        if is_last || failed {
            return;
        }
    }
}

/// Forces the kept fields to disk, adds the rows of their cases to the table, and forces the table.
fn force(solver: &CaseSolver<'_>, shared: &SharedWork<'_>) -> Result<(), StudyError> {
    let waiting = std::mem::take(&mut *shared.waiting());
    if let Some(kept) = solver.kept {
        kept.force()?;
    }
    for (case, done) in waiting {
        shared.table().add(case, done.status, &done.rows)?;
    }
    // The table is unlocked meanwhile.
    let unforced = shared.table().unforced()?;
    unforced.map_or(Ok(()), |file| file.force())
}

/// Starts every thread of the current pool, so that the address space of each is reserved when this returns.
fn begin_threads() {
    rayon::broadcast(|_| drop(std::hint::black_box(vec![0_u8; 64])));
}
