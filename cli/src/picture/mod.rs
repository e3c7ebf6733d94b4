//! Pictures of a solution, readable in print and by the colour-blind.

pub mod axis;
pub mod colours;
pub mod font;
pub mod pressure_map;
pub mod window;
