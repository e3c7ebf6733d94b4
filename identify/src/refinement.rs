//! The best fit under the noise estimated from its own residuals.

use std::rc::Rc;

use crate::{
    FitOptions, IdentifyError, NoiseLevels, Problem,
    least_squares::{LeastSquares, Minimum, Stopping},
    metric::Metric,
    noise::restricted_likelihood::{Part, RestrictedLikelihood},
    normal_equations::NormalEquations,
    predictor::{Evaluation, Predictor},
};

/// Maximum number of alternations between noise and fit; each changes the other less than the one before.
const MOST_ROUNDS: usize = 12;

/// Below this remaining gain in `χ²`, a fit is as accurate as double precision allows.
const NEGLIGIBLE_GAIN: f64 = 1e-12;

/// The best fit, and the covariance of the noise under which it is the best.
pub(crate) struct Refined<'p> {
    pub minimum: Minimum,
    pub metric: Metric<'p>,
    pub levels: NoiseLevels,
}

/// The refinement's inputs, the same in all rounds.
pub(crate) struct Refinement<'s, 'p> {
    pub problem: &'p Problem,
    pub options: &'s FitOptions,
    /// Unknowns that the data determine together.
    pub determined: &'s [usize],
}

impl<'p> Refinement<'_, 'p> {
    /// Estimates the noise and fits under it, in turn, until neither changes. The weights are those of the present
    /// point and do not act on the unknowns: iterated weights solve `Jᵀ V⁻¹ r = 0`. Weights inside the minimised
    /// function would bring a bias, which a determinant would have to remove (R. J. Carroll and D. Ruppert,
    /// Transformation and Weighting in Regression, 1988, section 2.1).
    pub fn run(
        &self,
        predictor: &mut Predictor,
        start: Rc<Evaluation>,
        first: NoiseLevels,
    ) -> Result<Refined<'p>, IdentifyError> {
        let mut at = start;
        let mut levels = first;
        let mut round = 0;
        loop {
            let metric;
            (metric, levels) = self.weighed(&at, levels);
            let mut minimum = self.descend(predictor, &metric, Rc::clone(&at))?;
            round += 1;
            let settled = Rc::ptr_eq(&minimum.at, &at) || minimum.within_jitter || self.is_fixed();
            if settled || round == MOST_ROUNDS {
                minimum.converged &= settled;
                let refined = Refined {
                    minimum,
                    metric,
                    levels,
                };
                return self.polished(predictor, refined);
            }
            at = minimum.at;
        }
    }

    /// The noise estimated at a fit that is not the best, and the problem linearised there.
    pub fn unfinished(
        &self,
        at: Rc<Evaluation>,
        first: NoiseLevels,
    ) -> Result<Refined<'p>, IdentifyError> {
        let (metric, levels) = self.weighed(&at, first);
        let system = metric.system(&at);
        let remaining = NormalEquations::new(&system, &self.free()).possible_decrease()?;
        let minimum = Minimum {
            at,
            system,
            converged: false,
            within_jitter: false,
            remaining,
        };
        Ok(Refined {
            minimum,
            metric,
            levels,
        })
    }

    /// The noise estimated from the residuals at a point, and the metric under it.
    fn weighed(&self, at: &Evaluation, levels: NoiseLevels) -> (Metric<'p>, NoiseLevels) {
        let part = Part {
            problem: self.problem,
            at,
            free: self.determined,
            departures: &[],
        };
        let levels =
            RestrictedLikelihood::new(vec![part], *self.problem.noise(), levels).estimate();
        (Metric::at(self.problem, &levels, at), levels)
    }

    /// Takes one more step without checking `χ²`: its decrease would be lost in the error of the model's derivatives,
    /// while the step itself has only their relative error. If there is no such step, the fit is unchanged.
    fn polished(
        &self,
        predictor: &mut Predictor,
        refined: Refined<'p>,
    ) -> Result<Refined<'p>, IdentifyError> {
        let Minimum {
            converged,
            within_jitter,
            remaining,
            ..
        } = refined.minimum;
        if !converged || within_jitter || remaining < NEGLIGIBLE_GAIN {
            return Ok(refined);
        }
        let free = self.free();
        let search = self.search(&refined.metric, &free);
        let Some(at) = search.full_step(predictor, &refined.minimum)? else {
            return Ok(refined);
        };
        let metric = Metric::at(self.problem, &refined.levels, &at);
        let minimum = Minimum {
            system: metric.system(&at),
            at,
            ..refined.minimum
        };
        Ok(Refined {
            minimum,
            metric,
            levels: refined.levels,
        })
    }

    fn descend(
        &self,
        predictor: &mut Predictor,
        metric: &Metric<'p>,
        at: Rc<Evaluation>,
    ) -> Result<Minimum, IdentifyError> {
        let free = self.free();
        let search = self.search(metric, &free);
        search.descend(predictor, at, |_| false)
    }

    fn free(&self) -> Vec<usize> {
        (0..self.problem.unknowns().len()).collect()
    }

    fn search<'m>(&self, metric: &'m Metric<'p>, free: &'m [usize]) -> LeastSquares<'m, 'p> {
        LeastSquares {
            problem: self.problem,
            metric,
            free,
            stopping: Stopping {
                tolerance: self.options.tolerance,
                degrees: None,
            },
        }
    }

    /// Whether the covariance of the noise is independent of the fit.
    fn is_fixed(&self) -> bool {
        let noise = self.problem.noise();
        noise.is_known() && noise.is_uniform() && self.problem.errors().is_empty()
    }
}
