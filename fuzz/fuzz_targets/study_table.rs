//! Any bytes as the table of a study.

#![no_main]

pellicle_fuzz::target!("table of a study");
