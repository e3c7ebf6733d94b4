//! Any bytes as the samples of a study.

#![no_main]

pellicle_fuzz::target!("samples of a study");
