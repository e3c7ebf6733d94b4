//! Contact curves as the forward model of a fit: all curves at the same parameters, or one at its own.

use std::ops::Range;

use pellicle_contact::ContactError;
use rayon::prelude::*;

use super::ContactCurves;
use crate::{ForwardError, ForwardModel, Prediction};

impl ContactCurves {
    /// The curve with this point, and its first one.
    fn curve_of(&self, point: usize) -> (usize, usize) {
        let mut first = 0;
        for (curve, of) in self.curves.iter().enumerate() {
            if point < first + of.abscissae.len() {
                return (curve, first);
            }
            first += of.abscissae.len();
        }
        (0, 0)
    }

    /// Number of derivatives of a prediction.
    fn columns(&self, parameters: &[f64]) -> usize {
        parameters.len().max(self.parameters.len())
    }
}

impl ForwardModel for ContactCurves {
    fn predict(&self, parameters: &[f64]) -> Result<Prediction, ForwardError> {
        self.predict_from(parameters, &[])
    }

    fn predict_from(
        &self,
        parameters: &[f64],
        origins: &[f64],
    ) -> Result<Prediction, ForwardError> {
        let curves = (0..self.curves.len()).into_par_iter();
        let predicted = curves.map(|curve| self.predicted(curve, parameters, origins, &[]));
        let predicted: Vec<Result<Prediction, ContactError>> = predicted.collect();
        let predicted = predicted.into_iter().collect::<Result<Vec<_>, _>>()?;
        Ok(Prediction::joined(predicted, self.columns(parameters)))
    }

    fn predict_curve(
        &self,
        points: Range<usize>,
        parameters: &[f64],
        origins: &[f64],
    ) -> Result<Prediction, ForwardError> {
        let (curve, first) = self.curve_of(points.start);
        let predicted = self.predicted(curve, parameters, origins, &[])?;
        let predicted = Prediction::joined(vec![predicted], self.columns(parameters));
        Ok(predicted.part(&(points.start - first..points.end - first)))
    }
}

impl From<ContactError> for ForwardError {
    fn from(source: ContactError) -> Self {
        match source {
            ContactError::Cancelled { .. } => Self::Stopped,
            source => Self::OutOfRange {
                source: Box::new(source),
            },
        }
    }
}
