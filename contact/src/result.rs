//! The result of a solution: its certificate, its summary and its errors.

pub mod certificate;
pub mod contact_field;
pub mod contact_shape;
pub mod cut_off;
pub mod deformed_surface;
pub mod grid_error;
mod not_stored;
pub mod peak;
pub mod point;
pub mod rough_contact;
pub mod step;
pub mod summary;
pub mod warning;
pub mod work;
