//! The reasons for failed cases, grouped if they differ only in numbers.

use std::collections::BTreeMap;

/// Most reasons counted separately.
const MAX_REASONS: usize = 200;

/// Most reasons listed.
const MAX_LISTED: usize = 50;

/// A reason, with the message of its first case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reason {
    /// Number of cases that failed for this reason.
    pub cases: usize,
    /// The first of them in the table.
    pub first: usize,
    /// The message of the first case.
    pub message: String,
}

/// The reasons, by their text without numbers.
#[derive(Debug, Default)]
pub struct Reasons(BTreeMap<String, Reason>);

impl Reasons {
    /// Adds the reason of a case; it is dropped if there are too many different ones already.
    pub fn add(&mut self, case: usize, message: &str) {
        let words = without_numbers(message);
        if let Some(known) = self.0.get_mut(&words) {
            known.cases += 1;
        } else if self.0.len() < MAX_REASONS {
            let reason = Reason {
                cases: 1,
                first: case,
                message: message.to_owned(),
            };
            self.0.insert(words, reason);
        }
    }

    /// Returns the reasons, the most frequent first.
    #[must_use]
    pub fn sorted(&self) -> Vec<&Reason> {
        let mut reasons: Vec<_> = self.0.values().collect();
        reasons.sort_by_key(|reason| (std::cmp::Reverse(reason.cases), reason.first));
        reasons.truncate(MAX_LISTED);
        reasons
    }
}

/// The words of a message, with a mark in place of each word that begins like a number.
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
    fn reasons_differing_only_in_numbers_are_merged_and_the_most_frequent_comes_first() {
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
        assert_eq!(reasons.sorted().len(), MAX_LISTED);
    }
}
