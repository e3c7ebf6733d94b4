//! The cases of a study's part still to be solved.

use crate::identity::StudyIdentity;
use crate::shard::Shard;

/// The cases not yet in a table, in order; one byte each.
#[derive(Debug, Clone)]
pub struct RemainingCases {
    shard: Shard,
    /// Whether a case is done.
    done: Vec<bool>,
    next: usize,
    count: usize,
}

impl RemainingCases {
    /// Returns the cases of this part that are not done.
    #[must_use]
    pub fn new(identity: &StudyIdentity, done: Vec<bool>) -> Self {
        let count_done = done.iter().filter(|done| **done).count();
        Self {
            shard: identity.shard,
            count: identity.case_count() - count_done,
            done,
            next: 0,
        }
    }

    /// Returns the number of cases left.
    #[must_use]
    pub fn count_left(&self) -> usize {
        self.count
    }
}

impl Iterator for RemainingCases {
    type Item = usize;

    fn next(&mut self) -> Option<usize> {
        let is_left =
            |case: &usize| self.shard.holds(*case) && self.done.get(*case) == Some(&false);
        let case = (self.next..self.done.len()).find(is_left)?;
        self.next = case + 1;
        self.count -= 1;
        Some(case)
    }
}
