//! Any bytes as the measured curve.

#![no_main]

pellicle_fuzz::target!("measured curve");
