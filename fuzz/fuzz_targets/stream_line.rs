//! Any bytes as the line of a stream.

#![no_main]

pellicle_fuzz::target!("line of a stream");
