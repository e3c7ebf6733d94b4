//! `pellicle solve --stream`: solves a case repeatedly with values that another program sends through a pipe.

mod stream_line;

use std::io::{self, BufRead};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

use pellicle::case::{BaseCase, Case};
use pellicle::input::overrides;
use pellicle::memory::MemoryBudget;
use pellicle::run::Completeness;
use pellicle::run::{self, Resources, Run};
use pellicle::summary::RunSummary;
use pellicle_contact::Status;
use pellicle_influence::Cache;
use serde::Serialize;

use self::stream_line::Replacement;
use crate::arguments::SolveArguments;
use crate::command::Outcome;
use crate::failure::Failure;
use crate::progress::ProgressLine;
use crate::{cache, terminal, threads};

/// Reads objects of keys and values from standard input, one per line. For each it prints the summary of the case, or
/// the error, as one line before reading the next. Ends with its input.
///
/// # Errors
///
/// [`Failure`] if the case file cannot be read as TOML, or standard input or output fails.
pub fn solve(arguments: &SolveArguments) -> Result<Outcome, Failure> {
    threads::set(arguments.threads)?;
    let base = BaseCase::read(&arguments.case.path, &arguments.case.sets)?;
    let stream = Stream {
        base,
        cache: cache::open_for_many(),
        memory: MemoryBudget::default(),
    };
    let mut outcome = Outcome::Done;
    for (i, bytes) in io::stdin().lock().split(b'\n').enumerate() {
        let bytes = bytes.map_err(|cause| Failure::Input { cause })?;
        if bytes.trim_ascii().is_empty() {
            continue;
        }
        let line = i + 1;
        let Some(answer) = stream.answer(line, &bytes) else {
            return Ok(Outcome::Stopped);
        };
        if !answer.is_certified() {
            outcome = Outcome::NotConverged;
        }
        terminal::print(&format!("{}\n", serde_json::to_string(&answer)?))?;
    }
    cache::report_warnings(&stream.cache);
    Ok(outcome)
}

/// The base case with the values of a line, of this number, in place of its own.
///
/// # Errors
///
/// [`Failure`] if the line has not the form of one, or the case is not valid.
pub fn case(base: &BaseCase, line: usize, bytes: &[u8]) -> Result<Case, Failure> {
    let mut root = base.root.clone();
    for Replacement { key, value, span } in stream_line::replacements(line, bytes)? {
        overrides::replace(&mut root, &key, &span, value)?;
    }
    Ok(base.resolve(&root)?)
}

/// The data common to all lines.
struct Stream {
    base: BaseCase,
    cache: Cache,
    memory: MemoryBudget,
}

/// One line of the output.
#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Answer {
    Solved(Box<RunSummary>),
    Failed {
        /// Line of the input, from 1.
        line: usize,
        status: &'static str,
        error: String,
    },
}

impl Answer {
    fn is_certified(&self) -> bool {
        matches!(self, Self::Solved(summary) if summary.status == Status::Certified)
    }
}

impl Stream {
    /// Returns the answer to a line; none if the user stops it.
    fn answer(&self, line: usize, bytes: &[u8]) -> Option<Answer> {
        let solved = catch_unwind(AssertUnwindSafe(|| self.summary(line, bytes)));
        let failed = |error| Answer::Failed {
            line,
            status: "failed",
            error,
        };
        match solved {
            Ok(Ok(summary)) => summary.map(|summary| Answer::Solved(Box::new(summary))),
            Ok(Err(failure)) => Some(failed(failure.to_string())),
            Err(_) => Some(failed("an internal error of the program".into())),
        }
    }

    fn summary(&self, line: usize, bytes: &[u8]) -> Result<Option<RunSummary>, Failure> {
        let start = Instant::now();
        let case = case(&self.base, line, bytes)?;
        let resources = Resources {
            cache: &self.cache,
            memory: &self.memory,
            writers: 0,
        };
        let mut line = ProgressLine::hidden();
        let solved = run::solve(&case, resources, start, &mut line)?;
        let whole = solved.filter(|run| run.completeness == Completeness::Whole);
        let Some(Run { mut summary, .. }) = whole else {
            return Ok(None);
        };
        summary.add_case(&case)?;
        Ok(Some(summary))
    }
}
