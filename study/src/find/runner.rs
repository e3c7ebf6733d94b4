//! Solves the cases of a search, one after another, each on all threads.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

use pellicle::case::Case;
use pellicle::result::table::stress::status_word;
use pellicle::run::{self, Resources};
use pellicle::{Completeness, Monitor};
use pellicle_contact::{ContactError, CriticalStatus};

use super::answer::{Answer, Verdict};
use super::crossing::Bracket;
use super::interval::{Bracketed, Towards};
use super::scale::Scales;
use super::tried::Tried;
use super::{Search, SearchMonitor};
use crate::StudyError;
use crate::case_status::CaseStatus;
use crate::table_columns::status;

/// The most cases of a search. A bracket of two decades takes 13 halvings to 10⁻³, and Chandrupatla's method at most
/// some three times as many values as bisection; a search that needs more does not close its bracket at all.
pub const MAX_CASES: usize = 48;

/// Halvings of the distance to the other end, tried in place of an end that is not certified.
const END_HALVINGS: usize = 4;

/// Why a search ends without an answer.
pub(super) enum Ended {
    /// The monitor stopped it.
    Stopped,
    /// A case does not count, for this reason.
    Blocked(String),
    /// A file cannot be written.
    Failed(StudyError),
}

impl From<StudyError> for Ended {
    fn from(error: StudyError) -> Self {
        Self::Failed(error)
    }
}

/// Receives the cases tried so far.
pub type Keep<'a> = &'a dyn Fn(&[Tried]) -> Result<(), StudyError>;

/// What the cases of a search need.
#[derive(Clone, Copy)]
pub struct Means<'a> {
    /// Cache and memory.
    pub resources: Resources<'a>,
    /// Told of every case.
    pub monitor: &'a dyn SearchMonitor,
    /// Told the cases tried so far after each of them.
    pub keep: Keep<'a>,
}

impl Search {
    /// Solves cases until the question is answered. `before` are cases of the same search that were tried earlier; they
    /// are not solved again. Returns the answer, none if the monitor stops the search, and the cases tried.
    ///
    /// # Errors
    ///
    /// [`StudyError`] if `keep` fails; a case that cannot be solved is no error.
    pub fn run(
        &self,
        before: Vec<Tried>,
        means: Means<'_>,
    ) -> Result<(Option<Answer>, Vec<Tried>), StudyError> {
        let mut tries = Tries {
            search: self,
            means,
            before,
            tried: Vec::new(),
            notes: Vec::new(),
        };
        let answer = match tries.answer() {
            Ok(answer) => Some(answer),
            Err(Ended::Blocked(reason)) => Some(Answer::without(Verdict::Blocked, reason)),
            Err(Ended::Stopped) => None,
            Err(Ended::Failed(error)) => return Err(error),
        };
        let Tries { tried, notes, .. } = tries;
        Ok((answer.map(|answer| answer.after(notes)), tried))
    }

    /// Solves the case with a value of the key; none if the monitor stops it.
    fn solve(
        &self,
        key: f64,
        resources: Resources<'_>,
        monitor: &mut dyn Monitor,
    ) -> Option<Tried> {
        let failed = |message: String| Some(Tried::failed(key, message));
        let case = match self.key.case(&self.base, key) {
            Ok(case) => case,
            Err(diagnosis) => return failed(diagnosis.to_string()),
        };
        let solve = || run::solve(&case, resources, Instant::now(), monitor);
        match catch_unwind(AssertUnwindSafe(solve)) {
            Err(_) => failed("an internal error of the program".into()),
            Ok(Ok(Some(run))) if run.completeness == Completeness::Whole => {
                Some(self.tried(key, &case, &run.summary))
            }
            Ok(Ok(_) | Err(pellicle::Error::Contact(ContactError::Cancelled { .. }))) => None,
            Ok(Err(error)) => failed(error.to_string()),
        }
    }

    /// A critical force that no load of the case reaches, and a sentence on it: larger than each load, so infinite if
    /// one of them is beyond the limit.
    fn above_all_loads(&self, summary: &pellicle::summary::RunSummary) -> (Option<f64>, String) {
        let loads = summary.steps.iter().map(|step| step.force);
        let largest = loads.fold(0.0, f64::max);
        let (name, words) = (
            &self.condition.result.name,
            self.condition.value_words(largest),
        );
        if largest < self.condition.limit {
            let message =
                format!("has no {name} up to its load, {words}, which is below the limit");
            return (None, message);
        }
        (Some(f64::INFINITY), format!("{name} is above {words}"))
    }

    fn tried(&self, key: f64, case: &Case, summary: &pellicle::summary::RunSummary) -> Tried {
        let result = &self.condition.result;
        let critical = summary.critical.as_deref().unwrap_or_default();
        let last = summary.steps.len().saturating_sub(1);
        let step = summary.steps.last();
        let cells = step.map_or_else(Vec::new, |step| self.columns.row(last, step, critical));
        let cell = |place: usize| cells.get(place).map_or("", String::as_str);
        let number: Option<f64> = cell(result.value).parse().ok();
        let mut codes: Vec<_> = summary.warnings.iter().map(|of| of.code.as_str()).collect();
        codes.sort_unstable();
        codes.dedup();
        let (number, message) = match (number, result.status.map(cell)) {
            (Some(number), _) => (Some(number), String::new()),
            (None, Some(status)) if status == status_word(CriticalStatus::NotReached) => {
                self.above_all_loads(summary)
            }
            (None, Some(status)) if !status.is_empty() => {
                (None, format!("has no {} ({status})", result.name))
            }
            (None, _) => (None, format!("has no {}", result.name)),
        };
        debug_assert_eq!(case.units, self.condition.units);
        Tried {
            key,
            status: status(summary),
            number,
            error: result.error.and_then(|place| cell(place).parse().ok()),
            resolved: result.resolved.map(|place| cell(place) == "true"),
            warnings: codes.join(" "),
            message,
        }
    }
}

/// The cases tried, and what is to be told about them.
struct Tries<'a> {
    search: &'a Search,
    means: Means<'a>,
    before: Vec<Tried>,
    tried: Vec<Tried>,
    notes: Vec<String>,
}

impl Tries<'_> {
    /// Tries a value of the key.
    fn at(&mut self, key: f64) -> Result<Tried, Ended> {
        let number = self.tried.len();
        if number >= MAX_CASES {
            let reason = format!("the limit is not bracketed after {MAX_CASES} cases");
            return Err(Ended::Blocked(reason));
        }
        let is_it = |tried: &&Tried| {
            tried.key.to_bits() == key.to_bits() && tried.status == CaseStatus::Certified
        };
        let words = self.search.key.words(key);
        let tried = if let Some(known) = self.before.iter().find(is_it) {
            known.clone()
        } else {
            let mut monitor = self.means.monitor.case(number, &words);
            let solved = self.search.solve(key, self.means.resources, &mut *monitor);
            solved.ok_or(Ended::Stopped)?
        };
        self.tried.push(tried.clone());
        (self.means.keep)(&self.tried)?;
        let outcome = self.search.outcome_words(&tried);
        self.means.monitor.ended(number, &words, &outcome);
        Ok(tried)
    }

    /// Tries an end of the range, or nearer to the other end if that case does not count.
    fn end(&mut self, end: f64, other: f64, scales: &Scales) -> Result<Tried, Ended> {
        let (mut place, other) = (scales.key(end), scales.key(other));
        let mut key = end;
        for _ in 0..=END_HALVINGS {
            let tried = self.at(key)?;
            if tried.certified().is_some() {
                return Ok(tried);
            }
            let case = self.search.case_words(key);
            self.notes.push(format!(
                "{case} {}: the search leaves it out",
                tried.reason()
            ));
            place = place.midpoint(other);
            key = scales.key_at(place);
        }
        let (case, count) = (self.search.case_words(end), END_HALVINGS + 1);
        let reason =
            format!("no certified case at {count} values from {case} towards the other end");
        Err(Ended::Blocked(reason))
    }

    /// Tries a value between two others, at one of which the condition holds.
    fn inside(&mut self, key: f64, [one, other]: [f64; 2]) -> Result<Tried, Ended> {
        let tried = self.at(key)?;
        if tried.certified().is_some() {
            return Ok(tried);
        }
        let case = self.search.case_words(key);
        let ends = [one.min(other), one.max(other)].map(|end| self.search.key.words(end));
        Err(Ended::Blocked(format!(
            "{case} {}: the condition changes between {} and {}",
            tried.reason(),
            ends[0],
            ends[1]
        )))
    }

    fn answer(&mut self) -> Result<Answer, Ended> {
        let (search, [low, high]) = (self.search, self.search.range);
        let on_key = Scales::new(search.range, [1.0; 2], &search.condition);
        let ends = [self.end(low, high, &on_key)?, self.end(high, low, &on_key)?];
        let numbers = ends.each_ref().map(|end| end.number.unwrap_or(f64::NAN));
        let scales = Scales::new(search.range, numbers, &search.condition);
        let point = |tried: &Tried| {
            let case = scales.certified(tried);
            case.map_or((f64::NAN, f64::NAN), |case| (case.key, case.number))
        };
        let Some(mut bracket) = Bracket::new(point(&ends[0]), point(&ends[1])) else {
            return Ok(search.no_crossing(&ends));
        };
        let width = if scales.is_key_logarithmic() {
            search.within
        } else {
            search.within * (high - low)
        };
        while let Some(next) = bracket.next(width) {
            let known = bracket.sides().map(|(key, _)| scales.key_at(key));
            let tried = self.inside(scales.key_at(next), known)?;
            bracket.add(point(&tried));
        }
        let keys = bracket.sides().map(|(key, _)| key);
        let bracketed = |tried: &[Tried]| {
            let cases = tried.iter().filter_map(|tried| scales.certified(tried));
            Bracketed::new(cases.collect(), keys, bracket.crossing(), width)
        };
        for towards in [Towards::Smaller, Towards::Larger] {
            if let Some(next) = bracketed(&self.tried).proposed(towards) {
                // A case beside the answer that is not certified leaves the interval wider, not wrong.
                self.at(scales.key_at(next))?;
            }
        }
        Ok(search.crossing(&bracketed(&self.tried), &bracket, &scales))
    }
}
