//! What a measurement will tell, before it is made.
//!
//! At the true parameters the information of a design is `JᵀJ` of the whitened derivatives, with the linear nuisances
//! eliminated and a row for each prior; its inverse is the covariance that a fit will have (Wald).

use crate::{
    Amount, Correlation, Curve, ForwardError, ForwardModel, IdentifyError, LinearNuisance, Noise,
    NoiseLevels, Prediction, Problem, Unknown,
    metric::{Metric, System},
    predictor::Evaluation,
    projection::Projection,
};

/// Curves that may be measured.
pub struct Design<'a> {
    /// Their model.
    pub model: &'a dyn ForwardModel,
    /// Abscissae of each curve, in the order of the model's points.
    pub abscissae: Vec<Vec<f64>>,
}

/// Expected relative standard errors `σ_θ/θ` of the unknowns, infinite where a design does not tell them.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Of each design alone: one list of unknowns for each.
    pub alone: Vec<Vec<f64>>,
    /// Of all designs together.
    pub together: Vec<f64>,
}

/// The expected standard errors of the unknowns at `parameters`, for each design and for all.
///
/// # Errors
///
/// [`IdentifyError::NoPlan`] where a model has no prediction at the parameters, [`IdentifyError::Length`] for more or
/// fewer parameters than unknowns; those of [`Problem::new`].
pub fn plan(
    designs: &[Design],
    unknowns: &[Unknown],
    parameters: &[f64],
    nuisances: &[LinearNuisance],
    noise: NoiseLevels,
) -> Result<Plan, IdentifyError> {
    if parameters.len() != unknowns.len() {
        return Err(IdentifyError::Length {
            list: "parameters of the plan",
            found: parameters.len(),
            wanted: unknowns.len(),
        });
    }
    let predictions: Vec<Prediction> = designs
        .iter()
        .map(|design| design.predict(parameters))
        .collect::<Result<_, _>>()?;
    let expected = |parts: &[Design], predictions: &[Prediction]| {
        let prediction = joined(predictions, unknowns.len());
        standard_errors(parts, prediction, unknowns, parameters, nuisances, noise)
    };
    let one = |k: usize| expected(&designs[k..=k], &predictions[k..=k]);
    Ok(Plan {
        alone: (0..designs.len()).map(one).collect::<Result<_, _>>()?,
        together: expected(designs, &predictions)?,
    })
}

impl Design<'_> {
    fn predict(&self, parameters: &[f64]) -> Result<Prediction, IdentifyError> {
        let prediction = self.model.predict(parameters);
        let prediction = prediction.map_err(|source| IdentifyError::NoPlan { source })?;
        let points = self.abscissae.iter().map(Vec::len).sum();
        if prediction.is_complete(points, parameters.len()) {
            return Ok(prediction);
        }
        Err(IdentifyError::NoPlan {
            source: ForwardError::Incomplete,
        })
    }
}

fn joined(predictions: &[Prediction], unknowns: usize) -> Prediction {
    let join = |of: &dyn Fn(&Prediction) -> &Vec<f64>| -> Vec<f64> {
        predictions.iter().flat_map(of).copied().collect()
    };
    Prediction {
        value: join(&|one| &one.value),
        slope: join(&|one| &one.slope),
        derivatives: (0..unknowns)
            .map(|j| join(&|one| &one.derivatives[j]))
            .collect(),
    }
}

fn standard_errors(
    designs: &[Design],
    prediction: Prediction,
    unknowns: &[Unknown],
    parameters: &[f64],
    nuisances: &[LinearNuisance],
    noise: NoiseLevels,
) -> Result<Vec<f64>, IdentifyError> {
    let mut values = prediction.value.iter().copied();
    let curves = designs
        .iter()
        .flat_map(|design| &design.abscissae)
        .map(|abscissa| {
            let observed = values.by_ref().take(abscissa.len()).collect();
            Curve::new(abscissa.clone(), observed)
        })
        .collect::<Result<_, _>>()?;
    let problem = Problem::new(curves, unknowns.to_vec(), nuisances, given(noise))?;
    let at = Evaluation::of(unknowns, parameters, prediction);
    let system = Metric::at(&problem, &noise, &at).system(&at);
    let relative = |(j, (unknown, value)): (usize, (&Unknown, &f64))| {
        standard_error(&system, j) * unknown.value_slope(*value) / value.abs()
    };
    let pairs = unknowns.iter().zip(parameters);
    Ok(pairs.enumerate().map(relative).collect())
}

/// The noise of these levels, none of them to be estimated.
fn given(levels: NoiseLevels) -> Noise {
    Noise {
        observed: Amount::Given(levels.observed),
        abscissa: Amount::Given(levels.abscissa),
        relative: Amount::Given(levels.relative),
        correlation: Correlation::Given {
            persistence: levels.persistence,
            white_fraction: levels.white_fraction,
        },
    }
}

/// `√((JᵀJ)⁻¹_jj)`. The unknown comes last, so that it is the one to be dropped where it depends on the others.
fn standard_error(system: &System, unknown: usize) -> f64 {
    let last = system.jacobian.len() - 1;
    let others = (0..=last).filter(|&j| j != unknown);
    let columns = others.chain([unknown]).map(|j| system.jacobian[j].clone());
    Projection::of(columns).inverse_gram()[last][last].sqrt()
}
