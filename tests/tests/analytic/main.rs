//! Against closed forms, on one grid each: Hertz, Sneddon, Winkler, and the limits in which a coating is not felt. How the errors fall
//! with the grid is in `convergence`.

mod closed_forms;
mod coatings;
mod winkler;
