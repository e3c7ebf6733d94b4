//! Fits of closed-form curves: known answers, work, coverage, verdicts, refusals.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "helpers of tests, which compare numbers that must be the same bits"
)]

mod analytic;
mod coverage;
mod exponents;
mod misfit;
mod noise;
mod profile_ends;
mod reference;
mod repeats;
mod robustness;
mod stopped;
mod toys;
mod verdicts;
mod work;
