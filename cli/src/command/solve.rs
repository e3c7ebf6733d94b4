//! `pellicle solve --stream`: solves a case repeatedly with values that another program sends through a pipe.

use std::io::{self, BufRead};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::time::Instant;

use pellicle_contact::Status;
use pellicle_influence::Cache;
use serde::Serialize;
use serde_json::Value;

use crate::arguments::SolveArguments;
use crate::case::BaseCase;
use crate::case_solution::{self, Resources, SolvedCase};
use crate::command::Outcome;
use crate::failure::Failure;
use crate::input::overrides;
use crate::input::span::{STREAM, Source, Span};
use crate::input::toml_tree::{TomlEntry, TomlNode, TomlTable, TomlValue};
use crate::memory::MemoryBudget;
use crate::output::folder::Completeness;
use crate::output::summary::RunSummary;
use crate::progress::ProgressLine;
use crate::{cache, interrupt, terminal, threads};

/// Reads objects of keys and values from standard input, one per line. For each it prints the summary of the case, or
/// the error, as one line before reading the next. Ends with its input.
///
/// # Errors
///
/// [`Failure`] if the case file cannot be read as TOML, or standard input or output fails.
pub fn solve(arguments: &SolveArguments) -> Result<Outcome, Failure> {
    let base = BaseCase::read(&arguments.case.path, &arguments.case.sets)?;
    threads::set(arguments.threads)?;
    let stream = Stream {
        base,
        cache: cache::open_for_many(),
        memory: MemoryBudget::default(),
    };
    let mut outcome = Outcome::Done;
    for (i, text) in io::stdin().lock().lines().enumerate() {
        let text = text.map_err(|cause| Failure::Input { cause })?;
        if text.trim().is_empty() {
            continue;
        }
        let line = i + 1;
        let Some(answer) = stream.answer(line, &text) else {
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
    fn answer(&self, line: usize, text: &str) -> Option<Answer> {
        let solved = catch_unwind(AssertUnwindSafe(|| self.summary(line, text)));
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

    fn summary(&self, line: usize, text: &str) -> Result<Option<RunSummary>, Failure> {
        let start = Instant::now();
        let mut root = self.base.root.clone();
        for (key, value, span) in values(line, text)? {
            overrides::replace(&mut root, &key, &span, value)?;
        }
        let case = self.base.resolve(&root)?;
        let resources = Resources {
            cache: &self.cache,
            memory: &self.memory,
            writers: 0,
        };
        let search = |_| interrupt::signal();
        let mut line = ProgressLine::hidden();
        let solved = case_solution::solve(&case, resources, start, &mut line, &search)?;
        let whole = solved.filter(|solved| solved.completeness == Completeness::Whole);
        let Some(SolvedCase { mut summary, .. }) = whole else {
            return Ok(None);
        };
        summary.add_case(&case)?;
        Ok(Some(summary))
    }
}

/// Reads the keys of a line, each with its value and its position: `{"load.force": "3 mN", "grid.elements": 64}`.
fn values(line: usize, text: &str) -> Result<Vec<(String, TomlNode, Span)>, Failure> {
    let name = format!("{STREAM}, line {line}");
    let read = serde_json::from_str::<Value>(text);
    let span = span(&name, text.to_owned());
    let wrong = |found| Failure::Line {
        line,
        found,
        wanted: "an object of keys and values, such as {\"load.force\": \"3 mN\"}",
    };
    match read {
        Ok(Value::Object(entries)) => {
            let entries = entries.into_iter();
            let node = |(key, value)| (key, node(value, &name), span.clone());
            Ok(entries.map(node).collect())
        }
        Ok(_) => Err(wrong("other JSON".into())),
        Err(cause) => Err(wrong(cause.to_string())),
    }
}

/// Converts a JSON value to TOML. TOML has no null: it becomes a date, which no key accepts.
fn node(value: Value, name: &str) -> TomlNode {
    let span = span(name, value.to_string());
    let value = match value {
        Value::Null => TomlValue::Datetime,
        Value::Bool(value) => TomlValue::Boolean(value),
        Value::Number(number) => match number.as_i64() {
            Some(number) => TomlValue::Integer(number),
            None => TomlValue::Float(number.as_f64().unwrap_or(f64::NAN)),
        },
        Value::String(text) => TomlValue::Text(text),
        Value::Array(items) => {
            let items = items.into_iter();
            TomlValue::List(items.map(|item| node(item, name)).collect())
        }
        Value::Object(entries) => {
            let entry = |(key, value)| TomlEntry {
                key,
                key_span: span.clone(),
                node: node(value, name),
            };
            let entries = entries.into_iter().map(entry).collect();
            TomlValue::Table(TomlTable { entries })
        }
    };
    TomlNode { value, span }
}

/// The position of a value, which messages quote, in a text of its own.
fn span(name: &str, text: String) -> Span {
    let source = Arc::new(Source::new(name, text));
    Span::new(&source, 0..source.inner().len())
}
