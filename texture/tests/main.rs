//! Tests of the reliefs: their area fractions and symmetries.

mod area_fraction;
mod symmetry;
