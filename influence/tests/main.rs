//! Tests of coefficients, operators, stresses inside and the cache.

mod bodies;
mod cache;
mod coefficients;
mod derivative;
mod operators;
mod subsurface;
