//! The elements on the wrong side of a solution with held elements.

/// The elements on the wrong side.
#[derive(Default)]
pub struct WrongSide {
    /// Free elements above the limit.
    pub above: Vec<usize>,
    /// Held elements to be released: with a gap, under a force those with the largest.
    pub open: Vec<usize>,
    /// The largest excess over the limit, in units of the limit.
    pub excess: f64,
    /// The largest error: that excess, or a gap relative to the penetration.
    pub by: f64,
}
