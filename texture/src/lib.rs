//! Geometry of textured surfaces: cylinders, dimples and grooves in patterns, films and measured height maps, sampled
//! on a grid of square elements.
//!
//! The crate answers one question: at every element of a [`Grid`], does the surface carry relief, how high does it
//! stand and how soft is it? The answer is a [`SampledRelief`] of three fields: the mask, the surface profile `f*` (m,
//! 0 on the tops) and the compliance `η` (m/Pa) of the one-dimensional springs that stand for the relief, `η = h / E_a`
//! ((3.3) of Stepanov and Torskaya, Mech. Solids 57, 2022). A [`SpringLaw`] says how they shorten: in proportion to the
//! pressure, or ever less. It knows no elasticity beyond that and depends on no other crate of the workspace.
//!
//! A field is a `Vec<f64>` of N² values with index `i * N + j`, first index along x, second along y; see [`Grid`].
//! Lengths and moduli may be in SI or in any consistent dimensionless system.
//!
//! ```
//! use pellicle_texture::{CylinderSpec, Cylinders, Grid, Lattice, Relief};
//!
//! # fn main() -> Result<(), pellicle_texture::TextureError> {
//! // The pillars of figure 2 of the paper, eight periods wide, 50 elements per period.
//! let pillars = Cylinders::new(CylinderSpec {
//!     lattice: Lattice::Square,
//!     radius: 5e-3,
//!     height: 1e-4,
//!     period: 0.0125,
//!     offset: [0.0, 0.0],
//!     young_modulus: 1.0,
//! })?;
//! let relief = Relief::Cylinders(pillars);
//! let sampled = relief.sample(&Grid::new(0.1, 400)?);
//!
//! // π r²/T² = 0.5027. A disc of radius 20 elements holds some 20^½ elements too many or too few (7 here), of 2500 in a period.
//! let sampled_fraction = sampled.mask_fraction();
//! assert!((sampled_fraction - relief.area_fraction()).abs() < 10.0 / 2500.0);
//! assert_eq!(sampled.compliance().iter().copied().fold(0.0, f64::max), 1e-4);
//! # Ok(())
//! # }
//! ```

#![cfg_attr(
    test,
    allow(
        clippy::float_cmp,
        reason = "tests compare numbers that are exact in binary"
    )
)]

mod custom_relief;
mod cylinders;
mod dimples;
mod error;
mod film;
mod grid;
mod grooves;
mod height_map;
mod interpolation;
mod lattice;
mod map_rim;
mod mean_plane;
mod nan_from_null;
mod parameter;
mod patch;
mod pattern;
mod placement;
mod recesses;
mod relief;
mod relief_map;
mod repeated_map;
mod roughness;
mod rounding;
mod sampled;
mod slope_spectrum;
mod spring_law;
mod step_limit;
mod summit;

pub use custom_relief::{CustomRelief, ReliefShape, mean_points};
pub use cylinders::{CylinderSpec, Cylinders};
pub use dimples::Dimples;
pub use error::{Quantity, TextureError};
pub use film::Film;
pub use grid::Grid;
pub use grooves::{GrooveProfile, GrooveSpec, Grooves};
pub use height_map::HeightMap;
pub use interpolation::Interpolation;
pub use lattice::Lattice;
pub use map_rim::RimStep;
pub use mean_plane::MeanPlane;
pub use nan_from_null::nan_from_null;
pub use parameter::ReliefParameter;
pub use pattern::Pattern;
pub use recesses::{RecessShape, Recesses};
pub use relief::Relief;
pub use relief_map::{MapCompliance, ReliefMap};
pub use roughness::{DerivativeSource, MapRim, PowerSpectrum, Roughness};
pub use sampled::SampledRelief;
pub use slope_spectrum::SlopeSpectrum;
pub use spring_law::SpringLaw;
