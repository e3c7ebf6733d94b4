//! Any bytes as the fields of a run.

#![no_main]

pellicle_fuzz::target!("fields of a run");
