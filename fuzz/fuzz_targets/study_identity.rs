//! Any bytes as the identity of a study.

#![no_main]

pellicle_fuzz::target!("identity of a study");
