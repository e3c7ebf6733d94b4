//! The interface between a model and a fit: the points of all curves and their derivatives.

use std::{error::Error, ops::Range};

use thiserror::Error;

/// A model of measured curves.
pub trait ForwardModel: Sync {
    /// Predicts the points of all curves, in the order of the curves. The values of the unknowns are in their own units
    /// and in the order of the problem's [`Unknown`](crate::Unknown)s.
    ///
    /// A fit never calls this twice with the same parameters, except for [single curves](Self::predict_curve).
    ///
    /// # Errors
    ///
    /// [`ForwardError::OutOfRange`] where the model has no prediction: the fit then takes a shorter step.
    /// [`ForwardError::Stopped`] ends the fit.
    fn predict(&self, parameters: &[f64]) -> Result<Prediction, ForwardError>;

    /// The same prediction with the abscissa of each point counted from an origin of its own. Only problems with a
    /// [zero of the abscissa](crate::LinearNuisance::abscissa_zero) need it; a fit calls it several times with the same
    /// parameters.
    ///
    /// # Errors
    ///
    /// As [`Self::predict`], and [`ForwardError::NoOrigin`] for a model that cannot.
    fn predict_from(
        &self,
        _parameters: &[f64],
        _origins: &[f64],
    ) -> Result<Prediction, ForwardError> {
        Err(ForwardError::NoOrigin)
    }

    /// The points of one curve alone, `points` among those of all, as [`Self::predict_from`] gives them; an empty list
    /// of origins, which are those of all points, is that of zeros. A fit of repeats gives each curve parameters of its
    /// own. By default all curves are predicted.
    ///
    /// # Errors
    ///
    /// As [`Self::predict_from`].
    fn predict_curve(
        &self,
        points: Range<usize>,
        parameters: &[f64],
        origins: &[f64],
    ) -> Result<Prediction, ForwardError> {
        let all = if origins.is_empty() {
            self.predict(parameters)
        } else {
            self.predict_from(parameters, origins)
        };
        Ok(all?.part(&points))
    }
}

/// The points of all curves for given parameters.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Prediction {
    /// The observable `y`, such as a penetration, one value for each point.
    pub value: Vec<f64>,
    /// Its derivative with respect to the abscissa, `∂y/∂Q`, one value for each point. Errors of the abscissa enter
    /// through it.
    pub slope: Vec<f64>,
    /// Its derivatives `∂y/∂θ_j` with respect to each unknown: one list of points for each unknown.
    pub derivatives: Vec<Vec<f64>>,
    /// The origin of the abscissa of each point; empty where all are zero.
    pub origins: Vec<f64>,
}

impl Prediction {
    /// Joins the points of several curves, with derivatives with respect to `unknowns` unknowns.
    pub(crate) fn joined(curves: Vec<Self>, unknowns: usize) -> Self {
        let mut all = Self {
            value: Vec::new(),
            slope: Vec::new(),
            derivatives: vec![Vec::new(); unknowns],
            origins: Vec::new(),
        };
        for one in curves {
            all.value.extend(one.value);
            all.slope.extend(one.slope);
            all.origins.extend(one.origins);
            for (to, from) in all.derivatives.iter_mut().zip(one.derivatives) {
                to.extend(from);
            }
        }
        all
    }

    /// The prediction at some of the points.
    pub(crate) fn part(&self, points: &Range<usize>) -> Self {
        let part = |values: &Vec<f64>| values.get(points.clone()).unwrap_or_default().to_vec();
        Self {
            value: part(&self.value),
            slope: part(&self.slope),
            derivatives: self.derivatives.iter().map(part).collect(),
            origins: part(&self.origins),
        }
    }

    /// Whether there is a finite number for each of the points and unknowns.
    pub(crate) fn is_complete(&self, points: usize, unknowns: usize) -> bool {
        let complete =
            |values: &[f64]| values.len() == points && values.iter().all(|v| v.is_finite());
        complete(&self.value)
            && complete(&self.slope)
            && self.derivatives.len() == unknowns
            && self.derivatives.iter().all(|column| complete(column))
    }
}

/// Why a forward model has no prediction for some parameters.
#[derive(Debug, Error)]
pub enum ForwardError {
    /// Parameters outside the range of the model. A fit retreats from there with a shorter step.
    #[error("the model has no prediction for these parameters")]
    OutOfRange {
        /// The model's own error.
        source: Box<dyn Error + Send + Sync>,
    },
    /// A prediction that lacks a finite number for some point, or for some point and unknown.
    #[error(
        "found a prediction that is not a finite number for each point and unknown, wanted one"
    )]
    Incomplete,
    /// A model that cannot count its abscissa from another origin.
    #[error("the model has no origin of the abscissa, which a zero of it wants")]
    NoOrigin,
    /// The caller wants the fit to end at once.
    #[error("the fit was stopped")]
    Stopped,
}
