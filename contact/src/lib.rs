//! Unilateral contact of a rigid indenter with a layered, textured elastic half-space.
//!
#![doc = include_str!("../README.md")]
#![cfg_attr(
    test,
    allow(
        clippy::float_cmp,
        reason = "tests compare numbers that are exact in binary"
    )
)]

mod body;
mod certificate;
mod contact_field;
mod contact_shape;
mod cut_off;
mod deformed_surface;
mod discrete_problem;
mod domain;
mod error;
mod grid_error;
mod hierarchy;
mod indenter;
mod level;
mod levels;
mod load;
mod model;
mod observer;
mod path;
mod peak;
pub mod reference;
mod scale;
mod sector;
pub mod solver;
mod status;
mod summary;
mod trust;
mod vector;
mod warning;
mod window;
mod work;

pub use certificate::{Certificate, Solution};
pub use cut_off::CutOff;
pub use deformed_surface::DeformedSurface;
pub use discrete_problem::DiscreteProblem;
pub use domain::{Domain, choose_side, default_side};
pub use error::ContactError;
pub use grid_error::{Estimate, GridError, LevelValues};
pub use indenter::{
    Cone, FlatPunch, Indenter, IndenterError, IndenterMap, IndenterQuantity, Paraboloid, Profile,
    Pyramid, Sphere,
};
pub use load::Load;
pub use model::{Model, SampledModel};
pub use observer::{Observer, Progress, Signal};
pub use path::{LoadingPath, Step, loads_at_once, solve_path};
pub use peak::PeakPlace;
pub use solver::{
    Iterate, Method, Solver, SolverOptions, Watch,
    active_set::{ActiveSetSolver, DropOnlySolver},
    gradient::GradientSolver,
};
pub use status::Status;
pub use summary::Summary;
pub use trust::{domain_much_larger, model_warnings};
pub use warning::Warning;
pub use work::{LevelWork, Work};
