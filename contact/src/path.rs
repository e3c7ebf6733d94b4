//! A loading path: many loads on one model, each from coarse to fine, on a domain that holds the contact.
//!
//! Each load starts from its own solution on coarser grids, which was measured to be nearer than the load before, by itself or as a correction: one to
//! three products fewer. So no load depends on another, bit for bit, and on grids too small to keep all threads busy as many loads are solved at
//! the same time as there are threads.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use pellicle_influence::{Origin, SurfaceElasticity};
use pellicle_texture::{Grid, SampledRelief};
use rayon::prelude::*;

use crate::{
    ContactError, DeformedSurface, Domain, GridError, Load, Model, Observer, Progress,
    SampledModel, Signal, Solution, SolverOptions, Summary, Warning, Work, default_side,
    hierarchy::Hierarchy,
    model::initial_gap,
    solver::Watch,
    trust,
    window::{Room, Window},
};

/// How often an automatic domain may grow, and by how much each time.
const ENLARGEMENTS: usize = 8;
const ENLARGEMENT: f64 = 1.5;
/// A contact is near the edge with fewer whole elements than this between.
const EDGE_MARGIN: usize = 3;

/// Elements of all loads that are solved at the same time, at most: each takes some 100 bytes beside its solution.
const ELEMENTS_AT_ONCE: usize = 1 << 21;

/// A solved path.
#[derive(Debug, Clone)]
pub struct LoadingPath {
    /// The finest grid.
    pub grid: Grid,
    /// The relief on it.
    pub relief: SampledRelief,
    /// Indenter profile `f` on it, in m; N² values.
    pub indenter_profile: Vec<f64>,
    /// One step per load, in the order given.
    pub steps: Vec<Step>,
    /// What a user should know.
    pub warnings: Vec<Warning>,
    /// Time spent on coefficients of all grids, in s; the radial tables are built before.
    pub coefficients_seconds: f64,
    /// Where the coefficients of all grids together came from; the radial tables are not among them.
    pub coefficients_origin: Origin,
    /// Time spent in solvers, in s; less than the steps' own times together where several were solved at once.
    pub solve_seconds: f64,
    /// Whether the observer cancelled, so that only the loads before the first unfinished one are here.
    pub interrupted: bool,
    elasticity: Arc<SurfaceElasticity>,
}

impl LoadingPath {
    /// The surface at a step, afresh from its pressure by one product with `K`: a path keeps the pressures alone, a quarter of the memory.
    ///
    /// # Panics
    /// If there is no such step.
    #[must_use]
    pub fn surface(&self, step: usize) -> DeformedSurface {
        let Solution {
            pressure,
            penetration,
            ..
        } = &self.steps[step].solution;
        let size = self.grid.size();
        let window = Window::around(size, |e| pressure[e] > 0.0, Room::ForOne);
        let mut operator = (self.elasticity).spread(size, window.origin(), window.size());
        let mut surface = DeformedSurface {
            displacement: vec![0.0; pressure.len()],
            ..DeformedSurface::default()
        };
        operator.apply_into(&window.cut(pressure), &mut surface.displacement);
        let initial_gap = initial_gap(&self.indenter_profile, &self.relief);
        surface.add_up(pressure, self.relief.compliance(), &initial_gap);
        surface.lower_by(*penetration);
        surface
    }
}

/// One load's solution. It is converged if its certificate is satisfied.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    /// The pressure and its certificate.
    pub solution: Solution,
    /// The numbers that describe it.
    pub summary: Summary,
    /// What it cost.
    pub work: Work,
    /// How far the grid can be trusted.
    pub grid_error: GridError,
    /// Largest line of the certificate at each iteration on the finest grid, by the iteration's own residual.
    pub residuals: Vec<f64>,
    /// Contact stiffness `dQ/dD`, in N/m; none without contact, or where it was not asked for or not found.
    pub contact_stiffness: Option<f64>,
}

/// Solves `model` for every one of `loads` on `elements` × `elements` elements.
///
/// A step that misses its tolerance is in the path with an unsatisfied certificate and a warning, not an error. If the observer
/// cancels, the path holds the steps before the first that is not finished.
///
/// # Errors
/// A load, tolerance, side or grid that makes no sense; coefficients that miss their accuracy; a contact that outgrows every domain.
pub fn solve_path(
    model: &Model,
    domain: Domain,
    elements: usize,
    loads: &[Load],
    options: &SolverOptions,
    observer: &mut dyn Observer,
) -> Result<LoadingPath, ContactError> {
    let options = options.checked_for(elements)?;
    for load in loads {
        load.checked()?;
    }
    // On a thread of the pool from beginning to end: every parallel loop entered from outside would cost two changes of thread.
    rayon::scope(|_| solve_on_domains(model, domain, elements, loads, options, observer))
}

/// Solves the path on ever larger domains, until one holds the contact.
fn solve_on_domains(
    model: &Model,
    domain: Domain,
    elements: usize,
    loads: &[Load],
    options: SolverOptions,
    observer: &mut dyn Observer,
) -> Result<LoadingPath, ContactError> {
    let mut side = match domain {
        Domain::Side(side) => side,
        Domain::Automatic => default_side(model, loads),
    };
    for _ in 0..=ENLARGEMENTS {
        let hierarchy = Hierarchy::new(model, side, elements, loads.len());
        let mut run = PathRun {
            lanes: hierarchy.lanes(lanes(elements, loads.len()))?,
            steps: Vec::new(),
            warnings: Vec::new(),
            solve_seconds: 0.0,
            interrupted: false,
        };
        if run.solve_all(loads, domain, options, observer)? {
            return run.finish(model);
        }
        side *= ENLARGEMENT;
    }
    Err(ContactError::DomainTooSmall {
        side: side / ENLARGEMENT,
        enlargements: ENLARGEMENTS,
    })
}

/// How many loads to solve at the same time: one on a grid that keeps several threads busy by itself.
fn lanes(elements: usize, loads: usize) -> usize {
    let most = (ELEMENTS_AT_ONCE / elements.pow(2)).max(1);
    rayon::current_num_threads().min(most).min(loads.max(1))
}

/// A path under way on one domain.
struct PathRun<'a> {
    lanes: Vec<Hierarchy<'a>>,
    steps: Vec<Step>,
    warnings: Vec<Warning>,
    solve_seconds: f64,
    interrupted: bool,
}

impl PathRun<'_> {
    /// Solves every load; false as soon as an automatic domain turns out too small.
    fn solve_all(
        &mut self,
        loads: &[Load],
        domain: Domain,
        options: SolverOptions,
        observer: &mut dyn Observer,
    ) -> Result<bool, ContactError> {
        for together in loads.chunks(self.lanes.len()) {
            for outcome in self.solve_together(together, loads.len(), options, observer) {
                let step = match outcome {
                    Err(ContactError::Cancelled { .. }) => {
                        self.interrupted = true;
                        return Ok(true);
                    }
                    outcome => outcome?,
                };
                let to_edge = trust::elements_to_edge(&step.solution.pressure);
                if let Some(elements) = to_edge.filter(|elements| *elements < EDGE_MARGIN) {
                    if domain == Domain::Automatic {
                        return Ok(false);
                    }
                    self.warnings.push(Warning::DomainEdge {
                        step: self.steps.len(),
                        elements,
                    });
                }
                self.steps.push(step);
            }
        }
        Ok(true)
    }

    /// Solves the next loads of `steps`, no more than there are lanes, all at the same time.
    fn solve_together(
        &mut self,
        loads: &[Load],
        steps: usize,
        options: SolverOptions,
        observer: &mut dyn Observer,
    ) -> Vec<Result<Step, ContactError>> {
        let (clock, spent_before) = (Instant::now(), self.coefficients_seconds());
        let finished = self.steps.len();
        let observer = Mutex::new(observer);
        let lanes = self.lanes.par_iter_mut().zip(loads).enumerate();
        let solve = |(index, (lane, load)): (usize, (&mut Hierarchy<'_>, &Load))| {
            let mut watch = Watch {
                observer: &mut InTurn(&observer),
                step: finished + index,
                finished,
                steps,
            };
            lane.solve(*load, options, &mut watch)
        };
        let outcomes = lanes.map(solve).collect();
        let on_coefficients = self.coefficients_seconds() - spent_before;
        self.solve_seconds += clock.elapsed().as_secs_f64() - on_coefficients;
        outcomes
    }

    /// Time spent on coefficients of all grids; those of a single lane are made when they are first needed.
    fn coefficients_seconds(&self) -> f64 {
        self.lanes.iter().map(Hierarchy::coefficients_seconds).sum()
    }

    /// Adds the warnings that need whole solutions and hands the path over.
    fn finish(mut self, model: &Model) -> Result<LoadingPath, ContactError> {
        let coefficients_seconds = self.coefficients_seconds();
        let hierarchy = self.lanes.swap_remove(0);
        drop(self.lanes);
        let coefficients_origin = hierarchy.coefficients_origin();
        let (sampled, elasticity) = hierarchy.into_finest()?.into_parts();
        let SampledModel {
            grid,
            relief,
            indenter_profile,
        } = sampled;
        let mut warnings = self.warnings;
        warnings.extend(trust::model_warnings(model, &grid));
        for (index, step) in self.steps.iter().enumerate() {
            warnings.extend(trust::step_warnings(model, &relief, index, step));
        }
        Ok(LoadingPath {
            grid,
            relief,
            indenter_profile,
            warnings,
            coefficients_seconds,
            coefficients_origin,
            solve_seconds: self.solve_seconds,
            steps: self.steps,
            interrupted: self.interrupted,
            elasticity,
        })
    }
}

/// An observer that several lanes tell, one at a time.
struct InTurn<'a, 'b>(&'a Mutex<&'b mut dyn Observer>);

impl Observer for InTurn<'_, '_> {
    fn progress(&mut self, progress: &Progress) -> Signal {
        let mut observer = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        observer.progress(progress)
    }
}
