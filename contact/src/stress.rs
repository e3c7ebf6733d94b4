//! Stress inside the body under a solved pressure: at points, on planes, its extremes, and the loads at which a body
//! yields or cracks or an interface debonds.

pub mod body_extremes;
pub mod critical_load;
mod edge_extreme;
mod edge_tension;
pub mod extreme;
mod extreme_finder;
pub mod field;
mod load_search;
pub mod model;
mod neighbourhood;
mod peak_search;
mod plane_scan;
mod pressure_blocks;
pub mod quantity;
pub mod residual;
pub mod search_work;
mod solved_loads;
pub mod unresolved;

/// How often a peak is followed to a place beyond those known.
const MOST_MOVES: usize = 8;

/// The nearest whole number.
#[expect(
    clippy::cast_possible_truncation,
    reason = "places of elements are far below the largest integer"
)]
pub(crate) fn nearest(x: f64) -> isize {
    x.round() as isize
}
