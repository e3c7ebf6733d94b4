//! `pellicle run`: solves a case, certifies the solution and writes the results.

use std::panic::resume_unwind;
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use pellicle::Completeness;
use pellicle::case::Case;
use pellicle::forecast::need::Need;
use pellicle::input::source_file;
use pellicle::memory::MemoryBudget;
use pellicle::run::{self, Stresses, stress_search};
use pellicle::summary::{Clock, RunSummary};
use pellicle_contact::{ContactError, Domain, LoadingPath, Model};
use pellicle_files::json;
use pellicle_files::whole::Existing;
use rayon::ThreadPool;

use crate::arguments::RunArguments;
use crate::command::{Outcome, complaint};
use crate::failure::Failure;
use crate::output::{report, results, summary_text};
use crate::progress::{ProgressLine, SearchLine};
use crate::results_folder::{self, ResultsFolder};
use crate::{cache, interrupt, terminal, threads};

/// Interval at which a request to stop is checked during the search for stresses.
const LOOK: Duration = Duration::from_millis(20);

/// Solves the case, writes its results folder and reports the result.
///
/// # Errors
///
/// [`Failure`] if the case is wrong, the results cannot be written, or the contact cannot be computed.
pub fn run(arguments: &RunArguments) -> Result<Outcome, Failure> {
    threads::set(arguments.threads)?;
    let start = Instant::now();
    let mut case = Case::read(&arguments.case.path, &arguments.case.sets)?;
    arguments.output.replace(&mut case.output);
    let folder = claim(arguments)?;
    let mut line = progress_line(arguments, case.solver.tolerance);
    let tables = Instant::now();
    let cache = cache::open();
    let model = case.model(&cache)?;
    let tables_seconds = tables.elapsed().as_secs_f64();
    threads::begin();
    let memory = MemoryBudget::default();
    let writers = folder.as_ref().map_or(0, |_| rayon::current_num_threads());
    let domain = case.domain(&model.value)?;
    let _share = memory.take(Need::new(&case, &model.value, domain, writers), &mut line)?;
    let path = Arc::new(run::path(&case, &model.value, domain, &mut line)?);
    if path.interrupted && path.steps.is_empty() {
        drop(line);
        return Ok(stopped_at_once());
    }
    interrupt::hold();
    let stresses = find_stresses(&case, &model.value, domain, &path, &line)?;
    let clock = Clock {
        start,
        tables_seconds,
        tables_origin: model.origin,
    };
    let mut summary = RunSummary::new(&case, &path, clock, &cache.take_warnings())?;
    run::complete(&case, &model.value, &path, stresses, &mut summary)?;
    let write = |folder: ResultsFolder| {
        let on_progress = line.writing();
        folder.write(|folder| {
            let written = results::write(folder, &path, &mut summary, &case, start, &on_progress)?;
            Ok(if path.interrupted {
                Completeness::Part
            } else {
                written
            })
        })
    };
    let written = folder.map(write).transpose()?;
    drop(line);
    print_result(arguments, &summary, written.as_deref());
    if arguments.json {
        terminal::print(&json(&summary)?)?;
    }
    Ok(outcome(&summary))
}

/// Finds the stresses of a path; none if the case requests none or the user stops.
fn find_stresses(
    case: &Case,
    model: &Model,
    domain: Domain,
    path: &Arc<LoadingPath>,
    line: &ProgressLine,
) -> Result<Option<Stresses>, Failure> {
    if case.stress.is_none() || interrupt::is_requested() {
        return Ok(None);
    }
    let threads = rayon::current_num_threads();
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()?;
    let found = find_beside(pool, case, model, domain, path, line.searching());
    Ok(run::unless_stopped(found)?)
}

/// Finds the stresses on separate threads, which are abandoned when the user asks to stop: the extremes of one step may
/// take too long to wait for, and the finished results are still to be written.
fn find_beside(
    pool: ThreadPool,
    case: &Case,
    model: &Model,
    domain: Domain,
    path: &Arc<LoadingPath>,
    mut line: SearchLine,
) -> Result<Option<Stresses>, pellicle::Error> {
    let (case, model, path) = (case.clone(), model.clone(), Arc::clone(path));
    let (alive, ended) = mpsc::channel::<()>();
    let search = thread::spawn(move || {
        // Dropped when the search ends, in whatever way.
        let _alive = alive;
        pool.install(|| stress_search::find(&case, &model, domain, &path, &mut line))
    });
    while ended.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
        if interrupt::is_requested() {
            return Err(ContactError::Cancelled { step: 0 }.into());
        }
    }
    search.join().unwrap_or_else(|panic| resume_unwind(panic))
}

/// Claims the results folder; none with `--json` alone.
fn claim(arguments: &RunArguments) -> Result<Option<ResultsFolder>, Failure> {
    let existing = if arguments.force {
        Existing::Replace
    } else {
        Existing::Keep
    };
    let name = source_file::stem(&arguments.case.path);
    let folder = match &arguments.out {
        Some(path) => ResultsFolder::claim(path, existing)?,
        None if arguments.json => return Ok(None),
        None => ResultsFolder::claim_default(&name, existing)?,
    };
    results_folder::sweep_beside(folder.path());
    Ok(Some(folder))
}

fn progress_line(arguments: &RunArguments, tolerance: f64) -> ProgressLine {
    let line = if prints_text(arguments) {
        ProgressLine::new(tolerance)
    } else {
        ProgressLine::hidden()
    };
    line.keeping_steps()
}

fn stopped_at_once() -> Outcome {
    terminal::report("stopped before the first loading step was solved; nothing is written");
    Outcome::Stopped
}

fn prints_text(arguments: &RunArguments) -> bool {
    !arguments.quiet && !arguments.json
}

/// Prints the summary in words, the warnings, and the path of the results.
fn print_result(arguments: &RunArguments, summary: &RunSummary, folder: Option<&Path>) {
    if prints_text(arguments) {
        terminal::report(summary_text::text(summary).trim_end());
    }
    if !arguments.quiet && !summary.warnings.is_empty() {
        terminal::report(&summary_text::warning_lines(&summary.warnings));
    }
    if let Some(complaint) = complaint(summary.status) {
        terminal::report(&complaint);
    }
    if let (true, Some(folder)) = (prints_text(arguments), folder) {
        terminal::report(&format!("written to {}", folder.display()));
        let report = folder.join(report::FILE);
        terminal::report(&format!("report: {}", report.display()));
    }
}

/// The outcome; also `Stopped` if the user asked to stop when only the writing was left.
fn outcome(summary: &RunSummary) -> Outcome {
    if interrupt::is_requested() {
        Outcome::Stopped
    } else if summary.is_certified() {
        Outcome::Done
    } else {
        Outcome::NotConverged
    }
}
