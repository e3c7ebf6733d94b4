//! Errors in the input of a fit, and failures of it.

use thiserror::Error;

use crate::ForwardError;

/// Errors of the crate. A fit that does not converge or does not follow its data is not an error: it is returned with a
/// verdict that says so.
#[derive(Debug, Error)]
pub enum IdentifyError {
    /// A number outside its range.
    #[error("found {found} for the {quantity}, wanted {wanted}")]
    Number {
        /// Name of the number.
        quantity: &'static str,
        /// Value found.
        found: f64,
        /// The values allowed.
        wanted: &'static str,
    },
    /// A number that belongs to an unknown or a nuisance and lies outside its range.
    #[error("found {found} for the {quantity} of {name}, wanted {wanted}")]
    NumberOf {
        /// The unknown or the nuisance.
        name: String,
        /// Name of the number.
        quantity: &'static str,
        /// Value found.
        found: f64,
        /// The values allowed.
        wanted: &'static str,
    },
    /// A list whose length does not match the list it belongs to.
    #[error("found {found} values of the {list}, wanted {wanted}")]
    Length {
        /// Name of the list.
        list: &'static str,
        /// Values found.
        found: usize,
        /// Values wanted.
        wanted: usize,
    },
    /// A value in a curve that is not finite, or a time that does not increase.
    #[error("found {found} for the {list} of point {point}, wanted {wanted}")]
    Point {
        /// Name of the list.
        list: &'static str,
        /// Index of the point, from 0.
        point: usize,
        /// Value found.
        found: f64,
        /// The values allowed.
        wanted: &'static str,
    },
    /// A drift without times.
    #[error("found no times in curve {curve}, wanted them for the drift")]
    NoTime {
        /// Index of the curve, from 0.
        curve: usize,
    },
    /// No unknown to find.
    #[error("found no unknown, wanted at least one")]
    NoUnknown,
    /// Two unknowns with the same name.
    #[error("found {name} twice among the unknowns, wanted it once")]
    Twice {
        /// The name.
        name: String,
    },
    /// Too few points for the parameters to be fitted.
    #[error("found {points} points for {wanted} parameters, wanted more points than parameters")]
    TooFewPoints {
        /// Points found.
        points: usize,
        /// Unknowns and nuisances.
        wanted: usize,
    },
    /// The model has no prediction at any start.
    #[error("found no start at which the model has a prediction, wanted one; {starts} were tried")]
    NoStart {
        /// Starts tried.
        starts: usize,
        /// The model's error at the last of them.
        source: ForwardError,
    },
    /// Parameters of a plan at which the model has no prediction.
    #[error("found no prediction at the parameters of the plan, wanted one")]
    NoPlan {
        /// The model's own error.
        source: ForwardError,
    },
    /// The caller ended the fit.
    #[error("the fit was stopped after {predictions} predictions")]
    Stopped {
        /// Predictions made so far.
        predictions: usize,
    },
    /// A matrix without a decomposition, because an entry is not finite.
    #[error("found a matrix of size {size} without a decomposition, wanted finite numbers in it")]
    Decomposition {
        /// Rows of the matrix.
        size: usize,
    },
}
