//! What work tells its caller, and the caller's answer: go on or stop.

use pellicle_contact::{Observer, Progress, Signal};

/// Something that happens while a case is being solved.
#[derive(Debug, Clone, Copy)]
pub enum Event<'a> {
    /// One iteration of a solution.
    Iteration(&'a Progress),
    /// The search for the stresses of a step begins: its index, from 0, and the number of steps.
    StressesOf(usize, usize),
    /// The search for the critical loads begins.
    CriticalLoads,
    /// The case waits for memory that others hold; told some ten times a second.
    WaitsForMemory,
}

/// Told what happens during long work, and may stop it.
pub trait Monitor: Send {
    /// Called for every event; [`Signal::Cancel`] stops the work.
    fn told(&mut self, event: Event<'_>) -> Signal;
}

/// Never stops.
impl Monitor for () {
    fn told(&mut self, _: Event<'_>) -> Signal {
        Signal::Continue
    }
}

/// A monitor as the observer of a solution.
#[derive(Debug)]
pub struct Watching<'a, M: ?Sized>(pub &'a mut M);

impl<M: Monitor + ?Sized> Observer for Watching<'_, M> {
    fn progress(&mut self, progress: &Progress) -> Signal {
        self.0.told(Event::Iteration(progress))
    }
}
