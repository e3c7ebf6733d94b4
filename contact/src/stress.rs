//! Stress inside the body under a solved pressure: at points, on planes, its extremes, and the loads at which a body
//! yields or cracks or an interface comes off.

pub mod extremes;
pub mod field;
pub mod model;
