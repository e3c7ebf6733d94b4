//! Work on separate threads: Python starts it, waits for it in short intervals, receives its progress, and may stop it.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use pellicle_cli::Failure;
use pellicle_identify::StopFlag;
use pyo3::prelude::*;

use crate::error::{self, Refusal};
use crate::process::Threads;

/// A result, a failure, or a panic.
type Finished<T> = Result<Result<T, Failure>, Box<dyn Any + Send>>;

/// The state of the work.
struct State<P, T> {
    progress: Option<P>,
    is_finished: bool,
    outcome: Option<Finished<T>>,
}

/// The state shared by the work and the threads that wait for it.
pub struct Watched<P, T> {
    state: Mutex<State<P, T>>,
    finished: Condvar,
    /// The request to end the work.
    pub stop: StopFlag,
}

impl<P, T> Watched<P, T> {
    fn new() -> Self {
        Self {
            state: Mutex::new(State {
                progress: None,
                is_finished: false,
                outcome: None,
            }),
            finished: Condvar::new(),
            stop: StopFlag::default(),
        }
    }

    fn state(&self) -> MutexGuard<'_, State<P, T>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Reports the progress of the work.
    pub fn report(&self, progress: P) {
        self.state().progress = Some(progress);
    }

    fn finish(&self, outcome: Finished<T>) {
        let mut state = self.state();
        state.outcome = Some(outcome);
        state.is_finished = true;
        drop(state);
        self.finished.notify_all();
    }
}

/// Running work. It is stopped when this object is dropped.
pub struct Work<P, T> {
    watched: Arc<Watched<P, T>>,
    threads: Mutex<Option<Threads>>,
}

impl<P: Copy + Send + 'static, T: Send + 'static> Work<P, T> {
    /// Starts work on this many threads.
    pub fn start(
        threads: Option<u16>,
        work: impl FnOnce(&Watched<P, T>) -> Result<T, Failure> + Send + 'static,
    ) -> Result<Self, Failure> {
        let threads = Threads::take(threads)?;
        let watched = Arc::new(Watched::new());
        let of_work = Arc::clone(&watched);
        threads.pool().spawn(move || {
            let outcome = catch_unwind(AssertUnwindSafe(|| work(&of_work)));
            of_work.finish(outcome);
        });
        Ok(Self {
            watched,
            threads: Mutex::new(Some(threads)),
        })
    }

    /// Waits at most this many milliseconds; returns whether the work is finished.
    pub fn wait(&self, py: Python<'_>, milliseconds: u64) -> bool {
        py.detach(|| {
            let patience = Duration::from_millis(milliseconds);
            let waits = |state: &mut State<P, T>| !state.is_finished;
            let finished = &self.watched.finished;
            let waited = finished.wait_timeout_while(self.watched.state(), patience, waits);
            waited.unwrap_or_else(PoisonError::into_inner).0.is_finished
        })
    }

    /// Asks the work to end.
    pub fn cancel(&self) {
        // An earlier request does not matter.
        let _ = self.watched.stop.raise();
    }

    /// The latest progress.
    pub fn progress(&self) -> Option<P> {
        self.watched.state().progress
    }

    /// Takes the result of finished work.
    pub fn result(&self) -> PyResult<T> {
        let outcome = self.watched.state().outcome.take();
        let Some(outcome) = outcome else {
            let message = "there is no result to take";
            return Err(error::InternalError::new_err(message));
        };
        let mut threads = self.threads.lock().unwrap_or_else(PoisonError::into_inner);
        threads.take().into_iter().for_each(Threads::release);
        match outcome {
            Err(panic) => Err(error::of_panic(panic)),
            Ok(found) => Ok(found.map_err(Refusal::from)?),
        }
    }
}

impl<P, T> Drop for Work<P, T> {
    fn drop(&mut self) {
        let threads = self.threads.get_mut();
        let Some(threads) = threads.unwrap_or_else(PoisonError::into_inner).take() else {
            return;
        };
        // In a forked child, the state may be locked by a thread that no longer exists.
        if threads.are_of_parent() || self.watched.state().is_finished {
            threads.release();
        } else {
            let _ = self.watched.stop.raise();
        }
    }
}
