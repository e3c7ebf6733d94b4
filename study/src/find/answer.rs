//! What a search has found, in words and as JSON.

use pellicle::display::{DisplayUnit, significant};
use serde::Serialize;

use super::Search;
use super::crossing::Bracket;
use super::interval::{Bracketed, End, Towards};
use super::scale::Scales;
use super::tried::Tried;
use crate::case_status::CaseStatus;

/// How a search has ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The condition holds up to a value, or from one.
    Found,
    /// The condition holds at both ends of the range.
    HoldsAtBothEnds,
    /// The condition holds at neither end of the range.
    HoldsAtNeitherEnd,
    /// A case on the way is not certified, or the range has no certified cases.
    Blocked,
}

/// The end of the values for which the condition holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Extreme {
    /// It holds up to the answer.
    Largest,
    /// It holds from the answer.
    Smallest,
}

/// What a search has found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Answer {
    /// How it has ended.
    pub verdict: Verdict,
    /// Whether the answer is the largest or the smallest value for which the condition holds.
    pub extreme: Option<Extreme>,
    /// The value of the key at which the number meets its limit, in SI units or the case's own.
    pub value: Option<f64>,
    /// The interval of the key in which number ± error straddles the limit; none if the ± is not resolved.
    pub interval: Option<[f64; 2]>,
    /// What is to be known about the answer, or why there is none: a sentence each.
    pub notes: Vec<String>,
}

impl Answer {
    /// An answer that is no value.
    pub(super) fn without(verdict: Verdict, reason: String) -> Self {
        Self {
            verdict,
            extreme: None,
            value: None,
            interval: None,
            notes: vec![reason],
        }
    }

    /// The answer with these notes before its own.
    pub(super) fn after(mut self, mut notes: Vec<String>) -> Self {
        notes.append(&mut self.notes);
        self.notes = notes;
        self
    }
}

impl Search {
    /// The answer of a search whose condition holds at both ends or at neither. Where an end does not count, that says
    /// nothing of the whole range.
    pub(super) fn no_crossing(&self, ends: &[Tried; 2]) -> Answer {
        let holds = ends[0]
            .number
            .is_some_and(|number| self.condition.holds(number));
        let keys = ends.each_ref().map(|end| end.key.to_bits());
        let is_whole = keys == self.range.map(f64::to_bits);
        let (verdict, word) = match (holds, is_whole) {
            (true, true) => (Verdict::HoldsAtBothEnds, "both ends:"),
            (false, true) => (Verdict::HoldsAtNeitherEnd, "neither end:"),
            (true, false) => (Verdict::Blocked, "both of the outermost values that count:"),
            (false, false) => (
                Verdict::Blocked,
                "neither of the outermost values that count:",
            ),
        };
        let [low, high] = ends.each_ref().map(|end| {
            let number = self.outcome_words(end);
            format!("{number} at {}", self.case_words(end.key))
        });
        let condition = self.condition.words();
        let advice = if is_whole {
            "; `--between` gives another range"
        } else {
            ""
        };
        Answer::without(
            verdict,
            format!("{condition} holds at {word} {low}, and {high}{advice}"),
        )
    }

    /// The answer of a search whose limit is bracketed.
    pub(super) fn crossing(&self, cases: &Bracketed, bracket: &Bracket, scales: &Scales) -> Answer {
        let [(below, _), (above, _)] = bracket.sides();
        let holds_before = (below < above) == self.condition.comparison.is_upper_limit();
        let mut notes = Vec::new();
        let changes = cases.changes();
        if changes > 1 {
            notes.push(format!(
                "the number is not monotonic: the condition changes {changes} times among the cases tried, and the \
                 answer is one of the changes"
            ));
        }
        let interval = self.interval(cases, bracket, scales, &mut notes);
        let place = if leaves_zero(bracket, scales) {
            let [first, last] = bracket.ends();
            first.midpoint(last)
        } else {
            bracket.crossing()
        };
        Answer {
            verdict: Verdict::Found,
            extreme: Some(if holds_before {
                Extreme::Largest
            } else {
                Extreme::Smallest
            }),
            value: Some(scales.key_at(place)),
            interval,
            notes,
        }
    }

    /// The interval in which the ± of the number straddles the limit, or a note why there is none.
    fn interval(
        &self,
        cases: &Bracketed,
        bracket: &Bracket,
        scales: &Scales,
        notes: &mut Vec<String>,
    ) -> Option<[f64; 2]> {
        let name = &self.condition.result.name;
        if leaves_zero(bracket, scales) {
            let [first, last] = bracket.ends().map(|place| scales.key_at(place));
            notes.push(format!(
                "no interval: {name} leaves zero between {} and {} on this grid, and no ± tells how far off that is: \
                 ask again on a finer one",
                self.case_words(first),
                self.key.words(last)
            ));
            return None;
        }
        if self.condition.result.error.is_none() {
            notes.push(format!(
                "no interval: {name} has no ±, so the answer is that of the grid as it is"
            ));
            return None;
        }
        let ends = [Towards::Smaller, Towards::Larger].map(|towards| cases.end(towards));
        let mut end = |end: End, range: f64| match end {
            End::At(place) => Some(scales.key_at(place)),
            End::Beyond => {
                notes.push(format!(
                    "the ± of {name} reaches the limit up to the end of the range, {}",
                    self.case_words(range)
                ));
                Some(range)
            }
            End::Unresolved => None,
        };
        let [low, high] = [end(ends[0], self.range[0]), end(ends[1], self.range[1])];
        if low.is_none() || high.is_none() {
            notes.push(format!(
                "no interval, as the ± of {name} is not resolved on this grid: more elements may help"
            ));
        }
        low.zip(high).map(|(low, high)| [low, high])
    }

    /// A case in words: `load.force = 2.0000 mN`.
    #[must_use]
    pub fn case_words(&self, key: f64) -> String {
        format!("{} = {}", self.key.path, self.key.words(key))
    }

    /// The outcome of a case in words: `max pressure = 1.2000 GPa ± 0.0020 GPa`.
    #[must_use]
    pub fn outcome_words(&self, tried: &Tried) -> String {
        let result = &self.condition.result;
        let (CaseStatus::Certified, Some(number)) = (tried.status, tried.number) else {
            return tried.reason();
        };
        if number.is_infinite() {
            return tried.message.clone();
        }
        let value = self.condition.value_words(number);
        let error = match (tried.error, tried.resolved) {
            (Some(error), _) => {
                let scale = DisplayUnit::of_dimension(number, result.dimension(), self.key.units);
                let error = significant(error / scale.divisor, 2);
                format!(" ± {}", format!("{error} {}", scale.label).trim_end())
            }
            (None, Some(_)) => " (± not resolved)".into(),
            (None, None) => String::new(),
        };
        format!("{} = {value}{error}", result.name)
    }

    /// The answer in sentences, one a line.
    #[must_use]
    pub fn words(&self, answer: &Answer) -> String {
        let mut lines = Vec::new();
        if let (Some(extreme), Some(value)) = (answer.extreme, answer.value) {
            lines.push(self.answer_words(extreme, value, answer.interval));
        }
        lines.extend(answer.notes.iter().cloned());
        lines.join("\n") + "\n"
    }

    /// `largest load.force = 21.3 mN [20.9 mN, 21.8 mN] with max pressure < 2.0000 GPa`.
    fn answer_words(&self, extreme: Extreme, value: f64, interval: Option<[f64; 2]>) -> String {
        let extreme = match extreme {
            Extreme::Largest => "largest",
            Extreme::Smallest => "smallest",
        };
        let digits = interval.map_or(5, |interval| digits(value, interval));
        let values: Vec<_> = [value]
            .into_iter()
            .chain(interval.into_iter().flatten())
            .collect();
        let words = self.key.words_of(&values, digits);
        let interval = match &words[1..] {
            [low, high] => format!(" [{low}, {high}]"),
            _ => String::new(),
        };
        let condition = self.condition.words();
        format!(
            "{extreme} {} = {}{interval} with {condition}",
            self.key.path, words[0]
        )
    }
}

/// Whether the number is zero on one side of the crossing, as an area before any contact.
fn leaves_zero(bracket: &Bracket, scales: &Scales) -> bool {
    let sides = bracket.sides();
    sides.iter().any(|(_, number)| scales.is_zero(*number))
}

/// Fewest and most digits of an answer.
const DIGITS: [usize; 2] = [3, 8];

/// The digits of a value that show the width of its interval with two.
fn digits(value: f64, [low, high]: [f64; 2]) -> usize {
    let wanted = (value.abs() / (high - low)).log10().floor() + 2.0;
    let [fewest, most] = DIGITS;
    (fewest..most)
        .find(|digits| *digits as f64 >= wanted)
        .unwrap_or(most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_has_the_digits_of_its_interval() {
        assert_eq!(digits(21.3, [20.9, 21.8]), 3);
        assert_eq!(digits(21.3, [21.29, 21.31]), 5);
        assert_eq!(digits(21.3, [21.3, 21.3]), 8);
    }
}
