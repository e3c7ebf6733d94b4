//! A case being solved: Python starts it, waits for it in short turns, hears how far it is, and may stop it.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use pellicle_cli::Failure;
use pellicle_cli::solved::{Resources, SolvedCase, solve};
use pellicle_contact::{Observer, Progress, Signal};
use pyo3::prelude::*;

use crate::error::{self, Refusal};
use crate::process::{self, Shared, Threads};
use crate::solution::Solution;

/// A solution, none if it was stopped before it began; a failure; or a panic.
type Outcome = Result<Result<Option<SolvedCase>, Failure>, Box<dyn Any + Send>>;

/// Where the work stands.
#[derive(Default)]
struct State {
    progress: Option<Progress>,
    is_finished: bool,
    outcome: Option<Outcome>,
}

/// What the work and those who wait for it both see.
#[derive(Default)]
struct Watched {
    state: Mutex<State>,
    finished: Condvar,
    is_cancelled: AtomicBool,
}

impl Watched {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn signal(&self) -> Signal {
        if self.is_cancelled.load(Ordering::Relaxed) {
            Signal::Cancel
        } else {
            Signal::Continue
        }
    }

    fn finish(&self, outcome: Outcome) {
        let mut state = self.state();
        state.outcome = Some(outcome);
        state.is_finished = true;
        drop(state);
        self.finished.notify_all();
    }
}

/// The observer of a solution, which remembers the last progress.
struct Watcher<'a>(&'a Watched);

impl Observer for Watcher<'_> {
    fn progress(&mut self, progress: &Progress) -> Signal {
        self.0.state().progress = Some(*progress);
        self.0.signal()
    }
}

/// A case being solved. It is stopped when nobody holds this any more.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct Run {
    case: Arc<pellicle_cli::Case>,
    watched: Arc<Watched>,
    threads: Mutex<Option<Threads>>,
}

impl Run {
    /// Starts to solve a case on so many threads.
    pub fn start(case: Arc<pellicle_cli::Case>, threads: Option<u16>) -> Result<Self, Failure> {
        let start = Instant::now();
        let (shared, threads) = (process::shared(), Threads::take(threads)?);
        let watched = Arc::<Watched>::default();
        let (of_work, case_of_work) = (Arc::clone(&watched), Arc::clone(&case));
        threads.pool().spawn(move || {
            let work = || solve_watched(&case_of_work, &shared, start, &of_work);
            of_work.finish(catch_unwind(AssertUnwindSafe(work)));
        });
        Ok(Self {
            case,
            watched,
            threads: Mutex::new(Some(threads)),
        })
    }

    fn release_threads(&self) {
        let mut threads = self.threads.lock().unwrap_or_else(PoisonError::into_inner);
        threads.take().into_iter().for_each(Threads::release);
    }
}

fn solve_watched(
    case: &pellicle_cli::Case,
    shared: &Shared,
    start: Instant,
    watched: &Watched,
) -> Result<Option<SolvedCase>, Failure> {
    let resources = Resources {
        cache: &shared.cache,
        memory: &shared.memory,
        writers: 0,
    };
    let search = |_| watched.signal();
    let solved = solve(case, resources, start, &mut Watcher(watched), &search)?;
    Ok(solved.map(|mut solved| {
        let warnings = shared.cache.take_warnings();
        solved
            .summary
            .warnings
            .extend(warnings.iter().map(Into::into));
        solved
    }))
}

#[pymethods]
impl Run {
    /// Waits at most so many milliseconds; whether the work is finished.
    fn wait(&self, py: Python<'_>, milliseconds: u64) -> bool {
        py.detach(|| {
            let patience = Duration::from_millis(milliseconds);
            let waits = |state: &mut State| !state.is_finished;
            let waited =
                self.watched
                    .finished
                    .wait_timeout_while(self.watched.state(), patience, waits);
            waited.unwrap_or_else(PoisonError::into_inner).0.is_finished
        })
    }

    /// Asks the work to end; the steps solved so far are kept.
    fn cancel(&self) {
        self.watched.is_cancelled.store(true, Ordering::Relaxed);
    }

    /// Step, finished steps, steps, elements a side, iteration, residual; none before the first iteration.
    fn progress(&self) -> Option<(usize, usize, usize, usize, usize, f64)> {
        let progress = self.watched.state().progress?;
        Some((
            progress.step,
            progress.finished,
            progress.steps,
            progress.elements,
            progress.iteration,
            progress.residual,
        ))
    }

    /// The solution of work that is finished, handed out once; none if not a single step is solved.
    fn result(&self) -> PyResult<Option<Solution>> {
        let outcome = self.watched.state().outcome.take();
        let Some(outcome) = outcome else {
            return Err(error::InternalError::new_err(
                "no result is there to be taken",
            ));
        };
        self.release_threads();
        match outcome {
            Err(panic) => Err(error::of_panic(&*panic)),
            Ok(solved) => {
                let solved = solved.map_err(Refusal::from)?;
                let solved = solved.filter(|solved| !solved.path.steps.is_empty());
                let case = Arc::clone(&self.case);
                Ok(solved.map(|solved| Solution::new(case, solved)))
            }
        }
    }
}

impl Drop for Run {
    fn drop(&mut self) {
        let threads = self.threads.get_mut();
        let Some(threads) = threads.unwrap_or_else(PoisonError::into_inner).take() else {
            return;
        };
        // In a forked child the state may be locked by a thread that is not there.
        if threads.are_of_parent() || self.watched.state().is_finished {
            threads.release();
        } else {
            self.watched.is_cancelled.store(true, Ordering::Relaxed);
        }
    }
}
