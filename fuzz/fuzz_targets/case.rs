//! Any bytes as the case.

#![no_main]

pellicle_fuzz::target!("case");
