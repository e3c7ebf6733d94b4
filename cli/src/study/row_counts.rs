//! The number of rows of every case: one per loading step.

use serde::{Deserialize, Serialize};

use super::Study;
use super::numbering::CaseNumbering;

/// The number of rows that a case has unless it fails. It takes no more room for a million cases than for one, unless
/// the lists of loads themselves vary.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct RowCounts {
    /// The axes on which it depends.
    axes: Vec<usize>,
    /// The counts, for every combination of values of these axes.
    counts: Vec<usize>,
}

impl RowCounts {
    /// The counts of a study.
    #[must_use]
    pub fn new(study: &Study) -> Self {
        let axes = study.axes_of(changes_the_number_of_loads);
        let cases = study.numbering().around(0, &axes);
        let mut counts: Vec<_> = cases.map(|case| study.steps(case)).collect();
        let are_equal = counts.windows(2).all(|pair| pair[0] == pair[1]);
        if are_equal {
            counts.truncate(1);
        }
        let axes = if are_equal { Vec::new() } else { axes };
        Self { axes, counts }
    }

    /// The rows of a case; none if there is no such case.
    #[must_use]
    pub fn of(&self, numbering: &CaseNumbering, case: usize) -> Option<usize> {
        if case >= numbering.len() {
            return None;
        }
        let place = numbering.place(case, &self.axes);
        self.counts.get(place).copied()
    }
}

/// Whether another value of this key may be another number of loads.
fn changes_the_number_of_loads(path: &[String]) -> bool {
    let mut path = path.iter().map(String::as_str);
    path.next() == Some("load")
        && path
            .next()
            .is_none_or(|key| matches!(key, "forces" | "penetrations"))
}
