//! Pictures of contacts, stresses and fits.
//!
#![doc = include_str!("../README.md")]
#![cfg_attr(
    test,
    allow(
        clippy::float_cmp,
        reason = "tests compare numbers that must be the same bits"
    )
)]

pub mod axes;
pub mod fit;
pub mod run;
pub mod sheet;
pub mod step;
pub mod stress;
pub mod study;
