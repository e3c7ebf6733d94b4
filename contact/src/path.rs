//! A loading path: many loads on one model, each from coarse to fine, on a domain that holds the contact.

use std::time::Instant;

use pellicle_influence::Origin;
use pellicle_texture::{Grid, SampledRelief};

use crate::{
    ContactError, Domain, GridError, Load, Model, Observer, SampledModel, Solution, SolverOptions,
    Summary, Warning, Work, default_side,
    level::{Level, LevelResult},
    levels::{COARSE_TOLERANCE, Field, coarser_sizes},
    solver::Watch,
    trust,
};

/// How often an automatic domain may grow, and by how much each time.
const ENLARGEMENTS: usize = 8;
const ENLARGEMENT: f64 = 1.5;
/// A contact is near the edge with fewer whole elements than this between.
const EDGE_MARGIN: usize = 3;

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
    /// Time spent in solvers, in s.
    pub solve_seconds: f64,
    /// Whether the observer cancelled, so that only the loads before it are solved.
    pub interrupted: bool,
}

/// One load's solution. It is converged if its certificate is satisfied.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    /// The fields and their certificate.
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
/// cancels, the path holds the steps finished until then.
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
    let mut side = match domain {
        Domain::Side(side) => side,
        Domain::Automatic => default_side(model, loads),
    };
    for _ in 0..=ENLARGEMENTS {
        let mut run = PathRun::start(model, side, elements, options)?;
        let contained = run.solve_all(loads, domain, observer)?;
        if contained {
            return Ok(run.finish(model));
        }
        side *= ENLARGEMENT;
    }
    Err(ContactError::DomainTooSmall {
        side: side / ENLARGEMENT,
        enlargements: ENLARGEMENTS,
    })
}

/// A path under way on one domain.
struct PathRun {
    options: SolverOptions,
    /// Coarsest first.
    coarse: Vec<Level>,
    finest: Level,
    steps: Vec<Step>,
    warnings: Vec<Warning>,
    coefficients_seconds: f64,
    interrupted: bool,
}

/// The field of a solved level.
fn field<'a>((values, level): &'a (Vec<f64>, &Level)) -> Field<'a> {
    Field {
        values,
        mask: level.mask(),
    }
}

impl PathRun {
    /// Samples the model and assembles the coefficients on every level.
    fn start(
        model: &Model,
        side: f64,
        elements: usize,
        options: SolverOptions,
    ) -> Result<Self, ContactError> {
        let clock = Instant::now();
        let level = |size: usize| Level::new(model, side, size);
        Ok(Self {
            options,
            finest: level(elements)?,
            coarse: coarser_sizes(elements)
                .into_iter()
                .map(level)
                .collect::<Result<_, _>>()?,
            steps: Vec::new(),
            warnings: Vec::new(),
            coefficients_seconds: clock.elapsed().as_secs_f64(),
            interrupted: false,
        })
    }

    /// Solves every load; false as soon as an automatic domain turns out too small.
    fn solve_all(
        &mut self,
        loads: &[Load],
        domain: Domain,
        observer: &mut dyn Observer,
    ) -> Result<bool, ContactError> {
        for (index, load) in loads.iter().enumerate() {
            let mut watch = Watch {
                observer: &mut *observer,
                step: index,
                steps: loads.len(),
            };
            let step = match self.solve_step(*load, &mut watch) {
                Err(ContactError::Cancelled { .. }) => {
                    self.interrupted = true;
                    return Ok(true);
                }
                outcome => outcome?,
            };
            let to_edge =
                trust::elements_to_edge(&step.solution.pressure, &self.finest.sampled.grid);
            if let Some(elements) = to_edge.filter(|elements| *elements < EDGE_MARGIN) {
                if domain == Domain::Automatic {
                    return Ok(false);
                }
                self.warnings.push(Warning::DomainEdge {
                    step: index,
                    elements,
                });
            }
            self.steps.push(step);
        }
        Ok(true)
    }

    /// Solves one load from the coarsest level to the finest.
    fn solve_step(&mut self, load: Load, watch: &mut Watch<'_>) -> Result<Step, ContactError> {
        let clock = Instant::now();
        let coarse_options = SolverOptions {
            tolerance: self.options.tolerance.max(COARSE_TOLERANCE),
            contact_stiffness: false,
            ..self.options
        };
        let (mut levels, mut values) = (Vec::new(), Vec::new());
        let mut coarser: Option<(Vec<f64>, &Level)> = None;
        for level in &mut self.coarse {
            let start = coarser.as_ref().map(field);
            let result = level.solve(load, start, coarse_options, watch)?;
            levels.push(result.work);
            values.push(result.values());
            coarser = Some((result.field, level));
        }
        let start = coarser.as_ref().map(field);
        let result = self.finest.solve(load, start, self.options, watch)?;
        levels.push(result.work);
        values.push(result.values());
        let work = Work {
            iterations: result.work.iterations,
            operator_applications: result.work.operator_applications,
            stiffness_applications: result.work.stiffness_applications,
            seconds: clock.elapsed().as_secs_f64(),
            levels,
        };
        let LevelResult {
            solution,
            summary,
            residuals,
            contact_stiffness,
            ..
        } = result;
        Ok(Step {
            solution,
            summary,
            work,
            grid_error: GridError::new(values),
            residuals,
            contact_stiffness,
        })
    }

    /// Where the coefficients of all levels together came from.
    fn coefficients_origin(&self) -> Origin {
        let origins = self.coarse.iter().map(|level| level.coefficients_origin);
        origins.fold(self.finest.coefficients_origin, Origin::max)
    }

    /// Adds the warnings that need whole solutions and hands the path over.
    fn finish(self, model: &Model) -> LoadingPath {
        let coefficients_origin = self.coefficients_origin();
        let interrupted = self.interrupted;
        let SampledModel {
            grid,
            relief,
            indenter_profile,
        } = self.finest.sampled;
        let mut warnings = self.warnings;
        warnings.extend(trust::model_warnings(model, &grid));
        for (index, step) in self.steps.iter().enumerate() {
            warnings.extend(trust::step_warnings(model, index, step));
        }
        LoadingPath {
            grid,
            relief,
            indenter_profile,
            warnings,
            coefficients_seconds: self.coefficients_seconds,
            coefficients_origin,
            solve_seconds: self.steps.iter().map(|step| step.work.seconds).sum(),
            steps: self.steps,
            interrupted,
        }
    }
}
