//! The smallest or largest value of one key for which a condition on a result holds, with the interval that ± leaves.
//!
//! [`Search`] is what was asked, checked before anything is solved. It solves the case at both ends of a range of the
//! key, then at values between them until the crossing of the limit is bracketed (`crossing`), and beside it until
//! the ± of the number no longer reaches the limit ([`interval`](mod@interval)). Only certified cases count.
//! [`Answer`](answer::Answer) is what was found, [`Tried`](tried::Tried) a case on the way.

pub mod answer;
pub mod condition;
mod crossing;
pub mod folder;
pub mod interval;
mod number;
mod runner;
mod scale;
pub mod searched_key;
pub mod tried;

use std::sync::Arc;

use pellicle::Monitor;
use pellicle::case::{BaseCase, Case};
use pellicle::input::diagnosis::{Diagnosis, Fault};
use pellicle::input::span::{Source, Span};
use pellicle::input::toml_tree::TomlValue;

use self::condition::Condition;
use self::searched_key::SearchedKey;
use crate::fingerprint;
use crate::table_columns::ResultColumns;

pub use runner::{Keep, MAX_CASES, Means};

/// Width of the final bracket, relative to the answer.
pub const WITHIN: f64 = 1e-3;

/// What is asked, each text under the name by which a message calls it, such as `--find`.
#[derive(Debug, Clone)]
pub struct Question {
    /// The condition, `max_pressure < 2 GPa`.
    pub condition: Arc<Source>,
    /// The key, `surface.period`.
    pub key: Arc<Source>,
    /// The ends of the range of its values; by default a decade down and up from the value of the case.
    pub between: Option<[Arc<Source>; 2]>,
    /// Width of the final bracket, relative to the answer.
    pub within: f64,
}

/// A search, read and checked.
#[derive(Debug, Clone)]
pub struct Search {
    base: BaseCase,
    /// Title of the case.
    pub title: String,
    /// The key.
    pub key: SearchedKey,
    /// The condition.
    pub condition: Condition,
    /// The range of the key, the smaller value first.
    pub range: [f64; 2],
    /// Width of the final bracket, relative to the answer.
    pub within: f64,
    columns: ResultColumns,
    /// The hash of everything on which its cases depend.
    pub identity: String,
}

/// Told which cases a search solves.
pub trait SearchMonitor: Sync {
    /// Returns the monitor of a case, counted from 0, with this value of the key in words.
    fn case<'a>(&'a self, number: usize, value: &str) -> Box<dyn Monitor + 'a>;

    /// Takes note of the outcome of a case, in words.
    fn ended(&self, number: usize, value: &str, outcome: &str);
}

/// Tells nobody, and never stops.
impl SearchMonitor for () {
    fn case<'a>(&'a self, _: usize, _: &str) -> Box<dyn Monitor + 'a> {
        Box::new(())
    }

    fn ended(&self, _: usize, _: &str, _: &str) {}
}

impl Search {
    /// Reads a question about a case.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the case has no such key or number, a value has another unit, or the case is invalid at an
    /// end of the range.
    pub fn new(base: BaseCase, question: &Question) -> Result<Self, Diagnosis> {
        refuse_study(&base)?;
        let key = SearchedKey::read(&question.key, &base)?;
        let range = match &question.between {
            Some(ends) => given_range(&key, ends)?,
            None => key.default_range(&base)?,
        };
        let [case, other] = [key.case(&base, range[0])?, key.case(&base, range[1])?];
        let mut columns = ResultColumns::default();
        columns.add(&case);
        columns.add(&other);
        let condition =
            Condition::read(&question.condition, &columns.header(case.units), case.units)?;
        let number = condition.result.heading();
        let own = own_case(&base);
        let own = own.as_ref().unwrap_or(&case);
        let identity = fingerprint::of_search(&base, own, &key.path, &number);
        Ok(Self {
            title: case.title,
            base,
            key,
            condition,
            range,
            within: question.within,
            columns,
            identity,
        })
    }
}

/// The case with its own value of the key, so that searches of other ranges are the same; none if it has no value.
fn own_case(base: &BaseCase) -> Option<Case> {
    base.resolve(&base.root).ok()
}

/// A study has more than one case.
fn refuse_study(base: &BaseCase) -> Result<(), Diagnosis> {
    let TomlValue::Table(root) = &base.root.value else {
        return Ok(());
    };
    root.entry("study").map_or(Ok(()), |study| {
        let fault = Fault::Wrong {
            found: "a table [study]".into(),
            wanted: "a single case, of which the search varies one key".into(),
        };
        Err(Diagnosis::of_key("study", study.key_span.clone(), fault))
    })
}

/// The range of two ends, in order.
fn given_range(key: &SearchedKey, ends: &[Arc<Source>; 2]) -> Result<[f64; 2], Diagnosis> {
    let [one, other] = [key.value(&ends[0])?, key.value(&ends[1])?];
    if one < other || other < one {
        return Ok([one.min(other), one.max(other)]);
    }
    let fault = Fault::Wrong {
        found: "the same value twice".into(),
        wanted: format!("two different values of {}", key.path),
    };
    let span = Span::new(&ends[1], 0..ends[1].inner().len());
    Err(Diagnosis::of_text(span, fault))
}
