//! Where figures get their runs from.

use pellicle_cli::output::summary::{EstimateSummary, StepSummary};

use super::Quality;
use crate::{PaperCase, PaperRun, Request, Runner, XtaskError};

/// The runner, the quality of the grids, and who hears of the progress.
pub(super) struct Studio<'a> {
    pub runner: &'a Runner,
    pub quality: Quality,
    pub tell: &'a mut dyn FnMut(&str),
}

/// A number of a step that a curve shows: its value and what the grid costs it.
pub(super) type Drawn = fn(&StepSummary) -> (f64, Option<EstimateSummary>);

/// The penetration.
pub(super) const PENETRATION: Drawn = |step| (step.penetration, step.grid_error.penetration);
/// The largest pressure.
pub(super) const PEAK: Drawn = |step| (step.max_pressure, step.grid_error.max_pressure);

/// The grid error, as a part of the value, below which a curve needs no finer grid: well below the width of its line.
const ENOUGH: f64 = 1e-3;

/// The domain of Fig. 2(c), for the small loads of Fig. 2(a) and (b).
const WIDER: &str = "grid.side=0.12";

impl Studio<'_> {
    /// A run whose fields are drawn. All of Fig. 2 is drawn on axes of one length, so its smaller domains are widened.
    pub(super) fn fields(&mut self, case: PaperCase) -> Result<PaperRun, XtaskError> {
        let request = Request::fields(case, self.quality.fields);
        let request = match case {
            PaperCase::Fig2a | PaperCase::Fig2b => request.with(WIDER),
            _ => request,
        };
        self.runner.run(&request, &mut *self.tell)
    }

    /// A loading path, on grids that are refined until the error of what is drawn is small enough.
    pub(super) fn path(
        &mut self,
        case: PaperCase,
        drawn: &[Drawn],
    ) -> Result<PaperRun, XtaskError> {
        let mut elements = self.quality.path;
        loop {
            let request = Request::numbers(case, elements);
            let run = self.runner.run(&request, &mut *self.tell)?;
            if 2 * elements > self.quality.finest_path || is_enough(&run, drawn) {
                return Ok(run);
            }
            elements *= 2;
        }
    }
}

/// Whether every step has an error that is known and small.
fn is_enough(run: &PaperRun, drawn: &[Drawn]) -> bool {
    let is_small = |(value, error): (f64, Option<EstimateSummary>)| {
        error.is_some_and(|error| error.resolved && error.estimate <= ENOUGH * value)
    };
    let step_is = |step| drawn.iter().all(|number| is_small(number(step)));
    run.steps().iter().all(step_is)
}
