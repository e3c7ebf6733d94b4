//! Identification of the parameters of a layered contact from measured curves.
//!
#![doc = include_str!("../README.md")]
#![cfg_attr(
    test,
    allow(
        clippy::float_cmp,
        reason = "tests compare numbers that are exact in binary"
    )
)]

mod abscissa_zero;
mod autoregressive;
mod contact_curves;
mod curve;
mod departure;
mod distribution;
pub mod draft;
mod error;
mod fit;
pub mod fit_file;
mod forward_model;
mod global_search;
mod goodness;
mod held_zeros;
pub mod indentation;
mod known_combination;
mod least_squares;
mod likelihood;
pub mod measured;
mod metric;
mod noise;
mod normal_equations;
mod nuisance;
mod null_direction;
mod options;
mod orthonormal_basis;
mod outlier;
mod plan;
mod predictor;
mod prior;
mod problem;
mod profile;
mod refinement;
mod repeats;
mod result;
mod start;
mod unknown;
mod verdict;

pub use contact_curves::{
    Calibration, ContactCurve, ContactCurves, CurveOptions, FixedNumber, ForceScale, Invalidity,
    Observable, ParameterAtPoint, Reading, StopFlag, Thinned,
};
pub use curve::Curve;
pub use departure::Departure;
pub use error::IdentifyError;
pub use fit::{explained, exponents, identify};
pub use forward_model::{ForwardError, ForwardModel, Prediction};
pub use goodness::{Goodness, REFUSAL};
pub use known_combination::KnownCombination;
pub use likelihood::Likelihood;
pub use noise::{Amount, Correlation, Noise, NoiseLevels, PointErrors};
pub use nuisance::{LinearNuisance, NuisanceShape, Scope};
pub use null_direction::NullDirections;
pub use options::{FitOptions, Intervals};
pub use outlier::Outlier;
pub use plan::{Expected, Information, Plan};
pub use prior::Prior;
pub use problem::{Problem, Scatter};
pub use profile::ProfilePoint;
pub use repeats::{OddRepeat, OddRepeats, WithoutOdd};
pub use result::{
    BetweenCurves, Coefficient, Estimate, Exclusion, Fit, FitVerdict, FitWarning, FitWork,
    FittedPoints, Stopped,
};
pub use unknown::{Coordinate, Role, Unknown};
pub use verdict::{IDENTIFIED_WITHIN, PRIOR_DRIVEN_ABOVE, Verdict};
