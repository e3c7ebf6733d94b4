//! One grid of a loading path: its problem, and the solution of successive, independent loads on it.

use std::sync::Arc;

use crate::{
    ActiveSetSolver, Boundary, ContactError, ContactSlope, DiscreteProblem, GradientSolver,
    Iterate, LevelValues, LevelWork, Load, Method, Model, RoughContact, Solution, Solver,
    SolverOptions, Summary,
    grid::window::Window,
    path::dilute::Dilute,
    path::domain::Guess,
    path::effort::Effort,
    path::start::{CoarserSolution, FineGrid, RoughSurface},
    problem::{model::SampledSector, operator_source::OperatorSource},
    result::certificate::{JudgedFields, Trial},
    result::contact_field::ContactField,
    solver::Watch,
};
use pellicle_influence::{Origin, SectorGrid, SurfaceElasticity};
use pellicle_texture::Grid;

/// A grid of a path.
pub struct Level {
    grid: Grid,
    elasticity: Arc<SurfaceElasticity>,
    pub coefficients_origin: Origin,
    /// Whether more loads may follow on this grid, so that memory is kept.
    keeps: bool,
    whole: SolvableProblem,
    /// Outline of the relief on the problem's sector.
    outline: Arc<Vec<bool>>,
    /// The window of the last load, and the problem on it.
    part: Option<(Window, SolvableProblem)>,
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
    /// Its pressures cover the window.
    pub solution: Solution,
    /// The window of the pressures.
    pub window: Window,
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
        (side, sector): (f64, SectorGrid),
        boundary: Boundary,
        hardness: f64,
        keeps: bool,
    ) -> Result<Self, ContactError> {
        let grid = Grid::new(side, sector.whole_size())?;
        let SampledSector {
            mask,
            compliance,
            initial_gap,
        } = model.sample_sector(grid, sector);
        let elasticity = model.elasticity(&grid)?;
        let source = OperatorSource::of(elasticity.value.clone(), boundary);
        let area = grid.element_area();
        let problem = DiscreteProblem::on(sector, source, compliance, initial_gap, area)?
            .with_spring_law(model.relief.spring_law());
        let problem = if hardness.is_finite() {
            problem.with_hardness(hardness)?
        } else {
            problem
        };
        let everywhere = problem.everywhere();
        Ok(Self {
            keeps,
            whole: SolvableProblem::new(problem),
            outline: Arc::new(mask),
            grid,
            elasticity: elasticity.value,
            coefficients_origin: elasticity.origin,
            part: None,
            judged: JudgedFields::on(everywhere),
        })
    }

    /// The same grid without the memory of any load; none if the problem cannot be recreated.
    pub fn fresh_copy(&self) -> Option<Self> {
        let everywhere = self.whole.problem.everywhere();
        Some(Self {
            grid: self.grid,
            outline: self.outline.clone(),
            elasticity: self.elasticity.clone(),
            keeps: self.keeps,
            whole: SolvableProblem::new(self.whole.problem.window(&everywhere)?),
            coefficients_origin: self.coefficients_origin,
            part: None,
            judged: JudgedFields::on(everywhere),
        })
    }

    /// Elements per side of the grid.
    pub fn size(&self) -> usize {
        self.whole.problem.grid_size()
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
                self.whole.problem.everywhere(),
                vec![0.0; self.whole.problem.elements()],
            )
        };
        let start = match start {
            LevelStart::Nothing => None,
            LevelStart::Guess(guess) => self.guessed(guess),
            LevelStart::Coarser(coarser) => self.prolonged(coarser),
        };
        let start = start.unwrap_or_else(nothing);
        let (solution, window, effort) = self.solve_from(start, load, options, watch)?;
        let field = self.field(model, &window, &solution.pressure);
        Ok(LevelResult {
            summary: Summary::of(&field, solution.force),
            rough: None,
            slope: None,
            solution,
            window,
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

    /// The last load's solution, given its pressure on a window.
    pub fn field<'a>(
        &'a self,
        model: &'a Model,
        window: &'a Window,
        pressure: &'a [f64],
    ) -> ContactField<'a> {
        ContactField {
            model,
            grid: &self.grid,
            boundary: self.whole.problem.boundary(),
            window,
            pressure,
            hardness: self.whole.problem.hardness(),
            initial_gap: self.whole.problem.initial_gap(),
            judged: &self.judged,
            mask: &self.outline,
            compliance: self.whole.problem.relief_compliance(),
            coefficient: self.elasticity.coefficient([0, 0]),
        }
    }

    /// A guessed pressure on a window around it; none if it presses on no element.
    fn guessed(&self, guess: Guess) -> Option<(Window, Vec<f64>)> {
        let (grid, everywhere) = (&self.grid, self.whole.problem.everywhere());
        let pressure: Vec<f64> = grid.centres().map(|place| guess.pressure(place)).collect();
        let pressure = everywhere.grid().cut(&pressure);
        let window = everywhere.around_pressing(&pressure)?;
        Some((window, window.cut(&pressure)))
    }

    /// A coarser level's pressure on a window around it; none if no element presses.
    fn prolonged(&self, coarser: &CoarserSolution) -> Option<(Window, Vec<f64>)> {
        let reach = coarser
            .window
            .on_finer(|_| true, self.whole.problem.size())?;
        let problem = &self.whole.problem;
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
        let window = reach.around_pressing(&pressure)?;
        let start = if window == reach {
            pressure
        } else {
            window.take_over(&reach, &pressure)
        };
        Some((window, start))
    }

    /// The elasticity of the elements.
    pub fn into_elasticity(self) -> Arc<SurfaceElasticity> {
        self.elasticity
    }

    /// Solves on a window, enlarged until it holds the contact; for a dilute contact only on candidates in the window.
    /// Also returns the window.
    fn solve_from(
        &mut self,
        start: (Window, Vec<f64>),
        load: Load,
        options: SolverOptions,
        watch: &mut Watch<'_>,
    ) -> Result<(Solution, Window, Effort), ContactError> {
        let everywhere = self.whole.problem.everywhere();
        let (mut window, mut pressure) = start;
        let mut effort = Effort::default();
        let mut dilute = Dilute::around(&self.whole.problem, &window, &pressure, &options);
        loop {
            let iterate = match &mut dilute {
                Some(dilute) => {
                    let whole = &self.whole.problem;
                    effort.among(dilute.solve(whole, &pressure, load, options, watch)?)
                }
                None => self.solve_in(&mut window, &pressure, load, options, watch)?,
            };
            let (reached_border, expected) = (iterate.reached_border, iterate.penetration);
            pressure = effort.take(iterate);
            if reached_border {
                pressure = window.grown().take_over(&window, &pressure);
                window = window.grown();
                continue;
            }
            if !self.keeps {
                self.part = None;
                self.whole.solver.release();
            }
            let tolerance = options.tolerance;
            let trial = Trial {
                window: &window,
                load,
                expected,
                tolerance,
            };
            let (problem, judged) = (&mut self.whole.problem, &mut self.judged);
            let solution = Solution::judge_within(problem, trial, pressure, judged);
            effort.operator_applications += judged.take_products();
            if let Some(candidates) = &mut dilute {
                if candidates.is_done(&solution, &options) {
                    return Ok((solution, window, effort));
                }
                let continues = candidates.correct(problem, judged, &solution.pressure);
                dilute = dilute.filter(|_| continues);
                pressure = solution.pressure;
                continue;
            }
            if window.is_whole() || solution.certificate.overlap <= tolerance {
                return Ok((solution, window, effort));
            }
            let wider = {
                let presses = |element| window.presses(&solution.pressure, element);
                let (initial_gap, size) = (problem.initial_gap(), problem.size());
                let judged = &self.judged;
                let overlaps =
                    |[i, j]: [usize; 2]| judged.gap_of([i, j], initial_gap[i * size + j]) < 0.0;
                window.wider(everywhere.around(|e| presses(e) || overlaps(e)))
            };
            pressure = wider.take_over(&window, &solution.pressure);
            window = wider;
        }
    }

    /// Solves on a window, which becomes the whole grid if there is no operator of its size.
    fn solve_in(
        &mut self,
        window: &mut Window,
        start: &[f64],
        load: Load,
        options: SolverOptions,
        watch: &mut Watch<'_>,
    ) -> Result<Iterate, ContactError> {
        let known = self.part.take_if(|(known, _)| known == window);
        let part = match known {
            Some((_, part)) => Some(part),
            None if window.is_whole() || options.method == Method::ActiveSet => None,
            None => self.whole.problem.window(window).map(SolvableProblem::new),
        };
        if let Some(mut part) = part {
            let iterate = part.solve(load, start, options, watch);
            self.part = Some((*window, part));
            return iterate;
        }
        let everywhere = self.whole.problem.everywhere();
        let start = everywhere.take_over(window, start);
        *window = everywhere;
        self.whole.solve(load, &start, options, watch)
    }

    /// Frees the memory needed only for further loads, if there are none.
    pub fn release(&mut self) {
        if !self.keeps {
            self.whole.problem.release_operator();
            self.judged = JudgedFields::on(self.whole.problem.everywhere());
        }
    }

    /// The solution that the next finer level starts from.
    pub fn as_coarser(&mut self, result: &LevelResult) -> CoarserSolution {
        let window = *self.judged.reach();
        CoarserSolution {
            window,
            pressure: window.take_over(&result.window, &result.solution.pressure),
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
            peak_place: self.summary.peak_place,
            meets_outline: self.summary.meets_outline,
        }
    }
}
