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

mod contact_curves;
mod forward_error;
mod forward_model;

pub use contact_curves::{ContactCurve, ContactCurves, CurveOptions, Observable};
pub use forward_error::ForwardError;
pub use forward_model::{ForwardModel, Prediction};
