//! The density of a posterior, in the form that the sampler needs.
//!
//! Over the coordinates `x`, with the covariance `V` of the noise at the best fit and columns `B` of the nuisances,
//! `ln p = −½ χ²(x) − ½ ln det V − ½ ln det BᵀV⁻¹B`. Here χ² is computed with the nuisances eliminated, by a Gaussian
//! integral over their coefficients. `V` and `B` are kept from the best fit, as in the profiles, so both determinants
//! are constants. Where the size of the noise is estimated with ν degrees of freedom, it is integrated out too:
//! `ln p = −½ (ν + k) ln(1 + (χ² − χ²₀)/ν)` for k unknowns, whose marginals are those of Student's distribution with ν
//! degrees (A. Gelman et al., Bayesian Data Analysis, 3rd ed., section 14.2).

use hammer_and_sample::Model;

use crate::{
    Coordinate, Fit, ForwardModel as _, IdentifyError, Prior, Problem, Surrogate, Unknown,
    metric::Metric, predictor::Evaluation,
};

/// The logarithm of a posterior's density.
pub(super) struct Density<'a> {
    surrogate: &'a Surrogate,
    problem: &'a Problem,
    metric: Metric<'a>,
    /// Coordinates of the best fit.
    pub best: Vec<f64>,
    /// χ² of the data at the best fit.
    least: f64,
    degrees: f64,
}

impl<'a> Density<'a> {
    pub fn new(
        surrogate: &'a Surrogate,
        problem: &'a Problem,
        fit: &Fit,
    ) -> Result<Self, IdentifyError> {
        let unknowns = problem.unknowns();
        let parameters: Vec<f64> = fit.estimates.iter().map(|one| one.value).collect();
        let predictions = surrogate.predictions();
        let prediction = surrogate
            .predict(&parameters)
            .map_err(|_| IdentifyError::Surrogate {
                reached: f64::INFINITY,
                wanted: surrogate.error(),
                predictions,
            })?;
        if !prediction.is_complete(problem.points(), unknowns.len()) {
            return Err(IdentifyError::Length {
                list: "points of the surrogate",
                found: prediction.value.len(),
                wanted: problem.points(),
            });
        }
        let at = Evaluation::of(unknowns, &parameters, prediction);
        let degrees = fit.estimates.iter().map(|one| one.degrees_of_freedom);
        let mut density = Self {
            surrogate,
            problem,
            metric: Metric::at(problem, &fit.noise, &at),
            best: at.position,
            least: 0.0,
            degrees: degrees.fold(f64::INFINITY, f64::min),
        };
        density.least = density.misfit(&density.best).0;
        Ok(density)
    }

    /// Smallest and largest coordinate of each unknown.
    pub fn sides(&self) -> &[[f64; 2]] {
        self.surrogate.region().coordinates()
    }

    /// The unknowns in their own units.
    pub fn values(&self, position: &[f64]) -> Vec<f64> {
        let pairs = self.problem.unknowns().iter().zip(position);
        pairs.map(|(unknown, &x)| unknown.value(x)).collect()
    }

    /// χ² of the data, and the logarithm of the priors' density.
    fn misfit(&self, position: &[f64]) -> (f64, f64) {
        let at = Evaluation {
            position: position.to_vec(),
            parameters: self.values(position),
            value: self.surrogate.values(position),
            slope: Vec::new(),
            jacobian: Vec::new(),
        };
        let all = self.metric.system(&at).chi_squared;
        let (mut squares, mut stretch) = (0.0, 0.0);
        for (unknown, &value) in self.problem.unknowns().iter().zip(&at.parameters) {
            if let Some(prior) = unknown.prior() {
                squares += prior.deviation(value).powi(2);
                stretch += log_stretch(unknown, prior, value);
            }
        }
        (all - squares, stretch - 0.5 * squares)
    }

    fn log_likelihood(&self, misfit: f64) -> f64 {
        let excess = misfit - self.least;
        if self.degrees.is_infinite() {
            return -0.5 * excess;
        }
        let unknowns = self.problem.unknowns().len() as f64;
        -0.5 * (self.degrees + unknowns) * (excess / self.degrees).max(-0.5).ln_1p()
    }
}

/// `ln dθ/dx` for a prior on θ where x is `ln θ`, and the reverse: the Jacobian of the change of coordinate.
fn log_stretch(unknown: &Unknown, prior: Prior, value: f64) -> f64 {
    match (prior, unknown.coordinate()) {
        (Prior::Normal { .. }, Coordinate::Logarithmic) => value.ln(),
        (Prior::Lognormal { .. }, Coordinate::Linear) => -value.ln(),
        _ => 0.0,
    }
}

impl Model for Density<'_> {
    type Params = Vec<f64>;

    fn log_prob(&self, position: &Vec<f64>) -> f64 {
        let mut pairs = position.iter().zip(self.sides());
        if !pairs.all(|(x, [low, high])| (low..=high).contains(&x)) {
            return f64::NEG_INFINITY;
        }
        let (misfit, prior) = self.misfit(position);
        self.log_likelihood(misfit) + prior
    }
}
