//! Fits of closed-form curves: known answers, work, coverage, verdicts, refusals.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "helpers of tests, which compare numbers that must be the same bits"
)]

mod abscissa_zeros;
mod analytic;
mod common_departure;
mod coverage;
mod exponents;
mod known_errors;
mod likelihood;
mod misfit;
mod noise;
mod outliers;
mod profile_ends;
mod reference;
mod repeats;
mod retraction;
mod robustness;
mod stopped;
mod told_noise;
mod toys;
mod verdicts;
mod work;
