//! Where figures get their runs from, and how fine the grids are.

use pellicle_cli::results::StepSummary;
use pellicle_contact::Estimate;

use super::run::{PaperRun, Runner};
use crate::XtaskError;

/// The runner, the quality of the grids, and who hears of the progress.
pub(super) struct Studio<'a> {
    pub runner: &'a Runner,
    pub quality: Quality,
    pub tell: &'a mut dyn FnMut(&str),
}

/// A number of a step that a curve shows: its value and what the grid costs it.
pub(super) type Drawn = fn(&StepSummary) -> (f64, Option<Estimate>);

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
    pub(super) fn fields(&mut self, case: &'static str) -> Result<PaperRun, XtaskError> {
        let mut sets = vec![format!("grid.elements={}", self.quality.fields)];
        if ["cases/fig2a", "cases/fig2b"].contains(&case) {
            sets.push(WIDER.to_owned());
        }
        self.run(case, &sets, true)
    }

    /// A loading path, on grids that are refined until the error of what is drawn is small enough.
    pub(super) fn path(
        &mut self,
        case: &'static str,
        drawn: &[Drawn],
    ) -> Result<PaperRun, XtaskError> {
        let mut elements = self.quality.path;
        loop {
            let run = self.run(case, &[format!("grid.elements={elements}")], false)?;
            if 2 * elements > self.quality.finest_path || is_enough(&run, drawn) {
                return Ok(run);
            }
            elements *= 2;
        }
    }

    fn run(
        &mut self,
        case: &'static str,
        sets: &[String],
        fields: bool,
    ) -> Result<PaperRun, XtaskError> {
        (self.tell)(&format!("solve:  {case}, {}", sets.join(", ")));
        self.runner.run(case, sets, fields)
    }
}

/// Whether every step has an error that is known and small.
fn is_enough(run: &PaperRun, drawn: &[Drawn]) -> bool {
    let is_small = |(value, error): (f64, Option<Estimate>)| {
        error.is_some_and(|error| error.resolved && error.estimate <= ENOUGH * value)
    };
    let step_is = |step| drawn.iter().all(|number| is_small(number(step)));
    run.steps().iter().all(step_is)
}

/// Elements per side, and when they are enough.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Quality {
    /// Elements per side of a run whose fields are drawn.
    pub fields: usize,
    /// Elements per side with which a loading path begins.
    pub path: usize,
    /// Elements per side to which a loading path is refined at most, as long as its grid error is above the bound.
    pub finest_path: usize,
    /// Whether the pictures are for a look only, and say so.
    pub is_quick: bool,
}

impl Quality {
    /// For print.
    pub const FULL: Self = Self {
        fields: 1024,
        path: 512,
        finest_path: 1024,
        is_quick: false,
    };

    /// For a look.
    pub const QUICK: Self = Self {
        fields: 256,
        path: 256,
        finest_path: 256,
        is_quick: true,
    };

    /// What a subtitle says of it.
    #[must_use]
    pub fn mark(self) -> &'static str {
        if self.is_quick {
            "QUICK, COARSE GRIDS.  "
        } else {
            ""
        }
    }
}
