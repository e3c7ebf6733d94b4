//! The evaluation of a load and its unloading by Oliver and Pharr, as ISO 14577-1 describes it: modulus, hardness,
//! creep and work of an indentation, each with its standard uncertainty.
//!
//! ```text
//! corrections   h ← h − h₀ − ḣ (t − t₀) − C_f P                                            correction.rs
//! zero          where the loading, extrapolated, begins                                    first_contact.rs
//! phases        loading, hold at the largest force, unloading, hold for the drift          phases.rs
//! unloading     P = α (h − h_f)^m,  S = dP/dh at P_max                                      unloading.rs
//! area          A(h)                                                                       area_function.rs
//! contact       h_c = h_max − ε P_max/S,  E_r = √π S/(2 β √A),
//!               1/E_r = (1 − ν²)/E_IT + (1 − ν_i²)/E_i                                     contact.rs
//! uncertainty   parts of independent sources                                               evaluation.rs
//! ```
//!
//! W. C. Oliver and G. M. Pharr, J. Mater. Res. 7, 1564 (1992) and 19, 3 (2004); ISO 14577-1:2015.

mod area_function;
mod calibration;
mod contact;
mod correction;
mod effective_indenter;
mod error;
mod evaluation;
mod first_contact;
mod inputs;
mod number;
mod numbers;
mod phases;
mod reading;
mod settings;
mod stiffness_readings;
mod uncertain;
mod unloading;

pub use area_function::{AreaFunction, Tip, TipShape};
pub use calibration::{Calibration, CalibrationTask, MeasuredContact, calibrate};
pub use correction::DriftHold;
pub use effective_indenter::{
    EffectiveIndenter, EffectiveIndenterError, EffectiveIndenterNumbers, UnloadingPoint,
};
pub use error::IndentationError;
pub use evaluation::{EvaluatedCurve, IndentationCurve, evaluate};
pub use number::IndentationNumber;
pub use numbers::IndentationNumbers;
pub use phases::Phases;
pub use settings::{DepthZero, Drift, Epsilon, EvaluationSettings, IndenterMaterial, KnownBody};
pub use stiffness_readings::evaluate_stiffnesses;
pub use uncertain::Uncertain;
pub use unloading::UnloadingFit;
