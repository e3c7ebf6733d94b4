//! The contact problem of an indenter pressed into a body, and its form on one grid.

pub mod discrete_problem;
pub mod gap_scale;
pub mod held_pressure;
pub mod load;
pub mod model;
pub mod relief_springs;
pub mod scale;
pub mod support;
pub mod tangents;
