//! Errors fall with the element's side at the order that theory gives, over nine grids; what does not is refused.

mod area;
mod closed_forms;
mod displacement;
mod layered;
mod rough;
