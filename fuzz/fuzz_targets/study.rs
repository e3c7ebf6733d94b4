//! Any bytes as the study.

#![no_main]

pellicle_fuzz::target!("study");
