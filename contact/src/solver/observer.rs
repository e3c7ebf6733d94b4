//! Progress reports to the caller, who may cancel.

/// Progress of the work, reported once per iteration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Loading step under way, counted from 0. On small grids several steps are solved at the same time.
    pub step: usize,
    /// Loading steps of the path that are finished.
    pub finished: usize,
    /// Number of loading steps.
    pub steps: usize,
    /// Elements per side of the grid level under way.
    pub elements: usize,
    /// Iteration on this level, counted from 0.
    pub iteration: usize,
    /// Largest line of the certificate at this iterate, according to the iteration's own residual; dimensionless.
    pub residual: f64,
    /// Number of elements in the working set.
    pub working_set: usize,
    /// Number of elements that entered or left the working set since the last iteration; all of it in a level's first
    /// iteration.
    pub working_set_change: usize,
}

/// The observer's answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Signal {
    /// Continue.
    Continue,
    /// Stop at once; the solution ends in [`ContactError::Cancelled`](crate::ContactError::Cancelled).
    Cancel,
}

/// Receives the progress of a solution on a thread of the pool that computes it, never on two at once. `()` ignores it.
pub trait Observer: Send {
    /// Called once per iteration.
    fn progress(&mut self, progress: &Progress) -> Signal;
}

impl Observer for () {
    fn progress(&mut self, _: &Progress) -> Signal {
        Signal::Continue
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        ActiveSetSolver, ContactError, GradientSolver, Load, Solver, Watch,
        solver::tests::{RIGID, SIZE, paraboloid, problem},
    };

    /// Keeps the reports, and cancels at a given iteration.
    struct Listener {
        reports: Vec<Progress>,
        last: usize,
    }

    impl Observer for Listener {
        fn progress(&mut self, progress: &Progress) -> Signal {
            self.reports.push(*progress);
            if progress.iteration == self.last {
                Signal::Cancel
            } else {
                Signal::Continue
            }
        }
    }

    fn solve(solver: &mut dyn Solver, last: usize) -> (Vec<Progress>, Option<usize>) {
        let mut problem = problem([1.0, 0.1], paraboloid, RIGID);
        let mut listener = Listener {
            reports: Vec::new(),
            last,
        };
        let mut watch = Watch {
            observer: &mut listener,
            step: 2,
            finished: 1,
            steps: 5,
        };
        let start = [0.0; SIZE * SIZE];
        let found = solver.solve(&mut problem, Load::Penetration(0.01), &start, &mut watch);
        let pressing = match found {
            Ok(found) => {
                assert!(
                    found.penetration.is_infinite()
                        || (found.penetration / 0.01 - 1.0).abs() < 1e-12
                );
                Some(found.pressure.iter().filter(|p| **p > 0.0).count())
            }
            Err(ContactError::Cancelled { step: 2 }) => None,
            Err(other) => panic!("{other:?}"),
        };
        (listener.reports, pressing)
    }

    #[test]
    fn the_observer_sees_every_iteration_and_may_cancel() {
        for solver in [
            &mut GradientSolver::default() as &mut dyn Solver,
            &mut ActiveSetSolver::default(),
        ] {
            let (reports, pressing) = solve(solver, usize::MAX);
            for (iteration, progress) in reports.iter().enumerate() {
                assert_eq!(progress.iteration, iteration);
                let place = [progress.step, progress.finished, progress.steps];
                assert_eq!((place, progress.elements), ([2, 1, 5], SIZE));
            }
            let [first, .., last] = &reports[..] else {
                panic!("{reports:?}")
            };
            assert!(last.residual < 1e-8 && first.residual > 1e-3);
            // The final set holds the elements that press; at the start all of it is new.
            assert_eq!(Some(last.working_set), pressing);
            assert_eq!(first.working_set, first.working_set_change);
            let (reports, pressing) = solve(solver, 2);
            assert_eq!((reports.len(), pressing), (3, None));
        }
    }
}
