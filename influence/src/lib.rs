//! Influence coefficients of square elements on layered elastic bodies, and their product with a pressure.
//!
#![doc = include_str!("../README.md")]
//!
//! # Three layers
//!
//! The table of coefficients of a hard coating on an adhesion layer on a soft interlayer on steel, for elements of a
//! tenth of a micrometre:
//!
//! ```
//! use pellicle_influence::{CoefficientTable, RadialTables, love};
//! use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
//!
//! let layer = |thickness, modulus, ratio| {
//!     Layer::new(thickness, Material::new(modulus, ratio)?, Interface::Bonded)
//! };
//! let layers = vec![
//!     layer(1.0e-6, 300e9, 0.20)?, // diamond-like carbon, the surface
//!     layer(0.1e-6, 280e9, 0.21)?, // chromium
//!     layer(0.5e-6, 80e9, 0.35)?,
//! ];
//! let steel = Material::new(210e9, 0.3)?;
//! let tables = RadialTables::build(&Foundation::new(layers, Base::HalfSpace(steel))?)?;
//! assert!(tables.error_estimate() < 1e-13);
//!
//! let table = CoefficientTable::assemble(&tables, 0.1e-6, 256)?;
//! // Ten thicknesses away only the steel is felt, to the order of (H/r)².
//! let far = table.coefficient([160, 0]) / love::coefficient(&steel, 0.1e-6, [160, 0]);
//! assert!((far - 1.0).abs() < 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # In a solver of one's own
//!
//! Any iteration that needs `K p` can use an [`ElasticOperator`]. Conjugate gradients for the pressure under a flat,
//! rigid, frictionless square that sinks by 1 nm:
//!
//! ```
//! use pellicle_influence::{CoefficientTable, ConvolutionOperator, ElasticOperator, RadialTables};
//! use pellicle_kernel::{Foundation, Material};
//!
//! fn dot(a: &[f64], b: &[f64]) -> f64 {
//!     a.iter().zip(b).map(|(a, b)| a * b).sum()
//! }
//!
//! let (n, side) = (32, 1e-6 / 32.0);
//! let foundation = Foundation::half_space(Material::new(1e9, 0.3)?);
//! let table = CoefficientTable::assemble(&RadialTables::build(&foundation)?, side, n)?;
//! let mut operator = ConvolutionOperator::new(&table);
//!
//! let mut pressure = vec![0.0; n * n];
//! let mut residual = vec![1e-9; n * n];
//! let mut direction = residual.clone();
//! let mut product = vec![0.0; n * n];
//! for _ in 0..60 {
//!     operator.apply_into(&direction, &mut product);
//!     let square = dot(&residual, &residual);
//!     let step = square / dot(&direction, &product);
//!     for i in 0..n * n {
//!         pressure[i] += step * direction[i];
//!         residual[i] -= step * product[i];
//!     }
//!     let ratio = dot(&residual, &residual) / square;
//!     for i in 0..n * n {
//!         direction[i] = residual[i] + ratio * direction[i];
//!     }
//! }
//! let force = pressure.iter().sum::<f64>() * side * side;
//! // Q = 1.152 E* L D for a square of side L, by extrapolation over N; 32 elements a side give 1 % less.
//! let stiffness = force / (1e9 / (1.0 - 0.09) * 1e-6 * 1e-9);
//! assert!((1.135..1.145).contains(&stiffness));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bodies;
mod cache;
mod coefficient_table;
mod element;
mod error;
mod filter;
mod numerics;
mod operator;
mod radial;
mod response;
mod sector;
mod subsurface;
mod surface_elasticity;
mod transform;

pub use bodies::{ElasticBodies, ElasticBody, ElasticDirection, ElasticParameter};
pub use cache::{Cache, CacheWarning, Cached, Origin, Usage};
pub use coefficient_table::CoefficientTable;
pub use element::{direct, love};
pub use error::InfluenceError;
pub use filter::{PeriodicFilter, PeriodicSymbol};
pub use operator::{
    ConvolutionOperator, DenseOperator, ElasticOperator, PeriodicOperator, ScatteredOperator,
    WindowOperator, scattered_work,
};
pub use radial::{CoefficientDerivative, RadialTables};
pub use sector::{Sector, SectorGrid};
pub use subsurface::{
    CentreStresses, Depth, ElementDepths, ElementFields, ElementLoads, LayerColumn,
    LayerCompression, PlaneFields, RoughDepths, Squares, SubsurfaceState, SurfaceLoad,
    SurfaceMeans,
};
pub use surface_elasticity::SurfaceElasticity;
