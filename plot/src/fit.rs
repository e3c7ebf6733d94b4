//! Pictures of a fit: curves with residuals, profiles, repeats; and of a plan.

pub mod axes;
mod colours;
pub mod curve;
pub mod designs;
pub mod heading;
pub mod moduli;
pub mod places;
pub mod profiles;
pub mod repeats;
pub mod unknown;
pub mod unloading;
