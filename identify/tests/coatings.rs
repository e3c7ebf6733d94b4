//! Coatings under balls on the real model: plans, surrogates, posteriors, coverage, and lost parameters.
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

mod certainty;
mod coating;
mod coverage;
mod misfit;
mod plan;
mod posterior;
mod surrogate;
mod variable_projection;
