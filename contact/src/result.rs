//! The result of a solution: its certificate, its summary and its errors.

pub mod averaged_pressure;
pub mod certificate;
pub mod contact_field;
pub mod contact_shape;
pub mod contact_slope;
pub mod cut_off;
pub mod deformed_surface;
pub mod grid_error;
pub mod limit_ratio;
pub mod map_resolution;
pub mod model_limits;
mod not_stored;
pub mod peak;
pub mod point;
pub mod rough_contact;
pub mod step;
pub mod step_wear;
pub mod summary;
pub mod warning;
pub mod work;
