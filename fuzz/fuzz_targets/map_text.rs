//! Any bytes as the map of heights as text.

#![no_main]

pellicle_fuzz::target!("map as text");
