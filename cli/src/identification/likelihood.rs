//! The likelihood of a fitted file, for samplers.

use pellicle_identify::{Fit, ForwardError, IdentifyError, Likelihood, Unknown};

use super::Identification;
use crate::failure::Failure;

/// The likelihood of the data of a fit, as a function of its estimates.
#[derive(Debug)]
pub struct FittedLikelihood {
    identification: Identification,
    likelihood: Likelihood,
    best: Vec<f64>,
}

impl FittedLikelihood {
    /// The likelihood with the noise of a fit.
    ///
    /// # Errors
    ///
    /// [`Failure`] if the user has stopped the fit.
    pub fn new(identification: Identification, fit: &Fit) -> Result<Self, Failure> {
        let stopped = || IdentifyError::Stopped {
            predictions: fit.work.curves_solved,
        };
        if fit.stopped.is_some() {
            return Err(stopped().into());
        }
        let best: Vec<f64> = fit.estimates.iter().map(|one| one.value).collect();
        let prediction = identification.problem.predict(&identification.model, &best);
        let prediction = prediction.map_err(|_| stopped())?;
        let likelihood = Likelihood::new(&identification.problem, fit, &prediction)?;
        Ok(Self {
            identification,
            likelihood,
            best,
        })
    }

    /// The keys of the unknowns, then of the nuisances.
    #[must_use]
    pub fn keys(&self) -> Vec<&str> {
        let unknowns = self.identification.problem.unknowns().iter();
        unknowns.map(Unknown::name).collect()
    }

    /// Their values in the best fit, in SI units.
    #[must_use]
    pub fn best(&self) -> &[f64] {
        &self.best
    }

    /// `ln (L/L₀)` of other values, where `L₀` is that of the best fit; −∞ outside the bounds, and where the model has
    /// no prediction.
    ///
    /// # Errors
    ///
    /// [`Failure`] if their number is wrong.
    pub fn logarithm(&self, values: &[f64]) -> Result<f64, Failure> {
        let unknowns = self.identification.problem.unknowns();
        if values.len() != unknowns.len() {
            return Err(Failure::from(IdentifyError::Length {
                list: "values of the unknowns",
                found: values.len(),
                wanted: unknowns.len(),
            }));
        }
        let is_inside = |(unknown, value): (&Unknown, &f64)| {
            let [low, high] = unknown.range();
            (low..=high).contains(value)
        };
        if !unknowns.iter().zip(values).all(is_inside) {
            return Ok(f64::NEG_INFINITY);
        }
        let Identification { problem, model, .. } = &self.identification;
        match problem.predict(model, values) {
            Ok(prediction) => Ok(self.likelihood.logarithm(&prediction)?),
            Err(ForwardError::Stopped) => Err(IdentifyError::Stopped { predictions: 1 }.into()),
            Err(_) => Ok(f64::NEG_INFINITY),
        }
    }
}
