//! A loading path: many loads on one model, each from coarse to fine, on a domain that holds the contact.

use pellicle_influence::Origin;
use pellicle_texture::{Grid, SampledRelief};

use crate::{
    ContactError, Domain, GridError, Load, Model, Observer, SampledModel, Solution, SolverOptions,
    Summary, Warning, Work, default_side, hierarchy::Hierarchy, solver::Watch, trust,
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
        let mut run = PathRun {
            hierarchy: Hierarchy::new(model, side, elements, loads.len()),
            steps: Vec::new(),
            warnings: Vec::new(),
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

/// A path under way on one domain.
struct PathRun<'a> {
    hierarchy: Hierarchy<'a>,
    steps: Vec<Step>,
    warnings: Vec<Warning>,
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
        for (index, load) in loads.iter().enumerate() {
            let mut watch = Watch {
                observer: &mut *observer,
                step: index,
                steps: loads.len(),
            };
            let step = match self.hierarchy.solve(*load, options, &mut watch) {
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
                    step: index,
                    elements,
                });
            }
            self.steps.push(step);
        }
        Ok(true)
    }

    /// Adds the warnings that need whole solutions and hands the path over.
    fn finish(self, model: &Model) -> Result<LoadingPath, ContactError> {
        let coefficients_seconds = self.hierarchy.coefficients_seconds();
        let coefficients_origin = self.hierarchy.coefficients_origin();
        let SampledModel {
            grid,
            relief,
            indenter_profile,
        } = self.hierarchy.into_sampled()?;
        let mut warnings = self.warnings;
        warnings.extend(trust::model_warnings(model, &grid));
        for (index, step) in self.steps.iter().enumerate() {
            warnings.extend(trust::step_warnings(model, index, step));
        }
        Ok(LoadingPath {
            grid,
            relief,
            indenter_profile,
            warnings,
            coefficients_seconds,
            coefficients_origin,
            solve_seconds: self.steps.iter().map(|step| step.work.seconds).sum(),
            steps: self.steps,
            interrupted: self.interrupted,
        })
    }
}
