//! Any bytes as the map of heights in NumPy's format.

#![no_main]

pellicle_fuzz::target!("map in NumPy's format");
