//! Contact problems as a whole: a [`Case`] in, a certified [`Run`] out.
//!
//! A case is read from TOML, every default filled in and every number checked; [`Case::solve`] solves its loading path
//! and finds the stresses, critical loads and derivatives that it asks for. A [`Monitor`] is told what happens and may
//! stop the work. The program `pellicle` and the Python package are built on this crate.
//!
//! ```
//! use pellicle::Case;
//!
//! # let folder = tempfile::tempdir()?;
//! # let path = folder.path().join("ball.toml");
//! # let text = "[foundation]\nsubstrate = { young_modulus = \"70 GPa\", poisson_ratio = 0.22 }\n\
//! #     [indenter]\nkind = \"paraboloid\"\nradius = \"10 mm\"\n[load]\nforce = \"10 N\"\n[grid]\nelements = 64\n";
//! # std::fs::write(&path, text)?;
//! let run = Case::from_toml(&path)?.solve(&mut ())?;
//! assert!(run.summary.is_certified());
//! # // Hertz: (9 Q²/(16 R E*²))^⅓
//! # let penetration = run.summary.steps[0].penetration;
//! # assert!((penetration / 1.013e-6 - 1.0).abs() < 1e-2, "{penetration}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![cfg_attr(
    test,
    allow(
        clippy::float_cmp,
        reason = "a number read from a case must be the number written in it, to the last bit"
    )
)]

pub mod case;
pub mod declare;
pub mod display;
mod error;
pub mod forecast;
pub mod input;
pub mod map;
pub mod memory;
mod monitor;
pub mod result;
pub mod run;
pub mod summary;

pub use case::Case;
pub use case::builder::CaseBuilder;
pub use error::Error;
pub use monitor::{Event, Monitor, Watching};
pub use run::{Completeness, Run};

/// The types from which a case is built in code.
pub use pellicle_contact::{
    Cone, EllipticParaboloid, FlatPunch, Load, Paraboloid, PowerLaw, Pyramid, Sphere,
};
pub use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
pub use pellicle_texture::{CylinderSpec, Cylinders, Film};

/// The README of the crate; its example is a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
