//! The fit as a whole.

use std::rc::Rc;

use crate::{
    Fit, FitOptions, FitVerdict, FitWarning, FitWork, FittedPoints, ForwardModel, Goodness,
    IdentifyError, Outlier, Problem, Scatter, global_search,
    goodness::{NoiseScale, OtherTests, Residuals, lower_half_score, smooth_score},
    noise::restricted_likelihood::{Part, RestrictedLikelihood},
    null_direction::NullSpace,
    outlier,
    predictor::{Evaluation, Predictor},
    refinement::{Refined, Refinement},
    repeats::Repeats,
    result::correlation,
};

mod covariance;
mod departure;
mod estimates;
mod explained;
mod exponents;
mod intervals;
mod scans;
mod stopped;

pub use explained::explained;
pub use exponents::exponents;
use intervals::{Interval, Scanned, Sought, missing_profiles};

/// Finds the unknowns of a problem and their intervals, and states what the data cannot determine.
///
/// If the model ends the fit with [`ForwardError::Stopped`](crate::ForwardError::Stopped), the result so far is
/// returned: see [`Fit::stopped`].
///
/// # Errors
///
/// [`IdentifyError::NoStart`] if the model has no prediction at any start, [`IdentifyError::Stopped`] if it ended the
/// fit before its first prediction, [`IdentifyError::Number`] for invalid options. A search that does not converge and
/// a model that does not follow the data are verdicts of the fit, not errors.
pub fn identify(
    model: &dyn ForwardModel,
    problem: &Problem,
    options: &FitOptions,
) -> Result<Fit, IdentifyError> {
    options.check()?;
    let mut predictor = Predictor::new(model, problem);
    match searched(&mut predictor, problem, options) {
        Err(stopped @ IdentifyError::Stopped { .. }) => {
            let Some(best) = global_search::best_so_far(&predictor, problem) else {
                return Err(stopped);
            };
            Fitting::new(problem, options, Vec::new())?.unfinished(&predictor, best)
        }
        found => found,
    }
}

/// Searches and refines; [`IdentifyError::Stopped`] if the model ended the fit before the best one was found.
fn searched(
    predictor: &mut Predictor,
    problem: &Problem,
    options: &FitOptions,
) -> Result<Fit, IdentifyError> {
    let Some(found) = global_search::search(problem, predictor, options)? else {
        return Err(global_search::no_start(predictor, options.starts));
    };
    let mut warnings = Vec::new();
    if found.several_minima {
        warnings.push(FitWarning::SeveralMinima);
    }
    match problem.scatter() {
        Scatter::BetweenCurves if problem.curves().len() > 1 => {
            let mut fit = Repeats::new(problem, options)?.run(predictor, &found.at)?;
            fit.warnings.extend(warnings);
            Ok(fit)
        }
        Scatter::None | Scatter::BetweenCurves => {
            Fitting::new(problem, options, warnings)?.run(predictor, found.at)
        }
    }
}

/// Jitter is reported from this gain in χ² on: a tenth of a standard error.
const REPORTED_JITTER: f64 = 0.01;
/// Maximum number of restarts from better fits found by profiles.
const MOST_RESTARTS: usize = 3;

/// A fit under way.
struct Fitting<'p> {
    problem: &'p Problem,
    options: &'p FitOptions,
    null_space: NullSpace,
    /// Unknowns that the data determine together.
    determined: Vec<usize>,
    warnings: Vec<FitWarning>,
}

impl<'p> Fitting<'p> {
    fn new(
        problem: &'p Problem,
        options: &'p FitOptions,
        warnings: Vec<FitWarning>,
    ) -> Result<Self, IdentifyError> {
        let null_space = problem.null_directions().among(problem.unknowns())?;
        let held = null_space.hold()?;
        let determined = (0..problem.unknowns().len())
            .filter(|j| !held.contains(j))
            .collect();
        Ok(Self {
            problem,
            options,
            null_space,
            determined,
            warnings,
        })
    }

    /// Refines the fit and scans the profiles; starts again from a better fit if a profile finds one.
    fn run(
        mut self,
        predictor: &mut Predictor,
        start: Rc<Evaluation>,
    ) -> Result<Fit, IdentifyError> {
        let levels = self.problem.first_levels();
        let mut refined = self.refinement().run(predictor, start, levels)?;
        let mut search = predictor.predictions();
        for _ in 0..MOST_RESTARTS {
            let sought = self.sought(&refined)?;
            let intervals = match self.scan(predictor, &refined, &sought)? {
                Scanned::All(intervals) => intervals,
                Scanned::Better(unknown, at) => {
                    self.warnings.push(FitWarning::BetterFitFound(unknown));
                    refined = self.refinement().run(predictor, at, refined.levels)?;
                    search = predictor.predictions();
                    continue;
                }
            };
            return Ok(self.finish(predictor, &refined, &sought, intervals, search));
        }
        // If the profiles keep finding better fits, this is not a minimum.
        refined.minimum.converged = false;
        let sought = self.sought(&refined)?;
        let intervals = sought
            .iter()
            .map(|one| one.wald_interval(self.problem))
            .collect();
        Ok(self.finish(predictor, &refined, &sought, intervals, search))
    }

    fn refinement(&self) -> Refinement<'_, 'p> {
        Refinement {
            problem: self.problem,
            options: self.options,
            determined: &self.determined,
        }
    }

    /// Degrees of freedom behind the variance of each unknown.
    fn degrees(&self, refined: &Refined) -> Result<Vec<f64>, IdentifyError> {
        let mut degrees = vec![f64::INFINITY; self.problem.unknowns().len()];
        if self.problem.noise().is_known() {
            return Ok(degrees);
        }
        let of_determined = self.likelihood(refined).degrees_of_freedom()?;
        let least = of_determined.iter().copied().fold(f64::INFINITY, f64::min);
        degrees.fill(least);
        for (&j, value) in self.determined.iter().zip(of_determined) {
            degrees[j] = value;
        }
        Ok(degrees)
    }

    fn likelihood<'r>(&'r self, refined: &'r Refined) -> RestrictedLikelihood<'r> {
        let part = Part {
            problem: self.problem,
            at: &refined.minimum.at,
            free: &self.determined,
            departures: &[],
        };
        RestrictedLikelihood::new(vec![part], *self.problem.noise(), refined.levels)
    }

    /// Assembles the result.
    fn finish(
        mut self,
        predictor: &Predictor,
        refined: &Refined,
        sought: &[Sought],
        intervals: Vec<Interval>,
        search: usize,
    ) -> Fit {
        self.warn(refined);
        let goodness = self.goodness(refined, sought);
        let points = self.points(refined);
        let outliers = self.outliers(refined, &points);
        let verdict = FitVerdict::of(refined.minimum.converged, &goodness, !outliers.is_empty());
        let covariance = self.covariance(refined);
        Fit {
            verdict,
            stopped: missing_profiles(&intervals),
            estimates: self.estimates(refined, sought, intervals),
            coefficients: self.coefficients(refined, sought),
            correlation: correlation(&covariance),
            covariance,
            noise: refined.levels,
            goodness,
            departure: self.departure(refined, verdict, &points),
            points,
            outliers,
            excluded: Vec::new(),
            odd: None,
            work: FitWork {
                curves_solved: predictor.predictions(),
                search,
            },
            warnings: self.warnings,
        }
    }

    fn warn(&mut self, refined: &Refined) {
        if refined.minimum.within_jitter && refined.minimum.remaining > REPORTED_JITTER {
            self.warnings.push(FitWarning::Jitter);
        }
        for (j, unknown) in self.problem.unknowns().iter().enumerate() {
            if unknown.bounds().contains(&refined.minimum.at.position[j]) {
                self.warnings.push(FitWarning::AtBound(j));
            }
        }
    }

    fn goodness(&self, refined: &Refined, sought: &[Sought]) -> Goodness {
        let problem = self.problem;
        let whitened = &refined.minimum.system.residual;
        let fitted = self.determined.len() + refined.metric.nuisance_rank();
        let least = sought
            .iter()
            .map(|one| one.degrees)
            .fold(f64::INFINITY, f64::min);
        let known = problem.noise().is_known();
        let at = (&refined.metric, &*refined.minimum.at);
        let scores = [
            lower_half_score(problem, at.0, at.1, &self.determined),
            smooth_score(problem, at.0, at.1, &self.determined),
        ];
        let degrees = whitened.len().saturating_sub(fitted).max(1) as f64;
        let chi_squared = refined.minimum.system.chi_squared;
        let scale = NoiseScale::of(problem, least, [chi_squared, degrees]);
        let [lower_half_p, smooth_p] = scores.map(|score| scale.probability(score));
        Residuals {
            series: problem
                .spans()
                .iter()
                .map(|span| &whitened[span.clone()])
                .collect(),
            chi_squared,
            points: problem.points(),
            degrees,
            known,
        }
        .judge(&OtherTests {
            lower_half: lower_half_p,
            smooth: smooth_p,
            persistence: self.likelihood(refined).persistence_p(),
            common: None,
        })
    }

    fn outliers(&self, refined: &Refined, points: &FittedPoints) -> Vec<Outlier> {
        let series = outlier::Series {
            residual: &points.residual,
            observed: self.problem.observed(),
            deviation: &(refined.levels).deviations(&refined.minimum.at, self.problem.errors()),
            is_told: self.problem.noise().is_given(),
        };
        outlier::outliers(&series, self.problem.spans())
    }

    fn points(&self, refined: &Refined) -> FittedPoints {
        let problem = self.problem;
        let mut model = refined.minimum.at.value.clone();
        for (column, c) in problem
            .columns()
            .iter()
            .zip(&refined.minimum.system.coefficients)
        {
            let column = column.with_slopes(&refined.minimum.at.slope);
            for (value, shape) in model.iter_mut().zip(&column) {
                *value += c * shape;
            }
        }
        FittedPoints {
            residual: problem
                .observed()
                .iter()
                .zip(&model)
                .map(|(y, f)| y - f)
                .collect(),
            whitened: refined.minimum.system.residual[..problem.points()].to_vec(),
            model,
        }
    }
}
