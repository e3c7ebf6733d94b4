//! Coatings under balls on the real model: plans, coverage, and lost parameters.
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

mod certainty;
mod coating;
mod coverage;
mod interpolant;
mod misfit;
mod plan;
mod variable_projection;
