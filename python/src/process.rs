//! Resources shared by all solutions of this process: the cache, the memory, and idle threads.
//!
//! Every solution has its own threads while it runs. Threads shared by several solutions could take up one while
//! waiting for part of another, which would then have to wait for the first.
//!
//! A forked child has the memory of its parent but none of its threads, so it starts afresh. The lock is taken and
//! released only while attached to the interpreter, and the forking thread is the only one attached: by the
//! interpreter's lock, or because a free-threaded interpreter makes all others stop or detach first. So no child finds
//! the lock taken.

use std::mem;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use pellicle::memory::MemoryBudget;
use pellicle_cli::Failure;
use pellicle_cli::solved::open_cache;
use pellicle_cli::studied;
use pellicle_influence::Cache;
use pyo3::{PyResult, Python};
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::error::{self, Refusal};

/// Maximum number of idle thread pools; further ones are ended.
const MOST_IDLE: usize = 8;

/// The caches and the memory.
#[derive(Debug)]
pub struct Shared {
    /// Radial tables and coefficients computed so far.
    pub cache: Cache,
    /// The same for cases of studies, which store fewer tables on disk.
    pub study_cache: Cache,
    /// The memory of all cases.
    pub memory: MemoryBudget,
}

/// The shared resources of one process, and its idle threads.
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

/// Runs an action on the resources of this process, not of the one that it was forked from.
fn with_process<T>(action: impl FnOnce(&mut Process) -> T) -> T {
    let mut guard: MutexGuard<'_, Option<Process>> =
        PROCESS.lock().unwrap_or_else(PoisonError::into_inner);
    let id = process::id();
    if guard.as_ref().is_some_and(|process| process.id != id) {
        // The threads belong to the parent and cannot be ended here.
        mem::forget(guard.take());
    }
    action(guard.get_or_insert_with(|| Process::new(id)))
}

/// The cache and the memory of this process.
pub fn shared() -> Arc<Shared> {
    with_process(|process| Arc::clone(&process.shared))
}

/// Threads for one piece of work after another. When released they wait for the next owner; when dropped they end.
#[derive(Debug)]
pub struct Threads {
    pool: ThreadPool,
    wanted: Option<u16>,
    process: u32,
}

impl Threads {
    /// Takes this many threads; by default as many as `RAYON_NUM_THREADS` specifies, or one per core.
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

    /// Runs work on threads of this process while Python's other threads continue. All work must run on such threads,
    /// because rayon's global ones are gone after a fork.
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

    /// The thread pool.
    pub fn pool(&self) -> &ThreadPool {
        &self.pool
    }

    /// Whether the threads belong to the process that this one was forked from.
    pub fn are_of_parent(&self) -> bool {
        self.process != process::id()
    }

    /// Returns the threads, which must be idle, for other work.
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
