//! Unilateral contact of an indenter with a layered elastic body that carries a relief.
//!
#![doc = include_str!("../README.md")]
#![cfg_attr(
    test,
    allow(
        clippy::float_cmp,
        reason = "tests compare numbers that are exact in binary"
    )
)]

pub mod adhesion;
pub mod axisymmetric;
mod error;
mod grid;
mod indenter;
mod model_parameter;
mod path;
mod problem;
pub mod reference;
mod result;
mod sensitivity;
pub mod solver;
mod stress;
mod vector;
pub mod wear;

pub use error::ContactError;
pub use grid::region::Boundary;
pub use indenter::{
    Cone, CustomProfile, EllipticParaboloid, FlatPunch, Indenter, IndenterError, IndenterMap,
    IndenterQuantity, Paraboloid, Plane, PowerLaw, Profile, Pyramid, Sphere,
};
pub use model_parameter::ModelParameter;
pub use path::{
    LoadingPath,
    domain::{
        Domain,
        choice::{choose_side, choose_side_at},
        default_side, estimated_force, estimated_force_at_radius,
    },
    levels::solved_grid,
    loads_at_once, solve_path,
    warnings::{
        FEWEST_ELEMENTS, LARGEST_SHORTENING, LARGEST_SLOPE, domain_much_larger,
        grid::{arc_under_resolved, map_under_resolved, model_warnings},
        relative_shortening,
    },
};
pub use problem::{
    discrete_problem::{DiscreteProblem, Identity},
    load::Load,
    model::{Model, SampledModel},
};
pub use result::{
    certificate::{Certificate, Solution},
    contact_slope::ContactSlope,
    cut_off::CutOff,
    deformed_surface::DeformedSurface,
    grid_error::{ErrorEstimate, GridError, GridNumber, LevelValues, UnresolvedNumbers},
    limit_ratio::{LimitRatio, ModelLimit},
    map_resolution::FEWEST_ELEMENTS_PER_WAVE,
    peak::{PeakPlace, UnresolvedArc},
    rough_contact::{Histogram, Islands, RoughContact},
    step::{CoarsePressure, Status, Step},
    summary::Summary,
    warning::Warning,
    work::{LevelWork, Work},
};
pub use sensitivity::{ForceCurve, ModelDerivatives, ModelDirection, Sensitivities, Sensitivity};
pub use solver::{
    Iterate, Method, Shortcuts, Solver, SolverOptions, Watch,
    active_set::ActiveSetSolver,
    gradient::GradientSolver,
    observer::{Observer, Progress, Signal},
};
pub use stress::{
    body_extremes::{
        BodyStress, BodyUtilisation, InterfaceStress, InterfaceUtilisation, StressExtremes,
        stress_extremes,
    },
    critical_load::{CriticalLoad, CriticalStatus, critical_loads},
    extreme::Extreme,
    field::{StressField, StressPlanes},
    model::{
        BodyPart, BodyStrengths, Criterion, InterfacePart, InterfaceStrengths, Sliding, StressModel,
    },
    quantity::StressQuantity,
    residual::ResidualStress,
    search_work::{LoadedElements, SearchWork, critical_work, search_work},
    unresolved::UnresolvedStresses,
};
