//! The neighbourhood of the best fit, from several starts.

use std::rc::Rc;

use crate::{
    FitOptions, ForwardError, IdentifyError, Problem,
    least_squares::{LeastSquares, Minimum, Stopping, difference},
    metric::Metric,
    orthonormal_basis::dot,
    predictor::{Evaluation, Predictor},
    start::start,
};

/// Tolerance of a first search, in units of χ²: a third of a standard error, less than the later estimate of the noise
/// will move the fit.
const COARSE: f64 = 0.1;
/// Two searches agree if they end within this many standard errors of each other.
const AGREEMENT: f64 = 1.0;

/// A fit with χ² per degree of freedom above this is clearly wrong, and may be in the wrong one of several minima.
const IMPLAUSIBLE: f64 = 3.0;

/// A fit with χ² per degree of freedom below this needs no second start.
const GOOD: f64 = 1.5;

/// The end of the best of several searches, and whether another one led elsewhere.
pub(crate) struct Found {
    pub at: Rc<Evaluation>,
    pub several_minima: bool,
}

/// Searches from one start after another until two agree on a plausible fit, or one is good.
pub(crate) fn search(
    problem: &Problem,
    predictor: &mut Predictor,
    options: &FitOptions,
) -> Result<Option<Found>, IdentifyError> {
    let free: Vec<usize> = (0..problem.unknowns().len()).collect();
    let stopping = Stopping {
        tolerance: COARSE,
        degrees: (!problem.noise().is_given()).then(|| degrees(problem)),
    };
    let mut metric: Option<Metric> = None;
    let mut best: Option<Minimum> = None;
    let mut several_minima = false;
    for index in 0..options.starts {
        let mut position = start(problem.unknowns(), index);
        if index == 0 {
            position = predictor.with_zeros_held(position, stopping)?;
        }
        let Some(first) = predictor.evaluate(&position)? else {
            continue;
        };
        let metric = metric.get_or_insert_with(|| Metric::provisional(problem, &first));
        let search = LeastSquares {
            problem,
            metric,
            free: &free,
            stopping,
        };
        let agrees = |at: &Evaluation| {
            best.as_ref()
                .is_some_and(|known| agree(known, at, &stopping))
        };
        let minimum = search.descend(predictor, first, agrees)?;
        if agrees(&minimum.at) {
            if is_plausible(problem, &minimum) {
                break;
            }
            continue;
        }
        let Some(known) = &best else {
            let is_good = is_good(problem, &minimum);
            best = Some(minimum);
            if is_good {
                break;
            }
            continue;
        };
        several_minima = minimum.converged;
        if minimum.system.chi_squared < known.system.chi_squared {
            best = Some(minimum);
        }
    }
    Ok(best.map(|minimum| Found {
        at: minimum.at,
        several_minima,
    }))
}

/// The error of a model that has no prediction at any start.
pub(crate) fn no_start(predictor: &mut Predictor, starts: usize) -> IdentifyError {
    let source = predictor
        .take_last_failure()
        .unwrap_or(ForwardError::Incomplete);
    IdentifyError::NoStart { starts, source }
}

/// The prediction nearest to the data, all measured with the same weights; `None` if there is none.
pub(crate) fn best_so_far(predictor: &Predictor, problem: &Problem) -> Option<Rc<Evaluation>> {
    let metric = Metric::provisional(problem, predictor.evaluations().next()?);
    let misfits = predictor
        .evaluations()
        .map(|at| (metric.system(at).chi_squared, at));
    let best = misfits.min_by(|(one, _), (other, _)| one.total_cmp(other));
    best.map(|(_, at)| Rc::clone(at))
}

fn degrees(problem: &Problem) -> f64 {
    let fitted = problem.unknowns().len() + problem.columns().len();
    problem.points().saturating_sub(fitted).max(1) as f64
}

/// Whether a fit is as near to the data as their noise allows; always true if the noise is not given.
fn is_plausible(problem: &Problem, minimum: &Minimum) -> bool {
    !problem.noise().is_given() || minimum.system.chi_squared <= IMPLAUSIBLE * degrees(problem)
}

/// Whether a fit follows the data within known noise, so that no other minimum can do better.
fn is_good(problem: &Problem, minimum: &Minimum) -> bool {
    problem.noise().is_given() && minimum.system.chi_squared <= GOOD * degrees(problem)
}

/// Whether a point lies within a standard error of a minimum, measured by `‖J (x − x₀)‖²`.
fn agree(known: &Minimum, at: &Evaluation, stopping: &Stopping) -> bool {
    let step = difference(&at.position, &known.at.position);
    let system = &known.system;
    let mut change = vec![0.0; system.residual.len()];
    for (column, s) in system.jacobian.iter().zip(&step) {
        for (c, g) in change.iter_mut().zip(column) {
            *c += s * g;
        }
    }
    let scale = stopping
        .degrees
        .map_or(1.0, |degrees| system.chi_squared / degrees);
    dot(&change, &change) <= AGREEMENT * AGREEMENT * scale
}
