//! Why a forward model has no prediction.

use std::error::Error;

use thiserror::Error;

/// Why a forward model has no prediction for some parameters.
#[derive(Debug, Error)]
pub enum ForwardError {
    /// Parameters outside what the model covers. A fit turns back from there with a shorter step.
    #[error("the model has no prediction for these parameters")]
    OutOfRange {
        /// The model's own error.
        source: Box<dyn Error + Send + Sync>,
    },
    /// Other than one finite number for each point, and for each point and unknown.
    #[error(
        "found a prediction that is not a finite number for each point and unknown, wanted one"
    )]
    Incomplete,
    /// The caller wants the fit to end at once.
    #[error("the fit was stopped")]
    Stopped,
}
