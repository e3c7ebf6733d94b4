//! Any bytes as the summary of a run.

#![no_main]

pellicle_fuzz::target!("summary of a run");
