//! Solves the remaining cases of a study, as many at a time as there are threads.

use std::num::NonZero;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Barrier, Mutex, PoisonError};
use std::thread;

use super::case_solver::CaseSolver;
use super::progress::StudyProgress;
use super::results_table::ResultsTable;
use crate::failure::Failure;
use crate::{interrupt, threads};

/// Solves `cases` and adds each to the table when it is done. Returns early, without an error, if the user asks to
/// stop.
///
/// Every case has threads of its own, a single one if there are more cases than threads: cases do not wait for each
/// other, and results do not depend on the number of threads.
///
/// # Errors
///
/// [`Failure`] of the first case whose results could not be written; the others would fail too.
pub fn run(
    kit: &CaseSolver<'_>,
    cases: &[usize],
    count: usize,
    table: &mut ResultsTable,
    lines: &StudyProgress,
) -> Result<(), Failure> {
    let workers = count.min(cases.len());
    if workers == 0 {
        return Ok(());
    }
    let queue = CaseQueue {
        cases,
        next: AtomicUsize::new(0),
        is_closed: AtomicBool::new(false),
    };
    let begun = Barrier::new(workers);
    let table = Mutex::new(table);
    let failure = Mutex::new(None);
    thread::scope(|scope| {
        for worker in 0..workers {
            // The first workers take the remainder.
            let own = count / workers + usize::from(worker < count % workers);
            let (queue, begun, table, failure) = (&queue, &begun, &table, &failure);
            scope.spawn(move || {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(own).build();
                if let Ok(pool) = &pool {
                    pool.install(threads::begin);
                }
                // All threads take their memory before the first case asks how much is left.
                begun.wait();
                let worked = pool
                    .map_err(Failure::from)
                    .and_then(|pool| work(kit, queue, &pool, table, lines));
                if let Err(first) = worked {
                    queue.is_closed.store(true, Ordering::SeqCst);
                    let mut failure = failure.lock().unwrap_or_else(PoisonError::into_inner);
                    failure.get_or_insert(first);
                }
            });
        }
    });
    let failure = failure.into_inner().unwrap_or_else(PoisonError::into_inner);
    failure.map_or(Ok(()), Err)
}

/// The default number of threads: one per core.
#[must_use]
pub fn default_threads() -> usize {
    thread::available_parallelism().map_or(1, NonZero::get)
}

/// The cases to do, in order.
struct CaseQueue<'a> {
    cases: &'a [usize],
    next: AtomicUsize,
    is_closed: AtomicBool,
}

impl CaseQueue<'_> {
    fn take(&self) -> Option<usize> {
        if self.is_closed.load(Ordering::SeqCst) || interrupt::is_requested() {
            return None;
        }
        let next = self.next.fetch_add(1, Ordering::SeqCst);
        self.cases.get(next).copied()
    }
}

fn work(
    kit: &CaseSolver<'_>,
    queue: &CaseQueue<'_>,
    pool: &rayon::ThreadPool,
    table: &Mutex<&mut ResultsTable>,
    lines: &StudyProgress,
) -> Result<(), Failure> {
    while let Some(case) = queue.take() {
        let solve = || {
            let mut line = lines.case(kit.study, case);
            kit.solve(case, &mut line)
        };
        let Some(done) = pool.install(solve)? else {
            return Ok(());
        };
        let mut table = table.lock().unwrap_or_else(PoisonError::into_inner);
        table.add(case, done.status, &done.rows)?;
        drop(table);
        lines.ended(kit.study, case, &done);
    }
    Ok(())
}
