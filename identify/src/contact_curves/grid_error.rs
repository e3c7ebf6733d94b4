//! The error of the predictions of curves, from a finer grid and more loads.

use pellicle_contact::ContactError;

use super::{ContactCurves, validity::FINER};
use crate::Prediction;

impl ContactCurves {
    /// The estimated error of each point of a prediction at these values: how far the exact one lies above it.
    ///
    /// # Errors
    ///
    /// [`ContactError`] where the contact cannot be solved at these values.
    pub fn grid_errors(
        &self,
        values: &[f64],
        at_values: &Prediction,
    ) -> Result<Vec<f64>, ContactError> {
        let finer = self.finer(values, &at_values.origins)?;
        let pairs = at_values.value.iter().zip(&finer.value);
        // Second order in the element's side: of an error e, the difference shows e − e/F².
        let seen = 1.0 - 1.0 / (FINER * FINER);
        Ok(pairs.map(|(value, finer)| (finer - value) / seen).collect())
    }
}
