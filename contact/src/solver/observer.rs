//! How a caller watches a solution grow, and stops it.

/// Where the work stands, told once per iteration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Loading step under way, counted from 0. On small grids several are solved at the same time.
    pub step: usize,
    /// Loading steps of the path that are finished.
    pub finished: usize,
    /// Number of loading steps.
    pub steps: usize,
    /// Elements per side of the grid level under way.
    pub elements: usize,
    /// Iteration on this level, counted from 0.
    pub iteration: usize,
    /// Largest line of the certificate at this iterate, by the iteration's own residual; dimensionless.
    pub residual: f64,
    /// Elements of the working set, which press or are about to.
    pub working_set: usize,
    /// Elements that entered or left it since the iteration before; in a level's first iteration all of it.
    pub working_set_change: usize,
}

/// The observer's answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Signal {
    /// Go on.
    Continue,
    /// Stop at once; the solution ends in [`ContactError::Cancelled`](crate::ContactError::Cancelled).
    Cancel,
}

/// Receives the progress of a solution, on a thread of the pool that computes it, never on two at once. `()` is the
/// observer that looks away.
pub trait Observer: Send {
    /// Called once per iteration.
    fn progress(&mut self, progress: &Progress) -> Signal;
}

impl Observer for () {
    fn progress(&mut self, _: &Progress) -> Signal {
        Signal::Continue
    }
}
