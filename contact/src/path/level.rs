//! One grid of a loading path: its problem, and the solution of successive, independent loads on it.

use std::{ops::ControlFlow, sync::Arc};

use crate::{
    ActiveSetSolver, ContactError, ContactSlope, DiscreteProblem, GradientSolver, Iterate,
    LevelValues, LevelWork, Load, Method, Model, RoughContact, Solution, Solver, SolverOptions,
    Summary,
    grid::region::Region,
    path::domain::Guess,
    path::effort::Effort,
    path::part::LevelPart,
    path::start::{CoarserSolution, FineGrid, RoughSurface},
    problem::{model::SampledRegion, support::choice::under},
    result::certificate::{JudgedFields, Trial},
    result::contact_field::ContactField,
    solver::Watch,
};
use pellicle_influence::{Origin, SurfaceElasticity};
use pellicle_texture::Grid;

/// A grid of a path.
pub struct Level {
    grid: Grid,
    elasticity: Arc<SurfaceElasticity>,
    pub coefficients_origin: Origin,
    /// Whether more loads may follow on this grid, so that memory is kept.
    keeps: bool,
    whole: SolvableProblem,
    /// Outline of the relief on the problem's elements.
    outline: Arc<Vec<bool>>,
    /// The region of the last load, and the problem on it.
    part: Option<(Region, SolvableProblem)>,
    /// Fields of the last load's certificate.
    judged: JudgedFields,
}

/// A problem, and its solver with storage.
struct SolvableProblem {
    problem: DiscreteProblem,
    solver: GradientSolver,
}

impl SolvableProblem {
    fn new(problem: DiscreteProblem) -> Self {
        Self {
            problem,
            solver: GradientSolver::default(),
        }
    }

    /// Solves by the method in the options.
    fn solve(
        &mut self,
        load: Load,
        start: &[f64],
        options: SolverOptions,
        watch: &mut Watch<'_>,
    ) -> Result<Iterate, ContactError> {
        let problem = &mut self.problem;
        match options.method {
            Method::Gradient => {
                self.solver.options = options;
                self.solver.solve(problem, load, start, watch)
            }
            Method::ActiveSet => ActiveSetSolver { options }.solve(problem, load, start, watch),
        }
    }
}

/// The start of a level.
#[derive(Clone, Copy)]
pub enum LevelStart<'a> {
    Nothing,
    Guess(Guess),
    Coarser(&'a CoarserSolution),
}

/// The result of one level.
pub struct LevelResult {
    /// Its pressures cover the region.
    pub solution: Solution,
    /// The region of the pressures.
    pub region: Region,
    pub summary: Summary,
    /// For the finest grid only, as the next.
    pub rough: Option<RoughContact>,
    pub slope: Option<ContactSlope>,
    pub work: LevelWork,
    pub residuals: Vec<f64>,
    pub contact_stiffness: Option<f64>,
}

impl Level {
    pub fn new(
        model: &Model,
        (side, region): (f64, Region),
        hardness: f64,
        keeps: bool,
    ) -> Result<Self, ContactError> {
        let grid = region.whole_grid(side)?;
        let SampledRegion {
            mask,
            compliance,
            initial_gap,
        } = model.sample_on(grid, &region);
        let elasticity = model.elasticity(&grid)?;
        let support = under(elasticity.value.clone(), region);
        let area = grid.element_area();
        let problem = DiscreteProblem::on(support, compliance, initial_gap, area)?
            .with_spring_law(model.relief.spring_law());
        let problem = if hardness.is_finite() {
            problem.with_hardness(hardness)?
        } else {
            problem
        };
        Ok(Self {
            keeps,
            whole: SolvableProblem::new(problem),
            outline: Arc::new(mask),
            grid,
            elasticity: elasticity.value,
            coefficients_origin: elasticity.origin,
            part: None,
            judged: JudgedFields::on(region),
        })
    }

    /// The same grid without the memory of any load; none if the problem cannot be recreated.
    pub fn fresh_copy(&self) -> Option<Self> {
        let everywhere = self.whole.problem.region();
        Some(Self {
            grid: self.grid,
            outline: self.outline.clone(),
            elasticity: self.elasticity.clone(),
            keeps: self.keeps,
            whole: SolvableProblem::new(self.whole.problem.part(&everywhere)?),
            coefficients_origin: self.coefficients_origin,
            part: None,
            judged: JudgedFields::on(everywhere),
        })
    }

    /// Elements per side of the grid.
    pub fn size(&self) -> usize {
        self.whole.problem.region().grid_size()
    }

    /// Solves from a coarser level's field or a guess, and judges the result with a new product.
    pub fn solve(
        &mut self,
        model: &Model,
        load: Load,
        start: LevelStart<'_>,
        options: SolverOptions,
        watch: &mut Watch<'_>,
    ) -> Result<LevelResult, ContactError> {
        let nothing = || {
            (
                self.whole.problem.region(),
                vec![0.0; self.whole.problem.elements()],
            )
        };
        let start = match start {
            LevelStart::Nothing => None,
            LevelStart::Guess(guess) => self.guessed(guess),
            LevelStart::Coarser(coarser) => self.prolonged(coarser),
        };
        let mut start = start.unwrap_or_else(nothing);
        if !options.shortcuts.windows {
            let everywhere = self.whole.problem.region();
            start = (everywhere, everywhere.take_over(&start.0, &start.1));
        }
        let (solution, region, effort) = self.solve_from(start, load, options, watch)?;
        let field = self.field(model, &region, &solution.pressure);
        Ok(LevelResult {
            summary: Summary::of(&field, solution.force, options.averaging_length),
            rough: None,
            slope: None,
            solution,
            region,
            work: LevelWork {
                elements: self.size(),
                iterations: effort.iterations,
                operator_applications: effort.operator_applications,
                stiffness_applications: effort.stiffness_applications,
                candidate_applications: effort.candidate_applications,
            },
            residuals: effort.residuals,
            contact_stiffness: effort.contact_stiffness,
        })
    }

    /// Solves from a pressure (Pa) on all elements; the solution has all of them too. Also returns the products with
    /// `K`.
    pub fn solve_near(
        &mut self,
        pressure: &[f64],
        load: Load,
        options: SolverOptions,
        watch: &mut Watch<'_>,
    ) -> Result<(Solution, usize), ContactError> {
        let everywhere = self.whole.problem.region();
        let region = everywhere.around_pressing(pressure).unwrap_or(everywhere);
        let start = (region, region.cut(pressure));
        let (mut solution, region, effort) = self.solve_from(start, load, options, watch)?;
        solution.pressure = everywhere.take_over(&region, &solution.pressure);
        let products = effort.operator_applications + effort.candidate_applications;
        Ok((solution, products))
    }

    /// Replaces the relief on the same elements: the compliance of its springs (m/Pa) and the initial gap (m).
    pub fn take_relief(&mut self, compliance: Vec<f64>, initial_gap: Vec<f64>) {
        self.whole.problem.take_relief(compliance, initial_gap);
        self.part = None;
    }

    /// The compliance of the springs (m/Pa) and the initial gap (m) of all elements.
    pub fn relief(&self) -> [&[f64]; 2] {
        let problem = &self.whole.problem;
        [problem.relief_compliance(), problem.initial_gap()]
    }

    /// The last load's solution, given its pressure on a region.
    pub fn field<'a>(
        &'a self,
        model: &'a Model,
        region: &'a Region,
        pressure: &'a [f64],
    ) -> ContactField<'a> {
        ContactField {
            model,
            grid: &self.grid,
            region,
            pressure,
            hardness: self.whole.problem.hardness(),
            initial_gap: self.whole.problem.initial_gap(),
            judged: &self.judged,
            mask: &self.outline,
            compliance: self.whole.problem.relief_compliance(),
            coefficient: self.elasticity.coefficient([0, 0]),
        }
    }

    /// A guessed pressure on a region around it; none if it presses on no element.
    fn guessed(&self, guess: Guess) -> Option<(Region, Vec<f64>)> {
        let (grid, everywhere) = (&self.grid, self.whole.problem.region());
        let pressure: Vec<f64> = grid.centres().map(|place| guess.pressure(place)).collect();
        let pressure = everywhere.grid().cut(&pressure);
        let region = everywhere.around_pressing(&pressure)?;
        Some((region, region.cut(&pressure)))
    }

    /// A coarser level's pressure on a region around it; none if no element presses.
    fn prolonged(&self, coarser: &CoarserSolution) -> Option<(Region, Vec<f64>)> {
        let problem = &self.whole.problem;
        let everywhere = problem.region();
        let reach = if everywhere.repeats() {
            everywhere
        } else {
            coarser.region.on_finer(|_| true, problem.size())?
        };
        let fine = FineGrid {
            initial_gap: problem.initial_gap(),
            outline: &self.outline,
            rough: problem.is_rough().then(|| RoughSurface {
                relief_compliance: problem.relief_compliance(),
                spring_law: problem.spring_law(),
                shortest_compliance: problem.shortest_compliance(),
                hardness: problem.hardness(),
            }),
        };
        let pressure = coarser.start_on(&reach, &fine);
        let region = reach.around_pressing(&pressure)?;
        let start = if region == reach {
            pressure
        } else {
            region.take_over(&reach, &pressure)
        };
        Some((region, start))
    }

    /// The elasticity of the elements.
    pub fn into_elasticity(self) -> Arc<SurfaceElasticity> {
        self.elasticity
    }

    /// Solves on a part of the level, enlarged until it holds the contact. Also returns the region of the pressure.
    fn solve_from(
        &mut self,
        start: (Region, Vec<f64>),
        load: Load,
        options: SolverOptions,
        watch: &mut Watch<'_>,
    ) -> Result<(Solution, Region, Effort), ContactError> {
        let (region, mut pressure) = start;
        let mut effort = Effort::default();
        let mut part = LevelPart::around(&self.whole.problem, region, &pressure, &options);
        loop {
            let iterate = match &mut part.dilute {
                Some(dilute) => {
                    let whole = &self.whole.problem;
                    effort.among(dilute.solve(whole, &pressure, load, options, watch)?)
                }
                None => self.solve_in(&mut part.region, &pressure, load, options, watch)?,
            };
            let (reached_border, expected) = (iterate.reached_border, iterate.penetration);
            pressure = effort.take(iterate);
            if reached_border {
                pressure = part.grow(&pressure);
                continue;
            }
            if !self.keeps {
                self.part = None;
                self.whole.solver.release();
            }
            let trial = Trial {
                region: &part.region,
                load,
                expected,
                tolerance: options.tolerance,
            };
            let (problem, judged) = (&mut self.whole.problem, &mut self.judged);
            let solution = Solution::judge_within(problem, trial, pressure, judged);
            effort.operator_applications += judged.take_products();
            match part.take_in(problem, judged, solution, &options) {
                ControlFlow::Break(solution) => return Ok((solution, part.region, effort)),
                ControlFlow::Continue(start) => pressure = start,
            }
        }
    }

    /// Solves on a region, which becomes the whole grid if there is no operator of its size.
    fn solve_in(
        &mut self,
        region: &mut Region,
        start: &[f64],
        load: Load,
        options: SolverOptions,
        watch: &mut Watch<'_>,
    ) -> Result<Iterate, ContactError> {
        let known = self.part.take_if(|(known, _)| known == region);
        let part = match known {
            Some((_, part)) => Some(part),
            None if region.is_whole() || options.method == Method::ActiveSet => None,
            None => self.whole.problem.part(region).map(SolvableProblem::new),
        };
        if let Some(mut part) = part {
            let iterate = part.solve(load, start, options, watch);
            self.part = Some((*region, part));
            return iterate;
        }
        let everywhere = self.whole.problem.region();
        let start = everywhere.take_over(region, start);
        *region = everywhere;
        self.whole.solve(load, &start, options, watch)
    }

    /// Frees the memory needed only for further loads, if there are none.
    pub fn release(&mut self) {
        if !self.keeps {
            self.whole.problem.support_mut().release();
            self.judged = JudgedFields::on(self.whole.problem.region());
        }
    }

    /// The solution that the next finer level starts from.
    pub fn as_coarser(&mut self, result: &LevelResult) -> CoarserSolution {
        let region = *self.judged.reach();
        CoarserSolution {
            region,
            pressure: region.take_over(&result.region, &result.solution.pressure),
            displacement: if self.keeps {
                self.judged.displacement().to_vec()
            } else {
                self.judged.take_displacement()
            },
            penetration: result.solution.penetration,
            outline: self.outline.clone(),
        }
    }
}

impl LevelResult {
    pub fn values(&self, load: Load) -> LevelValues {
        LevelValues {
            elements: self.work.elements,
            penetration: self.solution.penetration,
            force: match load {
                Load::Force(force) => force,
                Load::Penetration(_) => self.solution.force,
            },
            contact_area: self.summary.contact_area,
            edge_uncertainty: self.summary.edge_uncertainty,
            max_pressure: self.summary.max_pressure,
            averaged_pressure: self.summary.max_averaged_pressure,
            peak_place: self.summary.peak_place,
            meets_outline: self.summary.meets_outline,
        }
    }
}
