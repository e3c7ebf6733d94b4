//! Any bytes as the cached coefficients.

#![no_main]

pellicle_fuzz::target!("cached coefficients");
