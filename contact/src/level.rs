//! One grid of a loading path: its problem, and the solution of one load on it after the other, none of which depends on another.

use std::sync::Arc;

use pellicle_influence::{Origin, SurfaceElasticity};
use rayon::prelude::*;

use crate::{
    ActiveSetSolver, ContactError, DeformedSurface, DiscreteProblem, GradientSolver, Iterate,
    LevelValues, LevelWork, Load, Method, Model, SampledModel, Solution, Solver, SolverOptions,
    Summary,
    levels::{Field, prolong},
    solver::Watch,
    window::{Room, Window},
};

/// Pressure that stands for a gap, as a part of what closes the gap alone: halfway between contact that ends at the last element
/// that presses and at the first that does not. From 0.2 to 1 it matters little.
const PRESSURE_PER_GAP: f64 = 0.5;
/// Gaps beyond this (m) are as good as infinite.
const FAR: f64 = 1e30;

/// A grid of a path.
pub struct Level {
    sampled: Arc<SampledModel>,
    elasticity: Arc<SurfaceElasticity>,
    pub coefficients_origin: Origin,
    problem: DiscreteProblem,
    /// The window of the last load, and the problem on it.
    window: Option<(Window, DiscreteProblem)>,
    /// The surface of the last load: memory that the next uses again.
    surface: DeformedSurface,
}

/// What one level ended with.
pub struct LevelResult {
    pub solution: Solution,
    pub summary: Summary,
    pub work: LevelWork,
    pub residuals: Vec<f64>,
    pub contact_stiffness: Option<f64>,
}

impl Level {
    pub fn new(model: &Model, side: f64, size: usize) -> Result<Self, ContactError> {
        let sampled = model.sample(side, size)?;
        let elasticity = model.elasticity(&sampled.grid)?;
        Ok(Self {
            problem: sampled.problem(elasticity.value.clone())?,
            sampled: Arc::new(sampled),
            elasticity: elasticity.value,
            coefficients_origin: elasticity.origin,
            window: None,
            surface: DeformedSurface::default(),
        })
    }

    /// The same grid without memory of any load; none where the problem cannot be made again.
    pub fn twin(&self) -> Option<Self> {
        let everywhere = Window::whole(self.size());
        Some(Self {
            sampled: self.sampled.clone(),
            elasticity: self.elasticity.clone(),
            problem: self.problem.window(&everywhere)?,
            coefficients_origin: self.coefficients_origin,
            window: None,
            surface: DeformedSurface::default(),
        })
    }

    pub fn size(&self) -> usize {
        self.problem.size()
    }

    /// Solves from a coarser level's field, and judges the result afresh.
    pub fn solve(
        &mut self,
        load: Load,
        coarser: Option<Field<'_>>,
        options: SolverOptions,
        watch: &mut Watch<'_>,
    ) -> Result<LevelResult, ContactError> {
        let start = match coarser {
            Some(field) => prolong(&field, self.size(), self.mask()),
            None => vec![0.0; self.size() * self.size()],
        };
        let (solution, effort) = self.solve_from(start, load, options, watch)?;
        Ok(LevelResult {
            summary: Summary::new(&solution, &self.sampled.grid, &self.sampled.relief),
            solution,
            work: LevelWork {
                elements: self.size(),
                iterations: effort.iterations,
                operator_applications: effort.operator_applications,
                stiffness_applications: effort.stiffness_applications,
            },
            residuals: effort.residuals,
            contact_stiffness: effort.contact_stiffness,
        })
    }

    /// The geometry and the elasticity of the elements.
    pub fn into_parts(self) -> (SampledModel, Arc<SurfaceElasticity>) {
        (Arc::unwrap_or_clone(self.sampled), self.elasticity)
    }

    /// The relief's outline, across which nothing is interpolated.
    pub fn mask(&self) -> &[bool] {
        self.sampled.relief.mask()
    }

    /// Solves on a window that holds the contact, enlarged as long as it does not.
    fn solve_from(
        &mut self,
        start: Vec<f64>,
        load: Load,
        options: SolverOptions,
        watch: &mut Watch<'_>,
    ) -> Result<(Solution, Effort), ContactError> {
        let size = self.size();
        let room = if watch.steps > 1 {
            Room::ForMany
        } else {
            Room::ForOne
        };
        let mut window = Window::around(size, |e| start[e] > 0.0, room);
        let mut pressure = start;
        let mut effort = Effort::default();
        loop {
            let iterate = self.solve_in(&mut window, pressure, load, options, watch)?;
            let reached_border = iterate.reached_border;
            pressure = effort.take(iterate);
            if reached_border {
                window = window.grown();
                continue;
            }
            if watch.steps == 1 {
                self.window = None;
            }
            let tolerance = options.tolerance;
            let (problem, surface) = (&mut self.problem, &mut self.surface);
            let solution =
                Solution::judge_within(problem, &window, load, pressure, tolerance, surface);
            effort.operator_applications += 1;
            if window.is_whole() || solution.certificate.overlap <= tolerance {
                return Ok((solution, effort));
            }
            let presses = |e: usize| solution.pressure[e] > 0.0 || self.surface.gap[e] < 0.0;
            window = window.wider(Window::around(size, presses, room));
            pressure = solution.pressure;
        }
    }

    /// Solves on a window, which becomes the whole grid where there is no operator of its size; the pressure is that of the whole grid.
    fn solve_in(
        &mut self,
        window: &mut Window,
        start: Vec<f64>,
        load: Load,
        options: SolverOptions,
        watch: &mut Watch<'_>,
    ) -> Result<Iterate, ContactError> {
        if options.method == Method::ActiveSet {
            *window = Window::whole(self.size());
        }
        let known = self.window.take_if(|(known, _)| known == window);
        let part = match known {
            Some((_, problem)) => Some(problem),
            None if window.is_whole() => None,
            None => self.problem.window(window),
        };
        let Some(mut part) = part else {
            *window = Window::whole(self.size());
            return solver(options).solve(&mut self.problem, load, &start, watch);
        };
        let part_of_start = window.cut(&start);
        drop(start);
        let iterate = solver(options).solve(&mut part, load, &part_of_start, watch);
        self.window = Some((*window, part));
        let iterate = iterate?;
        Ok(Iterate {
            pressure: window.spread(&iterate.pressure),
            ..iterate
        })
    }

    /// Gives back the memory that only another load would need.
    pub fn release(&mut self) {
        self.problem.release_operator();
        self.surface = DeformedSurface::default();
    }

    /// The last load's pressure, and where there is none the gap as a negative pressure.
    pub fn signed_field(&self, solution: &Solution) -> Vec<f64> {
        let per_gap = PRESSURE_PER_GAP / self.elasticity.coefficient([0, 0]);
        let fields = solution.pressure.par_iter().zip(&self.surface.gap);
        fields
            .map(|(p, g)| {
                if *p > 0.0 {
                    *p
                } else {
                    -per_gap * g.clamp(0.0, FAR)
                }
            })
            .collect()
    }
}

/// The work of several windows together.
#[derive(Default)]
struct Effort {
    iterations: usize,
    operator_applications: usize,
    stiffness_applications: usize,
    residuals: Vec<f64>,
    contact_stiffness: Option<f64>,
}

impl Effort {
    /// Adds an iterate's, and returns its pressure.
    fn take(&mut self, iterate: Iterate) -> Vec<f64> {
        self.iterations += iterate.iterations;
        self.operator_applications += iterate.operator_applications;
        self.stiffness_applications += iterate.stiffness_applications;
        self.residuals.extend(iterate.residuals);
        self.contact_stiffness = iterate.contact_stiffness;
        iterate.pressure
    }
}

impl LevelResult {
    pub fn values(&self) -> LevelValues {
        LevelValues {
            elements: self.work.elements,
            penetration: self.solution.penetration,
            contact_area: self.summary.contact_area,
            max_pressure: self.summary.max_pressure,
        }
    }
}

/// The solver that the options name.
fn solver(options: SolverOptions) -> Box<dyn Solver> {
    match options.method {
        Method::Gradient => Box::new(GradientSolver { options }),
        Method::ActiveSet => Box::new(ActiveSetSolver { options }),
    }
}
