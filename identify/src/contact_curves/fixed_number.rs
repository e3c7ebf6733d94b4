//! The numbers of the models that a fit takes as exact, and the sensitivity of the curves to them.

use std::iter;

use pellicle_contact::{ContactError, ModelParameter};
use rayon::prelude::*;

use super::ContactCurves;
use crate::{Prediction, problem::spans};

/// A number that the model of a curve holds fixed.
#[derive(Debug, Clone, PartialEq)]
pub struct FixedNumber {
    /// The curve, by its index.
    pub curve: usize,
    /// The number.
    pub parameter: ModelParameter,
    /// Its value, in SI units.
    pub value: f64,
    /// Derivatives `∂y/∂f` of the reading with respect to it, at all points of all curves; zero for the other curves.
    pub derivative: Vec<f64>,
}

impl ContactCurves {
    /// Predicts the curves at these parameters, from these origins of their abscissae (none are zeros), and their derivatives with respect to the `numbers` (one list per
    /// curve) that its model holds fixed, in their order. Numbers that are zero are left out, since a relative change
    /// of zero is zero.
    ///
    /// # Errors
    ///
    /// A contact that cannot be solved; [`ContactError::Cancelled`] once [`CurveOptions::stop`](super::CurveOptions)
    /// is raised.
    pub fn predict_with_fixed(
        &self,
        parameters: &[f64],
        origins: &[f64],
        numbers: &[Vec<ModelParameter>],
    ) -> Result<(Prediction, Vec<FixedNumber>), ContactError> {
        let curves = (0..self.curves.len()).into_par_iter();
        let predicted = curves.map(|curve| {
            let fixed = self.fixed(curve, numbers.get(curve).map_or(&[], Vec::as_slice));
            let prediction = self.predicted(curve, parameters, origins, &fixed)?;
            Ok((fixed, prediction))
        });
        let predicted: Vec<Result<_, ContactError>> = predicted.collect();
        let mut by_fixed = Vec::new();
        let mut predictions = Vec::new();
        for (curve, one) in predicted.into_iter().enumerate() {
            let (fixed, mut prediction): (_, Prediction) = one?;
            let changes = prediction.derivatives.split_off(parameters.len());
            by_fixed.extend(iter::repeat(curve).zip(fixed.into_iter().zip(changes)));
            predictions.push(prediction);
        }
        let spans = spans(predictions.iter().map(|one| one.value.len()));
        let all = Prediction::joined(predictions, parameters.len());
        let numbers = by_fixed.into_iter().map(|(curve, (parameter, change))| {
            let mut derivative = vec![0.0; all.value.len()];
            derivative[spans[curve].clone()].copy_from_slice(&change);
            FixedNumber {
                curve,
                parameter,
                value: (self.curves[curve].model.parameter(parameter)).unwrap_or(f64::NAN),
                derivative,
            }
        });
        let numbers = numbers.collect();
        Ok((all, numbers))
    }

    /// Selects the numbers that are not sought, or for which the curve has its own value.
    fn fixed(&self, curve: usize, numbers: &[ModelParameter]) -> Vec<ModelParameter> {
        let own: Vec<usize> = self.own(curve).collect();
        let parameters = self.parameters.iter().enumerate();
        let sought = parameters.filter(|(index, _)| !own.contains(index));
        let sought: Vec<&ModelParameter> = sought.map(|(_, parameter)| parameter).collect();
        let value = |of: &ModelParameter| self.curves[curve].model.parameter(*of);
        let fixed = numbers.iter().copied();
        let fixed = fixed.filter(|of| !sought.contains(&of));
        fixed
            .filter(|of| value(of).is_some_and(|value| value != 0.0))
            .collect()
    }
}
