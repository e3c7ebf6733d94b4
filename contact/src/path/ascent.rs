//! The solution of one load from the coarsest grid to the finest.

use crate::{
    CoarsePressure, GridError, LevelValues, LevelWork, Load, SolverOptions, Step, Work,
    path::level::LevelResult, path::start::CoarserSolution,
};

/// A load and its solution so far.
pub struct Ascent {
    pub load: Load,
    pub options: SolverOptions,
    /// The work on each grid solved so far.
    pub levels: Vec<LevelWork>,
    pub values: Vec<LevelValues>,
    /// The pressures of the finest of these grids, if requested.
    pub coarser: Vec<CoarsePressure>,
    /// The start of the next level.
    pub coarser_solution: Option<CoarserSolution>,
}

impl Ascent {
    pub fn of(load: Load, options: SolverOptions) -> Self {
        Self {
            load,
            options,
            levels: Vec::new(),
            values: Vec::new(),
            coarser: Vec::new(),
            coarser_solution: None,
        }
    }

    /// Converts to a step, given its result on the finest grid, its time in `seconds` and the relative error of the
    /// coefficients.
    pub fn into_step(self, result: LevelResult, seconds: f64, coefficient_error: f64) -> Step {
        let accuracy = result.solution.certificate.worst() + coefficient_error;
        Step {
            work: Work {
                iterations: result.work.iterations,
                operator_applications: result.work.operator_applications,
                stiffness_applications: result.work.stiffness_applications,
                candidate_applications: result.work.candidate_applications,
                seconds,
                levels: self.levels,
            },
            solution: result.solution,
            summary: result.summary,
            grid_error: GridError::new(self.values, accuracy),
            residuals: result.residuals,
            contact_stiffness: result.contact_stiffness,
            rough: result.rough,
            cut_off: None,
            slope: result.slope,
            limits: Vec::new(),
            coarser: self.coarser,
            wear: None,
        }
    }
}
