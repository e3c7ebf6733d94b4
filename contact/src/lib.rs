//! Unilateral contact of a rigid indenter with a layered, textured elastic half-space.

#![cfg_attr(
    test,
    allow(
        clippy::float_cmp,
        reason = "tests compare numbers that are exact in binary"
    )
)]

pub mod indenter;
pub mod reference;

pub use indenter::{
    Cone, FlatPunch, Indenter, IndenterError, IndenterMap, IndenterQuantity, Paraboloid, Profile,
    Pyramid, Sphere,
};
