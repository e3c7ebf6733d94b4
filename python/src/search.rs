//! A search for the value of a key at which a number of the result meets its limit.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use numpy::PyReadonlyArray2;
use pellicle::Monitor;
use pellicle::case::BaseCase;
use pellicle::input::span::{CALL, Source};
use pellicle::run::Resources;
use pellicle::{Event, input::diagnosis::Diagnosis};
use pellicle_cli::Failure;
use pellicle_contact::Signal;
use pellicle_files::json;
use pellicle_study::find::folder::SearchReport;
use pellicle_study::find::{Means, Question, Search, SearchMonitor, tried};
use pyo3::prelude::*;

use crate::case::map_sources;
use crate::error::Refusal;
use crate::function::Functions;
use crate::process::{self, Threads};
use crate::work::{Watched, Work};

/// Question and answer as in `find.json`, and the cases tried as in `find.csv`.
type Found = (String, String);

/// The state of a search; none if it was stopped.
type WatchedSearch = Watched<usize, Option<Found>>;

/// A search under way. It is stopped when this object is dropped.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct SearchRun(Work<usize, Option<Found>>);

/// Starts the search for a value of `key` at which `condition` begins or ceases to hold; the other arguments are those
/// of a case, the ends of the range, the width of the final bracket relative to the answer, and the number of threads.
#[pyfunction]
#[pyo3(signature = (case, condition, key, between, within, threads = None))]
pub fn find(
    py: Python<'_>,
    case: CaseText<'_>,
    condition: &str,
    key: &str,
    between: Option<[String; 2]>,
    within: f64,
    threads: Option<u16>,
) -> PyResult<SearchRun> {
    let (text, source, name, folder, arrays, functions) = case;
    let named = |name: &str, text: &str| {
        let name = format!("find {name}{CALL}");
        Arc::new(Source::new(name, text.trim().to_owned()))
    };
    let question = Question {
        condition: named("condition", condition),
        key: named("by", key),
        between: between.map(|ends| ends.map(|end| named("between", &end))),
        within,
    };
    let maps = map_sources(&folder, arrays, &functions);
    let source = Arc::new(Source::new(source, text));
    let read = || {
        let base = BaseCase::parse(&source, &name, maps)?;
        Search::new(base, &question)
    };
    let search: Result<_, Diagnosis> = Threads::work(py, read)?;
    let search = search.map_err(Refusal::from)?;
    let work = Work::start(threads, move |watched| run(&search, watched));
    Ok(SearchRun(work.map_err(Refusal::from)?))
}

/// Text, source, name, folder, arrays and functions of a case.
type CaseText<'py> = (
    String,
    String,
    String,
    PathBuf,
    BTreeMap<String, PyReadonlyArray2<'py, f64>>,
    Functions,
);

fn run(search: &Search, watched: &WatchedSearch) -> Result<Option<Found>, Failure> {
    let shared = process::shared();
    let means = Means {
        resources: Resources {
            cache: &shared.study_cache,
            memory: &shared.memory,
            writers: 0,
        },
        monitor: &Watching(watched),
        keep: &|_| Ok(()),
    };
    let (answer, tried) = search.run(Vec::new(), means)?;
    let Some(answer) = answer else {
        return Ok(None);
    };
    let report = SearchReport::new(search, tried.len(), Some(&answer));
    Ok(Some((json(&report)?, tried::table(search, &tried))))
}

/// The monitor of a search and of its cases.
struct Watching<'a>(&'a WatchedSearch);

impl SearchMonitor for Watching<'_> {
    fn case<'a>(&'a self, _: usize, _: &str) -> Box<dyn Monitor + 'a> {
        Box::new(Watching(self.0))
    }

    fn ended(&self, number: usize, _: &str, _: &str) {
        self.0.report(number + 1);
    }
}

impl Monitor for Watching<'_> {
    fn told(&mut self, _: Event<'_>) -> Signal {
        if self.0.stop.is_raised() {
            Signal::Cancel
        } else {
            Signal::Continue
        }
    }
}

#[pymethods]
impl SearchRun {
    /// Waits at most this many milliseconds; returns whether the work is finished.
    fn wait(&self, py: Python<'_>, milliseconds: u64) -> bool {
        self.0.wait(py, milliseconds)
    }

    /// Asks the work to end.
    fn cancel(&self) {
        self.0.cancel();
    }

    /// Number of cases tried; `None` before the first.
    fn progress(&self) -> Option<usize> {
        self.0.progress()
    }

    /// Takes question and answer and the cases tried of finished work; `None` if it was stopped.
    fn result(&self) -> PyResult<Option<Found>> {
        self.0.result()
    }
}
