//! The zeros of the abscissae: where each curve begins, such as the depth of the first contact where forces are
//! observed at depths.
//!
//! A zero `z` shifts a curve, `y = f(x − z; θ)`, and is no linear nuisance. For given θ it is found by the method of
//! Gauss and Newton, with the linear nuisances eliminated at each step, so that the unknowns of a fit stay few however
//! many curves there are:
//!
//! ```text
//! z ← the zero of the last prediction, or the best of a few
//! repeat: predict f(x − z), f′(x − z);  c ← coefficients of the columns −f′ beside the other nuisances
//!         z ← z + c, half as far for a curve whose misfit has grown
//! until c moves every curve by less than a thousandth of its noise
//! ```
//!
//! What is left of `c` is eliminated with the metric of the fit (metric.rs), whose noise is not that assumed here.

use std::ops::Range;

use crate::{
    Curve, ForwardError, ForwardModel, Prediction, Problem,
    metric::Metric,
    nuisance::NuisanceColumn,
    orthonormal_basis::{OrthonormalBasis, dot},
    predictor::Evaluation,
};

/// Number of predictions in which a zero is found. From a start that is off by the whole curve it takes some ten.
const MOST_STEPS: usize = 40;
/// The zeros are found when a further step would move every point by less than this fraction of the misfit.
const ACCURACY: f64 = 1e-3;
/// A zero lies at most this many lengths of its curve before the first abscissa, and this many before the last: farther
/// away a segment is straight.
const LENGTHS: [f64; 2] = [20.0, 0.02];
/// The longest step, in lengths of the curve.
const LONGEST_STEP: f64 = 0.25;
/// The zeros tried first, in lengths of the curve after its first abscissa, besides the one that it gives.
const TRIALS: [f64; 4] = [-0.1, 0.0, 0.3, 0.6];

/// The prediction of a problem's model, with the zeros of its abscissae as they fit best; `last` are the origins of an
/// earlier prediction.
pub(crate) fn prediction(
    model: &dyn ForwardModel,
    problem: &Problem,
    parameters: &[f64],
    last: Option<&[f64]>,
) -> Result<Prediction, ForwardError> {
    if !problem.has_abscissa_zeros() {
        return model.predict(parameters);
    }
    let search = Search {
        model,
        problem,
        parameters,
    };
    let first = match last {
        Some(last) => problem
            .spans()
            .iter()
            .map(|span| last[span.start])
            .collect(),
        None => search.best_trials()?,
    };
    search.settled(first)
}

impl Problem {
    /// What a model predicts for the points of this problem, with the zeros of their abscissae as they fit best.
    ///
    /// # Errors
    ///
    /// [`ForwardError`] where the model has no prediction.
    pub fn predict(
        &self,
        model: &dyn ForwardModel,
        parameters: &[f64],
    ) -> Result<Prediction, ForwardError> {
        prediction(model, self, parameters, None)
    }
}

struct Search<'a> {
    model: &'a dyn ForwardModel,
    problem: &'a Problem,
    parameters: &'a [f64],
}

/// A prediction from some origins.
struct Trial {
    prediction: Prediction,
    /// For each curve, χ² with the linear nuisances eliminated and the zeros at the origins, their priors included.
    misfits: Vec<f64>,
    /// The step of each zero to the least χ² of the linearised problem.
    steps: Vec<f64>,
    /// The length of each curve's column of slopes, and the root mean square of all residuals: both whitened.
    columns: Vec<f64>,
    size: f64,
}

/// The zero of one curve, on its way.
struct Walk {
    ends: [f64; 2],
    base: f64,
    least: f64,
    step: f64,
}

impl Search<'_> {
    /// The best of a few zeros for each curve.
    fn best_trials(&self) -> Result<Vec<f64>, ForwardError> {
        let curves = self.problem.curves();
        let shown = |curve: &Curve| curve.origin().unwrap_or(0.0);
        let mut best: Vec<f64> = curves.iter().map(shown).collect();
        let mut least = self.trial(&best)?.misfits;
        for part in TRIALS {
            let ends = curves.iter().map(|curve| range(curve.abscissa()));
            let origins: Vec<f64> = ends.map(|[low, high]| low + part * (high - low)).collect();
            let misfits = self.trial(&origins)?.misfits;
            for (index, found) in misfits.into_iter().enumerate() {
                if found < least[index] {
                    (least[index], best[index]) = (found, origins[index]);
                }
            }
        }
        Ok(best)
    }

    /// The prediction from the zeros found from these.
    fn settled(&self, origins: Vec<f64>) -> Result<Prediction, ForwardError> {
        let curves = self.problem.curves().iter().zip(origins);
        let mut walks: Vec<Walk> = curves
            .map(|(curve, base)| Walk {
                ends: range(curve.abscissa()),
                base,
                least: f64::INFINITY,
                step: 0.0,
            })
            .collect();
        let mut steps_left = MOST_STEPS;
        loop {
            let origins: Vec<f64> = walks.iter().map(|walk| walk.base + walk.step).collect();
            let trial = self.trial(&origins)?;
            for (curve, walk) in walks.iter_mut().enumerate() {
                walk.go_on(trial.misfits[curve], trial.steps[curve]);
            }
            let is_settled =
                |(walk, column): (&Walk, &f64)| walk.step.abs() * column <= ACCURACY * trial.size;
            steps_left -= 1;
            if steps_left == 0 || walks.iter().zip(&trial.columns).all(is_settled) {
                return Ok(trial.prediction);
            }
        }
    }

    fn trial(&self, origins: &[f64]) -> Result<Trial, ForwardError> {
        let problem = self.problem;
        let (spans, unknowns) = (problem.spans(), problem.unknowns());
        let pairs = spans.iter().zip(origins);
        let each = pairs.flat_map(|(span, origin)| std::iter::repeat_n(*origin, span.len()));
        let each: Vec<f64> = each.collect();
        let prediction = self.model.predict_from(self.parameters, &each)?;
        if !prediction.is_complete(problem.points(), unknowns.len()) {
            return Err(ForwardError::Incomplete);
        }
        let levels = problem.first_levels();
        let metric = Metric::new(problem, &levels, problem.observed(), &prediction.slope);
        let at = Evaluation::of(unknowns, self.parameters, prediction.clone());
        let (mut residual, _) = metric.rows(&at);
        let (of_slopes, others): (Vec<_>, Vec<_>) = (problem.columns().iter())
            .zip(metric.nuisance_columns())
            .partition(|(column, _)| column.by_slope);
        let mut basis = OrthonormalBasis::of(others.into_iter().map(|(_, column)| column));
        let first = basis.columns();
        basis.remove_from(&mut residual);
        let misfit = |span: &Range<usize>| dot(&residual[span.clone()], &residual[span.clone()]);
        let mut misfits: Vec<f64> = spans.iter().map(misfit).collect();
        let size = (dot(&residual, &residual) / problem.points() as f64).sqrt();
        let mut columns = vec![0.0; origins.len()];
        // The only curve of a problem has the index that it has among several.
        let place = |column: &NuisanceColumn| match column.curve {
            Some(curve) if origins.len() > 1 => curve,
            _ => 0,
        };
        for (column, whitened) in &of_slopes {
            basis.push(whitened.clone());
            let curve = place(column);
            columns[curve] = dot(whitened, whitened).sqrt();
            if let Some([mean, sd]) = column.prior {
                misfits[curve] += ((mean - origins[curve]) / sd).powi(2);
            }
        }
        let components = basis.remove_from(&mut residual);
        let coefficients = basis.coefficients(&components).split_off(first);
        let mut steps = vec![0.0; origins.len()];
        for ((column, _), c) in of_slopes.iter().zip(coefficients) {
            steps[place(column)] = c;
        }
        Ok(Trial {
            prediction,
            misfits,
            steps,
            columns,
            size,
        })
    }
}

impl Walk {
    /// Takes the step to a better zero, or half of the one that failed.
    fn go_on(&mut self, misfit: f64, step: f64) {
        if misfit > self.least {
            self.step *= 0.5;
            return;
        }
        let [low, high] = self.ends;
        let length = high - low;
        let [before, after] = LENGTHS.map(|lengths| lengths * length);
        self.base += self.step;
        self.least = misfit;
        let longest = LONGEST_STEP * length;
        let target = self.base + step.clamp(-longest, longest);
        self.step = target.clamp(low - before, high - after) - self.base;
    }
}

/// The smallest and the largest of some values.
fn range(values: &[f64]) -> [f64; 2] {
    let start = [f64::INFINITY, f64::NEG_INFINITY];
    let widened = |[low, high]: [f64; 2], value: &f64| [low.min(*value), high.max(*value)];
    values.iter().fold(start, widened)
}
