//! The part of a level on which a load is solved: a region, or a few candidates in one. It takes in what overlaps
//! outside, until nothing does.

use std::ops::ControlFlow;

use crate::{
    DiscreteProblem, Solution, SolverOptions, grid::region::Region, path::dilute::Dilute,
    result::certificate::JudgedFields,
};

/// A part of a level.
pub struct LevelPart {
    pub region: Region,
    /// The candidates of a dilute contact; none if all of the region is solved on.
    pub dilute: Option<Dilute>,
}

impl LevelPart {
    /// The part around a start on a region: its candidates, if that pays.
    pub fn around(
        whole: &DiscreteProblem,
        region: Region,
        start: &[f64],
        options: &SolverOptions,
    ) -> Self {
        Self {
            dilute: Dilute::around(whole, &region, start, options),
            region,
        }
    }

    /// Grows beyond the border that the contact has reached; returns the pressure there.
    pub fn grow(&mut self, pressure: &[f64]) -> Vec<f64> {
        self.move_to(self.region.grown(), pressure)
    }

    /// Breaks with a judged solution if it is final; else takes in what overlaps and returns the next start.
    pub fn take_in(
        &mut self,
        whole: &DiscreteProblem,
        judged: &JudgedFields,
        solution: Solution,
        options: &SolverOptions,
    ) -> ControlFlow<Solution, Vec<f64>> {
        if let Some(dilute) = &mut self.dilute {
            if dilute.is_done(&solution, options) {
                return ControlFlow::Break(solution);
            }
            if !dilute.correct(whole, judged, &solution.pressure) {
                self.dilute = None;
            }
            return ControlFlow::Continue(solution.pressure);
        }
        if self.region.is_whole() || solution.certificate.overlap <= options.tolerance {
            return ControlFlow::Break(solution);
        }
        let initial_gap = whole.initial_gap();
        let everywhere = whole.region();
        let wider = everywhere.around(|element| {
            let gap = initial_gap[everywhere.index_on_grid(element)];
            self.region.presses(&solution.pressure, element) || judged.gap_of(element, gap) < 0.0
        });
        ControlFlow::Continue(self.move_to(self.region.wider(wider), &solution.pressure))
    }

    /// Moves to another region; returns the pressure there.
    fn move_to(&mut self, region: Region, pressure: &[f64]) -> Vec<f64> {
        let moved = region.take_over(&self.region, pressure);
        self.region = region;
        moved
    }
}
