//! Compliance of layered elastic foundations in the wavenumber domain.
//!
//! A [`Foundation`] is any number of elastic layers, bonded, frictionless or on springs ([`Interface`]), on an elastic
//! half-space or on a rigid base. Under a pressure wave `p = p̅ cos kx` its surface moves by `u = u̅ cos kx` with
//!
//! ```text
//! u̅(k) = C(k) p̅(k)      C(k) = 2 (1 − ν₁²) / (E₁ k) · Φ(k)
//! ```
//!
//! `E₁`, `ν₁` belong to the body at the surface. Pressure is positive in compression; `u` and the depth axis point into
//! the body. For a wave in both directions `k = √(k_x² + k_y²)`, and `C` is the factor between the two transforms,
//! whatever the convention of the Fourier transform. Any consistent units will do; the documentation uses SI: `E` in
//! Pa, `k` in 1/m, `C` in m/Pa.
//!
//! [`Foundation::interior`] gives displacements and stresses at every depth, under tractions as well.
//!
//! # Example
//!
//! How much does 2 µm of a hard coating stiffen a steel surface, wave by wave?
//!
//! ```
//! use pellicle_kernel::{Foundation, Material};
//!
//! let coating = Material::new(400e9, 0.2)?;
//! let steel = Material::new(210e9, 0.3)?;
//! let coated = Foundation::coated(2e-6, coating, steel)?;
//! let bare = Foundation::half_space(steel);
//!
//! let ratio = |wavelength: f64| {
//!     let k = 2.0 * std::f64::consts::PI / wavelength;
//!     coated.compliance(k) / bare.compliance(k)
//! };
//! // A wave of 1 mm feels the steel, one of 1 µm the coating. What is left is of order k H = 0.013
//! // for the first and of order e^{−2kH} = 1e-11 for the second.
//! assert!((ratio(1e-3) - 1.0).abs() < 0.01);
//! let moduli = steel.plane_strain_modulus() / coating.plane_strain_modulus();
//! assert!((ratio(1e-6) / moduli - 1.0).abs() < 1e-7);
//! # Ok::<(), pellicle_kernel::KernelError>(())
//! ```
//!
//! # Accuracy
//!
//! The relative error of `Φ` is 1.5e-15 for one layer and 4e-15 for stacks (200 layers: 1e-14), that of `Φ − 1` of one
//! layer `2e-15 (1 + 2 k H)`, for moduli in any ratio from 1e-6 to 1e6, `ν` from 0 to 0.5 and every `k`. It was
//! measured against data of 20 and 40 digits (`tests/reference.rs`), and three independent methods agree
//! (`tests/agreement.rs`). States inside are accurate to 1e-13 of their larger components
//! (`tests/interior_reference.rs`, `tests/dense.rs`). No special cases need to be avoided: `ν = 0.5`, equal materials,
//! `k → 0` and `k → ∞` are limits that the formulas reach.
//!
//! # Where to start reading
//!
//! `response/minors.rs` holds the central idea of the crate: the bodies below a plane as five numbers.

mod asymptotics;
mod derivative;
mod direction;
mod error;
mod foundation;
mod graded;
mod interface;
mod interior;
mod layer;
mod material;
mod paper_notation;
mod parameter;
mod response;
mod transformed_system;
mod wave;

pub use asymptotics::{LongWaves, ShortWaves};
pub use derivative::ResponseDerivative;
pub use direction::FoundationDirection;
pub use error::KernelError;
pub use foundation::Foundation;
pub use graded::{GradedLayer, GradingOptions, SplitLayer};
pub use interface::{Interface, Spring};
pub use interior::{Amplitudes, Antiplane, InPlane, Interior, Side};
pub use layer::{Base, Layer};
pub use material::Material;
pub use paper_notation::{TwoLayer, load_transform};
pub use parameter::FoundationParameter;
pub use transformed_system::TransformedSystem;

/// The README, whose examples are documentation tests of this crate.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
