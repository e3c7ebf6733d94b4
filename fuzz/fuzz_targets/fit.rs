//! Any bytes as the fit.

#![no_main]

pellicle_fuzz::target!("fit");
