//! A case being solved.

use std::sync::Arc;
use std::time::Instant;

use pellicle::Run as SolvedCase;
use pellicle::run::Resources;
use pellicle::run::solve;
use pellicle::{Event, Monitor};
use pellicle_cli::Failure;
use pellicle_contact::{Progress, Signal};
use pyo3::prelude::*;

use crate::process::{self, Shared};
use crate::solution::Solution;
use crate::work::{Watched, Work};

/// The state of a solution, which is `None` if it was stopped before it began.
type WatchedSolution = Watched<Progress, Option<SolvedCase>>;

/// The monitor of a solution.
struct SolutionMonitor<'a>(&'a WatchedSolution);

impl Monitor for SolutionMonitor<'_> {
    fn told(&mut self, event: Event<'_>) -> Signal {
        if let Event::Iteration(progress) = event {
            self.0.report(*progress);
        }
        if self.0.stop.is_raised() {
            Signal::Cancel
        } else {
            Signal::Continue
        }
    }
}

/// A case being solved. It is stopped when this object is dropped.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct Run {
    case: Arc<pellicle::Case>,
    has_functions: bool,
    work: Work<Progress, Option<SolvedCase>>,
}

impl Run {
    /// Starts solving a case on this many threads; `has_functions` if its shapes are Python functions.
    pub fn start(
        case: Arc<pellicle::Case>,
        has_functions: bool,
        threads: Option<u16>,
    ) -> Result<Self, Failure> {
        let (start, shared) = (Instant::now(), process::shared());
        let of_work = Arc::clone(&case);
        let work = Work::start(threads, move |watched| {
            solve_watched(&of_work, &shared, start, watched)
        })?;
        Ok(Self {
            case,
            has_functions,
            work,
        })
    }
}

fn solve_watched(
    case: &pellicle::Case,
    shared: &Shared,
    start: Instant,
    watched: &WatchedSolution,
) -> Result<Option<SolvedCase>, Failure> {
    let resources = Resources {
        cache: &shared.cache,
        memory: &shared.memory,
        writers: 0,
    };
    let solved = solve(case, resources, start, &mut SolutionMonitor(watched))?;
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
    /// Waits at most this many milliseconds; returns whether the work is finished.
    fn wait(&self, py: Python<'_>, milliseconds: u64) -> bool {
        self.work.wait(py, milliseconds)
    }

    /// Asks the work to end; the steps solved so far are kept.
    fn cancel(&self) {
        self.work.cancel();
    }

    /// Step, finished steps, steps, elements per side, iteration, residual; `None` before the first iteration.
    fn progress(&self) -> Option<(usize, usize, usize, usize, usize, f64)> {
        let progress = self.work.progress()?;
        Some((
            progress.step,
            progress.finished,
            progress.steps,
            progress.elements,
            progress.iteration,
            progress.residual,
        ))
    }

    /// Takes the solution of finished work; `None` if no step was solved.
    fn result(&self) -> PyResult<Option<Solution>> {
        let solved = self.work.result()?;
        let solved = solved.filter(|solved| !solved.path.steps.is_empty());
        let case = Arc::clone(&self.case);
        Ok(solved.map(|solved| Solution::new(case, solved, self.has_functions)))
    }
}
