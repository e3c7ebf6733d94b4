//! Errors fall with the element's side at the order that theory gives, over nine grids; what does not is refused.

mod closed_forms;
mod controls;
mod displacement;
mod layered;
