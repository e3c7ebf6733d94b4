//! The reasons for which cases failed, those that differ in numbers alone together.

use std::collections::BTreeMap;

/// The most reasons that are counted apart.
const MOST_REASONS: usize = 200;

/// The most that are listed.
const MOST_LISTED: usize = 50;

/// A reason, as its first case has it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reason {
    /// Number of cases that failed for it.
    pub cases: usize,
    /// The first of them in the table.
    pub first: usize,
    /// The message of that one.
    pub message: String,
}

/// The reasons by their words without the numbers.
#[derive(Debug, Default)]
pub struct Reasons(BTreeMap<String, Reason>);

impl Reasons {
    /// Adds the reason of a case; forgotten if there are too many different ones already.
    pub fn add(&mut self, case: usize, message: &str) {
        let words = without_numbers(message);
        if let Some(known) = self.0.get_mut(&words) {
            known.cases += 1;
        } else if self.0.len() < MOST_REASONS {
            let reason = Reason {
                cases: 1,
                first: case,
                message: message.to_owned(),
            };
            self.0.insert(words, reason);
        }
    }

    /// The most frequent first.
    #[must_use]
    pub fn sorted(&self) -> Vec<&Reason> {
        let mut reasons: Vec<_> = self.0.values().collect();
        reasons.sort_by_key(|reason| (std::cmp::Reverse(reason.cases), reason.first));
        reasons.truncate(MOST_LISTED);
        reasons
    }
}

/// The words of a message, a mark in place of each that begins like a number.
fn without_numbers(message: &str) -> String {
    let is_number = |word: &&str| {
        let word = word.trim_start_matches(['-', '+', '.', '[', '(', '"', '`']);
        word.starts_with(|first: char| first.is_ascii_digit())
    };
    let words = message.split_whitespace();
    let words: Vec<_> = words
        .map(|word| if is_number(&word) { "#" } else { word })
        .collect();
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reasons_that_differ_in_numbers_are_one_and_the_most_frequent_comes_first() {
        let mut reasons = Reasons::default();
        reasons.add(7, "no room");
        for case in 8..11 {
            reasons.add(
                case,
                &format!("found -{case}.5 nm, wanted 0 to \"{case} nm\""),
            );
        }
        let found = reasons.sorted();
        assert_eq!((found.len(), found[0].cases, found[0].first), (2, 3, 8));
        assert_eq!(found[0].message, "found -8.5 nm, wanted 0 to \"8 nm\"");
        for case in 0..1000 {
            reasons.add(case, &"x".repeat(case + 1));
        }
        assert_eq!(reasons.sorted().len(), MOST_LISTED);
    }
}
