//! Rows of a measurement that are left out, counted by reason.

use std::fmt;

/// The reason why rows of a table are not points of its curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ExclusionReason {
    /// A requested column has no valid number in the row.
    InvalidValue,
    /// The fit file leaves the row out by its number.
    Omitted,
    /// The force is far above those beside it.
    Spike,
    /// The column of segments has another value.
    OtherSegment,
    /// The rows lie before the segment.
    BeforeSegment,
    /// The rows lie after the segment.
    AfterSegment,
    /// The rows were measured after the maximum force, and the loading is used.
    AfterLargestForce,
    /// The rows were measured before the maximum force, and the unloading is used.
    BeforeLargestForce,
    /// The rows lie after the largest depth step.
    AfterDepthStep,
}

impl fmt::Display for ExclusionReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::InvalidValue => "invalid value",
            Self::Omitted => "omitted row",
            Self::Spike => "spike of the force",
            Self::OtherSegment => "other segment",
            Self::BeforeSegment => "before the segment",
            Self::AfterSegment => "after the segment",
            Self::AfterLargestForce => "after the largest force",
            Self::BeforeLargestForce => "before the largest force",
            Self::AfterDepthStep => "after the largest depth step",
        })
    }
}

/// The number of rows left out for one reason.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ExcludedRows {
    /// The reason.
    pub reason: ExclusionReason,
    /// Number of rows, at least one.
    pub count: usize,
}

/// The rows kept so far, in order, and the number of those left out.
#[derive(Debug, Clone, Default)]
pub(crate) struct KeptRows {
    /// Rows, from 0.
    pub(crate) rows: Vec<usize>,
    /// The points left out, by reason.
    pub(crate) excluded: Vec<ExcludedRows>,
}

impl KeptRows {
    /// Keeps the rows for which `keep` is true.
    pub(crate) fn retain(&mut self, reason: ExclusionReason, mut keep: impl FnMut(usize) -> bool) {
        let before = self.rows.len();
        self.rows.retain(|row| keep(*row));
        self.count(reason, before - self.rows.len());
    }

    /// Keeps the rows at these positions in the list of kept rows.
    pub(crate) fn keep_places(&mut self, from: usize, to: usize, reasons: [ExclusionReason; 2]) {
        let (from, to) = (
            from.min(self.rows.len()),
            to.min(self.rows.len()).max(from.min(self.rows.len())),
        );
        self.count(reasons[1], self.rows.len() - to);
        self.count(reasons[0], from);
        self.rows.truncate(to);
        self.rows.drain(..from);
    }

    fn count(&mut self, reason: ExclusionReason, count: usize) {
        match self
            .excluded
            .iter_mut()
            .find(|found| found.reason == reason)
        {
            Some(found) => found.count += count,
            None if count > 0 => self.excluded.push(ExcludedRows { reason, count }),
            None => {}
        }
    }
}
