//! The likelihood of parameters, for those who want samples instead of intervals.
//!
//! With the covariance `V` of the noise at the best fit and the linear nuisances integrated out, `ln L = −½ (χ² − χ²₀)`
//! up to a constant, where χ² is the smallest over their coefficients and χ²₀ that of the best fit. `V` is kept from
//! the best fit, as in the profiles. Where the size of the noise is estimated with ν degrees of freedom, it is
//! integrated out too: `ln L = −½ (ν + k) ln(1 + (χ² − χ²₀)/ν)` for k unknowns, whose marginals are those of Student's
//! distribution with ν degrees (A. Gelman et al., Bayesian Data Analysis, 3rd ed., section 14.2).

use crate::{
    Fit, IdentifyError, NoiseLevels, Prediction, Problem, curve::check_length, metric::Metric,
    predictor::Evaluation,
};

/// The likelihood of a problem's data near its best fit, as a function of what a model predicts.
///
/// Priors of the unknowns are not in it, those of the linear nuisances are. Repeats count as curves with the same
/// parameters: their scatter and the curves that a fit leaves out are not regarded.
#[derive(Debug, Clone)]
pub struct Likelihood {
    /// The problem without the priors of its unknowns.
    problem: Problem,
    noise: NoiseLevels,
    best: Evaluation,
    /// `χ²₀`.
    least: f64,
    /// ν, infinite where the noise is given.
    degrees: f64,
}

impl Likelihood {
    /// The likelihood with the noise of a fit; `best` is what the model predicts for the fit's values.
    ///
    /// # Errors
    ///
    /// [`IdentifyError::Length`] if the prediction does not have one value and one slope for each point of the problem.
    pub fn new(problem: &Problem, fit: &Fit, best: &Prediction) -> Result<Self, IdentifyError> {
        check_length("slopes of the prediction", &best.slope, problem.points())?;
        let degrees = fit.estimates.iter().map(|one| one.degrees_of_freedom);
        let mut likelihood = Self {
            problem: problem.without_priors(),
            noise: fit.noise,
            best: evaluation(best),
            least: 0.0,
            degrees: degrees.fold(f64::INFINITY, f64::min),
        };
        likelihood.least = likelihood.chi_squared(best)?;
        Ok(likelihood)
    }

    /// `ln (L/L₀)` of what the model predicts for other values of the unknowns, where `L₀` is that of the best fit.
    ///
    /// # Errors
    ///
    /// [`IdentifyError::Length`] if the prediction does not have one value for each point of the problem.
    pub fn logarithm(&self, prediction: &Prediction) -> Result<f64, IdentifyError> {
        let excess = self.chi_squared(prediction)? - self.least;
        if self.degrees.is_infinite() {
            return Ok(-0.5 * excess);
        }
        let unknowns = self.problem.unknowns().len() as f64;
        // The excess is negative only where the fit has missed a better minimum.
        let relative = (excess / self.degrees).max(-0.5);
        Ok(-0.5 * (self.degrees + unknowns) * relative.ln_1p())
    }

    fn chi_squared(&self, prediction: &Prediction) -> Result<f64, IdentifyError> {
        let points = self.problem.points();
        check_length("values of the prediction", &prediction.value, points)?;
        let metric = Metric::at(&self.problem, &self.noise, &self.best);
        Ok(metric.system(&evaluation(prediction)).chi_squared)
    }
}

/// Values and slopes alone, without derivatives by the unknowns.
fn evaluation(of: &Prediction) -> Evaluation {
    Evaluation {
        position: Vec::new(),
        parameters: Vec::new(),
        value: of.value.clone(),
        slope: of.slope.clone(),
        jacobian: Vec::new(),
        origins: of.origins.clone(),
    }
}
