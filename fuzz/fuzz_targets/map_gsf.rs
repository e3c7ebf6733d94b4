//! Any bytes as the map of heights in Gwyddion's format.

#![no_main]

pellicle_fuzz::target!("map in Gwyddion's format");
