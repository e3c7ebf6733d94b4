//! Any bytes as the measured curve of a draft.

#![no_main]

pellicle_fuzz::target!("measured curve of a draft");
