//! Resources shared by all solutions of this process: the cache, the memory, and threads that wait for work.
//!
//! Every solution has threads to itself while it runs. Threads shared by several solutions could take up one while they
//! wait for a part of another, which would then wait for the first.
//!
//! A child that is forked from a process has its memory but none of its threads, so it begins anew. The lock is taken
//! and released while attached to the interpreter, and whoever forks is attached alone: by its lock, or because a
//! free-threaded one lets all others stop or detach first. No child finds it taken.

use std::mem;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use pellicle_cli::Failure;
use pellicle_cli::solved::{MemoryBudget, open_cache};
use pellicle_cli::studied;
use pellicle_influence::Cache;
use pyo3::{PyResult, Python};
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::error::{self, Refusal};

/// The most pools of threads that wait; more are ended.
const MOST_IDLE: usize = 8;

/// The cache and the memory.
#[derive(Debug)]
pub struct Shared {
    /// Radial tables and coefficients found so far.
    pub cache: Cache,
    /// The same for the cases of studies, which leave fewer tables on disk.
    pub study_cache: Cache,
    /// The memory of all cases.
    pub memory: MemoryBudget,
}

/// The shared things of one process, and its threads without work.
struct Process {
    id: u32,
    shared: Arc<Shared>,
    idle: Vec<(Option<u16>, ThreadPool)>,
}

static PROCESS: Mutex<Option<Process>> = Mutex::new(None);

impl Process {
    fn new(id: u32) -> Self {
        Self {
            id,
            shared: Arc::new(Shared {
                cache: open_cache(),
                study_cache: studied::open_cache(),
                memory: MemoryBudget::default(),
            }),
            idle: Vec::new(),
        }
    }
}

/// Does something with what is of this very process, and not of the one that it was forked from.
fn with_process<T>(action: impl FnOnce(&mut Process) -> T) -> T {
    let mut guard: MutexGuard<'_, Option<Process>> =
        PROCESS.lock().unwrap_or_else(PoisonError::into_inner);
    let id = process::id();
    if guard.as_ref().is_some_and(|process| process.id != id) {
        // Its threads are the parent's, and cannot be ended here.
        mem::forget(guard.take());
    }
    action(guard.get_or_insert_with(|| Process::new(id)))
}

/// The cache and the memory of this process.
pub fn shared() -> Arc<Shared> {
    with_process(|process| Arc::clone(&process.shared))
}

/// Threads for one piece of work after the other. They wait for the next owner when they are released, and end when
/// they are dropped.
#[derive(Debug)]
pub struct Threads {
    pool: ThreadPool,
    wanted: Option<u16>,
    process: u32,
}

impl Threads {
    /// So many threads; without a number as many as `RAYON_NUM_THREADS` says, or as there are cores.
    ///
    /// # Errors
    ///
    /// [`Failure::Threads`] if they cannot be started.
    pub fn take(wanted: Option<u16>) -> Result<Self, Failure> {
        let idle = with_process(|process| {
            let place = process.idle.iter().position(|(of, _)| *of == wanted)?;
            Some(process.idle.swap_remove(place).1)
        });
        let start = || ThreadPoolBuilder::new().num_threads(wanted.map_or(0, usize::from));
        Ok(Self {
            pool: idle.map_or_else(|| start().build(), Ok)?,
            wanted,
            process: process::id(),
        })
    }

    /// Does some work on threads of this process while Python's other threads go on. All work belongs on such threads:
    /// rayon's global ones are gone after a fork.
    ///
    /// # Errors
    ///
    /// An exception if they cannot be started, or the work panics.
    pub fn work<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
        let threads = Self::take(None).map_err(Refusal::from)?;
        let work = || catch_unwind(AssertUnwindSafe(work));
        let done = py.detach(|| threads.pool.install(work));
        threads.release();
        done.map_err(error::of_panic)
    }

    /// The threads themselves.
    pub fn pool(&self) -> &ThreadPool {
        &self.pool
    }

    /// Whether they are those of the process that this one was forked from.
    pub fn are_of_parent(&self) -> bool {
        self.process != process::id()
    }

    /// Lets the threads wait for other work; they must have none.
    pub fn release(self) {
        if self.are_of_parent() {
            // They cannot be ended here.
            mem::forget(self.pool);
            return;
        }
        let Self { pool, wanted, .. } = self;
        with_process(|process| {
            if process.idle.len() < MOST_IDLE {
                process.idle.push((wanted, pool));
            }
        });
    }
}
