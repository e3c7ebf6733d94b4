//! Errors fall with the element's side at the theoretical order over nine grids; a lower order is refused.

mod area;
mod closed_forms;
mod displacement;
mod layered;
mod rough;
