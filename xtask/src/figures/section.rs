//! A section of the fields beside the axis, along x, as lines of depth.

use std::ops::Range;

use pellicle_cli::results::Fields;

/// The row of elements beside the axis, along x.
pub(super) struct Section<'a> {
    pub fields: Fields<'a>,
    /// Of the relief.
    pub height: f64,
    /// The unit of the depths.
    pub unit: f64,
}

impl Section<'_> {
    /// The surface of the layer lies `u + h` below the undeformed tops.
    pub(super) fn layer(&self) -> Vec<Vec<(f64, f64)>> {
        self.parts(|_| true, |e| self.fields.displacement[e] + self.height)
    }

    /// The top of an element lies `u + w*` below where it was.
    pub(super) fn tops(&self) -> Vec<Vec<(f64, f64)>> {
        self.parts(|e| self.fields.mask[e], |e| self.top(e))
    }

    /// The indenter lies the gap above what it meets.
    pub(super) fn indenter(&self) -> Vec<Vec<(f64, f64)>> {
        self.parts(|_| true, |e| self.top(e) - self.fields.gap[e])
    }

    /// `u + w* − f*`.
    fn top(&self, e: usize) -> f64 {
        self.fields.displacement[e] + self.fields.shortening[e] - self.fields.profile[e]
    }

    /// The depths along the row where a line is, in runs of neighbouring elements.
    fn parts(
        &self,
        is_there: impl Fn(usize) -> bool,
        depth: impl Fn(usize) -> f64,
    ) -> Vec<Vec<(f64, f64)>> {
        let size = self.fields.size;
        let element = |i: usize| i * size + size / 2;
        let runs = runs(size, |i| is_there(element(i)));
        let point = |i| (self.fields.centre(i), depth(element(i)) / self.unit);
        runs.into_iter()
            .map(|run| run.map(point).collect())
            .collect()
    }
}

/// The longest runs of indices below `count` for which something holds.
fn runs(count: usize, holds: impl Fn(usize) -> bool) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for i in (0..count).filter(|i| holds(*i)) {
        match runs.last_mut() {
            Some(run) if run.end == i => run.end = i + 1,
            _ => runs.push(i..i + 1),
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_as_long_as_they_can_be() {
        assert_eq!(runs(6, |i| i != 2), [0..2, 3..6]);
        assert!(runs(3, |_| false).is_empty());
    }
}
